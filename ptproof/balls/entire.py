"""Entire functions on complex balls: every result encloses the true values."""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Mapping
from typing import Any

import flint
import sympy as sp

from ptproof.balls.ball import enclose
from ptproof.balls.tape import Undefined

Compiled = Callable[[Mapping[sp.Symbol, Any]], Any]
_ENTIRE = {sp.sin: "sin", sp.cos: "cos", sp.exp: "exp", sp.sinh: "sinh", sp.cosh: "cosh"}


def compile_entire(expression: sp.Expr, known: Mapping[sp.Symbol, Any], bits: int) -> Compiled:
    """A function from {symbol: real or complex ball} to a ball that contains the values of ``expression``.

    Symbols in ``known`` have these real balls. In the others, only sums, products, powers and entire functions are
    accepted, so that the enclosed function is analytic on the balls (a branch cut would break that silently).
    Raises :class:`Undefined` for anything else.
    """

    def build(node: sp.Expr) -> Compiled:
        if node.is_Rational:
            fraction = flint.arb(flint.fmpq(int(node.p), int(node.q)))
            return lambda values: fraction
        if not node.free_symbols - known.keys():
            constant = enclose(node, {symbol: known[symbol] for symbol in node.free_symbols}, bits=bits)
            return lambda values: constant
        if node.is_Symbol:
            return operator.itemgetter(node)
        if node.is_Add or node.is_Mul:
            parts = [build(arg) for arg in node.args]
            join = operator.add if node.is_Add else operator.mul
            if len(parts) == 2:
                first, second = parts
                return lambda values: join(first(values), second(values))
            return lambda values: functools.reduce(join, (part(values) for part in parts))
        if node.is_Pow and node.exp.is_Integer and node.exp > 0:
            base, power = build(node.base), int(node.exp)
            # The library's own power is not defined on balls that contain zero.
            return lambda values: functools.reduce(operator.mul, [base(values)] * power)
        if node.func in _ENTIRE:
            inner, call = build(node.args[0]), operator.methodcaller(_ENTIRE[node.func])
            return lambda values: call(inner(values))
        raise Undefined(f"{node} is not known to be entire")

    return build(expression)
