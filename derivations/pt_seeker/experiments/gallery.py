"""The figures of a problem, by name: what the paper draws, with the averaged trajectory and the bound beside it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import Problem, parameters
from ptproof.simulation import GapOrder, Settings, Trajectory, gap_order, hover_radius, simulate
from ptproof.simulation.drawing import BLUE, GREEN, ORANGE, RED, new_figure
from ptproof.simulation.figures import against_time, draw_field, mark_time, paths
from ptproof.simulation.order import LADDER
from ptproof.simulation.plan import Array

_SATURATED_UNTIL = 4.0


def figures(problem: Problem, bounds: Mapping[str, tuple[Array, Array]] | None = None) -> dict[str, Any]:
    """All figures of a problem.

    Parameters
    ----------
    problem
        With a planar field.
    bounds
        Bounds on the averaged distance to draw, by name: times and values.

    Returns
    -------
    dict
        ``trajectories``, ``field``, ``distance``, ``inputs``, ``phase-portrait`` and ``order``; for a problem with a
        saturated seeker ``saturated-trajectories``, ``saturated-field`` and ``saturated-acceleration`` in the place of
        the first four.
        The same problem gives the same figures.
    """
    made = _saturated(problem) if problem.saturation is not None else _seekers(problem, bounds or {})
    made["phase-portrait"] = phase_portrait(problem)
    made["order"] = problem_order(problem).plot().figure
    return made


def _run(problem: Problem, seeker: str = "pt", **options: Any) -> Trajectory:
    return simulate(problem, seeker, samples=3000, **options)


def _paths_and_field(problem: Problem, runs: Mapping[str, Trajectory], prefix: str = "") -> dict[str, Any]:
    made: dict[str, Any] = {}
    made[f"{prefix}trajectories"], ax = new_figure(size=(5.0, 4.6))
    paths(problem, runs, ax)
    made[f"{prefix}field"], ax = new_figure()
    against_time(runs, "field", ax, "field value")
    ax.axhline(float(problem.peak), color=RED, lw=0.8, ls="--")
    mark_time(ax, float(problem.tuning.t0 + problem.tuning.T))
    return made


def _seekers(problem: Problem, bounds: Mapping[str, tuple[Array, Array]]) -> dict[str, Any]:
    runs = {
        "PT seeker": _run(problem), "asymptotic seeker": _run(problem, "asymptotic"),
        "PT seeker, averaged": _run(problem, model="average"),
        "asymptotic seeker, averaged": _run(problem, "asymptotic", model="average"),
    }  # fmt: skip
    ends = float(problem.tuning.t0 + problem.tuning.T)
    made = _paths_and_field(problem, runs)
    made["distance"], ax = new_figure()
    source = np.array([[float(value)] for value in problem.source])
    for (name, run), color in zip(runs.items(), (BLUE, ORANGE, GREEN), strict=False):
        distance = np.maximum(np.linalg.norm(run.x[:2] - source, axis=0), 1e-12)
        ax.semilogy(run.t, distance, lw=1, color=color, label=name)
    for name, (t, values) in bounds.items():
        ax.semilogy(t, values, lw=1, ls=":", color="black", label=name)
    radius = float(hover_radius(float(problem.tuning.omega)))
    ax.axhline(radius, color=RED, lw=0.8, ls="--", label="1/√ω")
    mark_time(ax, ends)
    ax.set(xlabel="t", ylabel="distance from the source")
    ax.legend(fontsize=7)
    made["inputs"], axes = new_figure(2, 1, sharex=True)
    for ax, name, label in zip(axes, ("u1", "u2"), ("forward velocity u₁", "angular velocity u₂"), strict=True):
        ax.plot(runs["PT seeker"].t, runs["PT seeker"][name], color=BLUE, lw=0.8)
        ax.set(ylabel=label)
        mark_time(ax, ends)
    axes[1].set(xlabel="t")
    return made


def _saturated(problem: Problem) -> dict[str, Any]:
    until = _SATURATED_UNTIL * float(problem.tuning.T)
    runs = {
        "time-varying gain": _run(problem, "saturated", until=until),
        "constant gain": _run(problem, "saturated-constant", until=until),
    }
    made = _paths_and_field(problem, runs, "saturated-")
    assert problem.saturation is not None
    made["saturated-acceleration"], axes = new_figure(2, 1, sharex=True, sharey=True)
    for ax, (name, run), color in zip(axes, runs.items(), (BLUE, ORANGE), strict=True):
        ax.plot(run.t, run["a"] * float(problem.saturation.epsilon), color=color, lw=0.6)
        ax.set(ylabel="ε · du₂/dt", title=name)
    axes[1].set(xlabel="t")
    return made


def phase_portrait(problem: Problem, seeker: str = "pt") -> Any:
    """The averaged system's phase portrait at t₀ over the field's level lines, with the source."""
    system = problem.averaged(seeker, "t")
    function = sp.lambdify([system.time, *system.state], list(system.rhs), modules="numpy")
    source = np.array([float(value) for value in problem.source])
    reach = 1.3 * max(1.0, max(abs(float(x) - s) for x, s in zip(problem.initial.x, source, strict=True)))
    X, Y = np.meshgrid(*(np.linspace(s - reach, s + reach, 41) for s in source))
    start = float(problem.tuning.t0)
    U, V = (np.broadcast_to(rate, X.shape) for rate in function(start, X, Y))
    figure, ax = new_figure(size=(5.0, 4.6))
    draw_field(problem, ax, source - reach, source + reach)
    ax.streamplot(X, Y, U, V, color=BLUE, linewidth=0.7, density=1.1, arrowsize=0.8)
    ax.set(xlabel=system.state[0].name, ylabel=system.state[1].name, title="average at the start")
    ax.set_aspect("equal")
    return figure


def problem_order(problem: Problem, omegas: tuple[float, ...] = LADDER) -> GapOrder:
    """The order of the gap between a problem's closed loop in τ and its average over [t₀, t₀ + 2T] of τ.

    The filter's μ = 1/(5ω²) is so fast that its own error, of order μω, does not interfere.
    """
    system = problem.closed_loop("pt", "tau", coordinates="reduced", symbolic=True)
    free = (parameters.omega, parameters.mu)
    keep = {symbol: value for symbol, value in problem.values.items() if symbol not in free}
    values: dict[Any, Any] = {**keep, parameters.mu: 1 / (5 * parameters.omega**2)}
    start = float(problem.tuning.t0)
    initial = [*(float(value) for value in problem.initial.x), float(problem.measured)]
    return gap_order(
        system, problem.averaged("pt", "tau", symbolic=True), initial=initial, start=start,
        end=start + 2 * float(problem.tuning.T), values=values, omega=parameters.omega, omegas=omegas,
        settings=Settings(rtol=1e-8),
    )  # fmt: skip
