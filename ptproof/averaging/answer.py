"""What is known of the average of one dither system, and the comparison with what its author claims."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.average import Pair
from ptproof.averaging.brackets import Vector
from ptproof.averaging.coefficients import Coefficients
from ptproof.averaging.ledger import Ledger
from ptproof.averaging.orders import Orders
from ptproof.averaging.powers import PoweredProblem
from ptproof.averaging.problem import DitherProblem
from ptproof.averaging.second import Letters, PoweredAverage
from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.settling import settle
from ptproof.proof.statement import Relation
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
    def as_expected(self) -> bool:
        """Covered by the theorem, the author's claim, if any, proved, and orders, if asked for, found and checked."""
        claimed = self.expected is None or self.expected.verdict is Verdict.PROVED
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
        expected = None
        if self.expected is not None:
            witness = self.expected.witness
            expected = {"verdict": str(self.expected.verdict), "witness": witness and witness.to_json()}
        found = {
            "average": None if self.system is None else [str(entry) for entry in self.system.rhs],
            "v": {f"{j},{i}": str(value) for (j, i), value in self.v.items()},
            "assumptions": self.ledger.to_json(),
            "expected": expected,
        }
        if isinstance(self.problem, PoweredProblem):
            return found | {"order": self.problem.order, **self._powers()}
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


def compare(system: System, expected: Vector, domain: Sequence[Relation] = ()) -> Evidence:
    """Whether the right-hand side of ``system`` equals ``expected`` on the domain, with a witness where it does not.

    proved: the difference has the normal form 0. refuted: exact values (polynomials for undefined functions) at
    which the two sides are apart. What is asked is that they agree wherever both are defined. The two sides are
    compared as given; neither is computed from the other.
    """
    both = Relation(sp.Matrix(system.rhs), "=", sp.Matrix(list(expected)))
    goal = Goal("expected average", both, tuple(domain), where_defined=True)
    return settle(goal, exact)
