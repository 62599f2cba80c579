"""One function for each key of the answer: its exact expression, or :class:`NotApplicable` with the reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, TypeAlias

import sympy as sp

from ptproof.gains import nonvanishing, vanishing
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, Unlimited, sign, times_exponential
from ptproof.gains.vanishing import Chain

Formula: TypeAlias = Callable[..., sp.Expr]


@dataclass(frozen=True)
class Entry:
    """A key of the answer: what a table calls it, and its expression for given data."""

    label: str
    compute: Callable[[GainData], sp.Expr]


TITLES: Mapping[str, str] = MappingProxyType({
    "constants": "Constants", "asymptotic": "Asymptotic seeker", "prescribed_time": "Prescribed time",
    "critical": "Critical start and time", "nonvanishing": "Drift that does not vanish", "clip": "Clipped gain",
})  # fmt: skip
_entries: dict[str, dict[str, Entry]] = {section: {} for section in TITLES}
ENTRIES: Mapping[str, Mapping[str, Entry]] = MappingProxyType(_entries)
"""Section to key to entry, in the order of this module."""


def _entry(key: str, label: str, **chosen: Any) -> Callable[[Formula], Formula]:
    """Put the function into :data:`ENTRIES` under ``section.key``; ``chosen`` are its further arguments."""

    def put(formula: Formula) -> Formula:
        section, name = key.split(".")
        _entries[section][name] = Entry(label, partial(formula, **chosen))
        return formula

    return put


def _along_gradient(data: GainData) -> None:
    if data.drift_bound is not None and data.drift_norm is None:
        raise NotApplicable("the drift is bounded, not along the gradient; see nonvanishing")


def _quadratic(data: GainData) -> None:
    _along_gradient(data)
    if data.bounds.kappa != 1:
        raise NotApplicable("for kappa = 1 only: with kappa >= 2 the average decays like a power of tau")


def _higher(data: GainData, chain: Chain, *, threshold: bool = False) -> None:
    _along_gradient(data)
    if data.bounds.kappa == 1:
        unlimited = threshold and (chain == "split" or data.unit.is_printed)
        raise (Unlimited if unlimited else NotApplicable)("for kappa = 1 the bound is finite for every V0 and T")
    _known_chain(data, chain)


def _known_chain(data: GainData, chain: Chain) -> None:
    if chain == "printed":
        data.unit.only_printed()


@_entry("constants.c2", "c₂ = b₂/a₂^q", name="c2")
@_entry("constants.c1", "c₁ = b₁/a₁^q", name="c1")
@_entry("constants.sigma", "exponent σ = 2q − 1", name="sigma")
@_entry("constants.q", "exponent q", name="q")
def _constant(data: GainData, name: str) -> sp.Expr:
    return getattr(data.bounds, name)


@_entry("asymptotic.k_min_printed", "least k, as printed")
def _k_min_printed(data: GainData) -> sp.Expr:
    _along_gradient(data)
    return vanishing.smallest_gain_printed(data.bounds, data.norm)


@_entry("asymptotic.k_min", "least k that suffices")
def _k_min(data: GainData) -> sp.Expr:
    _along_gradient(data)
    return vanishing.smallest_gain(data.push)


@_entry("prescribed_time.overshoot", "overshoot factor, as printed")
def _overshoot(data: GainData) -> sp.Expr:
    _quadratic(data)
    _known_chain(data, "printed")
    if data.norm == 0:
        return sp.sqrt(data.bounds.a1 / data.bounds.a2)
    (T,) = data.known("T")
    return vanishing.overshoot(data.bounds, data.norm, T)


@_entry("prescribed_time.rate", "decay rate in τ")
def _rate(data: GainData) -> sp.Expr:
    _quadratic(data)
    (k,) = data.known("k")
    return vanishing.decay_rate(data.bounds, k)


@_entry("prescribed_time.overshoot_split", "overshoot factor, sharper")
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


@_entry("critical.V0_at_tau_star", "V₀ that escapes at τ*")
def _at_tau_star(data: GainData) -> sp.Expr:
    _higher(data, "printed")
    _, _, tau_star = data.known("k", "T", "tau_star")
    value = vanishing.critical_value_at(data, tau_star - data.t0)
    if value is None:
        raise NotApplicable("the denominator vanishes at no V0: needs ||E|| > k*c1**2/(2*c2**2)*((tau*-t0)/T + 1)")
    return value


@_entry("critical.V0_threshold", "safe V₀ below", chain="split")
@_entry("critical.V0_threshold_printed", "safe V₀ below, as printed", chain="printed")
def _V0_threshold(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, chain, threshold=True)
    value = vanishing.critical_value(data, chain)
    if value is None:
        raise Unlimited("no threshold: the bound decreases from the start, for every V0")
    return value


@_entry("critical.T_threshold", "safe T below", chain="split")
@_entry("critical.T_threshold_printed", "safe T below, as printed", chain="printed")
def _T_threshold(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, chain, threshold=True)
    return vanishing.critical_horizon(data, chain)


@_entry("critical.escape_time_split", "the sharper bound escapes at τ", chain="split")
@_entry("critical.escape_time", "the printed bound escapes at τ", chain="printed")
def _escape(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, "printed")
    initial = data.start_value
    threshold = vanishing.critical_value(data, chain)
    if threshold is None or sign(threshold - initial) > 0:
        raise NotApplicable("never: V0 is below the threshold, the bound is finite for all time")
    return data.t0 + vanishing.escape_elapsed(data, chain, initial)


@_entry("nonvanishing.h1", "h₁")
def _h1(data: GainData) -> sp.Expr:
    (k,) = data.known("k")
    return nonvanishing.damping(data.bounds, k)


@_entry("nonvanishing.h2", "h₂")
def _h2(data: GainData) -> sp.Expr:
    return nonvanishing.input_factor(data.bounds)


@_entry("nonvanishing.gamma", "γ(h₂d), as printed")
def _gamma(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    return nonvanishing.input_gain_printed(data.bounds, k, nonvanishing.input_factor(data.bounds) * d)


@_entry("nonvanishing.ultimate_bound", "ultimate distance")
def _ultimate(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    return nonvanishing.ultimate_bound(data.bounds, k, d, _last_rate(data))


@_entry("nonvanishing.ultimate_bound_printed", "ultimate distance, printed γ")
def _ultimate_printed(data: GainData) -> sp.Expr:
    k, d = data.known("k", "drift_bound")
    level = nonvanishing.input_factor(data.bounds) * d / _last_rate(data)
    return nonvanishing.input_gain_printed(data.bounds, k, level)


def _last_rate(data: GainData) -> sp.Expr:
    return sp.S.One if data.nu_min is None else data.unit.cap


@_entry("nonvanishing.exact_bound", "exact bound in τ, unclipped")
def _exact_bound(data: GainData) -> sp.Expr:
    return nonvanishing.exact_bound(data) / sp.sqrt(data.bounds.a2)


@_entry("clip.tau_end", "τ reached at t₀ + T")
def _tau_end(data: GainData) -> sp.Expr:
    data.known("T", "nu_min")
    return data.t0 + data.horizon.stretched_end


@_entry("clip.k_effective", "gain after the clip, k·dτ/dt")
def _k_effective(data: GainData) -> sp.Expr:
    k, _ = data.known("k", "nu_min")
    return k * data.unit.cap


@_entry("clip.k_min_after_clip", "least k for convergence after the clip")
def _k_min_after_clip(data: GainData) -> sp.Expr:
    _along_gradient(data)
    data.known("nu_min")
    return vanishing.smallest_gain(data.push) / data.unit.cap


@_entry("clip.u1_peak", "peak of u₁")
def _u1_peak(data: GainData) -> sp.Expr:
    omega, _ = data.known("omega", "nu_min")
    return sp.sqrt(omega) * data.unit.cap


@_entry("clip.u2_peak", "peak of |u₂| while r ≤ r₀")
def _u2_peak(data: GainData) -> sp.Expr:
    """(ω + kG(√ω + ‖f‖))K, G = b₂‖x₀ − x*‖^(2κ−1), K the last rate: while no farther out than at the start.

    With e = y − z, de/dτ = ∇F·dx/dτ − e/μ and |∇F·dx/dτ| ≤ G(√ω + ‖f‖), so |e|/μ stays below that when z starts
    at the measured field.
    """
    omega, _, k, distance = data.known("omega", "nu_min", "k", "x0_norm")
    slope = data.bounds.b2 * distance ** (2 * data.bounds.kappa - 1)
    drift = data.norm * slope if data.drift_bound is None else data.drift_bound
    return (omega + k * slope * (sp.sqrt(omega) + drift)) * data.unit.cap


@_entry("clip.residual_bound_printed", "distance at t₀ + T, as printed", chain="printed")
@_entry("clip.residual_bound", "distance at t₀ + T is at most", chain="split")
def _residual(data: GainData, chain: Chain) -> sp.Expr:
    _, T, _ = data.known("k", "T", "nu_min")
    _known_chain(data, chain)
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


@_entry("clip.nu_min_for_residual", "largest ν_min for the residual")
def _nu_min_for_residual(data: GainData) -> sp.Expr:
    (residual,) = data.known("residual")
    if data.drift_bound is not None:
        raise NotApplicable("solved in closed form only without a bounded drift")
    value = vanishing.clip_for_residual(data, "split", residual)
    if value is None:
        raise NotApplicable("no clip reaches it: V0 is not below the critical value")
    return value
