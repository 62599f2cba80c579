"""The named changes of time: the paper's, and the power, logarithmic, exponential and tangent maps.

Every one of them is a :class:`~ptproof.transforms.clocks.clock.Clock`, so it can't be made with a wrong inverse.
With s = t − t₀, e = τ − t₀ and ν = 1 − s/T:

=============  ==================================  =====================  ===========================
map            τ − t₀                              rate dτ/dt             t − t₀
=============  ==================================  =====================  ===========================
power          (T/m)(ν⁻ᵐ − 1)                      ν⁻⁽ᵐ⁺¹⁾                T(1 − (1 + me/T)^(−1/m))
logarithmic    −T ln ν                             ν⁻¹                    T(1 − exp(−e/T))
exponential    T(exp(s/(T − s)) − 1)               ν⁻² exp(s/(T − s))     T L/(1 + L), L = ln(1 + e/T)
tangent        (2T/π) tan(πs/(2T))                 1 + tan²(πs/(2T))      (2T/π) arctan(πe/(2T))
growing        (exp(gs) − 1)/g, for all s ≥ 0      exp(gs)                ln(1 + ge)/g
=============  ==================================  =====================  ===========================

The power map of order m = 1 is the paper's. In τ a seeker with the gain dτ/dt is one with a constant gain, so what
decays like exp(−λe) there decays in t like ν^(λT) under the logarithmic map, and faster than every power of ν under
the others.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

import sympy as sp

from ptproof.errors import InputError
from ptproof.transforms.clocks.clock import Clock


def prescribed_time_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "prescribed-time clock"
) -> Clock:
    """The paper's map τ = t₀ + (t − t₀)/ν with ν = 1 − (t − t₀)/T (eq:tau_to_t, eq:nu, eq:t_to_tau)."""
    s, e, T = t - start, tau - start, horizon
    return Clock(t, tau, start + s / (1 - s / T), start + e / (1 + e / T), start, T, name)


def identity_clock(t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr) -> Clock:
    """τ = t: the clock of an asymptotic seeker."""
    return constant_clock(t, tau, start=start, rate=sp.S.One, name="identity clock")


def constant_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, rate: sp.Expr, name: str = "constant clock"
) -> Clock:
    """dτ/dt = ``rate`` > 0 all the time: the clock of a seeker with a constant gain."""
    return Clock(t, tau, start + rate * (t - start), start + (tau - start) / rate, start, sp.oo, name)


def power_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, order: sp.Expr, name: str = "power clock"
) -> Clock:
    """dτ/dt = ν^(−(m+1)) with the ``order`` m > 0, a positive number or symbol; m = 1 is the paper's map."""
    m, T = sp.sympify(order), horizon
    if not m.is_positive or m.has(sp.Float):
        raise InputError(f"{name}: the order must be an exact positive number or a positive symbol, got {m}")
    to_tau = start + T / m * ((1 - (t - start) / T) ** (-m) - 1)
    return Clock(t, tau, to_tau, start + T * (1 - (1 + m * (tau - start) / T) ** (-1 / m)), start, T, name)


def logarithmic_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "logarithmic clock"
) -> Clock:
    """dτ/dt = 1/ν, the slowest growth of this kind that still reaches τ = ∞; its inverse is an exponential."""
    s, e, T = t - start, tau - start, horizon
    return Clock(t, tau, start - T * sp.log(1 - s / T), start + T * (1 - sp.exp(-e / T)), start, T, name)


def exponential_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "exponential clock"
) -> Clock:
    """dτ/dt = ν⁻² exp(s/(T − s)), which grows faster than every power of 1/ν."""
    s, T = t - start, horizon
    logarithm = sp.log(1 + (tau - start) / T)
    to_tau = start + T * (sp.exp(s / (1 - s / T) / T) - 1)
    return Clock(t, tau, to_tau, start + T * logarithm / (1 + logarithm), start, T, name)


def tangent_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "tangent clock"
) -> Clock:
    """dτ/dt = 1 + tan²(πs/(2T))."""
    s, e, scale = t - start, tau - start, 2 * horizon / sp.pi
    return Clock(t, tau, start + scale * sp.tan(s / scale), start + scale * sp.atan(e / scale), start, horizon, name)


def growing_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, growth: sp.Expr, name: str = "growing clock"
) -> Clock:
    """dτ/dt = exp(g(t − t₀)) for all t ≥ t₀, with ``growth`` g > 0: an exponential gain on an infinite horizon."""
    s, e, g = t - start, tau - start, sp.sympify(growth)
    if not g.is_positive:
        raise InputError(f"{name}: the growth must be positive, got {g}")
    return Clock(t, tau, start + (sp.exp(g * s) - 1) / g, start + sp.log(1 + g * e) / g, start, sp.oo, name)


# What a problem file may say, and ``exponent`` is the power clock's order.
CLOCKS: Mapping[str, Callable[..., Clock]] = {
    "paper": prescribed_time_clock,
    "power": power_clock,
    "logarithmic": logarithmic_clock,
    "exponential": exponential_clock,
    "tangent": tangent_clock,
}
_TAKES_EXPONENT = ("power",)


def check_clock(name: str, exponent: object = None) -> None:
    """Refuse a name that no clock with a prescribed time has, and an exponent where none belongs or one is missing.

    Raises
    ------
    InputError
        Opening with ``clock`` or ``exponent``, whichever is at fault.
    """
    if name not in CLOCKS:
        raise InputError(f"clock: {name!r} is not one of {', '.join(CLOCKS)}")
    if name in _TAKES_EXPONENT and exponent is None:
        raise InputError(f"exponent: the clock {name!r} needs one, the m > 0 of the rate 1/nu^(m + 1)")
    if name not in _TAKES_EXPONENT and exponent is not None:
        raise InputError(f"exponent: the clock {name!r} takes none; that of the clock 'power' does")


def named_clock(
    name: str, t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, exponent: sp.Expr | None = None
) -> Clock:
    """The clock of that name in :data:`CLOCKS`, on [start, start + horizon)."""
    check_clock(name, exponent)
    more = {"order": exponent} if exponent is not None else {}
    return _made(CLOCKS[name], t, tau, start=start, horizon=horizon, **more)


@lru_cache(maxsize=64, typed=True)
def _made(make: Callable[..., Clock], *times: sp.Symbol, **numbers: sp.Expr) -> Clock:
    """A clock is a value, and what it checks of itself takes a tenth of a second."""
    return make(*times, **numbers)
