"""A map of what is feasible over two of the numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ptproof.certify.loop.certify import certify_loop
from ptproof.design.answer import Design
from ptproof.design.limits import Limits, angular_peak, forward_peak
from ptproof.design.search import rounded, with_numbers
from ptproof.errors import InputError
from ptproof.gains import tight_bound
from ptproof.problem import Problem
from ptproof.proof.verdict import Verdict

CERTIFIED, AVERAGE, NEITHER, LIMITED = range(4)
WORDS = (
    "the vehicle is certified to end within the residual",
    "the average's bound is within the residual, no certificate for the vehicle",
    "not even the average's bound is within the residual",
    "an input's limit is not certain to be kept",
)
_COLOURS = ("#0072B2", "#56B4E9", "#DDDDDD", "#E69F00")
_TOLERANCE = 0.5
_SPREAD = {"nu_min": 1.6}


def feasible_map(
    found: Design, names: Sequence[str] = ("omega", "k"), *, limits: Limits | None = None, radius: Any = None,
    filter_gap: Any = 0, size: int = 7, workers: int | None = None,
    progress: Callable[[int], None] | None = None,
) -> tuple[Any, Any]:  # fmt: skip
    """What is feasible on a grid of ``size`` × ``size`` values of two numbers around those of a design.

    With ω on an axis μ changes so that μω stays. Where the map says that the vehicle is certified, it is, with these
    very numbers; elsewhere another search may do better.

    Returns
    -------
    The Matplotlib figure, and the classes (size × size, rows along the second name) as integers: 0 certified,
    1 the average alone, 2 neither, 3 an input's limit.
    """
    if len(names) != 2 or names[0] == names[1]:
        raise InputError(f"a map is over two of the numbers, not {', '.join(names)}")
    columns, rows = (_values(found.problem, name, size) for name in names)
    classes = np.zeros((size, size), dtype=int)
    for j, second in enumerate(rows):
        for i, first in enumerate(columns):
            changes, tuning = dict(zip(names, (first, second), strict=True)), found.problem.tuning
            if "omega" in changes and "mu" not in changes:
                changes["mu"] = rounded(float(tuning.mu * tuning.omega) / float(changes["omega"]))
            problem = with_numbers(found.problem, **changes)
            classes[j, i] = _class(problem, found, limits or Limits(), radius, filter_gap, workers)
            if progress is not None:
                progress(1)
    return _drawn(found, names, columns, rows, classes), classes


def _values(problem: Problem, name: str, size: int) -> list[Any]:
    given = getattr(problem.tuning, name, None)
    if given is None:
        raise InputError(f"the problem has no {name} to draw a map over")
    spread = _SPREAD.get(name, 4.0 if name == "omega" else 2.0)
    values = [rounded(float(given) * factor) for factor in np.geomspace(1 / spread, spread, size)]
    return [value if name != "nu_min" else min(value, rounded(1)) for value in values]


def _class(problem: Problem, found: Design, limits: Limits, radius: Any, gap: Any, workers: int | None) -> int:
    residual = float(found.residual)
    if limits.excess(forward_peak(problem), 0.0) is not None:
        return LIMITED
    if problem.tuning.nu_min is not None:
        curve = tight_bound(problem, radius, time_limit=60)
        if curve.evidence.verdict is not Verdict.PROVED or curve.final > residual:
            return NEITHER
    if float(problem.tuning.omega) ** -0.5 >= residual:
        return AVERAGE
    certificate = certify_loop(problem, radius, filter_gap=gap, tolerance=_TOLERANCE, workers=workers)
    if certificate.final is None or certificate.final > residual:
        return AVERAGE
    peak = angular_peak(problem, max(certificate.distances), gap)
    return LIMITED if limits.excess(0.0, peak) is not None else CERTIFIED


def _drawn(found: Design, names: Sequence[str], columns: Sequence[Any], rows: Sequence[Any], classes: Any) -> Any:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    figure = Figure(figsize=(6.4, 5.6), layout="constrained")
    axes = figure.subplots()
    axes.pcolormesh(
        _edges(columns), _edges(rows), classes, cmap=ListedColormap(list(_COLOURS)),
        norm=BoundaryNorm(np.arange(-0.5, 4), 4), edgecolors="white", linewidth=0.5,
    )  # fmt: skip
    axes.plot(*(float(found.numbers[name]) for name in names), "k*", ms=11)
    axes.set(xscale="log", yscale="log", xlabel=names[0], ylabel=names[1])
    axes.set_title(f"to end within {float(found.residual):g} of the source")
    handles = [Patch(color=color, label=word) for color, word in zip(_COLOURS, WORDS, strict=True)]
    figure.legend(handles=handles, loc="outside lower center", fontsize=8, ncols=1)
    return figure


def _edges(values: Sequence[Any]) -> Any:
    logs = np.log([float(value) for value in values])
    middles = (logs[1:] + logs[:-1]) / 2
    return np.exp(np.concatenate([[2 * logs[0] - middles[0]], middles, [2 * logs[-1] - middles[-1]]]))
