"""Gain conditions and bounds for a drift along the gradient, f = E∇F, and for no drift.

Along the averaged system dx/dτ = wE∇F + (k/2)∇F with w = dt/dτ (ν² for the paper's clock) and V = F(x*) − F, exactly
dV/dτ = −∇Fᵀ(wE + k/2)∇F ≤ (mw − k/2)‖∇F‖², where m = ‖E‖, or the sharper −λ_min((E + Eᵀ)/2) of a known E.
c₁V^q ≤ ‖∇F‖ ≤ c₂V^q (eq:ass4) turns this into a scalar inequality in two ways: the paper estimates the push by
c₂ and the gain by c₁, term by term; estimating the sum, by c₂ while it is positive and by c₁ while it is
negative, gives the *split* bound, which is never larger.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Literal

import sympy as sp

from ptproof.comparison import DilatedBound
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, Unlimited, short, sign, times_exponential
from ptproof.problem.field import FieldBounds

Chain = Literal["printed", "split"]
STRETCHED = sp.Symbol("tau", real=True)
# The comparison is checked once in these letters, and the numbers are put in afterwards.
_INITIAL, _HORIZON, _GROWTH, _DECAY = sp.symbols("V0 T g h", positive=True)


def smallest_gain_printed(bounds: FieldBounds, norm: sp.Expr) -> sp.Expr:
    """2(c₂/c₁)²‖E‖, above which the paper's asymptotic seeker converges on average (eq:convergence_cond)."""
    return 2 * (bounds.c2 / bounds.c1) ** 2 * norm


def smallest_gain(push: sp.Expr) -> sp.Expr:
    """max(0, 2m): the averaged asymptotic seeker converges for every k above it, whatever κ is.

    dV/dt ≤ (m − k/2)‖∇F‖² is negative off the source, and V is proper. With m = ‖E‖ no smaller constant
    serves all E of that norm: for E = −‖E‖I and k ≤ 2‖E‖ V does not decrease at all.
    """
    return sp.S.Zero if sign(push) <= 0 else 2 * push


def overshoot(bounds: FieldBounds, norm: sp.Expr, T: sp.Expr) -> sp.Expr:
    """√(a₁/a₂)·e^(c₂²‖E‖T/2), the factor of eq:x_bar_upper_bound (κ = 1)."""
    return sp.sqrt(bounds.a1 / bounds.a2) * sp.exp(bounds.c2**2 * norm * T / 2)


def decay_rate(bounds: FieldBounds, k: sp.Expr) -> sp.Expr:
    """k·c₁²/4, the decay rate of ‖x̄ − x*‖ in τ (eq:x_bar_upper_bound, κ = 1)."""
    return k * bounds.c1**2 / 4


def rates(data: GainData, chain: Chain) -> tuple[sp.Expr, sp.Expr]:
    """(g, h) of dV/dτ ≤ (g/(1 + (τ − t₀)/T)² − h)V^(1+σ) without a clip (eq:remark_inequality).

    For the split chain this holds up to the turning point only, with c₂ for both terms.
    """
    bounds, (k,) = data.bounds, data.known("k")
    push, lower = (data.norm, bounds.c1) if chain == "printed" else (data.push, bounds.c2)
    return bounds.c2**2 * push, k * lower**2 / 2


def escape_elapsed(data: GainData, chain: Chain, initial: sp.Expr) -> sp.Expr:
    """The first τ − t₀ at which the bound from V₀ = ``initial`` is infinite; applies at or above the threshold."""
    return _put_in(data, chain, _in_letters(data.bounds.sigma).escape_elapsed, initial)


def critical_value_at(data: GainData, elapsed: sp.Expr) -> sp.Expr | None:
    """The V₀ whose printed bound is infinite at τ − t₀ = ``elapsed`` (critical-V_0); None if there is none."""
    return critical_values(data, elapsed) if sign(last_critical(data) - elapsed) > 0 else None


def critical_values(data: GainData, elapsed: sp.Expr) -> sp.Expr:
    """That V₀ as a formula in ``elapsed``, between 0 and :func:`last_critical`."""
    return _put_in(data, "printed", _in_letters(data.bounds.sigma).critical_initial_at(elapsed))


def last_critical(data: GainData) -> sp.Expr:
    """T(g/h − 1), the τ − t₀ from which on the printed bound is infinite for no V₀."""
    (T,), (g, h) = data.known("T"), rates(data, "printed")
    return T * (g / h - 1)


def _put_in(data: GainData, chain: Chain, formula: sp.Expr, initial: sp.Expr = _INITIAL) -> sp.Expr:
    (T,), (g, h) = data.known("T"), rates(data, chain)
    return formula.subs({_GROWTH: g, _DECAY: h, _HORIZON: T, _INITIAL: initial}, simultaneous=True)


@lru_cache
def _in_letters(sigma: sp.Expr) -> DilatedBound:
    return DilatedBound(STRETCHED, sp.S.Zero, _INITIAL, _HORIZON, _GROWTH, _DECAY, sigma)


def threshold_factor(data: GainData, chain: Chain) -> sp.Expr | None:
    """The largest A up to the prescribed time 1, the cap included; None if A falls from the start, for every V₀.

    A is in proportion to T, so that V₀ is critical when σT·factor·V₀^σ = 1. Printed: (k·c₁²/2)(ρ − 1)² with
    ρ = (c₂/c₁)√(2‖E‖/k), for a clock whose cap, if it has one, lies behind the turning point K = ρ². Split: c₂²J at
    the turning point, or at the prescribed time where the cap keeps the gain below what would turn it.

    Raises
    ------
    NotApplicable
        For the printed chain where the cap comes first: the paper proves it without a clip.
    """
    bounds, (k,) = data.bounds, data.known("k")
    if chain == "printed":
        ratio = bounds.c2 / bounds.c1 * sp.sqrt(2 * data.norm / k)
        if sign(ratio - 1) <= 0:
            return None
        if data.nu_min is not None and sign(ratio**2 - data.unit.cap) > 0:
            raise NotApplicable(
                f"printed without a clip: nu_min = {short(data.nu_min)} caps the gain before this bound turns"
            )
        return k * bounds.c1**2 / 2 * (ratio - 1) ** 2
    horizon = data.unit
    turning = horizon.turning(data.push, k)
    return None if sign(turning) == 0 else bounds.c2**2 * horizon.balance(turning, data.push, k)


def critical_value(data: GainData, chain: Chain, T: sp.Expr | None = None) -> sp.Expr | None:
    """(σT·factor)^(−1/σ): below it the bound is finite up to t₀ + T (κ ≥ 2); None if every V₀ is below.

    Where the constants hold on a ball only, the bound must also stay below the level L that lies in it:
    (L^(−σ) + σT·factor)^(−1/σ), or L·exp(−T·factor) for κ = 1. ``T`` may be a positive symbol; left out, it is the
    data's.
    """
    factor, level, sigma = threshold_factor(data, chain), data.level, data.bounds.sigma
    if level is not None and chain == "printed":
        raise NotApplicable(f"printed for constants that hold everywhere; these hold within {short(data.radius)}")
    if factor is None:
        return level
    T = data.known("T")[0] if T is None else T
    if sigma == 0:
        return None if level is None else times_exponential(level, -T * factor)
    return ((sp.S.Zero if level is None else level ** (-sigma)) + sigma * T * factor) ** (-1 / sigma)


def critical_horizon(data: GainData, chain: Chain) -> sp.Expr:
    """The T below which the bound is finite up to t₀ + T for this drift, V₀ and ν_min; see :class:`Unlimited`.

    Where the constants hold on a ball only, it also stays in that ball; then V₀ must lie below its level.
    """
    factor, level, sigma = threshold_factor(data, chain), data.level, data.bounds.sigma
    if level is not None and chain == "printed":
        raise NotApplicable(f"printed for constants that hold everywhere; these hold within {short(data.radius)}")
    if level is not None and sign(level - data.start_value) <= 0:
        raise NotApplicable(f"the start need not lie where the constants hold: needs V0 < {short(sp.N(level, 6))}")
    if factor is None or (sigma == 0 and level is None):
        raise Unlimited("no threshold: the bound holds for every T")
    if sigma == 0:
        assert level is not None
        return sp.log(level / data.start_value) / factor
    room = data.start_value ** (-sigma) - (sp.S.Zero if level is None else level ** (-sigma))
    return room / (sigma * factor)


def escape_after_cap(data: GainData, initial: sp.Expr) -> sp.Expr:
    """The τ − t₀ at which the split bound from V₀ = ``initial`` is infinite where it survives until the cap.

    From there on A grows at the steady rate c₂²(m/K − k/2), K the largest rate; it must be positive.
    """
    bounds, horizon, (k,) = data.bounds, data.horizon, data.known("k")
    slope = bounds.c2**2 * (data.push / horizon.cap - k / 2)
    room = initial ** (-bounds.sigma) / bounds.sigma - growth(data, horizon.corner, "split")
    return horizon.stretched_corner + room / slope


def growth(data: GainData, elapsed: sp.Expr, chain: Chain) -> sp.Expr:
    """A(e) with dV/dτ ≤ A'V^(2q): the integral of the scalar rate up to the elapsed time e."""
    bounds, horizon, (k,) = data.bounds, data.horizon, data.known("k")
    if chain == "printed":
        return bounds.c2**2 * data.norm * elapsed - bounds.c1**2 * k / 2 * horizon.stretched(elapsed)
    turning = horizon.turning(data.push, k)
    if sign(elapsed - turning) <= 0:
        return bounds.c2**2 * horizon.balance(elapsed, data.push, k)
    top = horizon.balance(turning, data.push, k)
    return bounds.c2**2 * top + bounds.c1**2 * (horizon.balance(elapsed, data.push, k) - top)


def distance_bound(data: GainData, elapsed: sp.Expr, chain: Chain) -> sp.Expr | None:
    """(V/a₂)^(1/2κ) with the bound of V: how far x̄ can be from the source; None if the bound has escaped."""
    bounds, initial = data.bounds, data.start_value
    sigma, amount = bounds.sigma, growth(data, elapsed, chain)
    if sigma == 0:
        return times_exponential(sp.sqrt(initial / bounds.a2), amount / 2)
    (k,) = data.known("k")
    printed = chain == "printed"
    push, gain = (bounds.c2**2 * data.norm, k * bounds.c1**2) if printed else (data.push, k)
    turning = data.horizon.turning(push, gain)  # A rises up to there, and falls from there on
    largest = growth(data, turning, chain) if sign(elapsed - turning) > 0 else amount
    if sign(1 - sigma * initial**sigma * largest) <= 0:
        return None
    value = initial * (1 - sigma * initial**sigma * amount) ** (-1 / sigma)
    return (value / bounds.a2) ** (1 / (2 * bounds.kappa))


def clip_for_residual(data: GainData, chain: Chain, residual: sp.Expr) -> sp.Expr | None:
    """The largest ν_min ≤ 1 whose bound at t₀ + T is at most ``residual``; None if none is.

    The bound at T falls with the stretched time s_T that the clip allows, and A at T is linear in s_T, so the
    condition is solved for s_T in closed form, and that for ν_min where the gain is a power of ν.
    """
    data = replace(data, nu_min=None)  # which is what is sought
    bounds, initial, (k, T) = data.bounds, data.start_value, data.known("k", "T")
    sigma, target, clip = bounds.sigma, bounds.a2 * residual ** (2 * bounds.kappa), data.horizon.clip_for
    wanted = (
        sp.log(target / initial) if sigma == 0 else (initial ** (-sigma) - target ** (-sigma)) / sigma
    )  # A at T must not exceed this
    factor = threshold_factor(data, chain)
    if sigma != 0 and factor is not None and sign(1 - sigma * T * factor * initial**sigma) <= 0:
        return None  # the bound must survive its maximum, which no clip lowers once it lies behind the maximum
    if chain == "printed":
        return clip((bounds.c2**2 * data.norm * T - wanted) * 2 / (k * bounds.c1**2))
    top = sp.S.Zero if factor is None else T * factor
    if factor is None or sign(wanted - top) <= 0:  # the gain wins before the clip
        return clip((data.push * T - top / bounds.c2**2 - (wanted - top) / bounds.c1**2) * 2 / k)
    return clip((data.push * T - wanted / bounds.c2**2) * 2 / k)
