"""Polynomials in y as polynomials in a radial variable and the coordinates v of a face of the cube.

What is the same in all directions, c·‖y‖^(2κ), is split off before, since it needs no enclosure.
"""

from __future__ import annotations

import operator
from collections import defaultdict
from collections.abc import Iterator
from functools import reduce

from flint import arb

from ptproof.balls.cube import Face
from ptproof.balls.series import Exponents, Nested, Taylor
from ptproof.balls.tape import Undefined

ALIKE = 1.5
"""How far apart the coefficients of y₁^(2κ) … yₙ^(2κ) may be, as a factor, for a common part to be split off."""


def by_degree(whole: Taylor, kappa: int, face: Face, slope: bool) -> tuple[arb, list[dict[int, Nested]]]:
    """c, and the rest of the polynomial, or its derivatives: for each degree a polynomial in v."""
    share, polynomials = _reduced(whole, kappa, slope)
    result = []
    for polynomial in polynomials:
        groups: dict[int, dict[Exponents, arb]] = defaultdict(dict)
        for degree, place, value in _on_face(polynomial, face):
            groups[degree][place] = value
        result.append({degree: Nested(group) for degree, group in groups.items()})
    return share, result


def in_radius(whole: Taylor, kappa: int, face: Face, outer: bool, slope: bool) -> tuple[arb, list[Nested]]:
    """c, and the rest or its derivatives as polynomials in (radial variable, v), the leading power taken out.

    Far out the radial variable is 1/‖y‖, and :class:`Undefined` is raised where the polynomial grows too fast.
    """
    share, polynomials = _reduced(whole, kappa, slope)
    top = 2 * kappa - slope
    result = []
    for polynomial in polynomials:
        terms: dict[Exponents, arb] = {}
        for degree, place, value in _on_face(polynomial, face):
            radial = top - degree if outer else degree - top
            if radial >= 0:
                terms[radial, *place] = value
            elif outer:
                raise Undefined("the field falls off faster than the power 2κ")
            # Near the source such a term is proved to vanish, see the order of vanishing.
        result.append(Nested(terms))
    return share, result


def _on_face(polynomial: Taylor, face: Face) -> Iterator[tuple[int, Exponents, arb]]:
    """(degree, exponents of v, coefficient) of each term for u on the face; no two have the same first two."""
    for key, value in polynomial.terms.items():
        place = (*key[: face.axis], *key[face.axis + 1 :])
        yield sum(key), place, value if face.sign > 0 or key[face.axis] % 2 == 0 else -value


def _reduced(whole: Taylor, kappa: int, slope: bool) -> tuple[arb, list[Taylor]]:
    """A number c and the polynomial minus c·‖y‖^(2κ), or the derivatives of that.

    Where the directions differ much, c is 0, for then the difference would be larger than the polynomial.
    """
    n = whole.dimension
    powers = [whole.terms.get(tuple(2 * kappa * (i == j) for j in range(n)), arb(0)).mid() for i in range(n)]
    low, high = reduce(arb.min, powers), reduce(arb.max, powers)
    share = ((low + high) / 2).mid()
    if share.is_zero() or not (low > 0 and high < ALIKE * low):
        share, rest = arb(0), whole
    else:
        square = whole.make({tuple(2 * (i == j) for j in range(n)): arb(1) for i in range(n)})
        rest = whole - reduce(operator.mul, [square] * kappa) * share
    return share, [rest.derivative(i) for i in range(n)] if slope else [rest]
