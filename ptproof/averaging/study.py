"""Everything about the average of one dither system: the result, its hypotheses, and the author's claims."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.attack import attack_powered, unshaken
from ptproof.averaging.average import Pair, derive
from ptproof.averaging.brackets import Vector
from ptproof.averaging.coefficients import Coefficients, v_matrix
from ptproof.averaging.expected import Expectation, compare, of_orders, open_ones, summary
from ptproof.averaging.ledger import Ledger, examine
from ptproof.averaging.orders import Orders, average_to_order
from ptproof.averaging.powered_ledger import CONDITIONS, examine_powered
from ptproof.averaging.powers import PoweredProblem, PoweredSystem
from ptproof.averaging.problem import DitherProblem
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, unless_refused
from ptproof.averaging.scaled import linear
from ptproof.averaging.second import Letters, PoweredAverage
from ptproof.errors import InputError
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import DitherSystem, System


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


def study(problem: DitherProblem | DitherSystem | PoweredProblem | PoweredSystem, order: int | None = None) -> Average:
    """Average a dither system and say which hypotheses of the theorem hold (thm:SPLBave, ass:singular_ass).

    Parameters
    ----------
    problem
        With fast states, a region and a claimed average, or a dither system alone. With ``mu_omega`` the average is the
        one at this fixed product of μ and ω, not its limit at 0. With powers of the frequency it is the limit of first
        or second order (:mod:`ptproof.averaging.second`).
    order
        The order in 1/√ω up to which averages are asked for; None for the average alone, and for as many as
        ``problem.expected_orders`` speaks of.

    Returns
    -------
    Average
        Where a hypothesis is refuted there is no averaged system, and ``refusals`` says why and where. What is
        undecided is listed in ``caveats``; then the average is the theorem's if these hold.

    Examples
    --------
    >>> import sympy as sp
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> found = study(DitherProblem(seeker, expected=(sp.diff(F, x),)))
    >>> found.refusals, str(found.expected.verdict)
    ((), 'refuted')
    """
    if isinstance(problem, PoweredSystem | PoweredProblem):
        if order is not None:
            raise InputError("order: orders in 1/sqrt(omega) are for systems without powers of omega")
        return study_powered(PoweredProblem(problem) if isinstance(problem, PoweredSystem) else problem)
    if isinstance(problem, DitherSystem):
        problem = DitherProblem(problem)
    asked, ledger = problem.expected, _filter_of(problem) or examine(problem)

    def without(v: Coefficients, reason: str) -> Average:
        expected = None if asked is None else Evidence("average", Verdict.UNDECIDED, reason)
        return Average(problem, None, v, {}, ledger, expected, higher=open_ones(problem.expected_orders, reason))

    if "mu_omega" in ledger.entries:
        return without({}, "there is no average to compare with")
    known = all(ledger.entries[letter].verdict is Verdict.PROVED for letter in ("form", "D"))
    solved = problem.fast is None or ledger.steady is not None
    if ledger.verdict is Verdict.REFUTED or not (known and solved):
        return without(v_matrix(problem.system) if known else {}, "there is no average to compare with")
    try:
        derived = unshaken(derive(problem.reduced(ledger.steady or ())), points=2, coefficients=0)
    except (AveragingRefused, AveragingUndecided) as error:
        return without({}, str(error))
    orders, reason = _orders(problem, max((order or 0, *problem.expected_orders)) or None)
    system = derived.system
    if problem.mu_omega is not None:
        if orders is None:
            return replace(without(derived.v, reason), unexpanded=reason)
        system = replace(system, rhs=orders.averages[0], parameters=None)
    expected = None if asked is None else compare(system.rhs, asked, problem.domain)
    higher = of_orders(orders, problem, reason)
    return Average(problem, system, derived.v, derived.brackets, ledger, expected, orders, reason, higher)


def _filter_of(problem: DitherProblem) -> Ledger | None:
    """Why fast states cannot keep their own dynamics, where they should: nothing else has to be asked then."""
    if problem.mu_omega is None or problem.fast is None:
        return None
    fast = problem.fast
    found = unless_refused("linear", lambda: linear(fast), "")
    return None if found.verdict is Verdict.PROVED else Ledger({"mu_omega": found}, None)


def _orders(problem: DitherProblem, order: int | None) -> tuple[Orders | None, str]:
    """The average to the order that is asked for, or why there is none."""
    if order is None and problem.mu_omega is None:
        return None, ""
    try:
        return average_to_order(problem, 1 if order is None else order), ""
    except (AveragingRefused, AveragingUndecided) as error:
        return None, str(error)


def study_powered(problem: PoweredProblem) -> Average:
    """The limit, if all that it rests on is not refuted, with the ledger of hypotheses.

    A refuted condition on powers (``2.1`` to ``2.3``) stands in the ledger and among the notes; where the limit is
    shown all the same, the average is that limit.
    """
    ledger, found = examine_powered(problem)
    broken = [letter for letter in ledger.with_verdict(Verdict.REFUTED) if letter not in CONDITIONS]
    if found is None or broken:
        reason = "there is no average to compare with"
        expected = None if problem.expected is None else Evidence("average", Verdict.UNDECIDED, reason)
        return Average(problem, None, {} if found is None else found.v, {}, ledger, expected)
    attack_powered(found, points=2)
    domain = problem.plain.domain
    free = set().union(*(entry.free_symbols for entry in (*found.system.rhs, *(problem.expected or ()))))
    if any(power.free_symbols & free for power in problem.system.powers):
        domain = (*domain, *problem.system.exponents.relations)
    expected = None if problem.expected is None else compare(found.system.rhs, problem.expected, domain)
    return Average(problem, found.system, found.v, found.brackets, ledger, expected, powered=found)
