"""From a seeking problem to the vehicle's flow and its function W, with the closed loop checked to be what is bounded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from
from ptproof.balls.rounding import up
from ptproof.balls.tape import switching_part
from ptproof.certify.loop.cover import Model
from ptproof.certify.loop.flow import Flow
from ptproof.certify.loop.jets import CLOCK, FIELD, FIRST, SECOND, Jets
from ptproof.certify.loop.lyapunov import lyapunov
from ptproof.certify.loop.polynomials import ZERO
from ptproof.certify.loop.ranges import Columns, Form
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem.model import TIME, parameters
from ptproof.transforms.clocks import CappedClock

SEEKER = "pt"


@dataclass(frozen=True)
class Phase:
    """A stretch of t on which the gain K = dτ/dt is one formula.

    Attributes
    ----------
    start, end
        Exact ends in t.
    rate
        K, an expression in t; it may be infinite at the end.
    """

    start: sp.Expr
    end: sp.Expr
    rate: sp.Expr

    @property
    def constant(self) -> bool:
        """Whether the gain is."""
        return not self.rate.has(TIME)


def phases(problem: Problem) -> tuple[Phase, ...]:
    """The gain's formulas from t₀ to t₀ + T; the closed loop in t is checked to be the seeker's with this gain."""
    check_form(problem)
    clock, given = problem.seeker_clock(SEEKER), problem.values
    start, end = (sp.sympify(item).subs(given) for item in (clock.start, problem.tuning.t0 + problem.tuning.T))
    if not isinstance(clock, CappedClock):
        return (Phase(start, end, clock.rate.subs(given)),)
    until = clock.until.subs(given)
    after = Phase(until, end, clock.last_rate.subs(given))
    return (after,) if until == start else (Phase(start, until, clock.clock.rate.subs(given)), after)


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
    for what, value in expressions.items():
        if (part := switching_part(value, {first, second, TIME})) is not None:
            raise InputError(f"certify: {what} is not shown to be smooth, because of {part}")
    return Jets((first, second), TIME, expressions, factor, order)


def models(problem: Problem, phase: Phase, orders: tuple[int, int, int], weight: float) -> Model:
    """W and its rate on a phase; ``orders`` are those of W, of the manifold and of the Taylor polynomials."""
    values = numbers(problem)
    drift = problem.drift
    drifting = any(rate != 0 for rate in drift.rate)
    matrix = None
    if drift.matrix is not None:
        rows = [[ball_from(entry) for entry in drift.matrix.row(i)] for i in (0, 1)]
        matrix = ((rows[0][0], rows[0][1]), (rows[1][0], rows[1][1]))
    flow = Flow(jets_of(problem, phase, orders[2]), values["k"], values["m"], matrix, drifting, ZERO)
    found = lyapunov(flow, orders[0], orders[1], weight)
    columns, alone = Columns.of(found.function, found.rate, found.flow.manifold), Columns.of(found.function)
    delta = values["delta"]
    return Model(
        found.flow.jets, columns, alone, Form.of(found.function, delta, alone), Form.of(found.function, delta, columns),
        Form.of(found.rate, delta, columns), Form.of(found.flow.manifold, delta, columns), up(delta),
    )  # fmt: skip


def marks(start: sp.Expr, end: sp.Expr, pieces: int) -> Iterator[sp.Expr]:
    """Ends of equal pieces, exact."""
    return (start + (end - start) * sp.Rational(i, pieces) for i in range(pieces + 1))
