"""Pictures of bounds: against time beside the simulated average, critical values, and the safe region."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.gains import nonvanishing, vanishing
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable
from ptproof.gains.tight import BoundCurve
from ptproof.gains.vanishing import Chain

_COLOURS = {"printed": "#b2182b", "closed form": "#ef8a62", "tight": "#2166ac", "simulated": "#777777"}
_X = sp.Symbol("x", positive=True)


def plot_gains(
    data: GainData | None,
    curve: BoundCurve | None = None,
    simulated: Sequence[Any] = (),
    path: str | Path | None = None,
) -> Any:
    """Draw the panels that these data allow; returns the matplotlib figure, and writes it to ``path`` if given.

    ``simulated`` holds trajectories of the averaged system as pairs (t, distance). Raises :class:`InputError` where
    there is nothing to draw or the file can't be written.
    """
    from matplotlib.figure import Figure

    panels: list[Callable[[Any], None]] = []
    if curve is not None or (data is not None and _has(data, "k", "T", "nu_min")):
        panels.append(lambda axes: _against_time(axes, data, curve, simulated))
    if data is not None and data.bounds.kappa > 1 and data.drift_norm is not None and _has(data, "k", "T"):
        if data.horizon.is_printed:
            panels.append(lambda axes: _critical(axes, data))
        panels.append(lambda axes: _safe_start(axes, data))
    elif data is not None and data.drift_bound is None:
        panels.append(lambda axes: _safe_gain(axes, data))
    if not panels:
        raise InputError("nothing to draw: give k, T, nu_min and x0_norm, or a drift norm")
    figure = Figure(figsize=(5.2 * len(panels), 4.0), layout="constrained")
    for draw, axes in zip(panels, figure.subplots(1, len(panels), squeeze=False)[0], strict=True):
        draw(axes)
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=8)
    if path is not None:
        try:
            figure.savefig(path)
        except (OSError, ValueError) as error:
            raise InputError(f"{path}: cannot write the picture ({error})") from None
    return figure


def _has(data: GainData, *names: str) -> bool:
    return all(getattr(data, name) is not None for name in names)


def _along(formula: sp.Expr, grid: Any) -> Any:
    """The values of a formula in x on the grid."""
    return np.broadcast_to(sp.lambdify(_X, formula, "numpy")(grid), grid.shape)


def _against_time(axes: Any, data: GainData | None, curve: BoundCurve | None, simulated: Sequence[Any]) -> None:
    for index, (t, distance) in enumerate(simulated):
        label = "averaged, simulated" if index == 0 else None
        axes.plot(t, distance, color=_COLOURS["simulated"], linewidth=0.8, label=label)
    if curve is not None:
        axes.plot(curve.times, curve.distances, color=_COLOURS["tight"], linewidth=1.8, label="certified, tight")
    if data is not None and _has(data, "k", "T", "nu_min"):
        for name, values in closed_form_curves(data).items():
            axes.plot(*zip(*values, strict=True), color=_COLOURS[name], linestyle="--", label=name)
    axes.set(xlabel="t", ylabel="distance to the source", yscale="log")


def closed_form_curves(data: GainData, points: int = 41) -> dict[str, list[tuple[float, float]]]:
    """``printed`` and ``closed form`` bounds of the distance as (t, value), where they apply.

    A prime number of ``points`` spares the tangent clock: SymPy writes tan(π/80) by nested roots, and tan(π/82) not.
    """
    (T,) = data.known("T")
    curves: dict[str, list[tuple[float, float]]] = {}
    for i in range(points + 1):
        e = T * sp.Rational(i, points)
        for name, chain in _chains(data):
            bound = None
            with suppress(NotApplicable):
                if data.drift_bound is None:
                    bound = vanishing.distance_bound(data, e, chain)
                elif chain == "split":
                    bound = nonvanishing.distance_bound(data, e)
            if bound is not None:
                curves.setdefault(name, []).append((float(data.t0 + e), float(bound)))
    return curves


def _chains(data: GainData) -> Sequence[tuple[str, Chain]]:
    split: list[tuple[str, Chain]] = [("closed form", "split")]
    return [("printed", "printed"), *split] if data.unit.is_printed else split


def _critical(axes: Any, data: GainData) -> None:
    last = float(vanishing.last_critical(data))
    if data.nu_min is not None:  # the formula is for the gain before its clip
        last = min(last, float(data.horizon.stretched_corner))
    if last <= 0:
        axes.text(0.5, 0.5, "no critical value:\nthe bound decreases", ha="center", transform=axes.transAxes)
        return
    s = np.linspace(0, last, 400)[1:-1]
    values = _along(vanishing.critical_values(data, _X), s)
    axes.plot(float(data.t0) + s, values, color=_COLOURS["printed"], label="V0 that escapes at τ*")
    for name, chain in _chains(data):
        value = _threshold(data, chain)
        if value is not None and value is not sp.oo:
            axes.axhline(float(value), linestyle=":", color=_COLOURS[name], label=f"threshold, {name}")
    axes.set(xlabel="τ*", ylabel="V0", yscale="log")


def _threshold(data: GainData, chain: Chain, T: sp.Expr | None = None) -> sp.Expr | None:
    """The critical V₀, infinite where there is none; None where the chain says nothing."""
    try:
        value = vanishing.critical_value(data, chain, T)
    except NotApplicable:
        return None
    return sp.oo if value is None else value


def _safe_start(axes: Any, data: GainData) -> None:
    T = float(data.horizon.T)
    grid = np.geomspace(T / 20, 20 * T, 200)
    for name, chain in _chains(data):
        threshold = _threshold(data, chain, _X)
        if threshold is None:
            continue
        if threshold is sp.oo:
            axes.text(0.5, 0.5, "safe everywhere", ha="center", transform=axes.transAxes)
            continue
        values = _along(threshold, grid)
        axes.plot(grid, values, color=_COLOURS[name], label=f"threshold, {name}")
        axes.fill_between(grid, values.min() / 10, values, color=_COLOURS[name], alpha=0.15)
    if data.V0 is not None or data.x0_norm is not None:
        axes.plot([T], [float(data.start_value)], "k*", label="these data")
    axes.set(xlabel="T", ylabel="V0", xscale="log", yscale="log", title="safe below the line")


def _safe_gain(axes: Any, data: GainData) -> None:
    norm = float(data.norm)
    top = max(2 * norm, 1.0)
    grid = np.linspace(0, top, 100)
    printed = _along(vanishing.smallest_gain_printed(data.bounds, _X), grid)
    least = _along(vanishing.smallest_gain(_X), grid)
    axes.plot(grid, printed, color=_COLOURS["printed"], label="k = 2(c2/c1)²‖E‖, printed")
    axes.plot(grid, least, color=_COLOURS["tight"], label="k = 2‖E‖")
    axes.fill_between(grid, least, max(printed[-1], 4 * top), color=_COLOURS["tight"], alpha=0.15)
    if data.nu_min is not None:
        capped = _along(vanishing.smallest_gain(_X) / data.unit.cap, grid)
        axes.plot(grid, capped, ":", color=_COLOURS["tight"], label="k = 2‖E‖ over the last rate")
    if data.k is not None:
        axes.plot([norm], [float(data.k)], "k*", label="these data")
    high = 4 * top if data.k is None else max(4 * top, 1.2 * float(data.k))
    axes.set(xlabel="‖E‖", ylabel="k", ylim=(0, high), title="asymptotic seeker converges above the line")
