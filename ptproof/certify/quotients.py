"""The quotients whose extreme values are the constants of a field, in coordinates that reach the source and infinity.

With y = x − x* and V(y) = F(x*) − F(x* + y), the quotients are V/‖y‖^(2κ) and ‖∇V‖²/‖y‖^(4κ−2). A direction is
y/‖y‖ = u/‖u‖ with u on a face of the cube [−1, 1]ⁿ: one coordinate is ±1, the others are v. In dimension 1 there
are the two directions only. The radial coordinate t is ‖y‖ on the inner chart and 1/‖y‖ on the outer one, so that
t = 0 is the source, or infinity, and the quotients have two forms there: the defining one for t > 0, and a
polynomial in (t, v) divided by a power of ‖u‖, plus an enclosed remainder that vanishes with t.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache, reduce
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.cube import Box, Face, reduced_faces
from ptproof.balls.growth import GROWTHS, Growth, coordinates, power_of
from ptproof.balls.rest import LineBound, line_bound, split_polynomial
from ptproof.balls.series import Nested, Taylor, coefficient_along, taylor
from ptproof.balls.tape import Tape, Undefined, compile_tape
from ptproof.certify.expansions import by_degree, in_radius

EXTRA_ORDERS = {1: 9, 2: 5, 3: 3}
"""How many orders beyond the leading one the Taylor polynomial has, by dimension."""

Function = Callable[[Sequence[Any], Any], Any]
"""A function of (coordinates, arithmetic)."""


class Quotients:
    """The two quotients of one field; ``drop`` is V in the variables ``offsets`` = y."""

    def __init__(self, drop: sp.Expr, offsets: Sequence[sp.Symbol], kappa: int) -> None:
        self.offsets = tuple(offsets)
        self.n = len(self.offsets)
        self.kappa = kappa
        self.polynomial, self.rest = split_polynomial(drop, self.offsets)
        self.drop = self.polynomial.as_expr() + self.rest
        self.value_tape = compile_tape([self.drop], self.offsets)
        self.vanishing_is_proved = False
        self.slope_tape = compile_tape([sp.diff(self.drop, y) for y in self.offsets], self.offsets)

    @property
    def is_polynomial(self) -> bool:
        """Whether V is a polynomial that has been expanded."""
        return bool(self.rest == 0)

    def tape(self, slope: bool) -> Tape:
        """The outputs V, or ∂V/∂y₁ … ∂V/∂yₙ."""
        return self.slope_tape if slope else self.value_tape

    @cached_property
    def order(self) -> int:
        """The order of the Taylor polynomial at the source."""
        if self.is_polynomial:
            return max(self.polynomial.total_degree(), 2 * self.kappa)
        return 2 * self.kappa + EXTRA_ORDERS.get(self.n, 2)

    @cached_property
    def expansion(self) -> Taylor:
        """The Taylor polynomial of V at the source; raises :class:`Undefined` where V is not analytic there."""
        return taylor(self.value_tape, self.n, self.order)[0]

    @cached_property
    def faces(self) -> tuple[Face, ...]:
        """The faces that remain when the symmetries of V are used: reflections, permutations, rotations, y → −y."""
        return reduced_faces(self.drop, self.offsets)

    def radial(self) -> Quotients:
        """The same for y·∇V instead of V: where its value quotient is positive, ∇V is not zero."""
        drop = sum((y * sp.diff(self.drop, y) for y in self.offsets), sp.Integer(0))
        quotients = Quotients(drop, self.offsets, self.kappa)
        # Each homogeneous part of V is multiplied by its degree, so that no lower order comes up.
        quotients.vanishing_is_proved = self.vanishing_is_proved
        return quotients

    # The defining form, for t > 0.

    def direct(self, face: Face, outer: bool, slope: bool, *, rest: bool = True) -> Function:
        """The quotient as a function of (t, v), defined for t > 0; without ``rest``, of the polynomial part alone.

        The powers of ‖y‖ in the polynomial part are divided out before anything is evaluated.
        """
        share, parts = _homogeneous_of(self, face, slope)
        tape = self._rest_tapes[slope] if rest and self.rest != 0 else None
        top = 2 * self.kappa - slope

        def function(values: Sequence[Any], arithmetic: Any) -> Any:
            t, v = values[0], values[1:]
            size = _norm(v, arithmetic)
            radius = _inverse(t * size, arithmetic) if outer else t * _inverse(size, arithmetic)
            outputs: list[Any] = [arb(0)] * len(parts)
            if any(parts):
                shrink = arithmetic.integer_power(size, -top)
                outputs = [_sum_of_powers(part, v, radius, top, arithmetic) * shrink for part in parts]
            if tape is not None:
                # The rest is divided by the power of t itself, which loses less than powers of t/‖u‖ and of ‖u‖.
                scale = arithmetic.integer_power(t, top if outer else -top)
                others = tape.run([u * radius for u in face.cube_point(v)], arithmetic)
                outputs = [main + value * scale for main, value in zip(outputs, others, strict=True)]
            return self._finish(outputs, face, v, size, share, slope, arithmetic)

        return function

    def _finish(
        self, outputs: Sequence[Any], face: Face, v: Sequence[Any], size: Any, share: arb, slope: bool, arithmetic: Any
    ) -> Any:
        """The quotient, from that of V − share·‖y‖^(2κ) or from those of its derivatives."""
        if not slope:
            return outputs[0] + share
        total = _squares(outputs, arithmetic)
        if share.is_zero():
            return total
        radial = sum((u * output for u, output in zip(face.cube_point(v), outputs, strict=True)), arb(0))
        double = 2 * self.kappa * share
        return total + radial * _inverse(size, arithmetic) * (2 * double) + double * double

    def _excess(self, tails: Sequence[arb], mains: Sequence[arb], w: Sequence[arb], share: arb) -> arb:
        """By how much the squared slope quotient changes when ``tails`` are added to ``mains``."""
        double = 2 * self.kappa * share
        total = arb(0)
        for tail, main, direction in zip(tails, mains, w, strict=True):
            whole = main + double * direction
            product = tail * (2 * whole + tail)
            difference = BALLS.integer_power(whole + tail, 2) - BALLS.integer_power(whole, 2)
            total += product.intersection(difference) if product.is_finite() else difference
        return total

    def direct_rest(self, box: Box, slope: bool) -> arb:
        """What :meth:`direct` without the rest misses on ``box`` (t > 0), as a ball."""
        balls = box.balls()
        size = _norm(balls[1:], BALLS)
        top = 2 * self.kappa - slope
        radius = 1 / (balls[0] * size) if box.outer else balls[0] / size
        u = box.face.cube_point(balls[1:])
        scale = BALLS.integer_power(balls[0] if box.outer else 1 / balls[0], top)
        tails = [value * scale for value in self._rest_tapes[slope].run([entry * radius for entry in u], BALLS)]
        if not slope:
            return tails[0]
        share, parts = _homogeneous_of(self, box.face, True)
        shrink = BALLS.integer_power(size, -top)
        mains = [_sum_of_powers(part, balls[1:], radius, top, BALLS) * shrink for part in parts]
        return self._excess(tails, mains, [entry / size for entry in u], share)

    # The form that includes t = 0: a polynomial, and a remainder.

    def leading(self, face: Face, outer: bool, slope: bool) -> Function:
        """The polynomial part of the quotient as a function of (t, v), defined for t ≥ 0.

        Near the source it leaves out the orders below 2κ, so it is refused before these are proved to vanish.
        """
        if not outer and not self.vanishing_is_proved:
            raise Undefined("the order of vanishing at the source is not known")
        share, parts = _parts_of(self, face, outer, slope)
        top = 2 * self.kappa - slope

        def function(values: Sequence[Any], arithmetic: Any) -> Any:
            size = _norm(values[1:], arithmetic)
            shrink = arithmetic.integer_power(size, -top)
            outputs = [part * shrink for part in _run_parts(parts, values, size, outer, arithmetic)]
            return self._finish(outputs, face, values[1:], size, share, slope, arithmetic)

        return function

    def remainder(self, box: Box, slope: bool) -> arb:
        """What is missing in :meth:`leading` on ``box``, as a ball; raises :class:`Undefined` where it has none."""
        if self.is_polynomial:
            return arb(0)
        balls = box.balls()
        size = _norm(balls[1:], BALLS)
        w = [entry / size for entry in box.face.cube_point(balls[1:])]
        tails = (self._outer_tails if box.outer else self._inner_tails)(box, w, slope)
        if not slope:
            return tails[0]
        share, parts = _parts_of(self, box.face, box.outer, True)
        scale = BALLS.integer_power(size, 1 - 2 * self.kappa)
        mains = [value * scale for value in _run_parts(parts, balls, size, box.outer, BALLS)]
        return self._excess(tails, mains, w, share)

    @cached_property
    def outer_expansion(self) -> Taylor:
        """The polynomial part of V with exact coefficients."""
        tape = compile_tape([self.polynomial.as_expr()], self.offsets)
        return taylor(tape, self.n, max(self.polynomial.total_degree(), 0))[0]

    def _inner_tails(self, box: Box, w: Sequence[arb], slope: bool) -> list[arb]:
        order = self.order + (0 if slope else 1)
        low, high = box.sides[0]
        if high.is_zero():
            return [arb(0)] * (self.n if slope else 1)
        factor = BALLS.integer_power(interval(low, high), self.order + 1 - 2 * self.kappa)
        return [factor * value for value in coefficient_along(self.tape(slope), interval(0, high), w, order)]

    @cached_property
    def _rests(self) -> tuple[list[sp.Expr], list[sp.Expr]]:
        return [self.rest], [sp.diff(self.rest, y) for y in self.offsets]

    @cached_property
    def _rest_tapes(self) -> list[Tape]:
        return [compile_tape(outputs, self.offsets) for outputs in self._rests]

    @cached_property
    def _rest_terms(self) -> list[list[list[tuple[Tape, LineBound | None]]]]:
        """For the rest and for its derivatives: each term with a bound over the whole line, if it has one."""

        def bounded(output: sp.Expr) -> list[tuple[Tape, LineBound | None]]:
            terms = sp.Add.make_args(sp.expand_mul(output))
            return [(compile_tape([term], self.offsets), line_bound(term, self.offsets)) for term in terms]

        return [list(map(bounded, outputs)) for outputs in self._rests]

    def _growths(self, w: Sequence[arb], reach: arb, slope: bool) -> list[Growth]:
        """The rest, or its derivatives, far out; a term that seems to grow too fast is replaced by its bound."""
        far = coordinates(w, reach)
        top = 2 * self.kappa - slope
        results = []
        for terms in self._rest_terms[slope]:
            total: Any = Growth({}, reach)
            for tape, bound in terms:
                try:
                    growth: Any = tape.run(far, GROWTHS)[0]
                except Undefined:
                    if bound is None:
                        raise
                    growth = bound.growth(w, reach)
                if bound is not None and isinstance(growth, Growth) and max(growth.terms, default=0) > top:
                    growth = bound.growth(w, reach)
                total = total + growth
            results.append(total)
        return results

    def _outer_tails(self, box: Box, w: Sequence[arb], slope: bool) -> list[arb]:
        low, high = box.sides[0]
        # At infinity itself the enclosure on a small neighbourhood serves: its decaying terms vanish there.
        reach = high if high > 0 else arb(1) / 2**20
        top = 2 * self.kappa - slope
        results = []
        for growth in self._growths(w, reach, slope):
            total = arb(0)
            for exponent, value in growth.terms.items():
                ends = [power_of(end, top - exponent) for end in (low, high)]
                if not all(end.is_finite() for end in ends):
                    raise Undefined("the field grows faster than the power 2κ")
                total += value.ball() * (interval(*ends) if low is not high else ends[0])
            results.append(total)
        return results


@lru_cache(maxsize=256)
def _parts_of(quotients: Quotients, face: Face, outer: bool, slope: bool) -> tuple[arb, list[Nested]]:
    whole = quotients.outer_expansion if outer else quotients.expansion
    return in_radius(whole, quotients.kappa, face, outer, slope)


@lru_cache(maxsize=256)
def _homogeneous_of(quotients: Quotients, face: Face, slope: bool) -> tuple[arb, list[dict[int, Nested]]]:
    return by_degree(quotients.outer_expansion, quotients.kappa, face, slope)


def _sum_of_powers(part: dict[int, Nested], v: Sequence[Any], radius: Any, top: int, arithmetic: Any) -> Any:
    powers = (nested.run(v) * arithmetic.integer_power(radius, degree - top) for degree, nested in part.items())
    return sum(powers, arb(0))


def _norm(v: Sequence[Any], arithmetic: Any) -> Any:
    return arithmetic.root(_squares(v, arithmetic) + arb(1), 1, 2, True) if v else arb(1)


def _squares(values: Sequence[Any], arithmetic: Any) -> Any:
    return reduce(operator.add, (arithmetic.integer_power(value, 2) for value in values))


def _inverse(value: Any, arithmetic: Any) -> Any:
    return arithmetic.integer_power(value, -1)


def _run_parts(parts: Sequence[Nested], values: Sequence[Any], size: Any, outer: bool, arithmetic: Any) -> list[Any]:
    t = values[0]
    radial = t * size if outer else t * _inverse(size, arithmetic)
    return [part.run([radial, *values[1:]]) for part in parts]
