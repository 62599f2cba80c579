"""The pictures of bounds: what their lines show is what the formulas say."""

import dataclasses

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.gains import GainData, vanishing
from ptproof.gains.plot import plot_gains
from ptproof.problem.field import FieldBounds

R = sp.Rational
ONE = FieldBounds(1, R(3, 2), R(1, 2), R(1, 2), R(13, 4))
TWO = FieldBounds(2, R(3, 2), R(1, 2), R(7, 5), R(33, 10))
ESCAPE = GainData(TWO, drift_norm=R(3, 2), k=R(9, 5), T=R(1), V0=R(1, 2))
CLIPPED = GainData(ONE, drift_norm=R(1), k=R(9, 5), T=R(1), nu_min=R(3, 10), x0_norm=R(2))


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def panels(figure):
    return {axes.get_xlabel(): lines(axes) for axes in figure.axes}


def test_the_critical_curve_touches_the_printed_threshold():
    drawn = panels(plot_gains(ESCAPE))["τ*"]
    lowest = min(drawn["V0 that escapes at τ*"].get_ydata())
    threshold = float(vanishing.critical_value(ESCAPE, "printed"))
    assert threshold <= lowest <= threshold * 1.001
    assert drawn["threshold, printed"].get_ydata()[0] == pytest.approx(threshold)


def test_the_safe_region_ends_at_the_threshold_for_each_prescribed_time():
    drawn = panels(plot_gains(ESCAPE))["T"]
    times, values = drawn["threshold, closed form"].get_data()
    threshold = float(vanishing.critical_value(ESCAPE, "split"))
    assert np.interp(1, times, values) == pytest.approx(threshold, rel=0.01)


def test_the_closed_forms_start_at_the_distance_and_end_at_the_residual():
    drawn = panels(plot_gains(CLIPPED))["t"]
    for name, chain in (("printed", "printed"), ("closed form", "split")):
        values = drawn[name].get_ydata()
        assert values[-1] == pytest.approx(float(vanishing.distance_bound(CLIPPED, R(1), chain)))
        assert values[0] == pytest.approx(2 * 3**0.5)


def test_the_least_gain_is_twice_the_norm_and_less_after_the_clip():
    drawn = panels(plot_gains(CLIPPED))["‖E‖"]
    norms, gains = drawn["k = 2‖E‖"].get_data()
    assert gains == pytest.approx(2 * norms)
    assert drawn["k = 2‖E‖ over the last rate"].get_ydata() == pytest.approx(0.18 * norms)


def test_another_clock_has_no_printed_lines():
    data = dataclasses.replace(ESCAPE, clock="logarithmic", nu_min=R(1, 5), V0=R(1, 1000))
    drawn = panels(plot_gains(data))
    assert set(drawn) == {"t", "T"}
    assert not any("printed" in label for labels in drawn.values() for label in labels)


def test_where_nothing_is_known_there_is_nothing_to_draw():
    with pytest.raises(InputError, match="nothing to draw"):
        plot_gains(GainData(ONE, drift_bound=R(1)))


def test_a_file_that_cannot_be_written_is_bad_input(tmp_path):
    with pytest.raises(InputError, match="cannot write"):
        plot_gains(CLIPPED, path=tmp_path / "missing" / "x.png")
