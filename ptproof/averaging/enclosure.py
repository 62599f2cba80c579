"""Exact v_ji against rigorous enclosures, from the dithers themselves and by another route than the exact one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp
from flint import arb, fmpq

from ptproof.balls.ball import enclose, precision
from ptproof.balls.nested import Functions
from ptproof.system import DitherSystem

_BITS = 80
_COARSEST = arb("1e-6")


def check_coefficients(
    system: DitherSystem, values: Mapping[tuple[int, int], sp.Expr], hints: Sequence[sp.Expr] = ()
) -> None:
    """Raise ``ArithmeticError`` if an exact v_ji lies outside its enclosure.

    ``hints`` are points where a dither may switch; wrong or missing ones cost time, not rigour.
    """
    with precision(_BITS):
        symbols = sample(set().union(*(dither.free_symbols for dither in system.dithers)) - {system.phase})
        period = enclose(system.period, bits=_BITS)
        dithers = Functions(system.dithers, system.phase, period, symbols)
        enclosures, sizes = dithers.nested_integrals(hints), dithers.sizes
        for (j, i), exact in values.items():
            ball = enclosures[j - 1, i - 1] / period
            if not ball.rad() <= _COARSEST * period * sizes[j - 1] * sizes[i - 1]:
                raise ArithmeticError(f"the enclosure {ball} of v_{j},{i} is too wide to check anything")
            if not ball.overlaps(enclose(exact, symbols, bits=_BITS) if exact != 0 else arb(0)):
                raise ArithmeticError(f"v_{j},{i} = {exact} lies outside its enclosure {ball}; please report this")


def sample(symbols: set[sp.Symbol]) -> dict[sp.Symbol, arb]:
    """Exact values for symbols, as balls, that respect their assumptions: the same ones each time."""
    values = {}
    for place, symbol in enumerate(sorted(symbols, key=lambda symbol: symbol.name)):
        size = fmpq(place + 1) if symbol.is_integer else fmpq(7 * place + 5, 3 * place + 8)
        values[symbol] = arb(-size if symbol.is_negative or symbol.is_nonpositive else size)
    return values
