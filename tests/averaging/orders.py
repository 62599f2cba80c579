"""What the tests of averages to any order share: systems, and what is left along the system itself, in numbers."""

import math
from typing import Any

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.simplify.cse_main import tree_cse

from ptproof.averaging.orders import Orders
from ptproof.averaging.problem import OMEGA, PHASE, TIME, DitherProblem, FastStates
from ptproof.system import DitherSystem, replaced, substitute

x, y, z = sp.symbols("x y z", real=True)
k = sp.Symbol("k", positive=True)
SQUARE = sp.Piecewise((1, sp.Mod(PHASE, 2 * sp.pi) < sp.pi), (-1, True))
TRIANGLE = sp.Abs(sp.Mod(PHASE, 1) - sp.Rational(1, 2)) - sp.Rational(1, 4)
MU = sp.Symbol("mu", positive=True)


def dithered(state: Any, drift: Any, fields: Any, dithers: Any, period: Any = 2 * sp.pi) -> DitherSystem:
    return DitherSystem(
        TIME, PHASE, OMEGA, tuple(state), tuple(drift), tuple(map(tuple, fields)), tuple(dithers), period
    )


def finite_seeker(rate: Any) -> DitherProblem:
    """The paper's seeker in the plane, with an unknown drift and field and μω = ``rate``."""
    field = sp.Function("F", real=True)(x, y)
    drift = [sp.Function(name, real=True)(TIME, x, y) for name in ("d1", "d2")]
    c, s = sp.cos(k * z), sp.sin(k * z)
    system = dithered((x, y), drift, [[c, -s], [s, c]], [sp.cos(PHASE), sp.sin(PHASE)])
    return DitherProblem(system, FastStates((z,), (field - z,)), mu_omega=rate)


def left_over(found: Orders) -> float:
    """The power of ω with which dX/dτ, along the system in its own letters, approaches the average at X."""
    left = _Left(found)
    small, large = 10**8, 10**12
    with mpmath.workdps(110):
        return math.log(left.at(mpmath.mpf(large)) / left.at(mpmath.mpf(small))) / math.log(large / small)


class _Left:
    """dX/dτ − average(X) at one point, in numbers: the derivative is a quotient of differences of 110 digits."""

    def __init__(self, found: Orders) -> None:
        problem, system = found.problem, found.problem.system
        moving = problem.fast if problem.fast and problem.mu_omega is not None else None
        rates = [sp.S.One, OMEGA]
        for row, _ in enumerate(system.state):
            waves = (field[row] * dither for field, dither in zip(system.fields, system.dithers, strict=True))
            rates.append(system.drift[row] + sp.sqrt(OMEGA) * sp.Add(*waves))
        gaps: list[sp.Expr] = []
        if moving is not None:
            rates += [OMEGA * rate / problem.mu_omega for rate in moving.rate]
            steady = sp.solve(moving.rate, moving.state, dict=True)[0]
            gaps = [steady[fast] + sp.Rational(3 + i, 5) / sp.sqrt(OMEGA) for i, fast in enumerate(moving.state)]
        self.letters = (TIME, PHASE, *system.state, *(moving.state if moving else ()))
        shifts = [row / sp.sqrt(OMEGA) ** n for n, row in enumerate(map(sp.Matrix, found.correctors), start=1)]
        change = sp.Matrix(system.state) + sum(shifts, sp.zeros(*shifts[0].shape))
        change = change.applyfunc(lambda entry: replaced(entry, found.fast))
        self.gaps, self.rates = self._function(gaps), self._function(rates)
        self.change, self.means = self._function(change), self._function(found.system.rhs)
        self.start = [sp.Rational(3, 7), sp.Rational(4, 9), sp.Rational(2, 7), sp.Rational(5, 11)][
            : 2 + len(system.state)
        ]

    def _function(self, expressions: Any) -> Any:
        exact = _concrete(tuple(expressions))
        free = set().union(*(entry.free_symbols for entry in exact)) - {*self.letters, OMEGA}
        exact = [entry.xreplace({symbol: _parameter(symbol) for symbol in free}) for entry in exact]
        return sp.lambdify((*self.letters, OMEGA), exact, "mpmath", cse=_repeated)

    def at(self, omega: Any) -> float:
        start = [mpmath.mpf(value.p) / value.q for value in self.start]
        rest = [mpmath.mpf(0)] * (len(self.letters) - len(start))
        point = [*start, *self.gaps(*start, *rest, omega)]
        speeds, step = self.rates(*point, omega), mpmath.mpf(10) ** -45

        def moved(sign: int) -> Any:
            return self.change(*(value + sign * step * v for value, v in zip(point, speeds, strict=True)), omega)

        slope = [(after - before) / (2 * step) for after, before in zip(moved(1), moved(-1), strict=True)]
        there = [*point[:2], *self.change(*point, omega), *point[2 + len(slope) :]]
        return float(mpmath.norm([a - b for a, b in zip(slope, self.means(*there, omega), strict=True)]))


def _repeated(expressions: Any) -> Any:
    """What occurs more than once as it stands; to look for more takes longer than the few values that are asked."""
    return tree_cse(expressions, sp.numbered_symbols(), order="none")


def _parameter(symbol: sp.Symbol) -> sp.Rational:
    return sp.Rational(2 + sum(map(ord, symbol.name)) % 5, 3)


def _concrete(expressions: Any) -> Any:
    """With a polynomial in place of each unknown function, the same one each time."""
    functions = set().union(*(entry.atoms(AppliedUndef) for entry in expressions), set())
    if not functions:
        return expressions
    values = {}
    for node in functions:
        own = node.args
        if all(argument.is_Symbol for argument in own):
            place = sum(map(ord, str(node.func))) % 7
            values[node] = (
                sum((i + 2 + place) * a / 7 for i, a in enumerate(own)) + math.prod(own) / 3 + own[-1] ** 3 / 5
            )
    return substitute(expressions, values)
