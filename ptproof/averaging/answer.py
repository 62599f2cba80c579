"""What is known of the average of one dither system, and what became of what its author claims."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.average import Pair
from ptproof.averaging.brackets import Vector
from ptproof.averaging.coefficients import Coefficients
from ptproof.averaging.expected import Expectation, summary
from ptproof.averaging.ledger import Ledger
from ptproof.averaging.orders import Orders
from ptproof.averaging.powers import PoweredProblem
from ptproof.averaging.problem import DitherProblem
from ptproof.averaging.second import Letters, PoweredAverage
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import System


@dataclass(frozen=True)
class Average:
    """The outcome of :func:`ptproof.averaging.study`.

    Attributes
    ----------
    problem
        What was asked.
    system
        The Lie bracket system, or None where the theorem does not cover the problem (see ``refusals``) or no
        exact average is known.
    v
        {(j, i): v_ji} for all pairs i < j; empty where form, period or mean are not as they should be.
    brackets
        {(i, j): [b_i, b_j]} for the pairs with v_ji ≠ 0, at the quasi-steady state; with powers of the frequency, those
        that count, also {(i, j, m): [[f_i, f_j], f_m]}.
    ledger
        The hypotheses, each with its verdict.
    expected
        Whether the average that the author claims is right; None if nothing was claimed.
    orders
        The average to the order that was asked for, checked; None where none was asked for or ``unexpanded`` says why
        there is none.
    higher
        What became of the author's claims about the orders from 2 on.
    powered
        Of a system with powers of the frequency, the coefficients γ, the brackets that count, and why.
    """

    problem: DitherProblem | PoweredProblem
    system: System | None
    v: Coefficients
    brackets: Mapping[Pair, Vector] | Mapping[Letters, Vector]
    ledger: Ledger
    expected: Evidence | None = None
    orders: Orders | None = None
    unexpanded: str = ""
    higher: tuple[Expectation, ...] = ()
    powered: PoweredAverage | None = None

    @property
    def refusals(self) -> tuple[str, ...]:
        """Why the theorem does not cover the problem: one sentence for each refuted hypothesis."""
        return () if self.powered is not None else self.ledger.details(Verdict.REFUTED)

    @property
    def notes(self) -> tuple[str, ...]:
        """What the cited theorem asks and is not so, where the average was shown to be the limit without it."""
        if self.powered is None or self.system is None:
            return ()
        return self.ledger.details(Verdict.REFUTED)

    @property
    def caveats(self) -> tuple[str, ...]:
        """What the average rests on beyond what was shown: one sentence for each undecided hypothesis."""
        found = self.ledger.details(Verdict.UNDECIDED)
        if self.orders is not None and self.orders.smooth.verdict is not Verdict.PROVED:
            found += (f"order {self.orders.order}: {self.orders.smooth.detail}",)
        return found

    @property
    def gradient(self) -> tuple[sp.Expr, AppliedUndef] | None:
        """(c, F) where Σ [b_i, b_j] v_ji = c ∇F, with c free of states, for an undefined function F of the states."""
        plain = self.problem.plain if isinstance(self.problem, PoweredProblem) else self.problem
        drift, fast = plain.system.drift, plain.fast
        if self.system is None or (fast is not None and any(set(fast.state) & entry.free_symbols for entry in drift)):
            return None
        added = [entry - start for entry, start in zip(self.system.rhs, drift, strict=True)]
        for applied in sorted(set().union(*(entry.atoms(AppliedUndef) for entry in added)), key=str):
            slopes = [sp.diff(applied, symbol) for symbol in self.system.state]
            if not slopes[0].has(sp.Derivative):
                continue
            factor = sp.cancel(added[0] / slopes[0])
            if factor.free_symbols & set(self.system.state) or factor.has(sp.Derivative):
                continue
            if all(sp.expand(entry - factor * slope) == 0 for entry, slope in zip(added, slopes, strict=True)):
                return factor, applied
        return None

    @property
    def expectations(self) -> tuple[Expectation, ...]:
        """All that the author claims, order by order."""
        if self.expected is None or self.problem.expected is None:
            return self.higher
        derived = None if self.system is None else self.system.rhs
        return (Expectation(1, self.problem.expected, derived, self.expected), *self.higher)

    @property
    def as_expected(self) -> bool:
        """Covered by the theorem, the author's claims, if any, proved, and orders, if asked for, found and checked."""
        claimed = all(found.evidence.verdict is Verdict.PROVED for found in self.expectations)
        checked = self.orders is None or (
            self.orders.evidence.verdict is Verdict.PROVED and self.orders.smooth.verdict is not Verdict.REFUTED
        )
        return self.system is not None and claimed and checked and not self.unexpanded

    def latex(self) -> str:
        """The averaged system, as an ``aligned`` block, or a sentence where there is none."""
        if self.system is None:
            return r"\text{no average: " + "; ".join(self.refusals + self.caveats).replace("_", r"\_") + "}"
        return self.system.latex()

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

    def to_json(self) -> dict[str, Any]:
        """As the command ``ptproof average --json`` prints it."""
        found: dict[str, Any] = {
            "average": None if self.system is None else [str(entry) for entry in self.system.rhs],
            "v": {f"{j},{i}": str(value) for (j, i), value in self.v.items()},
            "assumptions": self.ledger.to_json(),
            "expected": summary(self.expectations) if self.expectations else None,
        }
        if isinstance(self.problem, PoweredProblem):
            return found | {"order": self.problem.order, **self._powers()}
        if self.problem.mu_omega is not None:
            found["mu_omega"] = str(self.problem.mu_omega)
        if self.orders is not None:
            return found | self.orders.to_json()
        return found | {"orders": None, "remainder": None} if self.unexpanded else found

    def _powers(self) -> dict[str, Any]:
        assert isinstance(self.problem, PoweredProblem)
        system, gammas = self.problem.system, {} if self.powered is None else self.powered.gammas
        return {
            "powers": [*map(str, system.powers)],
            "conditions": [*map(str, system.conditions)],
            "gamma": {
                ",".join(map(str, letters)): gamma.to_json(system.plain.omega) for letters, gamma in gammas.items()
            },
            "account": [] if self.powered is None else [*self.powered.account],
        }
