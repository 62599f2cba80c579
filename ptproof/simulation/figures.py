"""Figures of runs over their field and against time, for any problem."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ptproof.problem import Problem
from ptproof.simulation.drawing import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, new_figure
from ptproof.simulation.quantities import field_function
from ptproof.simulation.trajectory import Trajectory

_STYLES: list[dict[str, Any]] = [
    {"color": BLUE, "lw": 0.9}, {"color": ORANGE, "lw": 0.9}, {"color": GREEN, "lw": 1.6, "ls": "--"},
    {"color": PURPLE, "lw": 1.6, "ls": ":"},
]  # fmt: skip


def draw_field(problem: Problem, ax: Any, low: Any, high: Any) -> None:
    """Level lines of the field in the rectangle from ``low`` to ``high``, and the source."""
    grid = [np.linspace(a, b, 160) for a, b in zip(low, high, strict=True)]
    X, Y = np.meshgrid(*grid)
    values = field_function(problem.field)(np.array([X, Y]))
    ax.contour(X, Y, values, levels=14, colors=GREY, linewidths=0.5, alpha=0.6, linestyles="solid")
    source = [float(value) for value in problem.source]
    ax.plot(*source, "*", color=RED, ms=9, label="source", zorder=5)


def paths(problem: Problem, runs: Mapping[str, Trajectory], ax: Any) -> None:
    """Trajectories over the field's level lines; the names are the legend."""
    points = np.concatenate([run.x[:2] for run in runs.values()] + [np.array(problem.source, float)[:, None]], axis=1)
    points = points[:, np.all(np.isfinite(points), axis=0)]
    low, high = points.min(axis=1), points.max(axis=1)
    margin = 0.12 * max(float(np.max(high - low)), 1e-9)
    draw_field(problem, ax, low - margin, high + margin)
    for (name, run), style in zip(runs.items(), _STYLES, strict=False):
        ax.plot(run.x[0], run.x[1], label=name, **style)
    ax.plot(*(float(value) for value in problem.initial.x), "o", color="black", ms=4, label="start", zorder=5)
    ax.set(xlabel=problem.variables[0].name, ylabel=problem.variables[1].name)
    ax.set_aspect("equal", adjustable="box")
    ax.legend(loc="best", fontsize=7)


def against_time(runs: Mapping[str, Any], what: str, ax: Any, label: str) -> None:
    """One quantity of several runs against time."""
    for (name, run), style in zip(runs.items(), _STYLES, strict=False):
        ax.plot(run.t, run[what], label=name, **style)
    ax.set(xlabel="t", ylabel=label)
    ax.legend(fontsize=7)


def mark_time(ax: Any, T: float) -> None:
    """A vertical line at t₀ + T."""
    ax.axvline(T, color="black", lw=0.8, ls=":")


def overview(problem: Problem, run: Trajectory) -> Any:
    """What a person wants to see of one run: the path over the field, the field value, the distance, the inputs."""
    figure, axes = new_figure(2, 2, size=(8.0, 6.4))
    paths(problem, {"trajectory": run}, axes[0, 0])
    ends = float(problem.tuning.t0 + problem.tuning.T)
    axes[0, 1].plot(run.t, run["field"], color=BLUE, lw=1)
    axes[0, 1].axhline(float(problem.peak), color=RED, lw=0.8, ls="--", label="peak F(x*)")
    axes[0, 1].set(xlabel="t", ylabel="field value")
    distance = np.linalg.norm(run.x[:2] - np.array([[float(value)] for value in problem.source]), axis=0)
    axes[1, 0].semilogy(run.t, np.maximum(distance, 1e-16), color=BLUE, lw=1)
    axes[1, 0].set(xlabel="t", ylabel="distance from the source")
    for ax in (axes[0, 1], axes[1, 0]):
        mark_time(ax, ends)
    axes[0, 1].legend(fontsize=7)
    for (name, samples), color in zip(run.inputs.items(), (BLUE, ORANGE), strict=False):
        axes[1, 1].plot(run.t, samples, lw=0.8, color=color, label=name)
    axes[1, 1].set(xlabel="t", ylabel="inputs")
    if run.inputs:
        axes[1, 1].legend(fontsize=7)
    figure.suptitle(f"{run.settings.get('example', '')}, {run.settings.get('seeker', '')}: {run.outcome}")
    return figure
