"""The engine for statements about every vehicle: a certificate of the closed loop, held against the statement."""

from __future__ import annotations

import math
from functools import lru_cache

import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from, precision
from ptproof.balls.rounding import at_most
from ptproof.balls.tape import Undefined
from ptproof.certify.loop import LoopCertificate, certify_loop
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.proof.claim import Goal, engine
from ptproof.proof.relation import Relation
from ptproof.proof.runs import Runs
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import System

NAME = "vehicle certificate"
_certificate = lru_cache(maxsize=8)(certify_loop)
_ROUNDING = 1e-9  # the instants of a certificate are floats


@engine
def certified(goal: Goal, problem: Problem, *, tolerance: float = 0.12) -> Evidence:
    """Decide a bound of the distance of every vehicle by :func:`ptproof.certify_loop`.

    Parameters
    ----------
    goal
        Its statement is an :class:`~ptproof.proof.runs.Runs` about the closed loop of the ``problem`` in t or τ, over
        its span of time: starts ‖x − x*‖² ≤ R² and z = F(x), of any heading; parts ‖x − x*‖² ≤ r² or < r².
    problem
        A proposal, from which nothing is taken that the statement does not say: its closed loop has to be the
        statement's system, letter by letter.
    tolerance
        As for :func:`ptproof.certify_loop`.

    Returns
    -------
    Evidence
        Never refuted: a bound that is not proved may still hold.
    """
    said = goal.statement
    if not isinstance(said, Runs):
        return _undecided("not a statement about runs")
    if reason := _other(said, problem):
        return _undecided(reason)
    try:
        radius = _radius(said, problem)
        limits = [_limit(said, part, problem) for part in said.parts]
        found = _certificate(problem, radius, tolerance=tolerance, workers=1)
        bound = _bound(said, found) if found.verdict is Verdict.PROVED else math.inf
    except (InputError, Undefined) as error:
        return _undecided(str(error))
    if found.verdict is not Verdict.PROVED:
        return _undecided(found.detail)
    with precision(96):
        for limit, part in zip(limits, said.parts, strict=True):
            square, asked = arb(bound) ** 2, ball_from(limit)
            if not (square < asked or (part.sign == "<=" and square <= asked)):
                return _undecided(
                    f"the distance is shown to be at most {at_most(bound, 6)}, which does not show {part}"
                )
    return Evidence(NAME, Verdict.PROVED, f"the distance is at most {at_most(bound, 6)}: {found.detail}")


def _undecided(reason: str) -> Evidence:
    return Evidence(NAME, Verdict.UNDECIDED, reason)


def _other(said: Runs, problem: Problem) -> str:
    """Why the statement is not about the closed loop of the problem; empty if it is."""
    loop: System = problem.closed_loop("pt")
    if (said.time, said.state, said.rates) != (loop.time, tuple(loop.state), tuple(loop.rhs)):
        return "it is not about the closed loop of the prescribed-time seeker of this problem"
    tuning = problem.tuning
    if said.span != (tuning.t0, tuning.t0 + tuning.T):
        return f"it is not about the time from {tuning.t0} to {tuning.t0 + tuning.T}"
    return ""


def _radius(said: Runs, problem: Problem) -> sp.Expr:
    """R, from starts that say ‖x − x*‖² ≤ R² and z = F(x), and nothing else."""
    if len(said.starts) != 2:
        raise InputError("starts are given by their distance from the source and by the filter, and by nothing else")
    ball, filter_ = said.starts
    if filter_ != Relation(problem.states.filter, "=", problem.field.expression):
        raise InputError(f"{filter_} is not the filter at the measured field")
    return sp.sqrt(_limit(said, ball, problem))


def _limit(said: Runs, part: Relation, problem: Problem) -> sp.Expr:
    """The number that the squared distance from the source is said not to exceed."""
    squared = sum((x - c) ** 2 for x, c in zip(problem.variables, problem.source, strict=True))
    if part.sign not in ("<", "<=") or part.right.free_symbols or sp.expand(part.left - squared) != 0:
        raise InputError(f"{part} does not say how large the squared distance from the source may be")
    if not ball_from(part.right) >= 0:
        raise InputError(f"no squared distance is at most {part.right}")
    return part.right


def _bound(said: Runs, found: LoopCertificate) -> float:
    """What the certificate says of the distance during the span of time that is spoken of."""
    if said.during == (said.span[1], said.span[1]):
        return found.distances[-1]
    first, last = (float(instant.mid()) for instant in map(ball_from, said.during))
    if not (first <= last and said.span[0] <= said.during[0] and said.during[1] <= said.span[1]):
        raise InputError("it speaks of instants beyond those of the runs")
    slack = _ROUNDING * (1 + abs(last))
    # Between two times the larger distance holds: those before and after belong to it.
    inside = [k for k, time in enumerate(found.times) if first - slack <= time <= last + slack]
    before = [k for k, time in enumerate(found.times) if time < first - slack][-1:]
    after = [k for k, time in enumerate(found.times) if time > last + slack][:1]
    return max(found.distances[k] for k in (*before, *inside, *after))
