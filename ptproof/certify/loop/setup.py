"""From a seeking problem to the vehicle's flow and its function W; the closed loop is checked to be what is bounded."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import sympy as sp
from flint import arb

from ptproof.balls.arrays import Intervals
from ptproof.balls.ball import ball_from, interval
from ptproof.balls.rounding import down, up
from ptproof.balls.tape import switching_part
from ptproof.certify.loop.flow import ONE, Flow, Lyapunov, lyapunov
from ptproof.certify.loop.jets import CLOCK, DISTANCE, FIELD, FIRST, SECOND, Jets
from ptproof.certify.loop.levels import Slice
from ptproof.certify.loop.model import Model
from ptproof.certify.loop.polynomials import ZERO, Letter, term
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem.model import TIME, parameters
from ptproof.transforms.clocks import CappedClock

SEEKER = "pt"
_PIECES = 40
_SHOWN = 24


class Unfit(Exception):
    """Why no certificate can be tried, in words."""


@dataclass(frozen=True)
class Phase:
    """A stretch of t on which the gain K = dτ/dt is one formula.

    Attributes
    ----------
    start, end
        Exact ends in t.
    rate
        K, an expression in t; it may be infinite at the end.
    to_tau
        τ, an expression in t, likewise.
    """

    start: sp.Expr
    end: sp.Expr
    rate: sp.Expr
    to_tau: sp.Expr

    @property
    def constant(self) -> bool:
        """Whether the gain is."""
        return not self.rate.has(TIME)

    def interval(self) -> Intervals:
        """The phase in t, from outside."""
        return Intervals.around(interval(ball_from(self.start), ball_from(self.end)))

    def dilated(self, time: sp.Expr) -> arb | None:
        """τ at an instant; None where it is infinite."""
        if not self.constant and time == self.end and not self.to_tau.subs(TIME, time).is_finite:
            return None
        return ball_from(self.to_tau.subs(TIME, time))


def phases(problem: Problem) -> tuple[Phase, ...]:
    """The gain's formulas from t₀ to t₀ + T; the closed loop in t is checked to be the seeker's with this gain."""
    check_form(problem)
    clock, given = problem.seeker_clock(SEEKER), problem.values
    start, end = (sp.sympify(item).subs(given) for item in (clock.start, problem.tuning.t0 + problem.tuning.T))
    if not isinstance(clock, CappedClock):
        return (Phase(start, end, clock.rate.subs(given), clock.to_tau.subs(given)),)
    until = clock.until.subs(given)
    early, late = (piece.to_tau.subs(given) for piece in (clock.pieces[0], clock.pieces[-1]))
    after = Phase(until, end, clock.last_rate.subs(given), late)
    return (after,) if until == start else (Phase(start, until, clock.clock.rate.subs(given), early), after)


def check_form(problem: Problem) -> None:
    """The right-hand side that is integrated is, term by term, the one that the flow is written for.

    dx/dt = K√ω e(θ) + f, dθ/dt = K(ω − k(F − z)/μ), dz/dt = K(F − z)/μ.
    """
    system = problem.closed_loop(SEEKER, "t", symbolic=True)
    states, drift, symbols = problem.states, problem.drift.rate, parameters
    K = problem.seeker_clock(SEEKER).rate
    innovation = (problem.field.expression - states.filter) / symbols.mu
    forward = K * sp.sqrt(symbols.omega)
    expected = (
        drift[0] + forward * sp.cos(states.heading),
        drift[1] + forward * sp.sin(states.heading),
        K * (symbols.omega - symbols.k * innovation),
        K * innovation,
    )
    gain = {K: sp.Symbol("K", real=True)}
    for ours, theirs in zip(expected, system.rhs, strict=True):
        if ours != theirs and sp.expand(ours.xreplace(gain) - theirs.xreplace(gain)) != 0:
            raise InputError(f"{problem.name}: the closed loop is not of the form that a certificate is for")


def numbers(problem: Problem) -> dict[str, arb]:
    """k, m = μω and δ = 1/√ω as balls."""
    tuning = problem.tuning
    omega = ball_from(tuning.omega)
    return {"k": ball_from(tuning.k), "m": ball_from(tuning.mu) * omega, "delta": 1 / omega.sqrt()}


def jets_of(problem: Problem, phase: Phase, order: int) -> Jets:
    """The letters of a phase, in coordinates whose origin is the source."""
    first, second = sp.symbols("y1 y2", real=True)
    moved = {
        symbol: place + new
        for symbol, place, new in zip(problem.variables, problem.source, (first, second), strict=True)
    }
    factor = 1 / phase.rate
    field = problem.field.expression.subs(moved, simultaneous=True) - problem.peak
    expressions = {FIELD: field, CLOCK: factor}
    for name, rate in zip((FIRST, SECOND), problem.drift.rate, strict=True):
        expressions[name] = factor * rate.subs(moved, simultaneous=True)
    expressions[DISTANCE] = (first**2 + second**2) / 2
    for what, value in expressions.items():
        if (part := switching_part(value, {first, second, TIME})) is not None:
            raise Unfit(f"{what} is not shown to be smooth, because of {part}")
    return Jets((first, second), TIME, expressions, factor, order)


def drift_factor(jets: Jets, start: float, end: float) -> tuple[float, float]:
    """About the least and the largest dt/dτ between two instants; it is monotone, and 0 where the gain is infinite."""
    ends = [sp.sympify(jets.factor).subs(TIME, sp.Float(time)) for time in (start, end)]
    found = sorted(abs(float(value)) if value.is_finite else 0.0 for value in ends)
    return found[0], found[1]


def models(
    problem: Problem, spans: Sequence[Phase], shape: str, orders: tuple[int, int, int], weight: float, typical: float
) -> tuple[Model, ...]:
    """W and its rate on each phase; ``orders`` are those of W, of the manifold and of the Taylor polynomials.

    V is F(x*) − F for the ``shape`` "field", and half the squared distance from the source for "distance". W is one and
    the same polynomial on all phases, in letters that are continuous where the gain is clipped.
    """
    values = numbers(problem)
    drift = problem.drift
    drifting = any(rate != 0 for rate in drift.rate)
    matrix = None
    if drift.matrix is not None:
        rows = [[ball_from(entry) for entry in drift.matrix.row(i)] for i in (0, 1)]
        matrix = ((rows[0][0], rows[0][1]), (rows[1][0], rows[1][1]))
    start = term(-ONE, Letter(FIELD)) if shape == "field" else term(ONE, Letter(DISTANCE))
    letters = [jets_of(problem, span, orders[2]) for span in (spans if drifting else spans[:1])]
    flows = [Flow(jets, values["k"], values["m"], matrix, drifting, ZERO) for jets in letters]
    first = lyapunov(flows[0], start, orders[0], orders[1], weight)
    found = [first]
    for flow in flows[1:]:
        found.append(Lyapunov.of(replace(flow, manifold=first.flow.manifold), first.function))
    made = tuple(Model.of(item, values["delta"], weight, typical) for item in found)
    return made if drifting else made * len(spans)  # without a drift nothing depends on time


def slices(problem: Problem, span: Phase) -> list[Slice]:
    """A phase in stretches of time that are equal in t; where nothing depends on time they are parts of one."""
    drift = problem.drift
    moving = any(rate.has(TIME) for rate in drift.rate)
    steady = not any(rate != 0 for rate in drift.rate) or (span.constant and not moving)
    pieces = _SHOWN if steady else _PIECES
    ends = [span.start + (span.end - span.start) * sp.Rational(i, pieces) for i in range(pieces + 1)]
    found = [_slice(span, a, b, steady) for a, b in pairwise(ends)]
    if not steady:
        return found
    return [replace(_slice(span, span.start, span.end, steady), parts=tuple(found))]


def _slice(span: Phase, start: sp.Expr, end: sp.Expr, steady: bool) -> Slice:
    ends = span.dilated(start), span.dilated(end)
    length = None if ends[0] is None or ends[1] is None else ends[1] - ends[0]
    shortest = math.inf if length is None else max(down(length), 0.0)
    longest = math.inf if length is None else up(length)
    time = Intervals.around(interval(ball_from(start), ball_from(end)))
    return Slice(float(start), float(end), time, shortest, longest, steady)
