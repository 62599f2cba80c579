"""One step of collocation in floating-point numbers: a polynomial that comes close to a solution, and proves nothing.

The method is Radau's, which follows stiff systems with steps much longer than their fast time constants. Coordinates
tell the fast directions of a Jacobian from the slow ones; any would be right.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import flint
import numpy as np
import sympy as sp
from flint import arb, arb_mat, fmpq
from numpy.polynomial import legendre

from ptproof.balls.ball import BALLS
from ptproof.balls.matrices import floats, matrix
from ptproof.balls.pieces import Proposal
from ptproof.balls.tape import Tape, Undefined

Array = Any
DEGREE = 16
_ROUNDING = 2.5e-16
_SPREAD = 13  # the degree of the spread, which is wanted to a few digits only


@dataclass(frozen=True)
class Scheme:
    """Nodes (N) on [−1, 1], the integrals from −1 to each node, and what turns values into coefficients.

    ``integrals`` (N × N) maps the values at the nodes of a polynomial of degree N − 1 to its integrals, ``spectrum``
    to its coefficients of Legendre polynomials, and ``low`` (fewer rows) to the powers of the first of these; in balls
    ``exact`` maps to its coefficients of powers, and ``fine`` to the integrals.
    """

    nodes: Array
    integrals: Array
    low: Array
    exact: arb_mat
    fine: arb_mat
    spectrum: Array


@lru_cache(maxsize=8)
def scheme(degree: int) -> Scheme:
    """Radau's right-hand nodes, the last of which is 1."""
    series = np.zeros(degree + 1)
    series[degree], series[degree - 1] = 1.0, -1.0
    nodes = np.sort(legendre.legroots(series))
    slope = legendre.legder(series)
    for _ in range(3):
        nodes = nodes - legendre.legval(nodes, series) / legendre.legval(nodes, slope)
    nodes[-1] = 1.0
    values = legendre.legvander(nodes, degree - 1)
    spectrum = np.linalg.inv(values)
    anti = np.array([legendre.legint(np.eye(degree)[k], lbnd=-1) for k in range(degree)])
    integrals = legendre.legval(nodes, anti.T).T @ spectrum
    with flint.ctx.workprec(300):
        vander = arb_mat(degree, degree, [arb(float(s)) ** k for s in nodes for k in range(degree)])
        exact = vander.inv()
        exact = arb_mat(degree, degree, [entry.mid() for entry in exact.entries()])
        powers = [(arb(float(s)) ** (k + 1) - (-1) ** (k + 1)) / (k + 1) for s in nodes for k in range(degree)]
        fine = arb_mat(degree, degree, powers) * exact
    kept = min(_SPREAD, degree)
    to_powers = np.array([[*legendre.leg2poly(np.eye(kept)[k])] + [0.0] * (kept - 1 - k) for k in range(kept)]).T
    return Scheme(nodes, integrals, to_powers @ spectrum[:kept], exact, fine, spectrum)


@dataclass(frozen=True)
class Rates:
    """A right-hand side in floats: ``of`` gives rates (N × n), Jacobians (N × n × n) and guards (N × g) at N points."""

    function: Any
    dimension: int
    guards: int

    @staticmethod
    def compiled(
        time: sp.Symbol, state: Sequence[sp.Symbol], rates: Sequence[sp.Expr], guards: Sequence[sp.Expr]
    ) -> Rates:
        """From expressions without parameters."""
        slopes = [sp.diff(rate, x) for rate in rates for x in state]
        function = sp.lambdify([time, *state], [*rates, *slopes, *guards], modules="numpy", cse=True)
        return Rates(function, len(rates), len(guards))

    def of(self, time: Array, x: Array) -> tuple[Array, Array, Array]:
        """At the times (N) and states (N × n); not finite where it has no value."""
        n = self.dimension
        with np.errstate(all="ignore"):
            found = self.function(time, *x.T)
        flat = np.empty((len(time), n + n * n + self.guards))
        for index, values in enumerate(found):
            flat[:, index] = values
        return flat[:, :n], flat[:, n : n + n * n].reshape(-1, n, n), flat[:, n + n * n :]


@dataclass(frozen=True)
class Trial:
    """A solved step: stage values (N × n), rates there, Jacobians, guards, and the relative size of its last terms."""

    stages: Array
    rates: Array
    jacobians: Array
    guards: Array
    tail: float
    solver: Array


def attempt(
    rates: Rates, start: float, length: float, begin: Array, guess: Array, degree: int = DEGREE
) -> Trial | None:
    """Solve the step from the state ``begin``; None where Newton's method does not converge.

    ``guess`` has the stage values to begin with (N × n).
    """
    plan, n = scheme(degree), rates.dimension
    times, half = start + length / 2 * (1 + plan.nodes), length / 2
    stages = np.array(guess, dtype=float)
    before, eye = np.inf, np.eye(degree * n)
    for turn in range(12):
        f, jacobian, _ = rates.of(times, stages)
        if not (np.all(np.isfinite(f)) and np.all(np.isfinite(jacobian))):
            return None
        solver = eye - half * np.einsum("ij,jab->iajb", plan.integrals, jacobian).reshape(degree * n, degree * n)
        residual = stages - begin - half * (plan.integrals @ f)
        try:
            step = np.linalg.solve(solver, residual.ravel()).reshape(degree, n)
        except np.linalg.LinAlgError:
            return None
        stages = stages - step
        scale = np.maximum(np.abs(begin), np.abs(stages).max(axis=0))
        scale = np.maximum(scale, 1e-6 * scale.max() + 1e-30)
        size = float(np.max(np.abs(step) / scale))
        if not np.isfinite(size) or (turn > 3 and size > before):
            return None if not size < 1e-11 else _trial(rates, plan, times, stages, half, scale, solver)
        if size < 4e-15 or (size < 1e-12 and size >= 0.3 * before) or (size < 1e-9 and size**2 < 1e-16 * before):
            return _trial(rates, plan, times, stages, half, scale, solver)
        before = size
    return None


def _trial(
    rates: Rates, plan: Scheme, times: Array, stages: Array, half: float, scale: Array, solver: Array
) -> Trial | None:
    f, jacobian, guards = rates.of(times, stages)
    if not np.all(np.isfinite(f)):
        return None
    # What rounding alone leaves in the rates is no sign of a step that is too long.
    noise = _ROUNDING * (np.abs(jacobian[-1]) @ np.abs(stages[-1]) + np.abs(f[-1]))
    terms = np.abs(plan.spectrum[-2:] @ (half * f)).max(axis=0)
    tail = float((np.maximum(terms - half * noise, 0.0) / scale).max())
    return Trial(stages, f, jacobian, guards, tail, solver)


def refined(trial: Trial, tape: Tape, centre: Sequence[arb], now: arb, length: arb) -> arb_mat:
    """The rates at the nodes (N × n) after one more step of Newton's method, with the residual in balls.

    What rounding leaves in floats, fast systems enlarge; their own precision is that of the balls. ``tape`` gives the
    rates alone.
    """
    degree, n = trial.stages.shape
    plan, half = scheme(degree), length / 2
    times = [now + half * (1 + arb(float(s))) for s in plan.nodes]
    stages, start = matrix(trial.stages), arb_mat(degree, n, list(centre) * degree)
    residual = stages - start - half * (plan.fine * _rates(tape, times, stages))
    step = np.linalg.solve(trial.solver, floats(residual).ravel()).reshape(degree, n)
    if not np.all(np.isfinite(step)):
        raise Undefined("no finite correction")
    return _rates(tape, times, stages - matrix(step))


def _rates(tape: Tape, times: Sequence[arb], stages: arb_mat) -> arb_mat:
    rows = (tape.run([time, *row], BALLS) for time, row in zip(times, stages.tolist(), strict=True))
    return arb_mat([[entry.mid() for entry in row] for row in rows])


def proposal(
    trial: Trial,
    rates: arb_mat,
    centre: Sequence[arb],
    length: float,
    begin: Array,
    basis: Array,
    scale: Array,
) -> Proposal:
    """The polynomials of a solved step.

    ``rates`` (N × n) are those of :func:`refined`; ``begin`` (n × n) is the spread at the start: the identity, or less.
    """
    degree, n = trial.stages.shape
    plan, half = scheme(degree), length / 2
    slopes = (plan.exact * (rates * arb(half))).transpose().tolist()  # for each state the coefficients of p'
    rows = []
    for c, row in zip(centre, slopes, strict=True):
        higher = [(entry * fmpq(1, k)).mid() for k, entry in enumerate(row, start=1)]
        rows.append([(c - sum((a * (-1) ** k for k, a in enumerate(higher, start=1)), arb(0))).mid(), *higher])
    right = np.tile(begin, (degree, 1))
    spreads = np.linalg.solve(trial.solver, right).reshape(degree, n, n)
    slopes_of = half * np.einsum("iab,ibc->iac", trial.jacobians, spreads)
    # Without the highest terms: what has died out within the step would leave noise in them.
    terms = np.tensordot(plan.low, slopes_of, axes=1)
    higher_terms = [part / (k + 1) for k, part in enumerate(terms)]
    first = begin - sum(part * (-1) ** (k + 1) for k, part in enumerate(higher_terms))
    spread = tuple(matrix(part) for part in (first, *higher_terms))
    return Proposal(arb_mat(rows), spread, matrix(basis), matrix(np.diag(scale)))


def extended(trial: Trial, begin: Array, before: float, length: float) -> Array:
    """A guess of the stages of a next step of ``length``, from the polynomial of the step before."""
    degree, _ = trial.stages.shape
    plan = scheme(degree)
    nodes = np.concatenate([[-1.0], plan.nodes])
    beyond = 1 + (1 + plan.nodes) * length / before
    values = np.concatenate([begin[None, :], trial.stages])
    keep = min(degree, 7)
    terms = np.linalg.lstsq(legendre.legvander(nodes, degree), values, rcond=None)[0]
    return legendre.legval(np.minimum(beyond, 1.8), terms[: keep + 1]).T


_FAST, _APART = 8.0, 2.0
_NEAR, _CHANGE = 5.0, 4.0  # in powers of 2


def split(jacobian: Array, length: float) -> tuple[Array, int]:
    """A basis (columns, n × n) with the slow directions first, and how many of these there are.

    A direction is fast if it dies out within the step. Each group is an invariant plane by Schur's decomposition of the
    balanced matrix, which does not mind eigenvectors that come close to each other; without fast directions, or where
    the groups can't be told apart, the basis has the axes, as the balanced matrix scales them.
    """
    from scipy import linalg

    n = len(jacobian)
    try:
        balanced, (scale, _) = linalg.matrix_balance(jacobian, permute=False, separate=True)
        everything = np.diag(scale), n
        rates = np.sort(np.linalg.eigvals(balanced).real)[::-1] * length
        slow = int(np.sum(rates >= -_FAST))
        if slow in (0, n) or rates[slow - 1] - rates[slow] < _APART:
            return everything
        shifted = balanced - (rates[slow - 1] + rates[slow]) / 2 / length * np.eye(n)
        columns = []
        for sort, size in (("rhp", slow), ("lhp", n - slow)):
            _, vectors, count = linalg.schur(shifted, sort=sort)
            if count != size:
                return everything
            columns.append(vectors[:, :size])
    except (np.linalg.LinAlgError, ValueError):
        return np.eye(n), n
    planes = np.concatenate(columns, axis=1)
    if not np.all(np.isfinite(planes)) or np.linalg.cond(planes) > 1e10:
        return everything
    return scale[:, None] * planes, slow


def scales(jacobians: Array, before: Array | None) -> Array:
    """Units of the states, powers of 2, for Jacobians (N × n × n) whose entries are of very different sizes.

    Only what is far off is scaled, and those from ``before`` are kept as long as they do: frames of errors do not like
    a change of units.
    """
    from scipy import linalg

    largest = np.abs(jacobians).max(axis=0)
    if not np.all(np.isfinite(largest)):
        return np.ones(len(largest)) if before is None else before
    _, (found, _) = linalg.matrix_balance(largest, permute=False, separate=True)
    powers = np.log2(found) - np.mean(np.log2(found))
    powers = np.round(np.sign(powers) * np.maximum(np.abs(powers) - _NEAR, 0.0))
    if before is not None and np.all(np.abs(powers - np.log2(before)) <= _CHANGE):
        return before
    return np.exp2(powers)


def slow_part(jacobian: Array, length: float, slow: int) -> Array | None:
    """The projection on the slow directions along the fast ones; None where there is none of that many."""
    basis, count = split(jacobian, length)
    if count != slow:
        return None
    keep = np.diag([1.0] * slow + [0.0] * (len(basis) - slow))
    return basis @ keep @ np.linalg.inv(basis)
