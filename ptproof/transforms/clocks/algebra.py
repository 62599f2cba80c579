"""What clocks are checked with: inverse functions that undo each other, signs, and limits at infinity."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy as sp

from ptproof.proof.engines.limits import limit_of
from ptproof.proof.engines.reals import follows
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Relation, ge, gt
from ptproof.proof.verdict import Verdict


@lru_cache(maxsize=1024)
def factored(expression: sp.Expr) -> sp.Expr:
    """``sp.factor`` with the same signs in every run: left alone, it takes the symbols in the order of their hashes."""
    if not expression.is_rational_function():
        found = sp.factor(expression)
        if not found.has(sp.exp):
            return found
        # One exponential: the numbers of two whose exponents cancel may be too large and too small.
        return sp.powsimp(found).replace(sp.exp, lambda exponent: sp.exp(sp.factor(sp.together(exponent))))
    return sp.factor(expression, *sorted(expression.free_symbols, key=lambda symbol: symbol.name))


def settle(expression: sp.Expr) -> sp.Expr:
    """Let logarithm, exponential and arctan(tan) undo each other where the signs of the symbols allow it."""

    def plain(entry: sp.Expr) -> sp.Expr:
        return sp.powsimp(sp.factor(sp.cancel(sp.expand(entry))))

    def arctan(entry: sp.Expr) -> sp.Expr:
        entry = plain(entry)
        if isinstance(entry, sp.tan) and _within_quarter_turn(entry.args[0]):
            return entry.args[0]
        return sp.atan(entry)

    if not expression.has(sp.exp, sp.log, sp.atan, sp.tan):
        return expression
    expression = expression.replace(sp.tan, lambda angle: sp.tan(sp.factor(sp.cancel(angle))))
    expression = expression.replace(sp.exp, lambda entry: sp.exp(sp.expand(sp.cancel(entry))))
    return expression.replace(sp.log, lambda entry: sp.log(plain(entry))).replace(sp.atan, arctan)


def _within_quarter_turn(angle: sp.Expr) -> bool:
    """Whether −π/2 < angle < π/2 is shown by the declared signs of its symbols."""
    return all(sp.factor(sp.cancel(sp.pi / 2 + side)).is_positive for side in (angle, -angle))


def is_positive(expression: sp.Expr, given: Sequence[Relation] = ()) -> bool:
    """Whether it is shown, by the declared signs of the symbols or by z3 from what is ``given``, to be positive."""
    expression = expression.replace(
        sp.tan, lambda angle: sp.Dummy("tan", real=True) if _within_quarter_turn(angle) else sp.tan(angle)
    )
    forms = (expression, sp.factor(sp.cancel(sp.together(expression))))
    if any(form.is_positive for form in forms):
        return True
    return follows(gt(forms[1], 0), given, seconds=2.0).shown


def is_nonnegative(expression: sp.Expr, given: Sequence[Relation] = ()) -> bool:
    """As :func:`is_positive`, with 0 allowed; for expressions without tan."""
    form = sp.factor(expression)
    return bool(form.is_nonnegative) or follows(ge(form, 0), given, seconds=2.0).shown


def is_smooth(expression: sp.Expr, variable: sp.Symbol) -> bool:
    """Whether it is shown to be real and continuously differentiable in ``variable``, on all that it is declared to be.

    Within a quarter turn a tangent is smooth, which is more than the engine knows of it.
    """
    tangent = sp.Function("tangent", real=True)
    expression = expression.replace(
        sp.tan, lambda angle: tangent(angle) if _within_quarter_turn(angle) else sp.tan(angle)
    )
    return smoothness(expression, [variable], 1, {tangent: sp.oo}).verdict is Verdict.PROVED


def limit_at_infinity(expression: sp.Expr, variable: sp.Symbol) -> sp.Expr | None:
    """The limit for ``variable`` → ∞, or None; arctan and log are turned over where that helps."""

    def turn(u: sp.Expr) -> sp.Expr:
        return sp.pi / 2 - sp.atan(1 / u) if limit_of(u, variable, sp.oo) is sp.oo else sp.atan(u)

    turned = expression.replace(sp.atan, turn)
    for form in (expression, turned):
        found = limit_of(form, variable, sp.oo)
        if found is not None:
            return found
    return None
