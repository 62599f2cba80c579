"""The homological equation ∂W/∂φ + (A y + h(x, φ)) · ∂W/∂y = mean − R, solved exactly."""

from __future__ import annotations

import functools
import graphlib
import itertools
import operator
from collections.abc import Iterable, Sequence

import sympy as sp

from ptproof.averaging.damped import Pieces
from ptproof.averaging.ring import Coefficient
from ptproof.averaging.waves import Harmonics, Powers, Wave, Waves, degree

Matrix = tuple[tuple[Coefficient, ...], ...]


class Homological:
    """L₀ = ∂/∂φ + (A y + h) · ∂/∂y on waves, for a constant matrix A with eigenvalues of negative real part.

    L₀ takes the parts of degree d in y to degrees d and d − 1, and for d ≥ 1 it is invertible on degree d: on the r-th
    harmonic its eigenvalues are i r plus a sum of d eigenvalues of A. So the highest degree is solved first, and only
    the mean of degree 0 is left over: the mean of R along the periodic solution of ẏ = A y + h.

    Parameters
    ----------
    waves
        The algebra. With fast states its phases are sines and cosines, or ``Pieces`` that decay as these do.
    matrix
        A (q × q), free of states and phase.
    forcing
        h: q waves that are free of the fast states.
    """

    def __init__(self, waves: Waves, matrix: sp.Matrix, forcing: Sequence[Wave]) -> None:
        self.waves, self.matrix, self.forcing = waves, matrix, tuple(forcing)
        self._on_degree = functools.cache(self._action)
        self._inverse = functools.cache(self._inverted)

    def solve(self, rest: Wave) -> tuple[Wave, Coefficient]:
        """(W, mean) with L₀W = mean − ``rest``, W's own mean being 0 where it is free of the fast states."""
        waves, solved = self.waves, []
        for level in range(max((degree(powers) for _, powers in rest), default=0), 0, -1):
            part = {key: value for key, value in rest.items() if degree(key[1]) == level}
            found = self._solve_degree(part, level)
            solved.append(found)
            fed = (
                waves.product(self.forcing[index], waves.along_fast(found, index)) for index in range(len(self.forcing))
            )
            lower = {key: value for key, value in rest.items() if degree(key[1]) < level}
            rest = waves.total((lower, *fed))
        mean = waves.mean(rest)
        swinging = waves.total((rest, waves.negative(waves.constant(mean))))
        return waves.total((*solved, waves.negative(waves.primitive(swinging)))), mean

    def _solve_degree(self, part: Wave, level: int) -> Wave:
        """∂W/∂φ + B W = −part on one degree: (B² + r²) a = r s − B c and (B² + r²) b = −r c − B s for each harmonic."""
        ring, phases = self.waves.ring, self.waves.phases
        if isinstance(phases, Pieces):
            return self._respond(part, level, phases)
        assert isinstance(phases, Harmonics)
        monomials, action = self._on_degree(level)
        result: dict[tuple[tuple[int, int], Powers], Coefficient] = {}
        for turns in sorted({key[0] for key, _ in part}):
            rate = phases.rate((turns, 0))
            cosines, sines = ([part.get(((turns, kind), powers), ring.zero) for powers in monomials] for kind in (0, 1))
            inverse = self._inverse(level, turns)
            if turns == 0:
                found = [[-value for value in _times(inverse, cosines)]]
            else:
                acted = [_times(action, values) for values in (cosines, sines)]
                found = [
                    _times(inverse, [rate * s - b for s, b in zip(sines, acted[0], strict=True)]),
                    _times(inverse, [-rate * c - b for c, b in zip(cosines, acted[1], strict=True)]),
                ]
            for kind, values in enumerate(found):
                for powers, value in zip(monomials, values, strict=True):
                    value = ring.reduced(value)
                    if value != 0:
                        result[(turns, kind), powers] = value
        return result

    def _respond(self, part: Wave, level: int, phases: Pieces) -> Wave:
        """The same between switches, monomial by monomial: w′ − a w = −(what drives it), a its rate of decay."""
        waves = self.waves
        monomials, action = self._on_degree(level)
        count = range(len(monomials))
        edges = [(i, j) for i in count for j in count if i != j and action[i][j] != 0]
        order = in_order(len(monomials), edges)
        assert order is not None  # it was asked of the matrix itself
        found: dict[int, Wave] = {}
        for place in order:
            powers = monomials[place]
            driving = [{key: value for key, value in part.items() if key[1] == powers}]
            driving += [
                {(key, powers): value * action[place][other] for (key, _), value in found[other].items()}
                for i, other in edges
                if i == place
            ]
            turns = tuple(sum(map(operator.mul, powers, column)) for column in zip(*phases.turns, strict=True))
            answers = (
                {(entry, powers): waves.ring.reduced(value * number) for entry, number in phases.response(key, turns)}
                for (key, _), value in waves.total(driving).items()
            )
            found[place] = waves.total(answers)
        return waves.total(found.values())

    def _action(self, level: int) -> tuple[tuple[Powers, ...], Matrix]:
        """The monomials of one degree and the matrix of W ↦ (A y) · ∂W/∂y on them."""
        monomials, action = self._symbolic(level)
        return monomials, self._read(action)

    def _symbolic(self, level: int) -> tuple[tuple[Powers, ...], sp.Matrix]:
        size = self.matrix.rows
        monomials = tuple(
            powers for powers in itertools.product(range(level + 1), repeat=size) if degree(powers) == level
        )
        place = {powers: i for i, powers in enumerate(monomials)}
        action = sp.zeros(len(monomials), len(monomials))
        for powers, a, b in itertools.product(monomials, range(size), range(size)):
            if powers[a]:  # A_ab y_b ∂/∂y_a takes y^α to α_a A_ab y^(α − e_a + e_b)
                image = tuple(power - (i == a) + (i == b) for i, power in enumerate(powers))
                action[place[image], place[powers]] += powers[a] * self.matrix[a, b]
        return monomials, action

    def _inverted(self, level: int, turns: int) -> Matrix:
        """(B² + r²)⁻¹, or B⁻¹ for the part that does not turn."""
        phases = self.waves.phases
        assert isinstance(phases, Harmonics)
        _, action = self._symbolic(level)
        square = action if turns == 0 else action**2 + (turns * phases.base) ** 2 * sp.eye(action.rows)
        return self._read(square.inv(method="ADJ").applyfunc(lambda entry: sp.factor(sp.cancel(entry))))

    def _read(self, matrix: sp.Matrix) -> Matrix:
        ring = self.waves.ring
        return tuple(tuple(ring.read(entry) for entry in matrix.row(i)) for i in range(matrix.rows))


def in_order(count: int, edges: Iterable[tuple[int, int]]) -> list[int] | None:
    """The numbers below ``count`` so that j stands before i for each edge (i, j); None where there is a circle."""
    needed: dict[int, set[int]] = {i: set() for i in range(count)}
    for i, j in edges:
        needed[i].add(j)
    try:
        return [*graphlib.TopologicalSorter(needed).static_order()]
    except graphlib.CycleError:
        return None


def _times(matrix: Matrix, vector: Sequence[Coefficient]) -> list[Coefficient]:
    return [sum(entry * value for entry, value in zip(row, vector, strict=True)) for row in matrix]
