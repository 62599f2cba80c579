"""Everything about the average of one dither system: the result, its hypotheses, and the author's claim."""

from __future__ import annotations

from dataclasses import replace

from ptproof.averaging.answer import Average
from ptproof.averaging.attack import attack_powered, unshaken
from ptproof.averaging.average import derive
from ptproof.averaging.coefficients import Coefficients, v_matrix
from ptproof.averaging.expected import compare, of_orders, open_ones
from ptproof.averaging.ledger import Ledger, examine
from ptproof.averaging.orders import Orders, average_to_order
from ptproof.averaging.powered_ledger import CONDITIONS, examine_powered
from ptproof.averaging.powers import PoweredProblem, PoweredSystem
from ptproof.averaging.problem import DitherProblem
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, unless_refused
from ptproof.averaging.scaled import linear
from ptproof.errors import InputError
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import DitherSystem


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
