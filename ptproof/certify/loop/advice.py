"""What would help where nothing is proved: a smaller start, a larger ω, by points and never proved."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.ball import ball_from
from ptproof.balls.rounding import up
from ptproof.certify.loop.levels import fallen
from ptproof.certify.loop.scene import NEAR, Scene, Task, held, reached_distance
from ptproof.certify.loop.setup import Unfit
from ptproof.certify.loop.stage import NoCertificate
from ptproof.problem import Problem

_LARGER, _SMALLER = (4, 16, 64), (2, 4, 16)
_GUIDED = 6  # stretches of time at which the rates are looked at
_MARGIN = 0.25  # of a typical rate, given away


@dataclass(frozen=True)
class Advice:
    """What would probably be proved, from rates at points: no promise.

    Attributes
    ----------
    omega, mu
        A larger ω, with μ such that μω stays what it is; None where none of those that were tried helps.
    radius
        A smaller radius of the starts, at the problem's own ω; None likewise.
    """

    omega: float | None
    mu: float | None
    radius: float | None

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        return dict(vars(self))

    def __str__(self) -> str:
        if self.omega is None and self.radius is None:
            return (
                f"at points, neither an omega {max(_LARGER)} times as large nor a start within 1/{max(_SMALLER)} "
                "of the radius helps: the drift may win, there may be another maximum within reach, or mu*omega be too "
                "large"
            )
        found = []
        if self.omega is not None:
            found.append(f"omega = {self.omega:.6g} with mu = {self.mu:.4g}")
        if self.radius is not None:
            found.append(f"a start within {self.radius:.4g}")
        return f"what would probably be proved, from points: {', or '.join(found)}"


def advice(problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str) -> Advice:
    """Look for a larger ω and for a smaller start among a few."""

    def at(factor: int) -> Problem:
        tuning = problem.tuning
        return replace(problem, tuning=replace(tuning, omega=tuning.omega * factor, mu=tuning.mu / factor))

    larger = next((n for n in _LARGER if promising(at(n), radius, gap, shape)), None)
    smaller = next((n for n in _SMALLER if radius and promising(problem, radius / n, gap, shape)), None)
    if larger == 4 and promising(at(2), radius, gap, shape):
        larger = 2
    tuning = None if larger is None else at(larger).tuning
    return Advice(
        None if tuning is None else float(tuning.omega), None if tuning is None else float(tuning.mu),
        None if smaller is None else float(radius / smaller),
    )  # fmt: skip


def promising(problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str) -> bool:
    """Whether a proof is to be expected: the comparison with rates at points and a few times, with a margin."""
    try:
        scene = Scene.of(problem, radius, gap, shape)
    except (NoCertificate, Unfit, Undefined):
        return False
    stage, step, seen, level = scene.stage, max(1, math.ceil(len(scene.work) / _GUIDED)), None, scene.stage.start
    slack = _MARGIN * scene.typical * stage.levels.edges[1:]
    for at, part in enumerate(scene.work):
        if seen is None or at % step == 0 or at == len(scene.work) - 1:
            seen = Task(*part, stage).expected() + slack
        level = fallen(level, seen, stage.levels, part[1].shortest, part[1].longest)
        if not level < stage.levels.edges[-1]:
            return False
    assert seen is not None
    if level > stage.start and not held(stage.levels, seen, level):
        return False
    near = max(up(ball_from(radius)), NEAR * scene.prepared[0].reach)
    return reached_distance(scene, level, shape) <= near
