"""A source that moves: the same problem in coordinates that move with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift, bounded_drift
from ptproof.problem.model import TIME
from ptproof.problem.problem import Problem
from ptproof.problem.smooth import require_smooth
from ptproof.reading.tables import finite


def motion_of(problem: Problem, motion: Any) -> tuple[sp.Expr, ...]:
    """How far the source is from its place at each t: n expressions in ``TIME``, from text or expressions.

    Raises
    ------
    InputError
        For another number of entries, for an entry that is no expression in t, or one that is not shown to be
        continuously differentiable.
    """
    entries, n = tuple(motion) if isinstance(motion, (list, tuple)) else (motion,), problem.field.dimension
    if len(entries) != n:
        raise InputError(
            f"motion: {len(entries)} entries for {n} coordinates; give one for each, such as t/5 and sin(t)"
        )
    found = tuple(
        entry if isinstance(entry, sp.Expr) else finite(entry, f"motion[{i}]", [TIME])
        for i, entry in enumerate(entries)
    )
    for i, entry in enumerate(found):
        if entry.free_symbols - {TIME}:
            raise InputError(f"motion[{i}]: {entry} may depend on t alone")
        require_smooth(entry, (TIME,), 1, f"motion[{i}]: the source needs a velocity")
    return found


def moving_source(problem: Problem, motion: Any) -> Problem:
    """The problem for y = x − d(t), where the source is at x* + d(t) and the field is F(x − d(t)).

    In these coordinates the source rests and the drift has the source's velocity subtracted:
    dy/dt = f + u₁(cos θ, sin θ) − d′(t). A drift E∇F is one that the source gives off, so that it moves along; any
    other stays where it is, f(t, y + d(t)). The problem is exact, so what is certified about it, with its drift, holds
    for the distance from the moving source.

    Parameters
    ----------
    motion
        d, as :func:`motion_of` takes it. [length]

    Raises
    ------
    InputError
        As :func:`motion_of`.

    Examples
    --------
    >>> from ptproof.problem import example
    >>> moving_source(example("saturated"), ("t/5", 0)).drift.rate
    (-1/5, 0)
    """
    shift = motion_of(problem, motion)
    velocity = tuple(sp.diff(entry, TIME) for entry in shift)
    start = {TIME: problem.tuning.t0}
    initial = tuple(sp.sympify(x) - d.subs(start) for x, d in zip(problem.initial.x, shift, strict=True))
    return replace(
        problem, drift=_relative(problem, shift, velocity), initial=replace(problem.initial, x=initial),
        name=f"{problem.name} with a moving source",
    )  # fmt: skip


def _relative(problem: Problem, shift: Sequence[sp.Expr], velocity: Sequence[sp.Expr]) -> Drift:
    drift, speed = problem.drift, sp.sqrt(sum((entry**2 for entry in velocity), sp.S.Zero))
    if drift.kind == "bounded":
        moved = {x: x + d for x, d in zip(problem.variables, shift, strict=True)}
        rate = tuple(entry.subs(moved, simultaneous=True) for entry in drift.rate)
    else:
        rate = drift.rate
    bound = {"none": speed, "bounded": None if drift.bound is None else drift.bound + speed}.get(drift.kind)
    return bounded_drift([f - v for f, v in zip(rate, velocity, strict=True)], bound)
