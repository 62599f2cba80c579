"""A certified bound of the averaged distance that is tight: the scalar comparison system of the radial envelope.

In the stretched time s the averaged distance r satisfies dr/ds ≤ w·d + r·G(w, r), with w = dt/ds, G the envelope of
:class:`ptproof.balls.radial.RadialEnvelope` and d a bound of the drift that does not vanish. On each short step
and in each shell both are replaced by constants from above, y' = a + g·y, which is solved by its formula in ball
arithmetic with every rounding outward. y lies above r: where y moves inside a shell by the Lipschitz comparison, and
where it rests on a boundary because the outer shell's rate is negative there.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from itertools import pairwise

import sympy as sp

from ptproof.errors import InputError
from ptproof.gains.horizon import horizon_of
from ptproof.gains.numbers import NotApplicable, short, sign
from ptproof.gains.upper import UpperSolution, time_grid
from ptproof.problem import Problem
from ptproof.proof.verdict import Evidence, Verdict


@dataclass(frozen=True)
class BoundCurve:
    """Certified upper bounds of ‖x̄ − x*‖ along the averaged system, for every start at the given distance.

    Attributes
    ----------
    times, stretched
        t and τ of the grid, floats; ``distances[i]`` holds at the exact grid time, which these round.
    distances
        Floats, rounded up; inf from where the bound is given up.
    initial
        ‖x₀ − x*‖, exact.
    evidence
        ``proved`` with the counts behind it, or ``undecided`` with the reason.
    """

    times: tuple[float, ...]
    stretched: tuple[float, ...]
    distances: tuple[float, ...]
    initial: sp.Expr
    evidence: Evidence

    @property
    def final(self) -> float:
        """The bound at the last time."""
        return self.distances[-1]


def tight_bound(
    problem: Problem, x0_norm: sp.Expr | None = None, *, steps: int = 400, until: sp.Expr | None = None,
    time_limit: float = 120.0,
) -> BoundCurve:  # fmt: skip
    """Enclose the averaged distance of ``problem`` from above, for all starts at the distance ``x0_norm``.

    Parameters
    ----------
    problem
        A field with its source, a drift, k, T and ν_min.
    x0_norm
        The initial distance; left out, that of the problem's initial position.
    steps
        Of the grid in the stretched time.
    until
        The last elapsed time, by default T; without a clip it must be given and less than T.
    time_limit
        Seconds after which the rest is left open (undecided).

    Returns
    -------
    A curve whose evidence is ``proved`` only if ball arithmetic has covered every shell and step.

    Raises
    ------
    InputError
        If the source is not a critical point, the distance is not positive, or ``until`` does not fit.

    Examples
    --------
    >>> from ptproof.problem import example
    >>> curve = tight_bound(example("saturated"), steps=20)
    >>> curve.evidence.verdict, round(curve.final, 4)
    (<Verdict.PROVED: 'proved'>, 0.0539)
    """
    started = time.perf_counter()
    initial, end = _asked(problem, x0_norm, until)
    if steps < 1:
        raise InputError(f"steps must be positive, got {steps}")
    grid = time_grid(horizon_of(problem.tuning), end, steps)
    distances: list[float] = []
    try:
        solution = UpperSolution(problem, initial, grid)
        distances.append(solution.y)
        for left, right in pairwise(grid):
            if time.perf_counter() - started > time_limit:
                raise NotApplicable(f"the time limit of {time_limit:g} s")
            distances.append(solution.step(left, right))
        envelope, verdict = solution.envelope, Verdict.PROVED
        detail = f"{len(grid) - 1} steps, {envelope.enclosed} shells, {envelope.evaluations} pieces enclosed"
    except NotApplicable as reason:
        verdict, detail = Verdict.UNDECIDED, f"given up at {reason}"
    distances += [math.inf] * (len(grid) - len(distances))
    evidence = Evidence("arb", verdict, detail, time.perf_counter() - started)
    t0 = float(problem.tuning.t0)
    times = tuple(t0 + float(node.elapsed) for node in grid)
    stretched = tuple(t0 + float(node.stretched) for node in grid)
    return BoundCurve(times, stretched, tuple(distances), initial, evidence)


def _asked(problem: Problem, x0_norm: sp.Expr | None, until: sp.Expr | None) -> tuple[sp.Expr, sp.Expr]:
    """The initial distance and the last elapsed time, checked."""
    tuning = problem.tuning
    end = tuning.T if until is None else sp.sympify(until)
    if sign(end) <= 0 or sign(tuning.T - end) < 0 or (tuning.nu_min is None and sign(tuning.T - end) == 0):
        raise InputError(f"until must lie in (0, T], and below T where nothing clips the gain; got {short(end)}")
    initial = distance_from_source(problem) if x0_norm is None else sp.sympify(x0_norm)
    if not initial.is_number or sign(initial) <= 0:
        raise InputError(f"the initial distance must be positive, got {short(initial)}")
    return initial, end


def distance_from_source(problem: Problem) -> sp.Expr:
    """‖x₀ − x*‖, exact."""
    pairs = zip(problem.initial.x, problem.source, strict=True)
    return sp.sqrt(sp.Add(*((a - b) ** 2 for a, b in pairs)))
