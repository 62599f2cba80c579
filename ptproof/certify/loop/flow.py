"""The vehicle in the coordinates in which it is slow: the centre of its circle, its heading, the filter's deviation.

With σ = ωτ, δ = 1/√ω, m = μω, the position x, the heading s and g = (F(x) − z)/(μ√ω), the closed loop is, exactly,

    dx/dσ = δ e(s) + δ² d(τ, x),   ds/dσ = 1 − δkg,   dg/dσ = (∇F(x)·(e(s) + δ d(τ, x)) − g)/m,

with e = (cos s, sin s) and d the drift in τ (f divided by the gain). The centre y = x − x* − δn(s), where
n = (sin s, −cos s), of the circle of radius δ on which the vehicle turns while g = 0 obeys

    dy/dσ = δ²(k g e(s) + d(τ, x* + y + δn)),

since dn/ds = e. So y moves at the order δ². Functions at x = x* + y + δn are Taylor polynomials in δ around y, with
Lagrange rests that stay as bounded letters. Last, q = g − ρ(y, s, τ) with any ρ that is a polynomial in these letters,
and the derivative of every function of (y, s, q, τ) along the loop is a polynomial again.

A function W that decreases along the vehicle is V of the circle's centre, corrected order by order. Nothing in that has
to be right: W and ρ are looked for in floats, and whatever they are, what is proved is proved of the derivative of
exactly this W (:meth:`Flow.derivative`). A wrong coefficient costs the certificate, not its truth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from flint import acb, arb

from ptproof.certify.loop.jets import CLOCK, FIELD, FIRST, REST, SECOND, Jets
from ptproof.certify.loop.polynomials import (
    ZERO,
    Key,
    Letter,
    Polynomial,
    by_filter,
    by_heading,
    by_slow,
    product,
    real,
    scaled,
    selected,
    term,
    total,
)

ONE = acb(1)
_HALF, _TURN = acb(0.5), acb(0, 0.5)
DIRECTION: tuple[Polynomial, Polynomial] = (
    {(0, 1, 0, ()): _HALF, (0, -1, 0, ()): _HALF},
    {(0, 1, 0, ()): -_TURN, (0, -1, 0, ()): _TURN},
)
"""e(s) = (cos s, sin s)."""
OUTWARD: tuple[Polynomial, Polynomial] = (DIRECTION[1], scaled(-ONE, DIRECTION[0]))
"""n(s) = (sin s, −cos s)."""
FILTER = term(ONE, power=1)


@dataclass(frozen=True)
class Flow:
    """The closed loop in (y, s, q, τ), as derivatives with respect to σ.

    Attributes
    ----------
    jets
        The letters.
    k, m
        Balls around the gain and around μω.
    matrix
        E where the drift is h E∇F; None where its entries are letters or there is none.
    drifting
        Whether there is a drift.
    manifold
        ρ, with real coefficients.
    """

    jets: Jets
    k: arb
    m: arb
    matrix: tuple[tuple[arb, arb], tuple[arb, arb]] | None
    drifting: bool
    manifold: Polynomial

    @cached_property
    def slope(self) -> tuple[Polynomial, Polynomial]:
        """∇F(x)."""
        order = self.jets.order
        first, second = (self.jets.moved(letter, order, OUTWARD) for letter in (Letter(FIELD, 1), Letter(FIELD, 0, 1)))
        return first, second

    @cached_property
    def drift(self) -> tuple[Polynomial, Polynomial]:
        """d(τ, x)."""
        if not self.drifting:
            return ZERO, ZERO
        if self.matrix is None:
            first, second = (self.jets.moved(Letter(name), self.jets.order - 1, OUTWARD) for name in (FIRST, SECOND))
            return first, second
        factor = term(ONE, Letter(CLOCK))
        first, second = (
            product(factor, total(*(scaled(acb(entry), part) for entry, part in zip(row, self.slope, strict=True))))
            for row in self.matrix
        )
        return first, second

    @cached_property
    def filter_rate(self) -> Polynomial:
        """g = q + ρ, proportional to what turns the heading away from a steady circle."""
        return total(FILTER, self.manifold)

    @cached_property
    def turning(self) -> Polynomial:
        """ds/dσ."""
        return total(term(ONE), scaled(acb(-self.k), self.filter_rate, grade=1))

    @cached_property
    def centre(self) -> tuple[Polynomial, Polynomial]:
        """dy/dσ."""
        first, second = (
            total(scaled(acb(self.k), product(self.filter_rate, e), grade=2), scaled(ONE, d, grade=2))
            for e, d in zip(DIRECTION, self.drift, strict=True)
        )
        return first, second

    @cached_property
    def deviation(self) -> Polynomial:
        """dq/dσ = dg/dσ − dρ/dσ."""
        drive = [
            product(slope, total(e, scaled(ONE, d, grade=1)))
            for slope, e, d in zip(self.slope, DIRECTION, self.drift, strict=True)
        ]
        measured = scaled(1 / acb(self.m), total(*drive, scaled(-ONE, self.filter_rate)))
        return total(measured, scaled(-ONE, self._without_filter(self.manifold)))

    def derivative(self, function: Polynomial) -> Polynomial:
        """The derivative of a function of (y, s, q, τ) along the closed loop."""
        return total(self._without_filter(function), product(by_filter(function), self.deviation))

    def _without_filter(self, function: Polynomial) -> Polynomial:
        along = self.jets.derivative
        return total(
            product(by_heading(function), self.turning),
            *(product(by_slow(function, axis, along), rate) for axis, rate in enumerate(self.centre)),
            scaled(ONE, by_slow(function, 2, along), grade=2),
        )


_NOISE = 1e-13


@dataclass(frozen=True)
class Lyapunov:
    """W and its rate dW/dτ."""

    flow: Flow
    function: Polynomial
    rate: Polynomial

    @staticmethod
    def of(flow: Flow, function: Polynomial) -> Lyapunov:
        """From any W, by exact differentiation along the flow."""
        return Lyapunov(flow, function, scaled(acb(1), flow.derivative(function), grade=-2))


def lyapunov(flow: Flow, start: Polynomial, order: int, manifold_order: int, weight: float) -> Lyapunov:
    """``start`` V, corrected to ``order``, with q measured from the slow manifold to ``manifold_order``.

    At the grade j the manifold solves m ∂ρ_j/∂s + ρ_j = what is left of m dq/dσ at q = 0, and W_j solves
    L₀W_j = −(R_j − its mean over s at q = 0), L₀ = ∂_s − (q/m)∂_q, which is diagonal in the terms exp(ins) q^p.
    ``weight`` is the λ of (λ/2)q².
    """
    flow = replace(flow, manifold=ZERO)
    m = float(flow.m)
    for grade in range(manifold_order + 1):
        left = selected(flow.deviation, _plain(grade, lambda key: key[2] == 0))
        step = {key: complex(value) * m / (1 + 1j * key[1] * m) for key, value in left.items()}
        flow = replace(flow, manifold=total(flow.manifold, _exact(step)))
    corrected = start
    for grade in range(1, order + 1):
        left = selected(flow.derivative(corrected), _plain(grade, lambda key: bool(key[1] or key[2])))
        step = {key: -complex(value) / (1j * key[1] - key[2] / m) for key, value in left.items()}
        corrected = total(corrected, _exact(step))
    return Lyapunov.of(flow, total(corrected, term(acb(weight) / 2, power=2)))


def _plain(grade: int, keep: Callable[[Key], bool]) -> Callable[[Key], bool]:
    """Of this grade, kept, with letters that W may have: no rests, and nothing that jumps where the gain is clipped."""
    return lambda key: (
        key[0] == grade and keep(key) and not any(letter.late or letter.name.startswith(REST) for letter in key[3])
    )


def _exact(part: Polynomial) -> Polynomial:
    """The terms that are more than rounding, as exact balls."""
    kept = {key: value for key, value in part.items() if abs(value) > _NOISE}
    return {key: acb(value) for key, value in real(kept).items()}
