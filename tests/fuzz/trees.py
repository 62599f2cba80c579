"""Strategies: expressions as SymPy trees of declared kinds, and exact points that the declarations allow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from random import Random
from typing import Any

import hypothesis.strategies as st
import sympy as sp

x, y = sp.symbols("x y", real=True)
p, q = sp.symbols("p q", positive=True)
n = sp.Symbol("n", nonnegative=True)
m = sp.Symbol("m", positive=True, integer=True)
i = sp.Symbol("i", integer=True)
z = sp.Symbol("z", negative=True)
w = sp.Symbol("w", real=True, nonzero=True)
SYMBOLS = (x, y, p, q, n, m, i, z, w)

F = sp.Function("F", real=True)
G = sp.Function("G", positive=True)

_SMALL = [sp.Rational(a, b) for a, b in ((1, 2), (1, 3), (2, 3), (3, 2), (4, 3), (1, 4), (5, 2), (-1, 2), (-1, 3))]
_ENTIRE = (sp.sin, sp.cos, sp.exp, sp.atan, sp.Abs)
_PARTIAL = (sp.log, sp.tan, sp.sinh, sp.cosh, sp.tanh, sp.sqrt, sp.asin, sp.acos)

integers = st.integers(-4, 4).map(sp.Integer)
fractions = st.fractions(-5, 5, max_denominator=6).map(lambda value: sp.Rational(value.numerator, value.denominator))
exponents = st.sampled_from([*_SMALL, sp.Integer(-2), sp.Integer(-1), sp.Integer(2), sp.Integer(3)])
numbers = st.one_of(integers, fractions, st.sampled_from([sp.pi, sp.E, sp.sqrt(2), sp.sqrt(3), sp.cbrt(2)]))


def expressions(
    symbols: Sequence[sp.Symbol] = SYMBOLS,
    *,
    functions: Sequence[Any] = (*_ENTIRE, *_PARTIAL),
    powers: st.SearchStrategy[Any] = exponents,
    symbolic: bool = False,
    undefined: Sequence[Any] = (),
    kinks: bool = False,
    leaves: int = 6,
) -> st.SearchStrategy[Any]:
    """Finite SymPy expressions over ``symbols``, of at most about so many leaves."""
    leaf = st.one_of(st.sampled_from(list(symbols)), st.sampled_from(list(symbols)), integers, numbers)

    def larger(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
        options = [
            st.builds(lambda a, b: a + b, inner, inner),
            st.builds(lambda a, b: a - b, inner, inner),
            st.builds(lambda a, b: a * b, inner, inner),
            st.builds(lambda a, b: a / b, inner, inner.filter(lambda entry: entry != 0)),
            st.builds(sp.Pow, inner.filter(lambda entry: entry != 0), powers),
        ]
        if functions:
            options.append(st.builds(lambda head, a: head(a), st.sampled_from(list(functions)), inner))
        if symbolic:
            options.append(st.builds(sp.Pow, inner.filter(lambda entry: entry != 0), inner))
        if undefined:
            options.append(st.builds(lambda head, a: head(a), st.sampled_from(list(undefined)), inner))
        if kinks:
            options += [
                st.builds(sp.Max, inner, inner), st.builds(sp.Min, inner, inner), inner.map(sp.Abs),
                inner.map(sp.sign),
                st.builds(_choice, inner, inner, inner),
            ]  # fmt: skip
        return st.one_of(options)

    def safely(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
        return strategy.filter(is_plain)

    return safely(st.recursive(safely(leaf), lambda inner: safely(larger(inner)), max_leaves=leaves))


def _choice(value: Any, other: Any, side: Any) -> Any:
    return sp.Piecewise((value, side < 1), (other, True)) if side.is_extended_real else value


def is_plain(expression: Any) -> bool:
    """Whether it is a finite real-looking expression: no infinity, no imaginary unit."""
    return isinstance(expression, sp.Expr) and not expression.has(sp.zoo, sp.nan, sp.oo, sp.I)


seeds = st.integers(0, 2**20)
_AWKWARD = [sp.Rational(*pair) for pair in ((1, 1), (2, 1), (1, 2), (1, 1000), (50, 1), (7, 3), (22, 7), (10**6, 1))]


def points(symbols: Iterable[sp.Symbol], count: int, seed: int) -> list[dict[sp.Symbol, sp.Rational]]:
    """Exact points that the declarations of ``symbols`` allow: awkward values among others; the same for a seed."""
    ordered, generator = sorted(symbols, key=str), Random(seed)
    return [{symbol: _value(symbol, generator) for symbol in ordered} for _ in range(count)]


def _value(symbol: sp.Symbol, generator: Random) -> sp.Rational:
    size = generator.choice(_AWKWARD) if generator.random() < 0.4 else sp.Rational(generator.randint(1, 600), 97)
    if symbol.is_integer:
        size = sp.Integer(generator.randint(1, 6))
    if not (symbol.is_nonzero or symbol.is_positive or symbol.is_negative) and generator.random() < 0.12:
        return sp.S.Zero
    if symbol.is_negative:
        return -size
    return size if symbol.is_nonnegative or generator.random() < 0.5 else -size
