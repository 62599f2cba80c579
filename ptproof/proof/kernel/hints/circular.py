"""Polynomials in variables and in sin and cos of them, by what is known of sin u and cos u for every u."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.products import products
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation


def by_circular_bounds(goal: Goal) -> Iterator[str]:
    """The difference as a sum of products of these bounds, of facts, and of squares."""
    relation = goal.relation.standard()
    gap = sp.expand(relation.right - relation.left)
    calls = sorted(gap.atoms(sp.sin, sp.cos), key=sp.default_sort_key)
    if relation.sign != "<=" or not calls or gap.atoms(sp.Function) != set(calls):
        return
    stands: dict[sp.Expr, sp.Symbol] = {}
    names = dict(goal.names)
    lines: list[str] = []
    facts = list(goal.known)
    for number, call in enumerate(calls):
        symbol = stands[call] = sp.Symbol(fresh(f"trig{number}", goal.names), real=True)
        names[symbol] = symbol.name
        (angle,) = call.args
        kind = "sin" if isinstance(call, sp.sin) else "cos"
        lines.append(f"bounds_of_{kind} {goal.text(angle)}; set ({symbol.name} := {goal.text(call)}) in *")
        facts += bounds(kind, symbol, angle)
    inner = Goal(relation, tuple(facts), names).map(lambda side: side.xreplace(stands))
    top = sp.expand(inner.relation.right - inner.relation.left)
    if not top.is_polynomial(*top.free_symbols):
        return
    found = products(top, [item.standard() for item in inner.known], squares=True)
    if found is None or found.factor != 1:
        return
    lines += [f"clearbody {symbol.name}" for symbol in stands.values()]
    lines.append(f"top_of {inner.text(top)} 1")
    lines += [f"fact_from {inner.text(fact.bottom)} {inner.text(fact.top)}" for fact in found.facts]
    for factors in found.products:
        powers = (inner.text(factor ** factors.count(factor)) for factor in dict.fromkeys(factors))
        lines.append(f"product ({' * '.join(powers)})")
    yield "; ".join([*lines, "linear"])


def bounds(kind: str, value: sp.Expr, u: sp.Expr) -> list[Relation]:
    """What is known of ``value``, the sin or cos of u, for every u."""
    one = sp.Integer(1)
    if kind == "cos":
        below = [1 - u**2 / 2, -one]
        above = [1 - u**2 / 2 + u**4 / 24, one]
        return [*(Relation(b, "<=", value) for b in below), *(Relation(value, "<=", a) for a in above)]
    pairs = [(value**2, u**2), (u**2 - u**4 / 6, u * value), (u * value, u**2), (-one, value), (value, one)]
    return [Relation(small, "<=", large) for small, large in pairs]
