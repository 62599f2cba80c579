"""Means of products of three: a dither and the antiderivatives of two."""

from __future__ import annotations

import functools
from typing import Any

import sympy as sp

from ptproof.averaging.signal import Signal


def triple_means(found: tuple[Signal, ...]) -> Any:
    """⟨u_b U_a U_c⟩ as a function of (b, a, c), each product formed once."""
    rates = [
        frozenset(rate for _, rate in signal.pieces[0].terms) if signal.is_trigonometric else None for signal in found
    ]

    @functools.cache
    def product(a: int, c: int) -> Signal:
        return found[a].primitive * found[c].primitive

    @functools.cache
    def mean(b: int, a: int, c: int) -> sp.Expr:
        if a > c:
            return mean(b, c, a)
        first, second, third = rates[a], rates[b], rates[c]
        if first is not None and second is not None and third is not None:
            sums = {sign * p + q for p in first for q in second for sign in (1, -1)}
            if not any(total in third or -total in third for total in sums):
                return sp.S.Zero
        return (found[b] * product(a, c)).mean

    return mean
