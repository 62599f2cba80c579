"""Hints for integrals: an antiderivative of each, the inner ones first; Coq differentiates it again."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable

import sympy as sp
from sympy.simplify.fu import TR8

from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Relation


def integrals(relations: Iterable[Relation], names: Names) -> list[str]:
    """The lines for every integral between finite ends in the relations."""
    sides = (side for relation in relations for side in (relation.left, relation.right))
    found = [part for side in sides for part in sp.preorder_traversal(side) if isinstance(part, sp.Integral)]
    bound = {limits[0] for part in found for limits in part.limits}
    lines: dict[str, None] = {}
    for integral in reversed(found):
        for count in range(1, len(integral.limits) + 1):
            with contextlib.suppress(NoTranslation):
                lines[_line(integral.func(integral.function, *integral.limits[:count]), bound, names)] = None
    return list(lines)


def _outermost(integral: sp.Integral) -> tuple[sp.Basic, sp.Tuple]:
    """What the last of an integral's signs, as they are listed, is about, and its variable with the ends."""
    *inner, last = integral.limits
    return (integral.func(integral.function, *inner) if inner else integral.function), last


def _line(integral: sp.Integral, bound: set[sp.Symbol], names: Names) -> str:
    """That the integrand is a plain function, and that this one has an antiderivative, for all outer variables."""
    function, (variable, *ends) = _outermost(integral)
    if len(ends) != 2 or ends[1].is_infinite:
        raise NoTranslation("no hint for such an integral")
    carried = _carried_out(function)
    plain = _plain(carried, variable)
    antiderivative = sp.integrate(plain, variable)
    if antiderivative.has(sp.Integral, sp.Piecewise):
        raise NoTranslation("no antiderivative")
    base = _base(sp.Tuple(carried, plain), variable)
    given, found, primitive, angle = (
        f"(fun {names[variable]} : R => {term(item, names)})" for item in (function, plain, antiderivative, base)
    )
    tactic = f"integral {given} {found} {primitive} {angle}"
    outer = [names[symbol] for symbol in sorted(bound & function.free_symbols - {variable}, key=str)]
    if not outer:
        return f"try ({tactic})"
    a, b = fresh("a", names), fresh("b", names)
    said = f"forall {' '.join(outer)} {a} {b} : R, is_RInt {given} {a} {b} ({primitive} {b} - {primitive} {a})"
    return f"try (assert ({said}) by (intros {' '.join(outer)}; {tactic}; assumption); cbv beta in *)"


def _plain(carried: sp.Basic, variable: sp.Symbol) -> sp.Basic:
    """Products of waves of the variable as sums of such."""
    others = {wave: sp.Dummy() for wave in carried.atoms(sp.sin, sp.cos) if not wave.has(variable)}
    found = sp.expand(TR8(sp.expand(carried.xreplace(others))))
    return found.xreplace({stands: wave for wave, stands in others.items()})


def _carried_out(expression: sp.Basic) -> sp.Basic:
    """The expression with every integral carried out."""
    if isinstance(expression, sp.Integral):
        function, (variable, lower, upper) = _outermost(expression)
        found = sp.integrate(_plain(_carried_out(function), variable), variable)
        return found.subs(variable, upper) - found.subs(variable, lower)
    if not expression.has(sp.Integral):
        return expression
    return expression.func(*map(_carried_out, expression.args))


def _base(expression: sp.Basic, variable: sp.Symbol) -> sp.Basic:
    """The angle of which the arguments of all waves of the variable are whole multiples; the variable, if none is."""
    angles = sorted({wave.args[0] for wave in expression.atoms(sp.sin, sp.cos) if wave.has(variable)}, key=str)
    ratios = [sp.cancel(angle / angles[0]) for angle in angles]
    if not angles or not all(ratio.is_Rational for ratio in ratios):
        return variable
    return angles[0] * sp.Rational(
        sp.igcd(0, *(ratio.p for ratio in ratios)), sp.ilcm(1, *(ratio.q for ratio in ratios))
    )
