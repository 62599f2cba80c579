"""Bounds from Bernoulli's differential inequalities, in which a power of what is bounded stands."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.comparisons import Compared, Rate, asserted, greatest, in_order, primitive_of
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.statement import Relation


def _powers(rate: Rate) -> set[sp.Pow]:
    """The powers of the function in its rate."""
    return {part for part in rate.rate.atoms(sp.Pow) if part.base == rate.function}


def _power_of(rate: Rate) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
    """The power U^r, r, a and b of the rate a U^r + b.

    Raises
    ------
    NoTranslation
        If it is not of this form.
    """
    found = _powers(rate)
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


def rooted(rate: Rate, start: sp.Expr, end: sp.Expr) -> Iterator[Compared]:
    """At a rate b V^q - c V^(2q), the power K of what the root V^(1 - q) falls to, where K = 1 / (1 - q)."""
    b, c, small, large = _two_powers(rate)
    K = sp.factor(sp.together(1 / (1 - small)))
    r = sp.expand(K - 1)
    less = sp.expand(r - 1)
    if not c.is_positive or not b.is_nonnegative or not less.is_positive:
        return
    first = rate.at(start)
    v, root = rate.as_said(first ** (less / K)), rate.as_said(first ** (1 / K))
    decayed = rate.as_said((1 + c / K * less * v * (end - start)) ** (-1 / less))
    level = rate.as_said((b / c) ** (1 / r)) if b != 0 else sp.S.Zero
    bound = rate.as_said((decayed * root + level) ** K)
    p, q, U, name = rate.write(start), rate.write(end), rate.names[rate.function.func], rate.names[rate.time]
    order = in_order(rate, start, end)
    exponents = ["rational", "rational"] if b != 0 else ["rational"]
    steps = [
        order, "sign", *(["sign"] if b != 0 else []), f"difference_as {rate.write(less)}", "rational", "never_negative",
        f"cbv beta; rate_is {U} {name} ltac:(same_rate)", *exponents, "same_power", "rational", "rational", "rational",
        *exponents[1:] * 2,
    ]  # fmt: skip
    powers = [large] if b == 0 else [small, large]
    given = [*([b] if b != 0 else []), c, K, r, *powers, v, decayed.base, decayed.exp, root.exp]
    given += [] if b == 0 else [level.base, level.exp]
    word = "root_decay_as" if b == 0 else "root_bound_as"
    lemma = f"({word} {U} {p} {q} {' '.join(map(rate.write, given))})"
    falls = (
        f"rpow {rate.write(decayed.base)} {rate.write(decayed.exp)} * rpow {rate.write(first)} {rate.write(root.exp)}"
    )
    above = "" if b == 0 else f" + rpow {rate.write(level.base)} {rate.write(level.exp)}"
    exact = f"(rpow ({falls}{above}) {rate.write(K)})"
    yield asserted(rate, end, bound, lemma, steps, exact, "right; alike")


def _two_powers(rate: Rate) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
    """b, c, q and 2q of the rate b V^q - c V^(2q), where b may be 0.

    Raises
    ------
    NoTranslation
        If it is not of this form.
    """
    found = _powers(rate)
    large = max(found, key=lambda part: float(part.exp.subs(dict.fromkeys(part.exp.free_symbols, 2))), default=None)
    rest = found - {large}
    if large is None or len(rest) > 1:
        raise NoTranslation("no powers")
    values = {part: sp.Dummy("v", real=True) for part in (large, *rest)}
    expression = sp.expand(rate.rate.xreplace(values))
    a, *others = (sp.diff(expression, value) for value in values.values())
    b = others[0] if others else sp.S.Zero
    small = next(iter(rest)).exp if rest else large.exp / 2
    linear = expression - a * values[large] - sum(b * values[part] for part in rest)
    if sp.expand(linear) != 0 or (a + b).has(rate.time, rate.function, *values.values()):
        raise NoTranslation("not a sum of multiples of two powers")
    if sp.simplify(2 * small - large.exp) != 0:
        raise NoTranslation("not a power and its square")
    return b, -a, small, large.exp
