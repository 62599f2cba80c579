"""Ball arithmetic for exact SymPy expressions: every result encloses the true value."""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from ptproof.averaging.refusal import AveragingUndecided

Compiled = Callable[[Mapping[sp.Symbol, Any]], Any]
# Entire functions only: on a complex ball a branch cut would silently break analyticity.
_ENTIRE = {sp.sin: "sin", sp.cos: "cos", sp.exp: "exp", sp.sinh: "sinh", sp.cosh: "cosh"}
_REAL = {**_ENTIRE, sp.tan: "tan", sp.asin: "asin", sp.acos: "acos", sp.atan: "atan", sp.log: "log", sp.tanh: "tanh"}


def compile_ball(expression: sp.Expr, *, entire: bool = False) -> Compiled:
    """A function from {symbol: ball} to a ball that contains the value of ``expression``.

    With ``entire`` only entire functions are accepted, so that the balls may be complex and the enclosed
    function is analytic on them. Raises :class:`AveragingUndecided` for anything else.
    """
    from flint import arb, fmpq

    def build(node: sp.Expr) -> Compiled:
        if entire and not node.is_Rational and not node.free_symbols:
            return compile_ball(node)
        if node.is_Symbol:
            return operator.itemgetter(node)
        if node.is_Rational:
            fraction = fmpq(int(node.p), int(node.q))
            return lambda values: arb(fraction)
        if node is sp.pi:
            return lambda values: arb.pi()
        if node is sp.E:
            return lambda values: arb(1).exp()
        if node.is_Add or node.is_Mul:
            parts = [build(arg) for arg in node.args]
            join = operator.add if node.is_Add else operator.mul
            return lambda values: functools.reduce(join, (part(values) for part in parts))
        if node.is_Pow:
            base = build(node.base)
            if node.exp.is_Integer and (node.exp > 0 or not entire):
                power = int(node.exp)
                return lambda values: base(values) ** power
            if not entire and node.exp == sp.Rational(1, 2):
                return lambda values: base(values).sqrt()
            if not entire and node.exp == sp.Rational(-1, 2):
                return lambda values: 1 / base(values).sqrt()
            if not entire:
                exponent = build(node.exp)
                return lambda values: base(values) ** exponent(values)
        if isinstance(node, sp.Abs) and not entire:
            inner = build(node.args[0])
            return lambda values: abs(inner(values))
        if isinstance(node, sp.atan2):
            first, second = (build(arg) for arg in node.args)
            return lambda values: arb.atan2(first(values), second(values))
        method = (_ENTIRE if entire else _REAL).get(node.func)
        if method is not None:
            inner = build(node.args[0])
            return lambda values: getattr(inner(values), method)()
        raise AveragingUndecided(f"{node} has no enclosure here")

    return build(expression)


def enclose(expression: sp.Expr, values: Mapping[sp.Symbol, Any], bits: int = 96) -> Any:
    """A real ball that contains ``expression`` at ``values`` (balls or exact numbers)."""
    from flint import ctx

    with ctx.workprec(bits):
        return compile_ball(expression)(values)
