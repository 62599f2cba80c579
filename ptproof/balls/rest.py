"""A field as a polynomial plus a rest, and bounds of the rest's terms over a whole line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp
from flint import arb
from sympy.utilities.iterables import sift

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.growth import GROWTHS, Exponent, Growth, Span, coordinates, power_of
from ptproof.balls.tape import Undefined, compile_tape

LARGEST_POLYNOMIAL = 300
"""The most terms for which a polynomial field is expanded."""
LINE = 16
"""Up to where an expression in one variable is bounded piece by piece, and from where on by its growth."""


@dataclass(frozen=True)
class LineBound:
    """An expression in one variable z lies in ``near`` + [−size, size]·|z|^degree for every real z; 0 is in near."""

    index: int
    near: arb
    size: arb
    degree: Exponent

    def growth(self, w: Sequence[arb], reach: arb) -> Growth:
        """The bound for z = r·w[index]."""
        width = power_of(w[self.index].abs_upper(), self.degree) * self.size
        constant = Growth({}, reach).lift(self.near)
        return constant + Growth({self.degree: Span(-width, width)}, reach) if self.size > 0 else constant


def line_bound(term: sp.Expr, offsets: Sequence[sp.Symbol]) -> LineBound | None:
    """A bound of an expression in one variable over the whole line; None if none is found."""
    if len(term.free_symbols) != 1:
        return None
    (variable,) = term.free_symbols
    tape = compile_tape([term], [variable])
    reach = arb(1) / LINE
    try:
        near = BALLS.either([arb(0), *(tape.run([interval(k, k + 1)], BALLS)[0] for k in range(-LINE, LINE))])
        sides = [tape.run(coordinates([arb(sign)], reach), GROWTHS)[0] for sign in (1, -1)]
        growths = [Growth({}, reach).lift(side) for side in sides]
        degree = max((exponent for growth in growths for exponent in growth.terms), default=0)
        if degree <= 0:
            near = BALLS.either([near, *(growth.range.ball() for growth in growths)])
            return LineBound(offsets.index(variable), near, arb(0), 0)
        size = arb(0)
        for growth in growths:
            sizes = (value.ball().abs_upper() * power_of(reach, degree - e) for e, value in growth.terms.items())
            size = size.max(sum(sizes, arb(0)).upper())
        return LineBound(offsets.index(variable), near, size, degree)
    except Undefined:
        return None


def split_polynomial(drop: sp.Expr, offsets: Sequence[sp.Symbol]) -> tuple[sp.Poly, sp.Expr]:
    """``drop`` as an expanded polynomial plus a rest without polynomial terms at its top level."""
    nothing = sp.Poly(0, *offsets)
    if not expandable(drop, len(offsets)):
        return nothing, drop
    expanded = sp.expand(drop, deep=False, power_exp=False, power_base=False, log=False)
    terms, rest = sift(sp.Add.make_args(expanded), lambda term: bool(term.is_polynomial(*offsets)), binary=True)
    if rest:
        # A constant stays with the rest, whose bounds at infinity it sharpens: 1 − cos is in [0, 2].
        terms, constants = sift(terms, lambda term: bool(term.has(*offsets)), binary=True)
        rest = [*constants, *rest]
    polynomial = sp.Poly(sp.Add(*terms), *offsets)
    return (polynomial, sp.Add(*rest)) if len(polynomial.terms()) <= LARGEST_POLYNOMIAL else (nothing, drop)


def expandable(drop: sp.Expr, n: int) -> bool:
    """Whether multiplying out stays small, judged by the powers of sums."""
    powers = [power for power in drop.atoms(sp.Pow) if isinstance(power.base, sp.Add) and power.exp.is_Integer]
    return all(math.comb(int(abs(power.exp)) + n, n) <= LARGEST_POLYNOMIAL for power in powers)
