"""A picture of a certificate: the quotients along many directions, and the certified band."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.certify.domain import Domain
from ptproof.problem.field import Field


def plot_quotients(field: Field, domain: Domain, bands: Mapping[str, Any], title: str, path: str | None = None) -> Any:
    """Draw both quotients against ‖x − x*‖ along rays, with the enclosures of the constants as bands.

    Returns the matplotlib figure; writes it to ``path`` if that is given. Without an outer radius the picture ends
    at 10, or at ten times the inner radius.
    """
    import numpy as np
    from matplotlib.figure import Figure

    inner = float(domain.inner)
    outer = float(domain.outer) if domain.outer is not None else max(10.0, 10 * inner)
    radii = np.linspace(max(inner, outer / 400), outer, 400)
    value = sp.lambdify(field.variables, field.peak - field.expression, "numpy")
    slope = sp.lambdify(field.variables, list(field.gradient), "numpy")
    source = np.array([float(entry) for entry in field.source])
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    power = 2 * field.kappa
    with np.errstate(all="ignore"):
        for direction in _directions(field.dimension):
            points = source[:, None] + np.outer(direction, radii)
            drops = np.broadcast_to(value(*points), radii.shape)
            left.plot(radii, drops / radii**power, color="0.6", linewidth=0.6)
            parts = [np.broadcast_to(part, radii.shape) for part in slope(*points)]
            right.plot(radii, np.sqrt(sum(p**2 for p in parts)) / radii ** (power - 1), color="0.6", linewidth=0.6)
    for axis, names in ((left, ("a1", "a2")), (right, ("b2", "b1"))):
        for name, colour in zip(names, ("tab:red", "tab:blue"), strict=True):
            ends = bands[name]
            if ends.lower is not None and ends.upper is not None:
                axis.axhspan(ends.lower, ends.upper, color=colour, alpha=0.4)
                axis.axhline(ends.upper, color=colour, linewidth=1.2, label=f"{name} ∈ {ends}")
        axis.set_xlabel("‖x − x*‖")
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8)
    left.set_title(f"(F(x*) − F(x)) / ‖x − x*‖^{power}", fontsize=9)
    right.set_title(f"‖∇F(x)‖ / ‖x − x*‖^{power - 1}", fontsize=9)
    figure.suptitle(title, fontsize=10)
    if path is not None:
        figure.savefig(path, dpi=150)
    return figure


def _directions(n: int) -> list[Any]:
    import numpy as np

    if n == 1:
        return [np.array([1.0]), np.array([-1.0])]
    if n == 2:
        return [np.array([math.cos(a), math.sin(a)]) for a in np.linspace(0, 2 * math.pi, 48, endpoint=False)]
    rows = np.random.default_rng(0).normal(size=(80, n))
    return list(rows / np.linalg.norm(rows, axis=1, keepdims=True))
