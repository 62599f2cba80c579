"""Figures of runs over their field and against time, for any problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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


def paths(
    problem: Problem, runs: Mapping[str, Trajectory], ax: Any, styles: Sequence[dict[str, Any]] = _STYLES
) -> None:
    """Trajectories over the field's level lines, which are those at the start where the source moves."""
    points = np.concatenate([run.x[:2] for run in runs.values()] + [np.array(problem.source, float)[:, None]], axis=1)
    points = points[:, np.all(np.isfinite(points), axis=0)]
    low, high = points.min(axis=1), points.max(axis=1)
    margin = 0.12 * max(float(np.max(high - low)), 1e-9)
    draw_field(problem, ax, low - margin, high + margin)
    for (name, run), style in zip(runs.items(), styles, strict=False):
        ax.plot(run.x[0], run.x[1], label=name, **style)
    for run in runs.values():
        if run.source is not None and np.ptp(run.source, axis=1).any():
            ax.plot(run.source[0], run.source[1], color=RED, lw=0.8, label="source's path")
            break
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


def overview(problem: Problem, run: Trajectory, average: Trajectory | None = None) -> Any:
    """What a person wants to see of one run: the path over the field, the field value, the distance, the inputs.

    With the ``average`` beside it, which is not the vehicle, and labelled so.
    """
    figure, axes = new_figure(2, 2, size=(8.0, 6.4))
    runs = {"vehicle": run} | ({} if average is None else {"average": average})
    styles = (_STYLES[0], _STYLES[2])
    paths(problem, runs, axes[0, 0], styles)
    ends = float(problem.tuning.t0 + problem.tuning.T)
    for (name, shown), style in zip(runs.items(), styles, strict=False):
        axes[0, 1].plot(shown.t, shown["field"], label=name, **style)
        axes[1, 0].semilogy(shown.t, np.maximum(shown["distance"], 1e-16), label=name, **style)
    axes[0, 1].axhline(float(problem.peak), color=RED, lw=0.8, ls="--", label="peak F(x*)")
    axes[0, 1].set(xlabel="t", ylabel="field value")
    axes[1, 0].set(xlabel="t", ylabel="distance from the source")
    for ax in (axes[0, 1], axes[1, 0]):
        if run.t[0] < ends <= run.t[-1] * (1 + 1e-9):
            mark_time(ax, ends)
        ax.legend(fontsize=7)
    for (name, samples), color in zip(run.inputs.items(), (BLUE, ORANGE), strict=False):
        axes[1, 1].plot(run.t, samples, lw=0.8, color=color, label=name)
    axes[1, 1].set(xlabel="t", ylabel="inputs")
    if run.inputs:
        axes[1, 1].legend(fontsize=7)
    figure.suptitle(f"{run.settings.get('example', '')}, {run.settings.get('seeker', '')}: {run.outcome}")
    return figure
