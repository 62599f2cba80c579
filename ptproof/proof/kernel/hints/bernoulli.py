"""Bounds from Bernoulli's differential inequalities, in which a power of what is bounded stands."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.comparisons import Compared, Rate, asserted, greatest, in_order, primitive_of
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.statement import Relation


def _power_of(rate: Rate) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
    """The power U^r, r, a and b of the rate a U^r + b.

    Raises
    ------
    NoTranslation
        If it is not of this form.
    """
    found = {part for part in rate.rate.atoms(sp.Pow) if part.base == rate.function}
    if len(found) != 1:
        raise NoTranslation("no power")
    power = found.pop()
    value = sp.Dummy("v", real=True)
    expression = rate.rate.xreplace({power: value})
    a, b = sp.diff(expression, value), expression.xreplace({value: sp.Integer(0)})
    if a.has(value) or expression.has(rate.function):
        raise NoTranslation("not a multiple of one power")
    return power, power.exp, a, b


def rated(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """What U(p) becomes at a rate a U^r, whatever the sign of a, which depends on the time."""
    _, r, a, b = _power_of(rate)
    less = sp.factor(sp.together(r - 1))
    if b != 0 or not a.has(rate.time) or not less.is_positive:
        return
    primitive, name, first = primitive_of(rate, a), rate.names[rate.time], rate.at(start)
    grown = primitive.subs(rate.time, end) - primitive.subs(rate.time, start)
    v = rate.as_said(first**less)
    decayed = rate.as_said((1 - less * sp.factor(grown) * v) ** (-1 / less))
    p, q, U = rate.write(start), rate.write(end), rate.names[rate.function.func]
    F, slope = (f"(fun {name} : R => {rate.write(item)})" for item in (primitive, a))
    tail = f"{rate.write(v)} {rate.write(decayed.base)} {rate.write(decayed.exp)}"
    signs = by_refutation(Goal(Relation(sp.S.Zero, "<", decayed.base), rate.known, rate.names))
    ways = ["solve [ sign ]", f"positive_at {q}", *(f"solve [ {line} ]" for line in signs)]
    steps = [
        in_order(rate, start, end), f"first [ lra | difference_as {rate.write(less)} ]", "never_negative",
        f"cbv beta; rate_is {U} {name} ltac:(same_rate)", f"cbv beta; antiderivative {U} {name}",
        "cbv beta; same_power", "cbv beta; rational", "rational", f"first [ {' | '.join(ways)} ]",
    ]  # fmt: skip
    lemma = f"(bernoulli_any_rate_as {U} {F} {slope} {p} {q} {rate.write(r)} {tail})"
    exact = f"(rpow {rate.write(decayed.base)} {rate.write(decayed.exp)} * {rate.write(first)})"
    yield asserted(rate, end, decayed * first, lemma, steps, exact)


def decaying(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """The level at which the rate b - c U^r balances, and what U(p), or a bound of it, decays to without b."""
    power, r, a, b = _power_of(rate)
    if a.has(rate.time) or not (-a).is_positive:
        return
    level, tactic = greatest(rate, b, -a, start, end, power)
    bounds = [
        item.right for item in map(Relation.standard, rate.known) if item.left == rate.at(start) and item.sign != "="
    ]
    for w in (*bounds, rate.at(start)):
        yield _decaying_from(rate, start, end, (level, -a, r, w), tactic)


def _decaying_from(
    rate: Rate, start: sp.Expr, end: sp.Expr, values: tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr], tactic: str
) -> Compared:
    level, c, r, w = values
    less = sp.factor(sp.together(r - 1))
    v = rate.as_said(w**less)
    base = 1 + c * less * v * (end - start)
    decayed = rate.as_said(base ** (-1 / less))
    p, q, U, name = rate.write(start), rate.write(end), rate.names[rate.function.func], rate.names[rate.time]
    rated = f"rate_is {U} {name} ltac:({'same_rate' if tactic == 'same' else tactic})"
    tail = f"{rate.write(v)} {rate.write(decayed.base)} {rate.write(decayed.exp)}"
    power = f"rpow {rate.write(decayed.base)} {rate.write(decayed.exp)} * {rate.write(w)}"
    grows = ["sign", f"first [ lra | difference_as {rate.write(less)} ]", "sign", "bound", rated]
    closing = ["same_power", "rational", "rational"]
    if level == 0:
        steps = ["bound", *grows, *closing]
        lemma = f"(bernoulli_decay_as {U} {p} {q} {rate.write(c)} {rate.write(r)} {rate.write(w)} {tail})"
        return asserted(rate, end, decayed * w, lemma, steps, f"({power})")
    balance = rate.as_said((level / c) ** (1 / r))
    pair = " ".join(map(rate.write, balance.as_base_exp()))
    steps = ["bound", "sign", *grows, "rational", "rational", *closing]
    words = " ".join(map(rate.write, (level, c, r, w)))
    lemma = f"(bernoulli_bound_as {U} {p} {q} {words} {pair} {tail})"
    return asserted(rate, end, balance + decayed * w, lemma, steps, f"(rpow {pair} + {power})")
