"""What a route to averages needs that shares nothing with them: the flow over a period by iterated integrals.

x(P) = x + Σ_w I_w L_{w_n} … L_{w_1} x, with I_w = ∫₀^P u_{w_1}(s_1) ∫₀^{s_1} u_{w_2}(s_2) … over all words of dithers.
"""

import itertools
from typing import Any

import sympy as sp

Sums = dict[tuple[int, sp.Expr], sp.Expr]  # of s^n exp(i r s): (n, r) → coefficient


def of_cosine(rate: Any) -> Sums:
    half = sp.Rational(1, 2)
    return {(0, sp.sympify(rate)): half, (0, -sp.sympify(rate)): half}


def of_sine(rate: Any) -> Sums:
    half = sp.I / 2
    return {(0, sp.sympify(rate)): -half, (0, -sp.sympify(rate)): half}


def _product(first: Sums, second: Sums) -> Sums:
    result: Sums = {}
    for ((n, r), a), ((m, q), b) in itertools.product(first.items(), second.items()):
        result[n + m, r + q] = result.get((n + m, r + q), sp.S.Zero) + a * b
    return result


def _from_zero(terms: Sums) -> Sums:
    """The integral from 0 to s."""
    result: Sums = {}
    for (n, r), a in terms.items():
        if r == 0:
            result[n + 1, r] = result.get((n + 1, r), sp.S.Zero) + a / (n + 1)
            continue
        for k in range(n + 1):
            value = a * (-1) ** k * sp.ff(n, k) / (sp.I * r) ** (k + 1)
            result[n - k, r] = result.get((n - k, r), sp.S.Zero) + value
    start = sum((a for (n, _), a in result.items() if n == 0), sp.S.Zero)
    result[0, sp.S.Zero] = result.get((0, sp.S.Zero), sp.S.Zero) - start
    return result


def iterated(dithers: list[Sums], period: sp.Expr) -> sp.Expr:
    """∫₀^P u_1(s_1) ∫₀^{s_1} u_2(s_2) … for dithers that make whole numbers of turns in P."""
    inner: Sums = {(0, sp.S.Zero): sp.S.One}
    for dither in reversed(dithers):
        inner = _from_zero(_product(dither, inner))
    return sp.expand(sum(a * period**n for (n, _), a in inner.items()))


def displacement(
    fields: list[tuple[sp.Expr, ...]], dithers: list[Sums], state: tuple[sp.Symbol, ...], period: sp.Expr, length: int
) -> list[sp.Expr]:
    """The terms of x(P) − x from words of ``length`` letters."""
    total = [sp.S.Zero] * len(state)
    for word in itertools.product(range(len(fields)), repeat=length):
        factor = iterated([dithers[letter] for letter in word], period)
        if factor == 0:
            continue
        for row, symbol in enumerate(state):
            value: sp.Expr = symbol
            for letter in word:
                value = sum(sp.diff(value, s) * f for s, f in zip(state, fields[letter], strict=True))
            total[row] += factor * value
    return total
