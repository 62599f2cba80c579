"""Polynomials on [−1, 1] by their coefficients of powers: bounds, and their expansions around a whole interval."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import comb

import flint
from flint import arb, arb_mat, arb_poly, fmpq, fmpq_mat

from ptproof.balls.ball import interval


@lru_cache(maxsize=64)
def _to_chebyshev(count: int, bits: int) -> arb_mat:
    """From ``count`` coefficients of powers (as rows) to those of Chebyshev polynomials; exact fractions in balls."""
    rows = [[0] * count for _ in range(count)]  # rows[k]: sᵏ in Chebyshev polynomials, times 2ᵏ
    for k in range(count):
        for i in range(k + 1):
            rows[k][abs(k - 2 * i)] += comb(k, i)
    return arb_mat(fmpq_mat(count, count, [fmpq(rows[k][j], 2**k) for k in range(count) for j in range(count)]))


def spectra(rows: arb_mat) -> arb_mat:
    """The Chebyshev coefficients of polynomials whose coefficients of powers are the rows."""
    return rows * _to_chebyshev(rows.ncols(), flint.ctx.prec)


def largest(spectrum: Sequence[arb]) -> arb:
    """What a polynomial with these Chebyshev coefficients does not exceed in absolute value on [−1, 1]."""
    return sum(map(arb.abs_upper, spectrum), arb(0)).upper()


def highest(spectrum: Sequence[arb]) -> arb:
    """What it does not exceed on [−1, 1]."""
    return (spectrum[0] + largest(spectrum[1:])).upper()


@lru_cache(maxsize=64)
def _shift(count: int, terms: int, bits: int) -> arb_mat:
    powers = [arb(1), *(interval(-1, 1) if k % 2 else interval(0, 1) for k in range(1, count))]
    return arb_mat(
        count, terms, [comb(j, k) * powers[j - k] if k <= j else arb(0) for j in range(count) for k in range(terms)]
    )


def around(rows: arb_mat, terms: int) -> arb_mat:
    """The first ``terms`` Taylor coefficients of polynomials (rows) at every point of [−1, 1], in one ball each."""
    return rows * _shift(rows.ncols(), terms, flint.ctx.prec)


def not_below(coefficients: Sequence[arb], bound: arb, depth: int = 12) -> bool:
    """Whether the polynomial is shown to be >= ``bound`` on [−1, 1], by halving where one look is not enough."""
    count = len(coefficients)
    spectrum = spectra(arb_mat(1, count, list(coefficients))).entries()
    if spectrum[0] - largest(spectrum[1:]) >= bound:
        return True
    if spectrum[0] + largest(spectrum[1:]) < bound or not depth:
        return False
    polynomial, half = arb_poly(list(coefficients)), fmpq(1, 2)
    for sign in (1, -1):
        part = polynomial(arb_poly([arb(sign * half), arb(half)])).coeffs()
        part = [*part, *[arb(0)] * (count - len(part))]
        if not not_below(part, bound, depth - 1):
            return False
    return True
