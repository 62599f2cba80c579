"""The comparison lemma for scalar differential inequalities v' ≤ φ(τ, v).

If v' ≤ φ(τ, v) and u' ≥ φ(τ, u) on [τ₀, τ₁], v(τ₀) ≤ u(τ₀), and φ is continuous in τ and locally Lipschitz in
its second argument, then v ≤ u on [τ₀, τ₁] (Khalil, Nonlinear Systems, Lemma 3.4, for the rate φ + δ with
δ(τ) = u' − φ(τ, u) ≥ 0, which v' satisfies as well and u solves). What is checked here is every hypothesis of
it: that the inequality is assumed on the whole of [τ₀, τ], that u solves the equation (exact algebra) or rises
faster (z3), starts at v(τ₀) or above, stays where φ is Lipschitz, and is regular on the interval together with φ; the
rest of the bound is a real inequality.

Where φ is not Lipschitz at 0, as v^q with q < 1, u has to be positive on the interval, and φ a combination of powers of
its second argument. If v(τ₁) > u(τ₁), let τ₂ be the last time before with v ≤ u. There v = u > 0, and from there on to
τ₁ both lie between two positive numbers, where φ is Lipschitz; so (v − u)' ≤ φ(τ, v) − φ(τ, u) ≤ L(v − u), and v − u
stays at or below 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.claim import Goal, engine
from ptproof.proof.declarations import is_plainly_real
from ptproof.proof.engines.lipschitz import is_lipschitz, is_polynomial
from ptproof.proof.engines.quantified import at_point, instances, mask_positive
from ptproof.proof.engines.reals import follows
from ptproof.proof.factors import factored
from ptproof.proof.facts import Fact, usable
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import ForAll, Implication, Relation, ge, gt, le, relations_of
from ptproof.proof.substitution import BINDERS
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "comparison lemma"
_REGULAR = (sp.Symbol, sp.Number, sp.NumberSymbol, sp.Add, sp.Mul, sp.Pow, sp.exp, sp.sin, sp.cos, sp.atan, sp.tanh)


@engine
def comparison(
    goal: Goal, solution: sp.Expr, *, denominators: Sequence[sp.Expr] = (), lemmas: Sequence[Fact] = ()
) -> Evidence:
    """Show ``v(τ) ≤ bound`` from the goal's assumption ``Derivative(v(s), s) ≤ φ(s, v(s))`` for all s.

    Parameters
    ----------
    goal
        Its statement is v(τ) ≤ bound(τ); among its assumptions are the differential inequality as a
        :class:`ForAll` over one time s whose domain has s ≥ τ₀, and that τ ≥ τ₀.
    solution
        u as an expression in the same time as the assumption and in v(τ₀): u' = φ(s, u), or u' ≥ φ(s, u).
    denominators
        Expressions in s whose positivity on the whole of [τ₀, τ] makes u defined there; each is shown positive
        from the goal's assumptions.
    lemmas
        Facts for the real inequalities.
    """
    reasons = []
    for cases in _cases(goal):
        try:
            details = [_check(goal, solution, denominators, lemmas, first) for first in cases]
        except _Failed as failure:
            reasons.append(str(failure))
            continue
        return Evidence(ENGINE, Verdict.PROVED, details[0], facts=(*lemmas, *_at_the_ends(goal)))
    return Evidence(ENGINE, Verdict.UNDECIDED, reasons[0])


class _Failed(Exception):
    """A hypothesis of the lemma that could not be shown."""


@dataclass(frozen=True)
class _Interval:
    """What is known at an arbitrary time of [τ₀, τ]."""

    s: sp.Symbol
    known: tuple[Relation, ...]
    facts: tuple[Implication, ...]

    def positive(self, expression: sp.Expr) -> bool:
        return bool(expression.is_positive) or follows(gt(expression, 0), self.known, self.facts).shown


def _cases(goal: Goal) -> list[tuple[sp.Expr, ...]]:
    """What v(τ₀) may be, in one case or in two: of what is not negative, 0 may have to be looked at by itself."""
    positive = sp.Dummy("v0", positive=True)
    try:
        inequality, _, v = _differential_inequality(goal, _bounded(goal).left)
    except _Failed:
        return [(sp.Dummy("v0", real=True),)]
    if _signed(goal, v, "positive", inequality):
        return [(positive,)]
    if _signed(goal, v, "nonnegative", inequality):
        return [(positive, sp.S.Zero), (sp.Dummy("v0", nonnegative=True),)]  # of powers of what may be 0 less is known
    return [(sp.Dummy("v0", real=True),)]


def _at_the_ends(goal: Goal) -> list[Fact]:
    """What the goal assumes for all times, at both ends: by this the bound may be defined."""
    inequality, s, _ = _differential_inequality(goal, _bounded(goal).left)
    return instances(goal, _initial_time(inequality, s), _bounded(goal).left.args[0])


def _bounded(goal: Goal) -> Relation:
    (statement,) = relations_of(goal.statement)
    if statement.sign != "<=" or not isinstance(statement.left, AppliedUndef):
        raise _Failed(f"not of the form v(time) <= bound: {statement}")
    return statement


def _check(
    goal: Goal, solution: sp.Expr, denominators: Sequence[sp.Expr], lemmas: Sequence[Fact], first: sp.Expr
) -> str:
    statement = _bounded(goal)
    at = statement.left
    inequality, s, v = _differential_inequality(goal, at)
    start, end = _initial_time(inequality, s), at.args[0]
    initial = v.subs(s, start)

    def read(item: Relation) -> Relation:
        return item.map(lambda side: _at(side, initial, first))

    facts = tuple(_map(fact, read) for fact in usable(goal, (*goal.facts, *lemmas)))
    outside = tuple(read(item) for item in goal.relations)
    if not follows(ge(end, start), outside, facts).shown:
        raise _Failed(f"nothing says that {end} >= {start}")
    interval = _interval(goal, inequality, s, (start, end), outside, facts, read)
    for denominator in denominators:
        if not interval.positive(_at(denominator, initial, first)):
            raise _Failed(f"{denominator} > 0 is not shown on the whole interval")

    u = _at(solution, initial, first)
    hints = [_at(item, initial, first) for item in denominators]
    above = _above(u, interval, hints)
    value = sp.Dummy("v", positive=True) if above else (
        sp.Dummy("v", real=True) if first.is_nonnegative is None else sp.Dummy("v", nonnegative=True))  # fmt: skip
    phi = _at(inequality.relation.right, v, value)
    if phi.has(AppliedUndef):
        raise _Failed("the rate depends on the function otherwise than through its value")
    if not is_lipschitz(phi, value):
        raise _Failed(f"the rate {inequality.relation.right} is not recognised as locally Lipschitz in {v}")
    _regular(phi, interval, hints, choices=(sp.Max, sp.Min))  # the rate has to be continuous, the solution smooth
    _regular(u, interval, hints)
    if value.is_nonnegative and not above and not is_polynomial(phi, value):
        _stays(u, interval)
    how = _solves(u, _at(phi, value, u), interval, hints, solution)
    begin = _at(u, s, start)
    if not vanishes(begin - first) and not follows(ge(begin, first), outside, facts).shown:
        raise _Failed(f"{solution} does not start at {initial}, nor above it")
    bound, reached = _at(statement.right, initial, first), _at(u, s, end)
    if any(item.has(sp.nan, sp.zoo, sp.oo) for item in (bound, u, phi)):
        raise _Failed(f"{solution} or the bound has no value where {initial} is {first}")
    if not vanishes(bound - reached):
        below = follows(ge(bound, reached), outside, facts)
        if not below.shown:
            raise _Failed(f"the solution of the equation is not shown to stay below the bound: {below.how}")
    return f"u = {solution} {how}, starts at or above {initial}, and is defined on the whole interval"


def _at(expression: sp.Expr, letter: sp.Expr, value: sp.Expr) -> sp.Expr:
    """The expression with the value of a letter; where nothing is bound, ``subs`` would look for it for longer."""
    return expression.subs(letter, value) if expression.has(*BINDERS) else expression.xreplace({letter: value})


def _differential_inequality(goal: Goal, at: AppliedUndef) -> tuple[ForAll, sp.Symbol, AppliedUndef]:
    for item in goal.assumptions:
        if isinstance(item, ForAll) and len(item.variables) == 1 and item.relation.sign == "<=":
            (s,) = item.variables
            v = at.func(s)
            if item.relation.left == sp.Derivative(v, s):
                if not is_plainly_real(s):
                    raise _Failed(f"{s} is not declared to be any real number: the inequality may have gaps")
                return item, s, v
    raise _Failed(f"no assumption of the form Derivative({at.func}(s), s) <= rate")


def _initial_time(inequality: ForAll, s: sp.Symbol) -> sp.Expr:
    for part in inequality.domain:
        if part.sign == ">=" and part.left == s:
            return part.right
    raise _Failed(f"the domain of {inequality} does not begin with {s} >= a time")


def _interval(
    goal: Goal, inequality: ForAll, s: sp.Symbol, ends: tuple[sp.Expr, sp.Expr], outside: tuple[Relation, ...],
    facts: tuple[Implication, ...], read: Callable[[Relation], Relation],
) -> _Interval:  # fmt: skip
    """What holds on [τ₀, τ]; the inequality has to be assumed on all of it."""
    if any(item.has(s) for item in outside):
        raise _Failed(f"{s} is bound in the differential inequality and free in an assumption")
    known = [ge(s, ends[0]), le(s, ends[1]), *outside]
    for part in inequality.domain:
        if not follows(part, known, facts).shown:
            raise _Failed(
                f"the inequality is assumed for {part} only, which is not shown between {ends[0]} and {ends[1]}"
            )
    for item in goal.assumptions:
        if isinstance(item, ForAll) and item is not inequality and not item.relation.left.has(sp.Derivative):
            there = at_point(item, s, known, facts)
            if there is not None:
                known.append(read(there))
    return _Interval(s, tuple(known), facts)


def _signed(goal: Goal, v: AppliedUndef, sign: str, inequality: ForAll) -> bool:
    if getattr(v, f"is_{sign}"):
        return True
    wanted = gt(v, 0) if sign == "positive" else ge(v, 0)
    # The sign is needed at every time of the interval, on all of which the inequality is shown to be assumed.
    return any(
        isinstance(item, ForAll) and item.relation == wanted and item.variables == inequality.variables
        and set(item.domain) <= set(inequality.domain) for item in goal.assumptions
    )  # fmt: skip


def _above(u: sp.Expr, interval: _Interval, hints: Sequence[sp.Expr]) -> bool:
    """Whether u is shown to be positive on the whole interval; the ``hints`` were shown positive there."""
    masks = {item: sp.Dummy(f"D{i}", positive=True) for i, item in enumerate(hints)}
    return bool(mask_positive(u.xreplace(masks), interval.known, interval.facts).is_positive)


def _stays(u: sp.Expr, interval: _Interval) -> None:
    if mask_positive(u, interval.known, interval.facts).is_nonnegative:
        return
    if not follows(ge(u, 0), interval.known, interval.facts).shown:
        raise _Failed(f"{u} is not shown to stay at or above 0, where the rate is defined")


def _solves(u: sp.Expr, rate: sp.Expr, interval: _Interval, hints: Sequence[sp.Expr], solution: sp.Expr) -> str:
    slope = sp.diff(u, interval.s)
    # A denominator that was shown positive becomes a positive symbol, so that its powers can be split off.
    masks = {item: sp.Dummy(f"D{i}", positive=True) for i, item in enumerate(hints)}

    def mask(item: Relation) -> Relation:
        return item.map(lambda side: side.xreplace(masks))

    if vanishes((slope - rate).xreplace(masks)) or vanishes(slope - rate):  # the quicker of the two first
        return "solves the equation"
    known = [mask(item) for item in interval.known] + [Relation(symbol, "=", item) for item, symbol in masks.items()]
    facts = [_map(fact, mask) for fact in interval.facts]
    if follows(mask(ge(slope, rate)), known, facts).shown:
        return "rises at least as fast as the equation asks"
    raise _Failed(f"{solution} neither solves the equation nor stays above it")


def _map(fact: Implication, change: Callable[[Relation], Relation]) -> Implication:
    return Implication(tuple(map(change, fact.hypotheses)), change(fact.conclusion), fact.source)


def _regular(
    expression: sp.Expr, interval: _Interval, hints: Sequence[sp.Expr], choices: tuple[type, ...] = ()
) -> None:
    """No pole and no root of a negative number on the interval: every such base is shown positive there."""
    shown = {factored(item) for item in hints}
    for node in sp.preorder_traversal(expression):
        if not node.has(interval.s):
            continue
        if not isinstance(node, _REGULAR + choices):
            raise _Failed(f"{node} is not known to be regular in {interval.s}")
        if not isinstance(node, sp.Pow) or (node.exp.is_integer and node.exp.is_nonnegative):
            continue
        base = factored(node.base)
        numerator, denominator = sp.fraction(base)
        if denominator.has(interval.s) and not interval.positive(denominator):
            raise _Failed(f"{denominator} may vanish, and nothing shows that it is positive")
        moving = numerator.has(interval.s) or node.exp.has(interval.s)
        if base in shown or not moving or interval.positive(numerator):
            continue
        if not interval.positive(base):
            raise _Failed(f"{base} may vanish, and nothing shows that it is positive")
