"""Pictures of bounds: against time beside the simulated average, critical values, and the safe region."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.gains import nonvanishing, vanishing
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable
from ptproof.gains.tight import BoundCurve

_COLOURS = {"printed": "#b2182b", "closed form": "#ef8a62", "tight": "#2166ac", "simulated": "#777777"}


def plot_gains(
    path: str | Path, data: GainData | None, curve: BoundCurve | None = None, simulated: Sequence[Any] = ()
) -> None:
    """Write the panels that these data allow: a figure in the format that the ending of ``path`` names.

    ``simulated`` holds trajectories of the averaged system as pairs (t, distance). Raises :class:`InputError` where
    there is nothing to draw or the file can't be written.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    panels = []
    if curve is not None or (data is not None and _has(data, "k", "T", "nu_min")):
        panels.append(lambda axes: _against_time(axes, data, curve, simulated))
    if data is not None and data.bounds.kappa > 1 and data.drift_norm is not None and _has(data, "k", "T"):
        panels += [lambda axes: _critical(axes, data), lambda axes: _safe_start(axes, data)]
    elif data is not None and data.drift_bound is None:
        panels.append(lambda axes: _safe_gain(axes, data))
    if not panels:
        raise InputError("nothing to draw: give k, T, nu_min and x0_norm, or a drift norm")
    figure, axes = plt.subplots(1, len(panels), figsize=(5.2 * len(panels), 4.0), squeeze=False)
    try:
        for draw, axis in zip(panels, axes[0], strict=True):
            draw(axis)
            axis.grid(alpha=0.3)
        figure.tight_layout()
        figure.savefig(path)
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot write the picture ({error})") from None
    finally:
        plt.close(figure)


def _has(data: GainData, *names: str) -> bool:
    return all(getattr(data, name) is not None for name in names)


def _against_time(axes: Any, data: GainData | None, curve: BoundCurve | None, simulated: Sequence[Any]) -> None:
    for index, (t, distance) in enumerate(simulated):
        label = "averaged, simulated" if index == 0 else None
        axes.plot(t, distance, color=_COLOURS["simulated"], linewidth=0.8, label=label)
    if curve is not None:
        axes.plot(curve.times, curve.distances, color=_COLOURS["tight"], linewidth=1.8, label="certified, tight")
    if data is not None and _has(data, "k", "T", "nu_min"):
        for name, values in closed_form_curves(data).items():
            t, distance = zip(*values, strict=True)
            axes.plot(t, distance, color=_COLOURS[name], linestyle="--", label=name)
    axes.set(xlabel="t", ylabel="distance to the source", yscale="log")
    axes.legend(fontsize=8)


def closed_form_curves(data: GainData, points: int = 40) -> dict[str, list[tuple[float, float]]]:
    """``printed`` and ``closed form`` bounds of the distance as (t, value), where they apply."""
    (T,) = data.known("T")
    curves = {}
    for name, chain in (("printed", "printed"), ("closed form", "split")):
        values = []
        for i in range(points + 1):
            e = T * sp.Rational(i, points)
            try:
                if data.drift_bound is not None:
                    bound = nonvanishing.distance_bound(data, e) if chain == "split" else None
                else:
                    bound = vanishing.distance_bound(data, e, "printed" if chain == "printed" else "split")
            except NotApplicable:
                bound = None
            if bound is not None:
                values.append((float(data.t0 + e), float(bound)))
        if values:
            curves[name] = values
    return curves


def _critical(axes: Any, data: GainData) -> None:
    k, T = (float(value) for value in data.known("k", "T"))
    sigma, c1, c2, norm = (float(v) for v in (data.bounds.sigma, data.bounds.c1, data.bounds.c2, data.norm))
    last = T * (2 * c2**2 * norm / (k * c1**2) - 1)
    if last <= 0:
        axes.text(0.5, 0.5, "no critical value:\nthe bound decreases", ha="center", transform=axes.transAxes)
        return
    s = np.linspace(0, last, 400)[1:-1]
    stretch = 1 + s / T
    V = (stretch / (sigma * s * (c2**2 * norm - k * c1**2 / 2 * stretch))) ** (1 / sigma)
    axes.plot(float(data.t0) + s, V, color=_COLOURS["printed"], label="V0 that escapes at τ*")
    for chain in ("printed", "split"):
        value = vanishing.critical_value(data, "printed" if chain == "printed" else "split")
        if value is not None:
            axes.axhline(float(value), linestyle=":", color=_COLOURS["printed" if chain == "printed" else "tight"],
                         label=f"threshold, {chain}")  # fmt: skip
    axes.set(xlabel="τ*", ylabel="V0", yscale="log")
    axes.legend(fontsize=8)


def _safe_start(axes: Any, data: GainData) -> None:
    (T,) = (float(value) for value in data.known("T"))
    grid = np.geomspace(T / 20, 20 * T, 200)
    sigma = float(data.bounds.sigma)
    for chain, colour in (("printed", _COLOURS["printed"]), ("split", _COLOURS["tight"])):
        factor = vanishing.threshold_factor(data, "printed" if chain == "printed" else "split")
        if factor is None:
            axes.text(0.5, 0.5, "safe everywhere", ha="center", transform=axes.transAxes)
            continue
        V = (sigma * grid * float(factor)) ** (-1 / sigma)
        axes.plot(grid, V, color=colour, label=f"threshold, {chain}")
        axes.fill_between(grid, V.min() / 10, V, color=colour, alpha=0.15)
    if data.V0 is not None or data.x0_norm is not None:
        axes.plot([T], [float(data.start_value)], "k*", label="these data")
    axes.set(xlabel="T", ylabel="V0", xscale="log", yscale="log", title="safe below the line")
    axes.legend(fontsize=8)


def _safe_gain(axes: Any, data: GainData) -> None:
    norm = float(data.norm)
    ratio = float((data.bounds.c2 / data.bounds.c1) ** 2)
    top = max(2 * norm, 1.0)
    grid = np.linspace(0, top, 100)
    axes.plot(grid, 2 * ratio * grid, color=_COLOURS["printed"], label="k = 2(c2/c1)²‖E‖, printed")
    axes.plot(grid, 2 * grid, color=_COLOURS["tight"], label="k = 2‖E‖")
    axes.fill_between(grid, 2 * grid, max(2 * ratio * top, 4 * top), color=_COLOURS["tight"], alpha=0.15)
    if data.nu_min is not None:
        axes.plot(grid, 2 * float(data.nu_min) ** 2 * grid, ":", color=_COLOURS["tight"], label="k = 2ν_min²‖E‖")
    if data.k is not None:
        axes.plot([norm], [float(data.k)], "k*", label="these data")
    high = 4 * top if data.k is None else max(4 * top, 1.2 * float(data.k))
    axes.set(xlabel="‖E‖", ylabel="k", ylim=(0, high), title="asymptotic seeker converges above the line")
    axes.legend(fontsize=8)
