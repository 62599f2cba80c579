"""Each key of the answer: what a table calls it, and its exact expression, or why it does not apply."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType

import sympy as sp

from ptproof.gains import nonvanishing, vanishing
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, Unlimited, short, sign, times_exponential
from ptproof.gains.vanishing import Chain


@dataclass(frozen=True)
class Entry:
    """A key of the answer.

    Attributes
    ----------
    label
        What a table calls it.
    formula
        Its expression for given data and the values of what it ``needs``, in this order.
    needs
        The data without which it does not apply.
    check
        Raises :class:`NotApplicable` for other data to which it does not apply.
    about
        Whose property it is: the ``average``'s, which is what the theorems speak of, the ``vehicle``'s itself, the
        ``field``'s or the ``clock``'s.
    """

    label: str
    formula: Callable[..., sp.Expr]
    needs: tuple[str, ...] = ()
    check: Callable[[GainData], None] | None = None
    about: str = "average"

    def compute(self, data: GainData) -> sp.Expr:
        """The expression; raises :class:`NotApplicable` with the reason where there is none."""
        if self.check is not None:
            self.check(data)
        return self.formula(data, *data.known(*self.needs))


def _one_drift(data: GainData) -> None:
    if data.drift_bound is not None and sign(data.drift_bound) != 0 and sign(data.norm) != 0:
        raise NotApplicable("both a gradient drift and a bounded one were given; give one")


def _along_gradient(data: GainData) -> None:
    _one_drift(data)
    if data.drift_bound is not None and (data.drift_norm is None or sign(data.drift_bound) != 0):
        raise NotApplicable("the drift is bounded, not along the gradient; see nonvanishing")


def _lasting(data: GainData) -> None:
    """Refuse what speaks of all time where the constants hold on a ball that may be left after t₀ + T."""
    _one_drift(data)
    if data.level is None:
        return
    bounds, (k,) = data.bounds, data.known("k")
    # V falls where it is above this, also under the least gain, K = 1.
    largest = bounds.a2 * nonvanishing.ultimate_bound(bounds, k, data.everlasting_drift) ** (2 * bounds.kappa)
    if max(sign(data.start_value - data.level), sign(largest - data.level)) > 0:
        raise NotApplicable(
            f"the constants hold within {short(data.radius)} of the source only, which may be left after t0 + T"
        )


def _quadratic(data: GainData) -> None:
    _along_gradient(data)
    if data.bounds.kappa != 1:
        raise NotApplicable("for kappa = 1 only: with kappa >= 2 the average decays like a power of tau")


def _higher(data: GainData, chain: Chain, *, threshold: bool = False) -> None:
    _along_gradient(data)
    if data.bounds.kappa == 1 and not (threshold and chain == "split" and data.level is not None):
        unlimited = threshold and data.level is None and (chain == "split" or data.unit.is_printed)
        raise (Unlimited if unlimited else NotApplicable)("for kappa = 1 the bound is finite for every V0 and T")
    if chain == "printed":
        data.unit.only_printed()


def _overshoot(data: GainData) -> sp.Expr:
    data.unit.only_printed()
    if data.norm == 0:
        return sp.sqrt(data.bounds.a1 / data.bounds.a2)
    return vanishing.overshoot(data.bounds, data.norm, *data.known("T"))


def _overshoot_split(data: GainData) -> sp.Expr:
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


def _at_tau_star(data: GainData) -> sp.Expr:
    _higher(data, "printed")
    _, _, tau_star = data.known("k", "T", "tau_star")
    if data.nu_min is not None and sign(tau_star - data.t0 - data.horizon.stretched_corner) > 0:
        raise NotApplicable(f"printed without a clip: tau_star lies behind the cap of nu_min = {short(data.nu_min)}")
    value = vanishing.critical_value_at(data, tau_star - data.t0)
    if value is None:
        raise NotApplicable("the denominator vanishes at no V0: needs ||E|| > k*c1**2/(2*c2**2)*((tau*-t0)/T + 1)")
    return value


def _V0_threshold(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, chain, threshold=True)
    value = vanishing.critical_value(data, chain)
    if value is None:
        falls = vanishing.threshold_factor(data, chain) is None
        why = "decreases from the start, for every V0" if falls else "is finite for every V0"
        raise Unlimited(f"no threshold: the bound {why}")
    return value


def _T_threshold(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, chain, threshold=True)
    return vanishing.critical_horizon(data, chain)


def _escape(data: GainData, chain: Chain) -> sp.Expr:
    _higher(data, "printed")
    initial, endless = data.start_value, replace(data, nu_min=None, radius=None)
    threshold = vanishing.critical_value(endless, chain)
    if threshold is not None and sign(threshold - initial) <= 0:
        elapsed = vanishing.escape_elapsed(endless, chain, initial)
        if data.nu_min is None or sign(elapsed - data.horizon.stretched_corner) <= 0:
            return data.t0 + elapsed
    elif data.nu_min is None:
        raise NotApplicable("never: V0 is below the threshold, the bound is finite up to t0 + T")
    if chain == "printed":
        raise NotApplicable("not before the clip, where the gain stops to grow; printed without one")
    threshold = vanishing.critical_value(replace(data, radius=None), chain)
    if threshold is None or sign(threshold - initial) > 0:
        raise NotApplicable("never: V0 is below the threshold, the bound is finite up to t0 + T")
    return data.t0 + vanishing.escape_after_cap(data, initial)


def _last_rate(data: GainData) -> sp.Expr:
    return sp.S.One if data.nu_min is None else data.unit.cap


def _ultimate_printed(data: GainData, k: sp.Expr, _: sp.Expr) -> sp.Expr:
    level = nonvanishing.input_factor(data.bounds) * data.everlasting_drift / _last_rate(data)
    return nonvanishing.input_gain_printed(data.bounds, k, level)


def _u2_peak(data: GainData, omega: sp.Expr, _: sp.Expr, k: sp.Expr, distance: sp.Expr) -> sp.Expr:
    """(ω + k(|e₀|/μ + G(√ω + ‖f‖)))K, G = b₂‖x₀ − x*‖^(2κ−1), K the last rate: while no farther out than at the start.

    With e = y − z, de/dτ = ∇F·dx/dτ − e/μ and |∇F·dx/dτ| ≤ G(√ω + ‖f‖), so |e|/μ stays below that where z starts
    at the measured field, and below |e₀|/μ more where it starts elsewhere.
    """
    _one_drift(data)
    error = data.filter_error / data.known("mu")[0] if sign(data.filter_error) != 0 else sp.S.Zero
    slope = data.bounds.b2 * distance ** (2 * data.bounds.kappa - 1)
    drift = data.norm * slope if data.drift_bound is None else data.drift_bound
    return (omega + k * (error + slope * (sp.sqrt(omega) + drift))) * data.unit.cap


def _residual(data: GainData, chain: Chain) -> sp.Expr:
    _, T, _ = data.known("k", "T", "nu_min")
    if chain == "printed":
        data.unit.only_printed()
    _one_drift(data)
    if data.drift_bound is not None:
        if chain == "printed":
            return nonvanishing.printed_distance_bound(data)
        return nonvanishing.distance_bound(data, T)
    value = vanishing.distance_bound(data, T, chain)
    if value is None:
        raise NotApplicable("the bound escapes before t0 + T: V0 is too large for this T, k and drift")
    return value


def _nu_min_for_residual(data: GainData, residual: sp.Expr) -> sp.Expr:
    if data.drift_bound is not None:
        raise NotApplicable("solved in closed form only without a bounded drift")
    value = vanishing.clip_for_residual(data, "split", residual)
    if value is None:
        raise NotApplicable("no clip reaches it: V0 is not below the critical value")
    return value


TITLES: Mapping[str, str] = MappingProxyType({
    "constants": "Constants", "asymptotic": "Asymptotic seeker", "prescribed_time": "Prescribed time",
    "critical": "Critical start and time", "nonvanishing": "Drift that does not vanish", "clip": "Clipped gain",
    "vehicle": "The vehicle around its average",
})  # fmt: skip
_TABLE: Mapping[str, Entry] = {
    "constants.q": Entry("exponent q", lambda data: data.bounds.q, about="field"),
    "constants.sigma": Entry("exponent σ = 2q − 1", lambda data: data.bounds.sigma, about="field"),
    "constants.c1": Entry("c₁ = b₁/a₁^q", lambda data: data.bounds.c1, about="field"),
    "constants.c2": Entry("c₂ = b₂/a₂^q", lambda data: data.bounds.c2, about="field"),
    "asymptotic.k_min_printed": Entry(
        "least k, as printed",
        lambda data: vanishing.smallest_gain_printed(data.bounds, data.norm), check=_along_gradient),
    "asymptotic.k_min": Entry(
        "least k that suffices", lambda data: vanishing.smallest_gain(data.push), check=_along_gradient),
    "prescribed_time.overshoot": Entry("overshoot up to t₀ + T, as printed", _overshoot, check=_quadratic),
    "prescribed_time.rate": Entry(
        "decay rate in τ", lambda data, k: vanishing.decay_rate(data.bounds, k), ("k",), _quadratic),
    "prescribed_time.overshoot_split": Entry(
        "overshoot up to t₀ + T, sharper", _overshoot_split, check=_along_gradient),
    "critical.V0_at_tau_star": Entry("V₀ that escapes at τ*", _at_tau_star),
    "critical.V0_threshold_printed": Entry("safe V₀ below, as printed", partial(_V0_threshold, chain="printed")),
    "critical.V0_threshold": Entry("safe V₀ below, up to t₀ + T", partial(_V0_threshold, chain="split")),
    "critical.T_threshold_printed": Entry("safe T below, as printed", partial(_T_threshold, chain="printed")),
    "critical.T_threshold": Entry("safe T below, up to t₀ + T", partial(_T_threshold, chain="split")),
    "critical.escape_time": Entry("the printed bound escapes at τ", partial(_escape, chain="printed")),
    "critical.escape_time_split": Entry("the sharper bound escapes at τ", partial(_escape, chain="split")),
    "nonvanishing.h1": Entry("h₁", lambda data, k: nonvanishing.damping(data.bounds, k), ("k",)),
    "nonvanishing.h2": Entry("h₂", lambda data: nonvanishing.input_factor(data.bounds)),
    "nonvanishing.gamma": Entry(
        "γ(h₂d), as printed",
        lambda data, k, d: nonvanishing.input_gain_printed(data.bounds, k, nonvanishing.input_factor(data.bounds) * d),
        ("k", "drift_bound"), _one_drift),
    "nonvanishing.ultimate_bound": Entry(
        "ultimate distance",
        lambda data, k, _: nonvanishing.ultimate_bound(data.bounds, k, data.everlasting_drift, _last_rate(data)),
        ("k", "drift_bound"), _lasting),
    "nonvanishing.ultimate_bound_printed": Entry(
        "ultimate distance, printed γ", _ultimate_printed, ("k", "drift_bound"), _lasting),
    "nonvanishing.exact_bound": Entry(
        "exact bound in τ", lambda data: nonvanishing.exact_bound_clipped(data) / sp.sqrt(data.bounds.a2),
        check=_one_drift),
    "clip.tau_end": Entry(
        "τ reached at t₀ + T", lambda data, *_: data.t0 + data.horizon.stretched_end, ("T", "nu_min"), about="clock"),
    "clip.k_effective": Entry(
        "gain after the clip, k·dτ/dt", lambda data, k, _: k * data.unit.cap, ("k", "nu_min"), about="clock"),
    "clip.k_min_after_clip": Entry(
        "least k for convergence after the clip",
        lambda data, _: vanishing.smallest_gain(data.push) / data.unit.cap, ("nu_min",), _along_gradient),
    "clip.u1_peak": Entry(
        "peak of u₁", lambda data, omega, _: sp.sqrt(omega) * data.unit.cap, ("omega", "nu_min"), about="vehicle"),
    "clip.u2_peak": Entry("peak of |u₂| while r ≤ r₀", _u2_peak, ("omega", "nu_min", "k", "x0_norm"), about="vehicle"),
    "clip.residual_bound": Entry("at t₀ + T within", partial(_residual, chain="split")),
    "clip.residual_bound_printed": Entry("at t₀ + T within, as printed", partial(_residual, chain="printed")),
    "clip.nu_min_for_residual": Entry(
        "largest ν_min for the residual", _nu_min_for_residual, ("residual",)),
    # The length of the average's first correction, whatever the field and the gain (simulation/order.py derives it).
    "vehicle.hover_radius": Entry(
        "circles at 1/√ω, to leading order", lambda data, omega: 1 / sp.sqrt(omega), ("omega",), about="vehicle"),
    "vehicle.omega_for_residual": Entry(
        "least ω with 1/√ω within the residual", lambda data, residual: 1 / residual**2, ("residual",),
        about="vehicle"),
}  # fmt: skip
ENTRIES: Mapping[str, Mapping[str, Entry]] = MappingProxyType({
    section: {key.split(".")[1]: entry for key, entry in _TABLE.items() if key.startswith(f"{section}.")}
    for section in TITLES
})  # fmt: skip
"""Section to key to entry, in this order."""
