"""What is said about a clipped gain includes the clip, at both sides of the instant at which the gain would win."""

import dataclasses
import math

import pytest
import random_sets
import sympy as sp
from scipy.integrate import solve_ivp

from ptproof.errors import InputError
from ptproof.gains import GainData, gains
from ptproof.gains.problem import gain_data
from ptproof.problem import example
from ptproof.problem.drift import bounded_drift
from ptproof.problem.field import FieldBounds
from ptproof.problem.model import TIME
from ptproof.testing import assert_gain_condition

R = sp.Rational
ONE = FieldBounds(1, R(3, 2), R(1, 2), R(1, 2), R(13, 4))
TWO = FieldBounds(2, R(3, 2), R(1, 2), R(7, 5), R(33, 10))
THREE = FieldBounds(3, R(3, 2), R(1), R(5), R(7))
CLOCKS = {
    "paper": {}, "power": {"clock": "power", "exponent": R(2)}, "logarithmic": {"clock": "logarithmic"},
    "exponential": {"clock": "exponential"}, "tangent": {"clock": "tangent"},
}  # fmt: skip


def scalar(data, initial, end, chain="split"):
    """V^-sigma (log V for kappa = 1) at the times up to ``end``, from the scalar inequality with equality."""
    sigma, norm, k, T = (float(v) for v in (data.bounds.sigma, data.norm, data.k, data.T))
    c1, c2, nu_min = float(data.bounds.c1), float(data.bounds.c2), float(data.nu_min)

    def rate(e, w):
        gain = k / 2 * random_sets.GAINS[data.clock](max(nu_min, 1 - e / T), float(data.exponent or 0))
        slope = c2**2 * norm - c1**2 * gain if chain == "printed" else (norm - gain) * (c2 if norm > gain else c1) ** 2
        return [slope if sigma == 0 else -sigma * slope]

    begin = math.log(initial) if sigma == 0 else initial**-sigma
    return solve_ivp(rate, (0, end), [begin], rtol=1e-9, atol=1e-12, max_step=end / 400).y[0]


def data(bounds, nu_min, clock="paper", **more):
    # The push outweighs the gain up to K = 2*5/(9/5) = 5.6.
    return GainData(bounds, k=R(9, 5), T=R(3, 2), drift_norm=R(5), nu_min=nu_min, **CLOCKS[clock], **more)


@pytest.mark.parametrize("nu_min", [R(9, 10), R(3, 5), R(1, 10)])
@pytest.mark.parametrize("clock", list(CLOCKS))
@pytest.mark.parametrize("bounds", [TWO, THREE])
def test_the_threshold_separates_escape_from_survival_up_to_the_prescribed_time(bounds, clock, nu_min):
    asked = data(bounds, nu_min, clock)
    threshold = gains(asked)["critical.V0_threshold"].value
    for factor, escapes in ((0.999, False), (1.001, True)):
        assert bool(scalar(asked, threshold * factor, 1.5).min() <= 0) is escapes


@pytest.mark.parametrize("nu_min", [R(9, 10), R(1, 10)])
def test_the_threshold_time_is_that_at_which_the_value_is_critical(nu_min):
    asked = dataclasses.replace(data(TWO, nu_min), V0=R(1, 50))
    T = gains(asked)["critical.T_threshold"].exact
    again = gains(dataclasses.replace(asked, T=T))["critical.V0_threshold"]
    assert again.value == pytest.approx(1 / 50)


def test_the_cap_makes_the_threshold_smaller_only_where_it_comes_first():
    free, late, early = (gains(data(TWO, nu))["critical.V0_threshold"].value for nu in (None, R(1, 10), R(9, 10)))
    assert late == pytest.approx(free)
    assert early < free / 2


@pytest.mark.parametrize("clock", list(random_sets.GAINS))
def test_no_average_overshoots_by_more_than_the_factor(clock):
    assert max(ratios(clock)) <= 1 + 1e-6


def ratios(clock):
    for seed in range(16):
        case = random_sets.make(seed, clock)
        if case.data.drift_bound is not None or case.data.bounds.kappa > 2:
            continue
        factor = gains(case.data)["prescribed_time.overshoot_split"]
        if factor is not None:
            found, escaped = random_sets.distances(case, [case.data.T * R(i, 8) for i in range(1, 9)])
            yield math.inf if escaped else max(found.values()) / (float(case.data.x0_norm) * factor.value)


def test_the_printed_factor_and_rate_hold_under_a_clip():
    for seed in range(40):
        case = random_sets.make(seed)
        if case.data.drift_bound is not None or case.data.bounds.kappa > 1:
            continue  # for which they are not given
        answer = gains(case.data)
        factor, rate = answer["prescribed_time.overshoot"], answer["prescribed_time.rate"]
        if factor is None or rate is None or answer["clip.residual_bound"] is None:
            continue
        times = [case.data.T * R(i, 4) for i in range(1, 5)]
        found, _ = random_sets.distances(case, times)
        for e in times:
            decay = math.exp(-rate.value * float(case.data.horizon.stretched(e)))
            assert found[float(e)] <= factor.value * decay * float(case.data.x0_norm) * (1 + 1e-6) + 1e-9


def test_what_comes_of_a_gain_that_is_capped_early_is_not_promised_away():
    """For F = −‖x‖²/2 and E = −5I the averaged distance is multiplied by exp(5 − (9/10)·11/9), and not by less."""
    asked = GainData(
        FieldBounds(1, R(1, 2), R(1, 2), 1, 1), k=R(9, 5), T=R(1), nu_min=R(9, 10), drift_norm=R(5), x0_norm=R(1)
    )
    with pytest.raises(AssertionError, match="refuted"):
        assert_gain_condition(asked, "prescribed_time.overshoot_split < 5")
    assert gains(asked)["prescribed_time.overshoot_split"].value == pytest.approx(math.exp(3.9))
    assert_gain_condition(dataclasses.replace(asked, nu_min=None), "prescribed_time.overshoot_split < 8")


@pytest.mark.parametrize("key", ["V0_threshold_printed", "T_threshold_printed"])
def test_a_printed_threshold_is_refused_where_the_cap_comes_first(key):
    late, early = (gains(data(TWO, nu, V0=R(1, 10))) for nu in (R(1, 100), R(3, 5)))
    assert late[f"critical.{key}"].value == gains(data(TWO, None, V0=R(1, 10)))[f"critical.{key}"].value
    assert early[f"critical.{key}"] is None
    assert "printed without a clip" in early.why[f"critical.{key}"]
    with pytest.raises(AssertionError, match="undecided"):
        assert_gain_condition(early.data, f"V0 < critical.{key}" if "V0" in key else f"T < critical.{key}")


def test_a_printed_critical_value_is_refused_behind_the_cap():
    corner = data(TWO, R(1, 2)).horizon.stretched_corner
    before, after = (gains(data(TWO, R(1, 2), tau_star=corner + shift)) for shift in (-R(1, 9), R(1, 9)))
    assert before["critical.V0_at_tau_star"] is not None
    assert "behind the cap" in after.why["critical.V0_at_tau_star"]


@pytest.mark.parametrize("nu_min", [R(9, 10), R(3, 5), R(1, 10)])
def test_the_escape_time_is_that_of_the_scalar_inequality(nu_min):
    asked = data(TWO, nu_min)
    threshold = gains(asked)["critical.V0_threshold"].value
    initial = R(str(round(1.05 * threshold, 9)))
    escape = gains(dataclasses.replace(asked, V0=initial))["critical.escape_time_split"].exact
    elapsed = float(asked.horizon.elapsed(escape))
    assert scalar(asked, float(initial), elapsed)[-1] == pytest.approx(0, abs=1e-5)
    below = gains(dataclasses.replace(asked, V0=initial / 2))
    assert below["critical.escape_time_split"] is None
    assert "never" in below.why["critical.escape_time_split"]


def test_the_exact_bound_goes_on_after_the_cap():
    asked = GainData(ONE, k=R(2), T=R(1), nu_min=R(1, 2), drift_bound=R(1), x0_norm=R(1), t0=R(3))
    formula = gains(asked)["nonvanishing.exact_bound"].exact
    end = float(formula.subs(sp.Symbol("tau", real=True), asked.t0 + asked.horizon.stretched_end))
    assert end == pytest.approx(gains(asked)["clip.residual_bound"].value)
    free = gains(dataclasses.replace(asked, nu_min=None))["nonvanishing.exact_bound"].exact
    assert float(free.subs(sp.Symbol("tau", real=True), asked.t0 + asked.horizon.stretched_end)) < end


BALL = {"radius": R(1), "k": R(9, 5), "T": R(3, 2), "nu_min": R(1, 5)}


@pytest.mark.parametrize("bounds", [ONE, TWO])
def test_on_a_ball_a_safe_start_does_not_leave_it(bounds):
    """At the threshold the scalar bound just reaches the level of V that lies in the ball."""
    asked = GainData(bounds, drift_norm=R(1), **BALL)
    threshold = gains(asked)["critical.V0_threshold"].value
    level = float(bounds.a2)
    path = scalar(asked, threshold, 1.5)
    top = math.exp(path.max()) if bounds.kappa == 1 else path.min() ** (-1 / float(bounds.sigma))
    assert top == pytest.approx(level, rel=1e-4)
    asked = dataclasses.replace(asked, V0=R(str(round(threshold, 12))))
    assert gains(asked)["critical.T_threshold"].value == pytest.approx(1.5)
    free = gains(dataclasses.replace(asked, radius=None))
    assert free["critical.V0_threshold"] is None or free["critical.V0_threshold"].value > threshold


def test_on_a_ball_no_threshold_is_unlimited():
    asked = GainData(ONE, drift_norm=R(1, 10), V0=R(1), **BALL)
    answer = gains(asked)
    assert answer["critical.V0_threshold"].exact == R(1, 2)
    assert not {key for key in answer.unlimited if "threshold" in key}
    assert "needs V0 <" in answer.why["critical.T_threshold"]
    with pytest.raises(AssertionError):
        assert_gain_condition(asked, "V0 < critical.V0_threshold")
    with pytest.raises(AssertionError):
        assert_gain_condition(asked, "V0 < critical.V0_threshold_printed")


def test_the_ultimate_bound_needs_a_ball_that_is_not_left():
    large, small = (GainData(ONE, drift_bound=R(1), V0=R(1, 4), **{**BALL, "radius": R(r)}) for r in (10, 1))
    assert gains(large)["nonvanishing.ultimate_bound"] is not None
    assert "may be left" in gains(small).why["nonvanishing.ultimate_bound"]


def test_a_drift_that_is_known_up_to_the_end_has_no_ultimate_bound():
    asked = GainData(ONE, drift_bound=R(1, 10), k=R(1), nu_min=R(1, 2), drift_until_end=True)
    assert "up to t0 + T only" in gains(asked).why["nonvanishing.ultimate_bound"]
    later = gains(dataclasses.replace(asked, drift_bound_later=R(1, 5)))["nonvanishing.ultimate_bound"]
    alone = gains(dataclasses.replace(asked, drift_until_end=False))["nonvanishing.ultimate_bound"]
    assert later.value == pytest.approx(2 * alone.value)


@pytest.mark.parametrize(
    "key",
    ["asymptotic.k_min", "prescribed_time.overshoot_split", "critical.V0_threshold", "nonvanishing.ultimate_bound",
     "nonvanishing.gamma", "clip.k_min_after_clip", "clip.residual_bound"],
)  # fmt: skip
def test_two_drifts_at_once_leave_every_bound_open(key):
    both = {"k": R(1), "T": R(1), "nu_min": R(1, 2), "x0_norm": R(1), "drift_bound": R(1)}
    assert "give one" in gains(GainData(ONE, drift_norm=R(1), **both)).why[key]
    assert "give one" not in gains(GainData(ONE, drift_norm=R(0), **both)).why.get(key, "")


def test_a_filter_that_starts_elsewhere_raises_the_peak_of_the_turn():
    asked = GainData(ONE, k=R(1), nu_min=R(1, 2), omega=R(4), mu=R(1, 10), x0_norm=R(1))
    raised = dataclasses.replace(asked, filter_error=R(3))
    low, high = (gains(item)["clip.u2_peak"].value for item in (asked, raised))
    assert high == pytest.approx(low + 4 * 30)
    assert "needs mu" in gains(dataclasses.replace(raised, mu=None)).why["clip.u2_peak"]


def test_a_radius_that_is_none_is_refused():
    with pytest.raises(InputError, match="radius must be positive"):
        GainData(ONE, radius=R(0))


def test_a_drift_is_enclosed_for_all_time_where_the_whole_line_allows_it():
    base, t = example("saturated"), TIME
    beats = dataclasses.replace(base, drift=bounded_drift([sp.sin(3 * t) / 2, sp.S.Zero]))
    grows = dataclasses.replace(base, drift=bounded_drift([t / 10, sp.S.Zero]))
    for problem, later in ((beats, R(1, 2)), (grows, None)):
        asked = gain_data(problem, ONE)
        assert asked.drift_until_end
        assert asked.drift_bound_later == (None if later is None else pytest.approx(later, rel=1e-4))
    assert float(gain_data(grows, ONE).drift_bound) == pytest.approx(0.1 * float(base.tuning.T), rel=1e-4)
    assert not gain_data(grows, ONE, drift_bound=R(7)).drift_until_end


def test_the_start_of_the_filter_is_that_of_the_problem():
    base = example("saturated")
    given = dataclasses.replace(base, initial=dataclasses.replace(base.initial, z=base.measured + 2))
    assert (gain_data(base, ONE).filter_error, gain_data(given, ONE).filter_error) == (0, 2)


def test_constants_are_confined_to_a_ball_only_where_they_are_certified_on_it():
    base = example("saturated")
    assert gain_data(base, ONE, R(3)).radius is None
    assert gain_data(base, ONE, R(3), confined=True).radius == 3
