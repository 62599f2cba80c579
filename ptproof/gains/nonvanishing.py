"""Bounds for a drift that is only known to be bounded, ‖f‖ ≤ d.

With U = V^(1/2κ) and r = 2κ − 1 the averaged system satisfies dU/dτ ≤ −h₁U^r + h₂dw with w = dt/dτ, which is ν² for
the paper's clock (eq:Ux_inequality), and
a₂^(1/2κ)‖x̄ − x*‖ ≤ U ≤ a₁^(1/2κ)‖x̄ − x*‖ (eq:Ux_bounds). By direct comparison (see
:class:`ptproof.comparison.DampedBound`) U ≤ w + (ζ/h₁)^(1/r) for ζ = sup h₂dw, so that
‖x̄ − x*‖ ≤ β + a₂^(−1/2κ)(ζ/h₁)^(1/r), which is at most β + γ with the printed γ.
"""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

from ptproof.comparison import DampedBound, fading_input
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, sign
from ptproof.problem.field import FieldBounds

STRETCHED = sp.Symbol("tau", real=True)
# The comparison is checked once in these letters, and the numbers are put in afterwards.
_START = sp.Symbol("t0", real=True)
_INITIAL, _DAMPING, _HORIZON, _INPUT = sp.symbols("u0 h T zeta", positive=True)


def damping(bounds: FieldBounds, k: sp.Expr) -> sp.Expr:
    """h₁ = k·c₁²/(4κ) (eq:Ux_inequality)."""
    return k * bounds.c1**2 / (4 * bounds.kappa)


def input_factor(bounds: FieldBounds) -> sp.Expr:
    """h₂ = c₂/(2κ) (eq:Ux_inequality)."""
    return bounds.c2 / (2 * bounds.kappa)


def input_gain_printed(bounds: FieldBounds, k: sp.Expr, zeta: sp.Expr) -> sp.Expr:
    """γ(ζ) = (a₁/a₂²)^(1/2κ)·(ζ/h₁)^(1/r), as printed below eq:Ux_inequality3."""
    root = 1 / (2 * bounds.kappa)
    return (bounds.a1 / bounds.a2**2) ** root * _rest(bounds, k, zeta)


def input_gain(bounds: FieldBounds, k: sp.Expr, zeta: sp.Expr) -> sp.Expr:
    """a₂^(−1/2κ)·(ζ/h₁)^(1/r): what direct comparison gives, the printed γ divided by (a₁/a₂)^(1/2κ)."""
    return bounds.a2 ** (-1 / (2 * bounds.kappa)) * _rest(bounds, k, zeta)


def transient(bounds: FieldBounds, k: sp.Expr, distance: sp.Expr, elapsed: sp.Expr) -> sp.Expr:
    """β(‖x₀ − x*‖, s): a₂^(−1/2κ)·w(s), dw/ds = −h₁w^r from a₁^(1/2κ)‖x₀ − x*‖; class KL (eq:upper_bound)."""
    root = 1 / (2 * bounds.kappa)
    start = bounds.a1**root * distance
    return bounds.a2 ** (-root) * _undriven(bounds, k, start, elapsed)


def ultimate_bound(bounds: FieldBounds, k: sp.Expr, drift_bound: sp.Expr, gain: sp.Expr = sp.S.One) -> sp.Expr:
    """(a₁/a₂)^(1/2κ)·(2d/(k·K·b₁))^(1/r): the distance within which x̄ ends under the constant gain K.

    dV/dt ≤ ‖∇F‖(d − (Kk/2)‖∇F‖) is negative where ‖x̄ − x*‖^r > 2d/(kKb₁), so V ends at or below a₁ times the
    2κ-th power of that radius. It is never more than γ(h₂d/K).
    """
    r = 2 * bounds.kappa - 1
    radius = (2 * drift_bound / (k * gain * bounds.b1)) ** (1 / r)
    return (bounds.a1 / bounds.a2) ** (1 / (2 * bounds.kappa)) * radius


@lru_cache(maxsize=8)
def exact_bound(data: GainData) -> sp.Expr:
    """For κ = 1 the exact solution of the scalar inequality as an expression in τ, without a clip: it bounds √V.

    Raises :class:`NotApplicable` for κ ≥ 2, another clock than the paper's, and where k, T, the drift's bound or the
    start is unknown.
    """
    bounds = data.bounds
    k, T, d = data.known("k", "T", "drift_bound")
    data.horizon.only_printed()
    if bounds.kappa != 1:
        raise NotApplicable("the scalar inequality is solved in closed form for kappa = 1 only")
    _without_logarithms(bounds.a1, bounds.a2, bounds.b1, bounds.b2, k, T, d, data.start_value, data.t0)
    values = {
        _START: data.t0, _INITIAL: sp.sqrt(data.start_value), _DAMPING: damping(bounds, k), _HORIZON: T,
        _INPUT: input_factor(bounds) * d,
    }  # fmt: skip
    return _fading_in_letters().subs(values, simultaneous=True)


def exact_bound_clipped(data: GainData) -> sp.Expr:
    """:func:`exact_bound` up to the cap of a clipped gain and, the input being constant from there on, after it."""
    early = exact_bound(data)
    if data.nu_min is None:
        return early
    h, cap = damping(data.bounds, data.known("k")[0]), data.horizon.cap
    corner = data.t0 + data.horizon.stretched_corner
    fade = sp.exp(-h * (STRETCHED - corner))
    rest = input_factor(data.bounds) * data.known("drift_bound")[0] / (cap * h)
    late = early.subs(STRETCHED, corner) * fade + rest * (1 - fade)
    return sp.Piecewise((early, corner >= STRETCHED), (late, True))


def distance_bound(data: GainData, elapsed: sp.Expr) -> sp.Expr:
    """How far x̄ can be from the source at the elapsed time e, under a clipped gain or before T without one.

    For κ = 1 and the paper's clock the scalar inequality is solved exactly; otherwise it is solved in two phases
    before the corner (halves of the stretched time, as in eq:finale). After the corner the input is constant.
    """
    k, _, d = data.known("k", "T", "drift_bound")
    bounds, horizon, initial = data.bounds, data.horizon, data.start_value
    root = 1 / (2 * bounds.kappa)
    level = input_factor(bounds) * d
    _without_logarithms(elapsed, horizon.T, horizon.nu_min or sp.S.One)
    after = horizon.nu_min is not None and sign(elapsed - horizon.corner) > 0
    first = horizon.stretched(horizon.corner if after else elapsed)
    if bounds.kappa == 1 and horizon.is_printed:
        early = exact_bound(data).subs(STRETCHED, data.t0 + first)
    else:
        half = first / 2
        middle = _undriven(bounds, k, initial**root, half) + _rest(bounds, k, level)
        early = _undriven(bounds, k, middle, half) + _rest(bounds, k, level * horizon.weight(half))
    if not after:
        return bounds.a2 ** (-root) * early
    remaining, late = horizon.stretched(elapsed) - first, level / horizon.cap
    if bounds.kappa == 1:
        fade = sp.exp(-damping(bounds, k) * remaining)
        final = early * fade + late / damping(bounds, k) * (1 - fade)
    else:
        final = _undriven(bounds, k, early, remaining) + _rest(bounds, k, late)
    return bounds.a2 ** (-root) * final


def printed_distance_bound(data: GainData) -> sp.Expr:
    """eq:finale at t₀ + T under a clipped gain, with the explicit β and the printed γ.

    The second half of the stretched time begins after the corner, so that ζ is at most h₂dν_min² there.
    """
    bounds, horizon, (k, d, nu_min) = data.bounds, data.horizon, data.known("k", "drift_bound", "nu_min")
    horizon.only_printed()
    _without_logarithms(k, d, nu_min, horizon.T, data.start_value)
    distance = data.x0_norm
    if distance is None:
        distance = (data.start_value / bounds.a2) ** (1 / (2 * bounds.kappa))
    half, level = horizon.stretched_end / 2, input_factor(bounds) * d
    middle = transient(bounds, k, distance, half) + input_gain_printed(bounds, k, level)
    return transient(bounds, k, middle, half) + input_gain_printed(bounds, k, level / horizon.cap)


def _without_logarithms(*numbers: sp.Expr) -> None:
    # In an exponent SymPy turns them into powers, of hundreds of digits where the coefficients are not simple.
    if any(number.has(sp.log) for number in numbers):
        raise NotApplicable("not evaluated for numbers with logarithms; give them as decimals")


def _undriven(bounds: FieldBounds, k: sp.Expr, start: sp.Expr, elapsed: sp.Expr) -> sp.Expr:
    values = {STRETCHED: elapsed, _INITIAL: start, _DAMPING: damping(bounds, k)}
    return _undriven_in_letters(2 * bounds.kappa - 1).subs(values, simultaneous=True)


@lru_cache
def _undriven_in_letters(power: sp.Expr) -> sp.Expr:
    return DampedBound(STRETCHED, sp.S.Zero, _INITIAL, _DAMPING, power, sp.S.Zero).transient


@lru_cache
def _fading_in_letters() -> sp.Expr:
    return fading_input(
        time=STRETCHED, start=_START, initial=_INITIAL, damping=_DAMPING, horizon=_HORIZON, input=_INPUT
    ).bound


def _rest(bounds: FieldBounds, k: sp.Expr, zeta: sp.Expr) -> sp.Expr:
    return (zeta / damping(bounds, k)) ** (1 / (2 * bounds.kappa - 1))
