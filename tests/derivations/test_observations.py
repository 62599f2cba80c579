"""Section 7 in numbers: each statement against its criterion, over a few headings, and the figures of the examples."""

import numpy as np
import pytest

from derivations.pt_seeker.experiments import block_diagram, observations
from derivations.pt_seeker.experiments.gallery import figures
from ptproof.problem import example
from ptproof.simulation.drawing import BLUE, png
from tests.pictures import lines_shown, shown

COUNT = 8


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_the_prescribed_time_seeker_reaches_the_source_from_every_heading(name):
    statement = observations.reaches_source(name, 24)
    assert statement.supported
    assert statement.data["worst distance"] < 2 * statement.data["hover radius"]


def test_the_asymptotic_seeker_moves_away_from_every_heading():
    statement = observations.moves_away(24)
    assert statement.supported
    assert statement.data["initial distance"] == pytest.approx(np.sqrt(8))


def test_it_would_be_said_if_it_did_not_reach_the_source(monkeypatch):
    real = observations._ensemble
    monkeypatch.setattr(observations, "_ensemble", lambda name, seeker, count: real(name, "asymptotic", count))
    assert not observations.reaches_source("vanishing", 6).supported


def test_the_asymptotic_seeker_oscillates_off_the_source_below_the_peak():
    statement = observations.oscillates(4)
    assert statement.supported
    assert statement.data["largest field"] < 1.9


def test_with_the_time_varying_gain_the_saturated_seeker_arrives_before_T():
    assert observations.saturated_reaches(COUNT).supported


def test_with_the_constant_gain_it_takes_about_three_times_T_from_some_headings_only():
    statement = observations.three_times_longer(COUNT)
    assert statement.supported
    assert 2.5 < statement.data["median arrival over that of the time-varying gain"] < 3.7
    assert 1 < statement.data["smallest arrival over T"] < 1.6
    assert 3 < statement.data["worst arrival over T"] < 3.7
    assert 0.2 < statement.data["share of the headings with 2.5 to 3.5"] < 0.7


def test_it_would_be_said_if_the_constant_gain_were_as_fast(monkeypatch):
    real = observations.arrivals
    monkeypatch.setattr(observations, "arrivals", lambda seeker, count: real("saturated", count))
    assert not observations.three_times_longer(COUNT).supported


def test_the_control_effort_is_greater_with_the_constant_gain():
    assert observations.acceleration_saturates(4).supported


def test_a_statement_is_data():
    data = observations.moves_away(24).to_json()
    assert data["supported"] is True
    assert "24, even" in data["settings"]["headings"]


FIGURES = {
    "vanishing": {"trajectories", "field", "distance", "inputs", "phase-portrait", "order"},
    "saturated": {
        "saturated-trajectories", "saturated-field", "saturated-acceleration", "phase-portrait", "order",
    },
}  # fmt: skip


@pytest.mark.parametrize("name", FIGURES)
def test_the_figures_of_an_example_are_drawn_and_the_same_bytes_again(name):
    problem = example(name)
    bound = {"a bound": (np.array([0.0, 1.0]), np.array([3.0, 1.0]))}
    made = figures(problem, bound)
    assert set(made) == FIGURES[name]
    images = {key: png(figure) for key, figure in made.items()}
    for key, figure in made.items():
        missing = {line: share for line, share in lines_shown(images[key], figure).items() if share < 0.25}
        assert missing == {}, key  # dotted lines have gaps, and curves cover each other
    start = [float(value) for value in problem.initial.x]
    path = next(key for key in made if key.endswith("trajectories"))
    assert shown(images[path], made[path].axes[0], *start, "black") == 1
    if name == "saturated":
        assert images == {key: png(figure) for key, figure in figures(problem, bound).items()}


def test_the_block_diagram_is_drawn():
    figure = block_diagram.draw()
    picture, axes = png(figure), figure.axes[0]
    # The sides of the box K(t), the arrow that goes into it, and nothing where nothing is.
    assert shown(picture, axes, [1.2, 2.2], 4.4, BLUE) == 1
    assert shown(picture, axes, np.linspace(0.4, 1.0, 10), 4.4, "black") == 1
    assert shown(picture, axes, np.linspace(3, 9, 30), 2.2, "white") == 1


@pytest.fixture(scope="module", params=["vanishing", "nonvanishing"])
def comparison(request):
    return block_diagram.compare_figure(example(request.param), points=20)


def test_with_the_filter_in_dilated_time_the_figure_is_the_closed_loop(comparison):
    assert comparison.rhs_dilated < 1e-12


def test_as_drawn_the_figure_is_not_the_closed_loop(comparison):
    assert comparison.rhs_drawn > 0.1
    assert comparison.largest_gap > 0.05


def test_the_filter_as_drawn_is_the_printed_transfer_function():
    import control  # a second of imports, which no other test here needs

    problem = example("vanishing")
    printed = block_diagram.washout_transfer(problem)
    mu = float(problem.tuning.mu)
    built = control.ss([[-1 / mu]], [[1 / mu]], [[-1 / mu]], [[1 / mu]])
    for s in (1j, 300j, 2 + 1000j):
        assert built(s) == pytest.approx(printed(s), rel=1e-12)
