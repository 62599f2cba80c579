"""One function for each key of the answer: its exact expression, or :class:`NotApplicable` with the reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import sympy as sp

from ptproof.gains import nonvanishing, vanishing
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, sign, times_exponential


def _along_gradient(data: GainData) -> None:
    if data.drift_bound is not None and data.drift_norm is None:
        raise NotApplicable("the drift is bounded, not along the gradient; see nonvanishing")


def _quadratic(data: GainData) -> None:
    _along_gradient(data)
    if data.bounds.kappa != 1:
        raise NotApplicable("for kappa = 1 only: with kappa >= 2 the average decays like a power of tau")


def _higher(data: GainData) -> None:
    _along_gradient(data)
    if data.bounds.kappa == 1:
        raise NotApplicable("for kappa = 1 the bound is finite for every V0 and T")


def _printed(data: GainData, chain: vanishing.Chain) -> None:
    if chain == "printed":
        data.unit.only_printed()


def _k_min_printed(data: GainData) -> sp.Expr:
    _along_gradient(data)
    return vanishing.smallest_gain_printed(data.bounds, data.norm)


def _k_min(data: GainData) -> sp.Expr:
    _along_gradient(data)
    return vanishing.smallest_gain(data.push)


def _overshoot(data: GainData) -> sp.Expr:
    _quadratic(data)
    data.unit.only_printed()
    if data.norm == 0:
        return sp.sqrt(data.bounds.a1 / data.bounds.a2)
    (T,) = data.known("T")
    return vanishing.overshoot(data.bounds, data.norm, T)


def _overshoot_split(data: GainData) -> sp.Expr:
    _along_gradient(data)
    bounds = data.bounds
    factor = (bounds.a1 / bounds.a2) ** (1 / (2 * bounds.kappa))
    if sign(data.push) <= 0:
        return factor
    _, T = data.known("k", "T")
    top = T * (vanishing.threshold_factor(data, "split") or sp.S.Zero)
    if bounds.sigma == 0:
        return times_exponential(factor, top / 2)
    left = 1 - bounds.sigma * data.start_value**bounds.sigma * top
    if sign(left) <= 0:
        raise NotApplicable("V0 is not below the critical value: the bound escapes")
    return factor * left ** (-1 / (bounds.sigma * 2 * bounds.kappa))


def _rate(data: GainData) -> sp.Expr:
    _quadratic(data)
    (k,) = data.known("k")
    return vanishing.decay_rate(data.bounds, k)


def _at_tau_star(data: GainData) -> sp.Expr:
    _higher(data)
    data.unit.only_printed()
    _, _, tau_star = data.known("k", "T", "tau_star")
    value = vanishing.critical_value_at(data, tau_star - data.t0)
    if value is None:
        raise NotApplicable("the denominator vanishes at no V0: needs ||E|| > k*c1**2/(2*c2**2)*((tau*-t0)/T + 1)")
    return value


def _V0_threshold(chain: vanishing.Chain) -> Callable[[GainData], sp.Expr]:
    def compute(data: GainData) -> sp.Expr:
        _higher(data)
        _printed(data, chain)
        value = vanishing.critical_value(data, chain)
        if value is None:
            raise NotApplicable("no threshold: the bound decreases from the start, for every V0")
        return value

    return compute


def _T_threshold(chain: vanishing.Chain) -> Callable[[GainData], sp.Expr]:
    def compute(data: GainData) -> sp.Expr:
        _higher(data)
        _printed(data, chain)
        value = vanishing.critical_horizon(data, chain, data.start_value)
        if value is None:
            raise NotApplicable("no threshold: the guarantee holds for every T")
        return value

    return compute


def _escape(chain: vanishing.Chain) -> Callable[[GainData], sp.Expr]:
    def compute(data: GainData) -> sp.Expr:
        _higher(data)
        data.unit.only_printed()
        initial = data.start_value
        threshold = vanishing.critical_value(data, chain)
        if threshold is None or sign(threshold - initial) > 0:
            raise NotApplicable("never: V0 is below the threshold, the bound is finite for all time")
        return data.t0 + vanishing.escape_elapsed(data, chain, initial)

    return compute


def _h1(data: GainData) -> sp.Expr:
    (k,) = data.known("k")
    return nonvanishing.damping(data.bounds, k)


def _gamma(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    return nonvanishing.input_gain_printed(data.bounds, k, nonvanishing.input_factor(data.bounds) * d)


def _ultimate(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    return nonvanishing.ultimate_bound(data.bounds, k, d, _last_gain(data))


def _ultimate_printed(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    return nonvanishing.input_gain_printed(
        data.bounds, k, nonvanishing.input_factor(data.bounds) * d / _last_gain(data)
    )


def _last_gain(data: GainData) -> sp.Expr:
    return sp.S.One if data.nu_min is None else data.unit.cap


def _exact_bound(data: GainData) -> sp.Expr:
    return nonvanishing.exact_bound(data) / sp.sqrt(data.bounds.a2)


def _tau_end(data: GainData) -> sp.Expr:
    data.known("T", "nu_min")
    return data.t0 + data.horizon.stretched_end


def _k_effective(data: GainData) -> sp.Expr:
    k, _ = data.known("k", "nu_min")
    return k * data.unit.cap


def _k_min_after_clip(data: GainData) -> sp.Expr:
    _along_gradient(data)
    data.known("nu_min")
    return vanishing.smallest_gain(data.push) / data.unit.cap


def _u1_peak(data: GainData) -> sp.Expr:
    omega, _ = data.known("omega", "nu_min")
    return sp.sqrt(omega) * data.unit.cap


def _u2_peak(data: GainData) -> sp.Expr:
    """(ω + kG(√ω + ‖f‖))K, G = b₂‖x₀ − x*‖^(2κ−1), K the last gain: no farther out than at the start.

    With e = y − z, de/dτ = ∇F·dx/dτ − e/μ and |∇F·dx/dτ| ≤ G(√ω + ‖f‖), so |e|/μ stays below that when z starts
    at the measured field.
    """
    omega, _, k, distance = data.known("omega", "nu_min", "k", "x0_norm")
    slope = data.bounds.b2 * distance ** (2 * data.bounds.kappa - 1)
    drift = data.norm * slope if data.drift_bound is None else data.drift_bound
    return (omega + k * slope * (sp.sqrt(omega) + drift)) * data.unit.cap


def _residual(chain: vanishing.Chain) -> Callable[[GainData], sp.Expr]:
    def compute(data: GainData) -> sp.Expr:
        _, T, _ = data.known("k", "T", "nu_min")
        _printed(data, chain)
        if data.drift_bound is not None:
            if sign(data.norm) != 0:
                raise NotApplicable("both a gradient drift and a bounded one were given; give one")
            if chain == "printed":
                return nonvanishing.printed_distance_bound(data)
            return nonvanishing.distance_bound(data, T)
        value = vanishing.distance_bound(data, T, chain)
        if value is None:
            raise NotApplicable("the bound escapes before t0 + T: V0 is too large for this T, k and drift")
        return value

    return compute


def _nu_min_for_residual(data: GainData) -> sp.Expr:
    (residual,) = data.known("residual")
    if data.drift_bound is not None:
        raise NotApplicable("solved in closed form only without a bounded drift")
    value = vanishing.clip_for_residual(data, "split", residual)
    if value is None:
        raise NotApplicable("no clip reaches it: V0 is not below the critical value")
    return value


ENTRIES: Mapping[str, Mapping[str, Callable[[GainData], sp.Expr]]] = MappingProxyType({
    "constants": {
        "q": lambda data: data.bounds.q,
        "sigma": lambda data: data.bounds.sigma,
        "c1": lambda data: data.bounds.c1,
        "c2": lambda data: data.bounds.c2,
    },
    "asymptotic": {"k_min_printed": _k_min_printed, "k_min": _k_min},
    "prescribed_time": {"overshoot": _overshoot, "rate": _rate, "overshoot_split": _overshoot_split},
    "critical": {
        "V0_at_tau_star": _at_tau_star,
        "V0_threshold_printed": _V0_threshold("printed"),
        "V0_threshold": _V0_threshold("split"),
        "T_threshold_printed": _T_threshold("printed"),
        "T_threshold": _T_threshold("split"),
        "escape_time": _escape("printed"),
        "escape_time_split": _escape("split"),
    },
    "nonvanishing": {
        "h1": _h1,
        "h2": lambda data: nonvanishing.input_factor(data.bounds),
        "gamma": _gamma,
        "ultimate_bound": _ultimate,
        "ultimate_bound_printed": _ultimate_printed,
        "exact_bound": _exact_bound,
    },
    "clip": {
        "tau_end": _tau_end,
        "k_effective": _k_effective,
        "k_min_after_clip": _k_min_after_clip,
        "u1_peak": _u1_peak,
        "u2_peak": _u2_peak,
        "residual_bound": _residual("split"),
        "residual_bound_printed": _residual("printed"),
        "nu_min_for_residual": _nu_min_for_residual,
    },
})  # fmt: skip
