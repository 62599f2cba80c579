"""Figures with Matplotlib: the paper's own, each from a simulation, with the same bytes for the same data."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ptproof.problem import Problem
from ptproof.simulation.quantities import field_function

if TYPE_CHECKING:
    from ptproof.simulation.order import GapOrder
    from ptproof.simulation.trajectory import Ensemble, Trajectory

# Okabe and Ito's colours, told apart with every kind of colour vision.
BLUE, ORANGE, GREEN, RED, PURPLE, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#666666"
_STYLE: Any = {
    "font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.alpha": 0.25, "legend.frameon": False, "figure.dpi": 150, "savefig.dpi": 150,
    "svg.hashsalt": "ptproof", "svg.fonttype": "path",
}  # fmt: skip


def new_figure(rows: int = 1, columns: int = 1, size: tuple[float, float] = (5.0, 3.6), **options: Any) -> Any:
    """A figure and its axes in the house style, without touching Matplotlib's global state."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, columns, **options)
    return figure, axes


def save(figure: Any, path: str | Path) -> None:
    """Write a figure as .png, .svg or .pdf, without dates, so that the same figure gives the same bytes."""
    import matplotlib

    file = Path(path)
    metadata: dict[str, Any] = {".svg": {"Date": None}, ".png": {"Software": None}}.get(
        file.suffix.lower(), {"CreationDate": None, "Producer": None, "Creator": None}
    )
    with matplotlib.rc_context(_STYLE):
        figure.savefig(file, metadata=metadata)


_COLOURS = 64


def png(figure: Any) -> bytes:
    """The figure as PNG bytes, with a palette: line drawings need no more colours, and pages stay small."""
    import matplotlib
    from PIL import Image

    drawn, packed = io.BytesIO(), io.BytesIO()
    with matplotlib.rc_context(_STYLE):
        figure.savefig(drawn, format="png", metadata={"Software": None})
    picture = Image.open(drawn).convert("RGB").quantize(_COLOURS, dither=Image.Dither.NONE)
    picture.save(packed, format="png", optimize=True)
    return packed.getvalue()


def draw_trajectory(run: Trajectory, ax: Any = None) -> Any:
    """The path in the plane where there are two positions, else each state against time."""
    if ax is None:
        _, ax = new_figure()
    if run.field is not None:
        first, second = run.states[:2]
        ax.plot(run.x[0], run.x[1], color=BLUE, lw=1)
        ax.plot(run.x[0, 0], run.x[1, 0], "o", color=BLUE, ms=4, label="start")
        ax.plot(run.x[0, -1], run.x[1, -1], "s", color=RED, ms=4, label=f"end: {run.outcome}")
        ax.set(xlabel=first, ylabel=second)
        ax.set_aspect("equal", adjustable="datalim")
    else:
        for name, samples in zip(run.states, run.x, strict=True):
            ax.plot(run.t, samples, lw=1, label=name)
        ax.set(xlabel="time", ylabel="state")
    ax.legend()
    return ax


def draw_ensemble(ensemble: Ensemble, ax: Any = None) -> Any:
    """A histogram of the final distances, with median and 95 % quantile."""
    if ax is None:
        _, ax = new_figure()
    finite = ensemble.distances[np.isfinite(ensemble.distances)]
    ax.hist(finite, bins=min(50, max(5, len(finite) // 10)), color=BLUE, alpha=0.7)
    for name, value, style in (("median", ensemble.median, "-"), ("95 %", ensemble.q95, "--")):
        ax.axvline(value, color=RED, ls=style, lw=1, label=f"{name}: {value:.3g}")
    ax.set(xlabel="final distance from the source", ylabel="members")
    ax.legend()
    return ax


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
    for (name, run), style in zip(runs.items(), _styles(), strict=False):
        ax.plot(run.x[0], run.x[1], label=name, **style)
    ax.plot(*(float(value) for value in problem.initial.x), "o", color="black", ms=4, label="start", zorder=5)
    ax.set(xlabel=problem.variables[0].name, ylabel=problem.variables[1].name)
    ax.set_aspect("equal", adjustable="box")
    ax.legend(loc="best", fontsize=7)


def _styles() -> list[dict[str, Any]]:
    return [
        {"color": BLUE, "lw": 0.9}, {"color": ORANGE, "lw": 0.9}, {"color": GREEN, "lw": 1.6, "ls": "--"},
        {"color": PURPLE, "lw": 1.6, "ls": ":"},
    ]  # fmt: skip


def against_time(runs: Mapping[str, Any], what: str, ax: Any, label: str) -> None:
    """One quantity of several runs against time."""
    for (name, run), style in zip(runs.items(), _styles(), strict=False):
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


def draw_order(gaps: GapOrder, ax: Any = None) -> Any:
    """The gap between a system and its average over the ladder of ω, with the fitted and the expected slope."""
    if ax is None:
        _, ax = new_figure()
    omega = np.array(gaps.omegas)
    ax.loglog(omega, gaps.gaps, "o", color=BLUE, label="gap")
    fit = f"fit: slope {gaps.slope:.3f}; between the last two {gaps.tail:.3f}"
    ax.loglog(omega, np.exp(gaps.intercept) * omega**gaps.slope, color=BLUE, lw=1, label=fit)
    anchor = gaps.gaps[-1] * (omega / omega[-1]) ** gaps.expected
    ax.loglog(omega, anchor, color=RED, lw=1, ls="--", label=f"theory: slope {gaps.expected:g}")
    ax.set(xlabel="ω", ylabel="largest gap over the interval")
    ax.legend()
    return ax
