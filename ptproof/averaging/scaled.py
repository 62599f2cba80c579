"""Dither systems, and systems whose phase is a state, in σ = ωτ and δ = 1/√ω: what is expanded there."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

import sympy as sp

from ptproof.averaging.boundary import hurwitz
from ptproof.averaging.brackets import Vector
from ptproof.averaging.fractions import Fractions, reading
from ptproof.averaging.oscillation import DELTA, Oscillation, in_delta, spread
from ptproof.averaging.problem import DitherProblem, FastStates
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided
from ptproof.proof.kinks import innermost
from ptproof.system import DitherSystem, System

Put = Callable[[sp.Expr], sp.Expr]


def of_problem(problem: DitherProblem, order: int) -> Oscillation:
    """A dither system, with all that counts up to δ^``order``.

    With ``problem.mu_omega`` = m the fast states keep their own dynamics: z = l(x) + y/√ω, where l is the quasi-steady
    state and dy/dσ = A y/m − (∂l/∂x) dx/dτ/√ω. Without it, they are at their quasi-steady state. Where all fields turn
    with an angle A(x, z), the phase is θ − A.

    Raises
    ------
    AveragingRefused, AveragingUndecided
        If the fast states are not linear with a constant matrix that is shown to be stable.
    """
    system = problem.system
    turned = _letter("psi", problem)
    angle, waves = rotating(system, turned) or (sp.S.Zero, sum_of_waves(system))
    slow = [DELTA * wave + DELTA**2 * entry for wave, entry in zip(waves, system.drift, strict=True)]
    states = system.state
    if any(system.time in entry.free_symbols for entry in (*slow, angle)):
        states, slow = (*states, system.time), [*slow, DELTA**2]
    fast = _Fast(problem)
    meaning = dict(fast.meaning)
    if angle != 0:
        meaning[turned] = system.phase - fast.settled(angle)
    return in_delta(
        Oscillation(
            turned if angle != 0 else system.phase,
            system.period,
            states,
            (),
            fast.scaled,
            fast.matrix,
            meaning=meaning,
            whole=fast.whole(states, slow, angle),
            name=system.name,
        ),
        order,
    )


class _Fast:
    """The fast states of a problem on the scale of the phase; none where they are missing or faster than that."""

    def __init__(self, problem: DitherProblem) -> None:
        fast, own = problem.fast, problem.mu_omega
        self._state = fast.state if fast else ()
        matrix, self._steady = linear(fast) if fast else (sp.zeros(0, 0), ())
        self.scaled = tuple(_letter(f"{z.name}_gap", problem) for z in self._state) if own is not None else ()
        self.matrix = sp.ImmutableDenseMatrix(matrix / own if own is not None else sp.zeros(0, 0))
        root = sp.sqrt(problem.system.omega)
        pairs = zip(self._state, self._steady, strict=True)
        self.meaning = dict(zip(self.scaled, (root * (z - value) for z, value in pairs), strict=False))

    def settled(self, entry: sp.Expr) -> sp.Expr:
        """``entry`` without the fast states, where these have no dynamics of their own."""
        return entry if self.scaled else self.put(entry)

    def put(self, entry: sp.Expr) -> sp.Expr:
        """``entry`` with z = l(x) + δ y, or z = l(x)."""
        gaps = [DELTA * y for y in self.scaled] or [sp.S.Zero] * len(self._state)
        there = {z: value + gap for z, value, gap in zip(self._state, self._steady, gaps, strict=True)}
        return entry.subs(there, simultaneous=True)

    def whole(self, states: Sequence[sp.Symbol], slow: Sequence[sp.Expr], angle: sp.Expr) -> Vector:
        """The rates of the slow states, of θ − ``angle`` and of the scaled fast states, exactly."""
        rates = list(map(self.put, slow))
        linear_part = self.matrix * sp.Matrix(self.scaled) if self.scaled else sp.zeros(0, 1)
        speeds = dict(zip(states, rates, strict=True))
        if self.scaled:
            speeds |= dict(zip(self._state, DELTA * linear_part, strict=True))
        own = self.settled(angle)
        turning = 1 - sp.Add(*(self.put(sp.diff(own, symbol)) * speed for symbol, speed in speeds.items()))
        if not self.scaled:
            return *rates, turning
        return *rates, turning, *_gaps(linear_part, self._steady, states, rates)


def _gaps(linear_part: sp.Matrix, steady: Vector, states: Sequence[sp.Symbol], rates: Sequence[sp.Expr]) -> Vector:
    """dy/dσ for y = (z − l(x))/δ: what the fast states do less what their quasi-steady state does."""
    moved = sp.Matrix(list(steady)).jacobian(list(states)) * sp.Matrix(list(rates)) / DELTA
    return tuple(linear_part - moved.applyfunc(spread))


def of_turning(
    system: System, phase: sp.Symbol, fast: Sequence[sp.Symbol], *, omega: sp.Symbol, mu: sp.Symbol,
    mu_omega: sp.Expr, order: int, period: sp.Expr = 2 * sp.pi,
) -> Oscillation:  # fmt: skip
    """A system whose fast phase is a state, such as a vehicle's heading, in σ = ωτ and with μ = m/ω.

    Parameters
    ----------
    system
        dx/dτ = … in which ``phase`` turns at the rate ω + O(√ω), and μ dz/dτ is affine in the ``fast`` states z.
    mu_omega
        m, positive.

    Raises
    ------
    AveragingRefused, AveragingUndecided
        If the rates are not of these orders, or the fast states not linear and stable.
    """
    rate = dict(zip(system.state, system.rhs, strict=True))
    own = FastStates(tuple(fast), tuple(sp.expand(mu * rate[z]) for z in fast))
    matrix, steady = linear(own)
    scaled = tuple(sp.Symbol(f"{z.name}_gap", real=True) for z in fast)
    there = {z: value + DELTA * y for z, value, y in zip(fast, steady, scaled, strict=True)}
    orders = {omega: DELTA**-2, mu: mu_omega * DELTA**2}

    def put(entry: sp.Expr) -> sp.Expr:
        return spread(DELTA**2 * entry.subs(there, simultaneous=True).subs(orders, simultaneous=True))

    states = tuple(symbol for symbol in system.state if symbol != phase and symbol not in there)
    slow = [put(rate[symbol]) for symbol in states]
    if any(system.time in entry.free_symbols for entry in (*slow, rate[phase])):
        states, slow = (*states, system.time), [*slow, DELTA**2]
    rates = _gaps(matrix / mu_omega * sp.Matrix(scaled), steady, states, slow)
    meaning = {y: sp.sqrt(omega) * (z - value) for y, z, value in zip(scaled, fast, steady, strict=True)}
    return in_delta(
        Oscillation(
            phase, period, states, (), scaled, sp.ImmutableDenseMatrix(matrix / mu_omega), meaning=meaning,
            whole=(*slow, put(rate[phase]), *rates), name=system.name,
        ),
        order,
    )  # fmt: skip


def linear(fast: FastStates) -> tuple[sp.Matrix, Vector]:
    """A and l of the rates A (z − l(x)), with A constant and stable."""
    matrix = sp.Matrix(list(fast.rate)).jacobian(list(fast.state)).applyfunc(sp.expand)
    for i, rate in enumerate(fast.rate, start=1):
        for value in matrix.row(i - 1):
            if value.free_symbols - {symbol for symbol in value.free_symbols if symbol.is_positive} or value.has(
                sp.Function, sp.Derivative
            ):
                raise AveragingRefused(
                    "E", f"system.fast.rate[{i}]",
                    f"{rate} is not linear in the fast states with constant coefficients, as needed here",
                )  # fmt: skip
    if not hurwitz(matrix):
        raise AveragingUndecided(
            f"system.fast.rate: the matrix {matrix.tolist()} of the fast states is not shown to be stable "
            "by the Routh-Hurwitz conditions"
        )
    rest = sp.Matrix(list(fast.rate)).subs(dict.fromkeys(fast.state, 0))
    return matrix, tuple(-(matrix.inv() * rest).applyfunc(sp.expand))


def _letter(name: str, problem: DitherProblem) -> sp.Symbol:
    """A real symbol of this name, or of one that nothing else has."""
    system = problem.system
    entries = [*system.drift, *(entry for field in system.fields for entry in field), *system.dithers]
    entries += problem.fast.rate if problem.fast else ()
    taken = {symbol.name for entry in entries for symbol in entry.free_symbols} | {s.name for s in system.state}
    while name in taken:
        name += "_"
    return sp.Symbol(name, real=True)


_MOST = 4


def rotating(system: DitherSystem, turned: sp.Symbol) -> tuple[sp.Expr, Vector] | None:
    """(A, Σ b_i u_i as a function of ``turned`` = θ − A), or None where no such A is found among the fields' angles.

    Where dithers turn with the state, so that all fields depend on θ − A(x, z) only, that is the better phase.

    Guaranteed by exact algebra: with θ = turned + A the sum is what is returned, and that is free of A's sine and
    cosine. A vehicle whose heading is θ − kz is averaged with the heading as its phase this way.
    """
    theta = system.phase
    if any(innermost(dither, {theta}) is not None for dither in system.dithers):
        return None
    waves = sum_of_waves(system)
    found = set().union(*(entry.atoms(sp.sin, sp.cos) for field in system.fields for entry in field))
    angles = {node.args[0] for node in found if not node.args[0].is_number}
    if len(angles) > _MOST:
        return None
    for angle, sign in itertools.product(sorted(angles, key=str), (1, -1)):
        written = _written(waves, theta, turned, sign * angle)
        if written is not None:
            return sign * angle, written
    return None


def sum_of_waves(system: DitherSystem) -> Vector:
    """Σ b_i u_i."""
    pairs = [*zip(system.fields, system.dithers, strict=True)]
    return tuple(sp.Add(*(field[row] * dither for field, dither in pairs)) for row in range(len(system.state)))


def _written(waves: Vector, theta: sp.Symbol, turned: sp.Symbol, angle: sp.Expr) -> Vector | None:
    try:
        return reading(lambda algebra: _in_algebra(waves, theta, turned, angle, algebra), most=96)
    except AveragingUndecided:
        return None


def _in_algebra(
    waves: Vector, theta: sp.Symbol, turned: sp.Symbol, angle: sp.Expr, algebra: Fractions
) -> Vector | None:
    result = []
    for wave in waves:
        value = algebra.simplest(algebra.read(wave.xreplace({theta: turned + angle})))
        left = {node.args[0] for node in algebra.letters(value) if isinstance(node, sp.sin | sp.cos)}
        if any(argument.free_symbols != {turned} for argument in left):
            return None
        result.append(algebra.expression(value))
    return tuple(result)
