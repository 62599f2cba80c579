"""Section 7: the vehicle itself. The runs of the problem files as theorems, and bounds for every heading.

The averages' guarantees (7e) say nothing about the vehicle at a given ω. Here the closed loops are those that are
simulated (7d), with filter, clip and drift, and nothing is sampled.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import sympy as sp

from ptproof.certify import certified, enclosed
from ptproof.problem import Problem
from ptproof.proof import Evidence, Goal, Relation, Runs, claim, eq, gt, le, lt

from .section7d_examples import (
    nonvanishing,
    nonvanishing_as_simulated,
    saturated,
    saturated_as_simulated,
    vanishing,
    vanishing_as_simulated,
)

SECTION = "7.6 Simulation: the vehicle, run by run and for every heading"


def run(
    problem: Problem, seeker: str, parts: Iterable[Relation], during: tuple[Any, Any] | None = None, until: Any = None
) -> Runs:  # fmt: skip
    """What holds on the run of the problem file, whose heading is 0; at the prescribed time, where left out."""
    loop, letters = problem.closed_loop(seeker), problem.states
    end = problem.tuning.t0 + problem.tuning.T if until is None else until
    own = dict(zip(problem.variables, problem.initial.x, strict=True))
    own |= {letters.heading: problem.initial.theta, letters.filter: problem.measured}
    own |= {letters.angular_velocity: problem.initial.u2}
    starts = tuple(eq(state, own[state]) for state in loop.state)
    return Runs(loop.time, loop.state, loop.rhs, (problem.tuning.t0, end), starts, tuple(parts), during or (end, end))


def every_vehicle(problem: Problem, starts: Any, ends: Any) -> Runs:
    """From ‖x − x*‖² ≤ ``starts``, with every heading and the filter at the measured field, to < ``ends`` at t₀ + T."""
    loop, end = problem.closed_loop("pt"), problem.tuning.t0 + problem.tuning.T
    far = squared(problem)
    allowed = (le(far, starts), eq(problem.states.filter, problem.field.expression))
    return Runs(loop.time, loop.state, loop.rhs, (problem.tuning.t0, end), allowed, (lt(far, ends),), (end, end))


def squared(problem: Problem) -> sp.Expr:
    """The squared distance from the source."""
    return sp.Add(*((x - c) ** 2 for x, c in zip(problem.variables, problem.source, strict=True)))


def near(problem: Problem, *millionths: int) -> list[Relation]:
    """That each coordinate is that many millionths, to one of them."""
    return [lt(sp.Abs(10**6 * x - at), 1) for x, at in zip(problem.variables, millionths, strict=True)]


def two_hover_radii(problem: Problem) -> Relation:
    """That the distance is at most 2/√ω."""
    return le(squared(problem), 4 / problem.tuning.omega)


# --- The runs of the problem files ------------------------------------------------------------------------------------


@claim(
    "7.1/run-reaches", "With vanishing drift the run from heading 0 ends within two hover radii of the source",
    run(vanishing, "pt", [two_hover_radii(vanishing), *near(vanishing, -176981, 25095)]),
    place="Section 7.1, fig:trajectories", uses=[vanishing_as_simulated],
)  # fmt: skip
def vanishing_run(goal: Goal) -> Evidence:
    """At T the vehicle is 0.1788 away from the source; its place is known to a millionth. What is observed of all
    headings is proved here of one, that of the problem file, with the filter at the field's value."""
    return enclosed(goal)


@claim(
    "7.1/run-asymptotic-away", "With vanishing drift the asymptotic seeker's run ends farther away than it starts",
    run(
        vanishing, "asymptotic",
        [gt(squared(vanishing), 8), *near(vanishing, -2248968, -2466955)],
    ),
    place="Section 7.1, fig:trajectories", uses=[vanishing_as_simulated],
)  # fmt: skip
def vanishing_asymptotic_run(goal: Goal) -> Evidence:
    """3.338 after 2.828, from heading 0."""
    return enclosed(goal)


@claim(
    "7.2/run-reaches", "With nonvanishing drift the run from heading 0 ends within two hover radii of the source",
    run(nonvanishing, "pt", [two_hover_radii(nonvanishing), *near(nonvanishing, -22188, -38683)]),
    place="Section 7.2, fig:trajectories_bounded", uses=[nonvanishing_as_simulated],
)  # fmt: skip
def nonvanishing_run(goal: Goal) -> Evidence:
    """At T the vehicle is 0.0446 away from the source."""
    return enclosed(goal)


@claim(
    "7.2/run-asymptotic-above", "With nonvanishing drift the asymptotic seeker's run ends above the source",
    run(
        nonvanishing, "asymptotic",
        [gt(nonvanishing.variables[1], 0), lt(squared(nonvanishing), 2),
         lt(nonvanishing.field.expression, nonvanishing.peak - sp.Rational(1, 10))],
        (nonvanishing.tuning.T / 2, nonvanishing.tuning.T),
    ),
    place="Section 7.2, fig:trajectories_bounded", uses=[nonvanishing_as_simulated],
)  # fmt: skip
def nonvanishing_asymptotic_run(goal: Goal) -> Evidence:
    """From T/2 to T, from heading 0: bounded, above the source and below the peak; observed is the same to t = 20."""
    return enclosed(goal)


@claim(
    "7.3/run-reaches", "With saturation the run from heading 0 comes to two hover radii of the source before T",
    run(saturated, "saturated", [two_hover_radii(saturated)], until=sp.Rational(89, 125)),
    place="Section 7.3, fig:field_sat", uses=[saturated_as_simulated],
)  # fmt: skip
def saturated_run(goal: Goal) -> Evidence:
    """At t = 0.712 it is 0.351 away, with the time-varying gain and through all switches of the saturation until then,
    each enclosed."""
    return enclosed(goal)


# --- Every heading ----------------------------------------------------------------------------------------------------


@claim(
    "7.3/vehicle-without-saturation", "At the paper's own ω every vehicle of 7.3 without saturation ends within 0.7",
    every_vehicle(saturated, 8, sp.Rational(49, 100)), place="Section 7.3",
)  # fmt: skip
def unsaturated_vehicle(goal: Goal) -> Evidence:
    """From every start within 2√2 of the source, that is from (2, 2) too, and every heading, with ω = 30 and
    μ = 0.001 as printed. It is the loop of eq:pt_seeker with the field and the numbers of Section 7.3: of the saturated
    angular acceleration, with which they are simulated there, it says nothing."""
    return certified(goal, saturated, tolerance=0.5)
