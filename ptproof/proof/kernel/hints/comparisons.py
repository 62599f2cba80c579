"""Bounds that follow from differential inequalities: for Coq, by its library's comparison lemmas.

An assumption ``Derivative(U(s), s) <= f`` for all s of a domain gives a bound of U(q) by U(p) for every two times
p <= q of the domain at which the claim speaks of U.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.claim import Claim
from ptproof.proof.kernel.hints.certificates import certificate
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.refuted import by_refutation, follows
from ptproof.proof.kernel.hints.views import view
from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import ForAll, Relation, RelationSign, expressions_of, plain

Compared = tuple[Relation, str]


@dataclass(frozen=True)
class Rate:
    """``U' <= rate`` at every ``time`` of the ``domain``; ``said`` are the claim's expressions."""

    function: AppliedUndef
    time: sp.Symbol
    rate: sp.Expr
    domain: tuple[Relation, ...]
    known: tuple[Relation, ...]
    said: tuple[sp.Expr, ...]
    names: Names

    @property
    def plain(self) -> tuple[Relation, ...]:
        """What is known of plain symbols."""
        return tuple(item for item in self.known if not item.has(AppliedUndef))

    def at(self, time: sp.Expr) -> sp.Expr:
        """The function's value at a time."""
        return self.function.xreplace({self.time: time})

    def write(self, expression: sp.Basic) -> str:
        return term(expression, self.names)

    def as_said(self, expression: sp.Expr) -> sp.Expr:
        """The expression with powers and exponentials as the claim writes them."""
        kinds = (sp.Pow, sp.exp)
        said = [part for item in self.said for part in item.atoms(*kinds) if not part.is_rational_function()]
        found: dict[sp.Basic, sp.Basic] = {}
        for part in sorted(expression.atoms(*kinds), key=sp.count_ops):
            mine = part.xreplace(found)
            for other in said:
                pairs = zip(mine.args, other.args, strict=False)
                if other.func is mine.func and all(a == b or sp.simplify(a - b) == 0 for a, b in pairs):
                    found[part] = other
                    break
        for part in sorted(found, key=sp.count_ops, reverse=True):
            expression = expression.xreplace({part: found[part]})
        return expression


# Bounds from a rate between two times.
Comparing = Callable[[Rate, sp.Expr, sp.Expr], Iterator[Compared]]


def compared(
    claim: Claim, known: Sequence[Relation], names: Names, others: Sequence[Comparing] = ()
) -> Iterator[Compared]:  # fmt: skip
    """The bounds, each with the line by which Coq finds it; by ``others`` than those of this module, too."""
    for rate, _ in rates(claim, known, names):
        for start, end in _times(rate):
            for way in (_integral, _decay, *others):
                with contextlib.suppress(NoTranslation, sp.PolynomialError):
                    yield from way(rate, start, end)


def solved(claim: Claim, known: Sequence[Relation], names: Names) -> Iterator[Compared]:
    """What solutions of linear differential equations are, each with the line by which Coq finds it."""
    for rate, sign in rates(claim, known, names):
        if sign == "=":
            for start, end in _times(rate):
                with contextlib.suppress(NoTranslation, sp.PolynomialError):
                    yield from _solution(rate, start, end)


def rates(claim: Claim, known: Sequence[Relation], names: Names) -> Iterator[tuple[Rate, RelationSign]]:
    """The differential equations and inequalities that the claim assumes."""
    statements = [claim.statement, *claim.assumptions]
    said = tuple(expressions_of(statements))
    for item in claim.assumptions:
        if not (isinstance(item, ForAll) and isinstance(item.relation, Relation) and len(item.variables) == 1):
            continue
        relation, time = item.relation.standard(), item.variables[0]
        if not isinstance(relation.left, sp.Derivative) or relation.left.variables != (time,):
            continue
        if not isinstance(relation.left.expr, AppliedUndef) or relation.right.has(sp.Derivative, sp.Integral):
            continue
        rate = Rate(relation.left.expr, time, relation.right, plain(item.domain), tuple(known), said, names)
        yield rate, relation.sign


def _times(rate: Rate) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    calls = {call for item in rate.said for call in item.atoms(AppliedUndef) if call.func == rate.function.func}
    times = sorted({call.args[0] for call in calls if not call.has(rate.time)}, key=sp.default_sort_key)
    seen = view(rate.plain)

    def shown(gap: sp.Expr) -> bool:
        goal = Goal(Relation(gap, ">=", sp.S.Zero), rate.plain, rate.names)
        return bool(sp.expand(seen.of(gap)).is_nonnegative or follows(goal))

    for start in times:
        for end in times:
            inside = [item.standard().map(lambda side, at=at: side.subs(rate.time, at))  # type: ignore[misc]
                      for item in rate.domain for at in (start, end)]  # fmt: skip
            gaps = [end - start, *(item.right - item.left for item in inside)]
            if start != end and all(map(shown, gaps)):
                yield start, end


def _linear(rate: Rate) -> tuple[sp.Expr, sp.Expr]:
    """a and b of the rate a U + b.

    Raises
    ------
    NoTranslation
        If it is not of this form.
    """
    value = sp.Dummy("u", real=True)
    expression = rate.rate.xreplace({rate.function: value})
    a = sp.diff(expression, value)
    if a.has(value):
        raise NoTranslation("not linear")
    return a, expression.xreplace({value: sp.Integer(0)})


def primitive_of(rate: Rate, function: sp.Expr) -> sp.Expr:
    """An antiderivative in the rate's time.

    Raises
    ------
    NoTranslation
        If none is found.
    """
    found = sp.Integer(0)
    for part in sp.Add.make_args(sp.expand_mul(function, deep=False)):
        constant, rest = part.as_independent(rate.time, as_Add=False)
        integral = sp.integrate(sp.factor(sp.together(rest)), rate.time)
        if integral.has(sp.Integral, sp.Piecewise, sp.log):
            raise NoTranslation("no antiderivative")
        found += constant * sp.factor(integral)
    return found


def in_order(rate: Rate, start: sp.Expr, end: sp.Expr) -> str:
    """Tactics for that the start comes first."""
    ways = [f"solve [ {line} ]" for line in by_refutation(Goal(Relation(start, "<=", end), rate.plain, rate.names))]
    return f"first [ {' | '.join(['bound', *ways])} ]"


def asserted(
    rate: Rate, end: sp.Expr, bound: sp.Expr, lemma: str, steps: Sequence[str], exact: str, same: str = "same"
) -> Compared:  # fmt: skip
    """The bound at the end, by a lemma of which the conclusion says ``exact``."""
    left = rate.at(end)
    line = (f"assert ({rate.write(left)} <= {rate.write(bound)}); [ apply Rle_trans with {exact}; "
            f"[ apply {lemma}; [ {' | '.join(steps)} ] | {same} ] | ]")  # fmt: skip
    return Relation(left, "<=", bound), line


def _integral(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """U(p) and the integral of a rate without U; or U(p) by e to the integral of a, where the rate is a U."""
    if (found := _integrated(rate, start, end)) is not None:
        bound, exact, word, arguments, closing = found
        lemma = f"({'integral' if word == '+' else 'exponential'}_bound {arguments})"
        name = rate.names[rate.time]
        order = in_order(rate, start, end)
        steps = [order, f"cbv beta; rate_is {rate.names[rate.function.func]} {name} ltac:(same)", closing]
        yield asserted(rate, end, bound, lemma, steps, exact)


def _solution(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """The same for an equation."""
    if (found := _integrated(rate, start, end)) is not None:
        bound, exact, word, arguments, closing = found
        lemma = f"({'is_integral' if word == '+' else 'is_exponential'} {arguments})"
        left = rate.at(end)
        rated = f"cbv beta; rate_equals {rate.names[rate.function.func]} {rate.names[rate.time]}"
        steps = f"{in_order(rate, start, end)} | {rated} | {closing}"
        line = (f"assert ({rate.write(left)} = {rate.write(bound)}) by (apply eq_trans with {exact}; "
                f"[ apply {lemma}; [ {steps} ] | first [ rational | same_values; rational ] ])")  # fmt: skip
        yield Relation(left, "=", bound), line


def _integrated(rate: Rate, start: sp.Expr, end: sp.Expr) -> tuple[sp.Expr, str, str, str, str] | None:
    """The value at the end, how the lemmas write it, what they join it by, their arguments, and the last step."""
    alone = not rate.rate.has(rate.function)
    slope, rest = (rate.rate, sp.S.Zero) if alone else _linear(rate)
    if rest != 0:
        return None
    primitive, name, first = primitive_of(rate, slope), rate.names[rate.time], rate.at(start)
    F, f = (f"(fun {name} : R => {rate.write(item)})" for item in (primitive, slope))
    p, q, U = rate.write(start), rate.write(end), rate.names[rate.function.func]
    grown = primitive.subs(rate.time, end) - primitive.subs(rate.time, start)
    bound, word = (first + grown, "+") if alone else (rate.as_said(first * sp.exp(grown)), "* exp")
    exact = f"({rate.write(first)} {word} ({F} {q} - {F} {p}))"
    return bound, exact, word, f"{U} {F} {f} {p} {q}", f"cbv beta; antiderivative {U} {name}"


def _decay(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """The level at which the rate b - c U balances, and U(p) decayed; b at its greatest."""
    a, b = _linear(rate)
    c = -a
    if not c.is_positive or c.has(rate.time) or b == 0:
        return
    level, tactic = greatest(rate, b, c, start, end)
    bound = rate.as_said(level / c + rate.at(start) * sp.exp(sp.expand(-c * (end - start))))
    p, q, U, name = rate.write(start), rate.write(end), rate.names[rate.function.func], rate.names[rate.time]
    words = " ".join(map(rate.write, (level, c, rate.at(start))))
    steps = ["bound", "sign", "sign", "bound", f"rate_is {U} {name} ltac:({tactic})"]
    exact = (f"({rate.write(level)} / {rate.write(c)} + {rate.write(rate.at(start))} * "
             f"exp (- ({rate.write(c)} * ({q} - {p}))))")  # fmt: skip
    yield asserted(rate, end, bound, f"(decay_bound {U} {p} {q} {words})", steps, exact)


def greatest(
    rate: Rate, b: sp.Expr, taken: sp.Expr, start: sp.Expr, end: sp.Expr, of: sp.Expr | None = None
) -> tuple[sp.Expr, str]:
    """A bound of b between the times, and how Coq sees that the rate is below ``bound - taken U``, or a power of U.

    Raises
    ------
    NoTranslation
        If b is not seen to be greatest at the start.
    """
    if not b.has(rate.time):
        return b, "same"
    level = b.subs(rate.time, start)
    inside = [Relation(start, "<=", rate.time), Relation(rate.time, "<=", end)]
    outside = [item.standard().map(lambda side: side.subs(rate.time, start)) for item in rate.domain]
    known = [*rate.known, *(item for item in outside if item.left != item.right), *inside]
    goal = Relation(rate.rate, "<=", level - taken * (rate.function if of is None else of))
    for text in certificate(goal, known, rate.names):
        return level, text
    raise NoTranslation("the rate is not seen to be greatest at the start")
