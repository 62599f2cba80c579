"""The answer to a question about gains: formulas against independent numbers, what does not apply, what is refused."""

import math
from dataclasses import replace

import pytest
import random_sets
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from ptproof.errors import InputError
from ptproof.gains import GainData, gains, nonvanishing, vanishing
from ptproof.gains.data import largest_singular_value, smallest_eigenvalue, symmetric_part
from ptproof.gains.horizon import Horizon, instant, unit_clock
from ptproof.gains.numbers import NotApplicable, Quantity, sign
from ptproof.problem.field import FieldBounds
from ptproof.transforms.clocks import Clock

R = sp.Rational
ONE = FieldBounds(1, R(3, 2), R(1, 2), R(1, 2), R(13, 4))
TWO = FieldBounds(2, R(3, 2), R(1, 2), R(7, 5), R(33, 10))
THREE = FieldBounds(3, 2, R(3, 2), 4, 7)


def value(answer, key):
    return answer[key].value


def test_the_constants_of_the_lyapunov_bounds():
    answer = gains(GainData(TWO))
    assert answer["constants.q"].exact == R(3, 4)
    assert answer["constants.sigma"].exact == R(1, 2)
    assert value(answer, "constants.c1") == pytest.approx(1.4 / 1.5**0.75)
    assert value(answer, "constants.c2") == pytest.approx(3.3 / 0.5**0.75)


def test_the_quadratic_case_of_the_paper():
    answer = gains(GainData(ONE, k=R(9, 5), T=2, drift_norm=1))
    c1, c2 = 0.5 / math.sqrt(1.5), 3.25 / math.sqrt(0.5)
    assert value(answer, "asymptotic.k_min_printed") == pytest.approx(2 * (c2 / c1) ** 2)
    assert value(answer, "asymptotic.k_min") == 2
    assert value(answer, "prescribed_time.overshoot") == pytest.approx(math.sqrt(3) * math.exp(c2**2))
    assert value(answer, "prescribed_time.rate") == pytest.approx(1.8 * c1**2 / 4)


@pytest.mark.parametrize("bounds", [TWO, THREE])
@pytest.mark.parametrize("norm", [R(3, 2), R(5, 1)])
def test_the_printed_threshold_is_the_least_critical_value_over_all_times(bounds, norm):
    k, T = R(9, 5), R(3, 2)
    data = GainData(bounds, k=k, T=T, drift_norm=norm)

    late = sp.Symbol("s", positive=True)
    formula = sp.lambdify(late, vanishing.critical_values(data, late))

    def critical(s):
        return formula(s) if s < vanishing.last_critical(data) else math.inf

    ratio = float(bounds.c2 / bounds.c1) * math.sqrt(2 * norm / k)
    turning = float(T) * (ratio - 1)
    found = minimize_scalar(critical, bounds=(turning / 3, turning * 1.5), method="bounded", options={"xatol": 1e-5})
    threshold = value(gains(data), "critical.V0_threshold_printed")
    there = gains(replace(data, tau_star=R(round(10**5 * found.x), 10**5)))
    assert value(there, "critical.V0_at_tau_star") == pytest.approx(found.fun, rel=1e-8)
    assert found.fun == pytest.approx(threshold, rel=1e-8)
    assert found.x == pytest.approx(turning, rel=1e-2)


CLOCKS = {
    "paper": {},
    "power": {"clock": "power", "exponent": R(2)},
    "logarithmic": {"clock": "logarithmic"},
    "exponential": {"clock": "exponential"},
    "tangent": {"clock": "tangent"},
}


def gain(clock, nu):
    return random_sets.GAINS[clock](nu, 2)


@pytest.mark.parametrize("clock", list(CLOCKS))
@pytest.mark.parametrize("bounds", [TWO, THREE])
def test_the_split_threshold_separates_escape_from_decay(bounds, clock):
    k, T, norm = R(9, 5), R(3, 2), R(5)
    answer = gains(GainData(bounds, k=k, T=T, drift_norm=norm, **CLOCKS[clock]))
    threshold = value(answer, "critical.V0_threshold")
    sigma, c1, c2 = (float(v) for v in (bounds.sigma, bounds.c1, bounds.c2))

    def rate(e, w):  # w = V^-sigma in the time t, which reaches 0 where V escapes
        r = float(norm) - float(k) / 2 * gain(clock, 1 - e / float(T))
        return [-sigma * r * (c2 if r > 0 else c1) ** 2]

    for factor, escapes in ((0.999, False), (1.001, True)):
        run = solve_ivp(rate, (0, 1.4), [(threshold * factor) ** -sigma], rtol=1e-9, atol=1e-12, max_step=0.005)
        assert bool(run.y.min() <= 0) is escapes


@pytest.mark.parametrize("bounds", [TWO, THREE])
def test_the_split_threshold_is_not_below_the_printed_one(bounds):
    answer = gains(GainData(bounds, k=R(9, 5), T=R(3, 2), drift_norm=R(5)))
    assert value(answer, "critical.V0_threshold") > value(answer, "critical.V0_threshold_printed")


@pytest.mark.parametrize("clock", list(CLOCKS))
def test_the_turning_point_is_where_the_gain_has_the_wanted_rate(clock):
    exponent = CLOCKS[clock].get("exponent")
    for rate in (R(5, 4), R(7), R(900)):
        found = 1 - instant(unit_clock(clock, exponent), rate)
        assert gain(clock, float(found)) == pytest.approx(float(rate), rel=1e-9)


def test_a_clock_whose_rate_falls_is_refused():
    t, tau = sp.symbols("t tau", real=True)
    slowing = Clock(t, tau, 2 * t - t**2, 1 - sp.sqrt(1 - tau), sp.S.Zero, sp.S.One, "slowing clock")
    with pytest.raises(InputError, match="its rate never falls"):
        Horizon(R(1), R(1, 2), slowing)


@pytest.mark.parametrize("clock", [name for name in CLOCKS if name != "paper"])
def test_what_is_printed_for_the_paper_s_clock_is_not_given_for_another(clock):
    data = {"k": R(1), "T": R(1), "nu_min": R(1, 2), "x0_norm": R(1), "tau_star": R(1, 10)}
    found = gains(GainData(TWO, drift_norm=R(5), **data, **CLOCKS[clock]))
    keys = ("critical.V0_at_tau_star", "critical.V0_threshold_printed", "critical.T_threshold_printed",
            "critical.escape_time", "critical.escape_time_split", "clip.residual_bound_printed")  # fmt: skip
    assert {found.why[key] for key in keys} == {
        f"printed for the paper's own clock only, not for the {unit_clock(clock, CLOCKS[clock].get('exponent')).name}"
    }
    bounded = gains(GainData(ONE, drift_bound=R(1), **data, **CLOCKS[clock]))
    for key in ("nonvanishing.exact_bound", "clip.residual_bound_printed"):
        assert "own clock only" in bounded.why[key]
    assert value(bounded, "clip.residual_bound") > 0


def test_the_power_clock_of_order_one_is_the_paper_s():
    data = {"k": R(1), "T": R(1), "nu_min": R(1, 2), "x0_norm": R(1), "drift_norm": R(1)}
    assert gains(GainData(TWO, clock="power", exponent=R(1), **data)).values == gains(GainData(TWO, **data)).values


@pytest.mark.parametrize(
    ("clock", "exponent", "message"),
    [("sundial", None, "clock: 'sundial' is not one of paper, power"), ("power", None, "needs one"),
     ("tangent", R(2), "takes none")],
)  # fmt: skip
def test_a_clock_that_does_not_exist_is_refused(clock, exponent, message):
    with pytest.raises(InputError, match=message):
        GainData(ONE, clock=clock, exponent=exponent)


@pytest.mark.parametrize("clock", ["power", "logarithmic"])
def test_the_clip_for_a_residual_is_solved_where_the_gain_is_a_power_of_nu(clock):
    data = GainData(ONE, k=R(2), T=R(1), x0_norm=R(1), residual=R(1, 2), **CLOCKS[clock])
    nu = gains(data)["clip.nu_min_for_residual"].exact
    end = gains(replace(data, nu_min=nu))["clip.residual_bound"]
    assert end.value == pytest.approx(1 / 2)


@pytest.mark.parametrize("clock", ["exponential", "tangent"])
def test_the_clip_for_a_residual_of_another_clock_is_not_solved(clock):
    found = gains(GainData(ONE, k=R(2), T=R(1), x0_norm=R(1), residual=R(1, 2), **CLOCKS[clock]))
    assert "powers of ν only" in found.why["clip.nu_min_for_residual"]


@pytest.mark.parametrize("name", ["T_threshold", "T_threshold_printed"])
def test_at_the_threshold_time_the_given_value_is_critical(name):
    data = {"bounds": TWO, "k": R(9, 5), "drift_norm": R(3), "V0": R(1, 7)}
    T = gains(GainData(**data))[f"critical.{name}"].exact
    again = gains(GainData(T=T, **data))["critical." + name.replace("T_", "V0_")]
    assert again.value == pytest.approx(1 / 7)


def test_below_the_threshold_nothing_escapes_and_above_it_something_does():
    data = {"bounds": TWO, "k": R(9, 5), "T": R(3, 2), "drift_norm": R(3)}
    threshold = R(sp.nsimplify(gains(GainData(**data))["critical.V0_threshold_printed"].exact.evalf(20), rational=True))
    below = gains(GainData(V0=threshold * R(99, 100), **data))
    assert below["critical.escape_time"] is None
    assert "never" in below.why["critical.escape_time"]
    above = gains(GainData(V0=threshold * R(101, 100), **data))
    turning = 1.5 * (float(TWO.c2 / TWO.c1) * math.sqrt(6 / 1.8) - 1)
    assert 0 < value(above, "critical.escape_time") < turning


def test_escape_times_count_from_the_start():
    data = {"bounds": TWO, "k": R(9, 5), "T": R(3, 2), "drift_norm": R(3), "V0": R(2)}
    early, late = gains(GainData(**data)), gains(GainData(t0=R(5), **data))
    assert value(late, "critical.escape_time") == pytest.approx(5 + value(early, "critical.escape_time"))


def test_a_gain_above_twice_the_norm_has_no_threshold():
    answer = gains(GainData(TWO, k=4, T=1, drift_norm=R(19, 10), V0=100))
    assert answer["critical.V0_threshold"] is None
    assert answer["critical.V0_threshold_printed"] is not None
    assert "no threshold" in answer.why["critical.V0_threshold"]


def test_a_threshold_above_every_value_is_told_from_one_that_is_not_known():
    free = gains(GainData(TWO, k=4, T=1, drift_norm=R(19, 10)))
    assert {"critical.V0_threshold", "critical.T_threshold"} <= free.unlimited
    other = gains(GainData(ONE, k=4, T=1, drift_norm=R(1), clock="tangent"))
    assert other.unlimited == {"critical.V0_threshold", "critical.T_threshold"}
    assert gains(GainData(TWO, k=1, drift_norm=R(5))).unlimited == frozenset()


@pytest.mark.parametrize(
    ("matrix", "gain"),
    [
        ([[-1, 0], [0, -1]], 2),
        ([[1, 0], [0, 1]], 0),
        ([[0, 3], [-3, 0]], 0),
        ([[0, 2], [0, 0]], 2),
        ([[-1, 0], [0, 5]], 2),
    ],
)
def test_the_least_gain_for_a_known_matrix(matrix, gain):
    answer = gains(GainData(TWO, drift_matrix=sp.ImmutableDenseMatrix(matrix)))
    assert answer["asymptotic.k_min"].exact == gain


def test_the_bounded_drift_formulas():
    k, d = R(2), R(3, 10)
    answer = gains(GainData(TWO, k=k, drift_bound=d, nu_min=R(1, 2)))
    c1, c2 = float(TWO.c1), float(TWO.c2)
    h1, h2 = 2 * c1**2 / 8, c2 / 4
    assert value(answer, "nonvanishing.h1") == pytest.approx(h1)
    assert value(answer, "nonvanishing.h2") == pytest.approx(h2)
    gamma = (1.5 / 0.25) ** 0.25 * (h2 * 0.3 / h1) ** (1 / 3)
    assert value(answer, "nonvanishing.gamma") == pytest.approx(gamma)
    assert value(answer, "nonvanishing.ultimate_bound_printed") == pytest.approx(gamma * 0.25 ** (1 / 3))
    assert value(answer, "nonvanishing.ultimate_bound") == pytest.approx(
        3**0.25 * (2 * 0.3 * 0.25 / (2 * 1.4)) ** (1 / 3)
    )


@pytest.mark.parametrize("bounds", [ONE, TWO, THREE])
def test_direct_comparison_never_gives_more_than_the_printed_gamma(bounds):
    zeta, k = R(7, 10), R(9, 5)
    ours, printed = (f(bounds, k, zeta) for f in (nonvanishing.input_gain, nonvanishing.input_gain_printed))
    assert sign(printed - ours) >= 0
    ultimate = nonvanishing.ultimate_bound(bounds, k, zeta / nonvanishing.input_factor(bounds))
    assert sign(ours - ultimate) >= 0


@pytest.mark.parametrize("bounds", [ONE, TWO])
def test_the_transient_starts_at_the_ratio_of_the_bounds_and_falls(bounds):
    start = nonvanishing.transient(bounds, R(2), R(3), sp.S.Zero)
    assert float(start) == pytest.approx(3 * 3 ** (1 / (2 * int(bounds.kappa))))
    later = [float(nonvanishing.transient(bounds, R(2), R(3), R(s))) for s in (1, 2, 5)]
    assert float(start) > later[0] > later[1] > later[2] > 0


def test_the_clipped_clock():
    answer = gains(GainData(ONE, k=R(9, 5), T=1, nu_min=R(3, 10), omega=30, t0=2))
    assert answer["clip.tau_end"].exact == 2 + R(17, 3)
    assert answer["clip.k_effective"].exact == 20
    assert value(answer, "clip.u1_peak") == pytest.approx(math.sqrt(30) / 0.09)


@pytest.mark.parametrize("clock", list(CLOCKS))
@pytest.mark.parametrize("nu_min", [R(1), R(3, 10), R(1, 10)])
def test_the_stretched_end_is_the_integral_of_the_gain(nu_min, clock):
    horizon = Horizon(R(2), nu_min, unit_clock(clock, CLOCKS[clock].get("exponent")))
    rate = lambda e, y: [gain(clock, max(float(nu_min), 1 - e / 2))]  # noqa: E731
    end = solve_ivp(rate, (0, 2), [0], rtol=1e-10, max_step=0.01).y[0, -1]
    assert float(horizon.stretched_end) == pytest.approx(end, rel=1e-5)
    assert float(horizon.stretched(R(2))) == pytest.approx(float(horizon.stretched_end), rel=1e-14)


def test_without_a_clip_the_end_is_refused():
    for call in (lambda: Horizon(R(1)).stretched(R(1)), lambda: Horizon(R(1)).stretched_end):
        with pytest.raises(InputError, match="infinite"):
            call()


def test_what_is_missing_is_named():
    answer = gains(GainData(ONE))
    assert answer["clip.residual_bound"] is None
    assert answer.why["clip.residual_bound"] == "needs k and T and nu_min"


def test_every_empty_key_has_a_reason_and_no_other_has():
    answer = gains(GainData(TWO, k=1, T=1, drift_norm=1))
    empty = {f"{s}.{k}" for s, entries in answer.values.items() for k, found in entries.items() if found is None}
    assert empty == set(answer.why)


def test_exact_input_gives_exact_output():
    answer = gains(GainData(ONE, k=sp.pi, T=1, nu_min=R(1, 3)))
    assert answer["clip.k_effective"].to_json() == {"exact": "9*pi", "value": pytest.approx(9 * math.pi)}


def test_a_value_that_no_float_holds_is_null_and_its_formula_stays():
    large = Quantity(sp.exp(10**6))
    assert large.to_json() == {"exact": "exp(1000000)", "value": None}
    assert large.text == "3.03322e+434294"
    assert Quantity(sp.Symbol("tau")).text == ""


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"k": R(0)}, "k must be positive"),
        ({"T": R(-1)}, "T must be positive"),
        ({"nu_min": R(3, 2)}, "nu_min must lie in"),
        ({"nu_min": R(0)}, "nu_min must be positive"),
        ({"drift_norm": R(-1)}, "must not be negative"),
        ({"drift_bound": R(-1)}, "must not be negative"),
        ({"k": 1.8}, "must be exact"),
        ({"k": sp.oo}, "finite"),
        ({"k": sp.I}, "real"),
        ({"k": sp.Symbol("k")}, "exact number"),
        ({"tau_star": R(0)}, "later than t0"),
        ({"V0": R(100), "x0_norm": R(1)}, "contradicts x0_norm"),
        ({"drift_norm": R(1, 2), "drift_matrix": sp.eye(2)}, "less than the norm"),
        ({"drift_matrix": sp.ones(2, 3)}, "square"),
    ],
)
def test_contradicting_data_are_refused(change, message):
    with pytest.raises(InputError, match=message):
        GainData(ONE, **change)


def test_numbers_that_cannot_be_told_apart_are_refused_or_equal():
    assert sign(sp.sqrt(2) * sp.sqrt(3) - sp.sqrt(6)) == 0
    assert sign(sp.exp(sp.log(3) / 2) - sp.sqrt(3)) == 0


def test_eigenvalues_of_small_matrices():
    E = sp.ImmutableDenseMatrix([[1, 2], [3, 4]])
    assert float(largest_singular_value(E)) == pytest.approx(5.464985704219043)
    assert float(smallest_eigenvalue(symmetric_part(E))) == pytest.approx(-0.4154759474226502)
    three = sp.ImmutableDenseMatrix([[2, 1, 0], [1, 2, 1], [0, 1, 2]])
    assert float(smallest_eigenvalue(three)) == pytest.approx(2 - math.sqrt(2))


def test_the_split_bound_is_not_larger_than_the_printed_one():
    data = GainData(ONE, k=R(9, 5), T=1, nu_min=R(3, 10), drift_norm=1, x0_norm=2 * sp.sqrt(2))
    answer = gains(data)
    assert value(answer, "clip.residual_bound") < value(answer, "clip.residual_bound_printed") / 1000


def test_a_bound_that_escapes_says_so():
    data = GainData(TWO, k=1, T=3, nu_min=R(3, 10), drift_norm=5, V0=100)
    answer = gains(data)
    assert answer["clip.residual_bound"] is None
    assert "escapes" in answer.why["clip.residual_bound"]


def test_the_start_value_needs_a_start():
    with pytest.raises(NotApplicable, match="V0 or x0_norm"):
        _ = GainData(ONE).start_value


def test_two_drifts_at_once_leave_the_residual_open():
    answer = gains(GainData(ONE, k=1, T=1, nu_min=R(1, 2), drift_norm=1, drift_bound=1, x0_norm=1))
    assert "give one" in answer.why["clip.residual_bound"]


def test_a_drift_that_helps_lowers_the_bound():
    data = {"bounds": ONE, "k": R(1), "T": R(1), "nu_min": R(1, 2), "x0_norm": R(1)}
    helped = vanishing.distance_bound(GainData(drift_matrix=sp.eye(2), **data), R(1), "split")
    alone = vanishing.distance_bound(GainData(**data), R(1), "split")
    assert sign(alone - helped) > 0


@pytest.mark.parametrize(
    ("bounds", "word"),
    [
        (ONE, None),
        (TWO, None),
        (FieldBounds(1, 3, 2, 1, 3), "a2 must not exceed"),
        (FieldBounds(2, 1, R(1, 10), 5, 6), "b1/"),
    ],
)
def test_constants_that_no_field_has_are_noticed(bounds, word):
    reason = GainData(bounds).impossible
    assert (reason is None) if word is None else (word in reason)


@pytest.mark.parametrize("bounds", [ONE, TWO, THREE])
def test_the_printed_estimate_of_a_bounded_drift_is_not_the_smaller_one(bounds):
    answer = gains(GainData(bounds, k=R(2), T=R(1), nu_min=R(1, 4), drift_bound=R(1, 2), x0_norm=R(1)))
    assert value(answer, "clip.residual_bound") <= value(answer, "clip.residual_bound_printed")


def test_an_order_beyond_reason_is_refused():
    with pytest.raises(InputError, match="at most 1000"):
        GainData(FieldBounds(100_000, 2, 1, 1, 2))
