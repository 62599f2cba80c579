"""What the tests of averages to any order share: systems, and what is left along the system itself, in numbers."""

import math
from typing import Any

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.orders import Orders
from ptproof.averaging.problem import OMEGA, PHASE, TIME, DitherProblem, FastStates
from ptproof.system import DitherSystem, substitute

x, y, z = sp.symbols("x y z", real=True)
k = sp.Symbol("k", positive=True)
SQUARE = sp.Piecewise((1, sp.Mod(PHASE, 2 * sp.pi) < sp.pi), (-1, True))
TRIANGLE = sp.Abs(sp.Mod(PHASE, 1) - sp.Rational(1, 2)) - sp.Rational(1, 4)
MU = sp.Symbol("mu", positive=True)


def dithered(state: Any, drift: Any, fields: Any, dithers: Any, period: Any = 2 * sp.pi) -> DitherSystem:
    return DitherSystem(TIME, PHASE, OMEGA, tuple(state), tuple(drift), tuple(map(tuple, fields)), tuple(dithers), period)


def finite_seeker(rate: Any) -> DitherProblem:
    """The paper's seeker in the plane, with an unknown drift and field and μω = ``rate``."""
    field = sp.Function("F", real=True)(x, y)
    drift = [sp.Function(name, real=True)(TIME, x, y) for name in ("d1", "d2")]
    c, s = sp.cos(k * z), sp.sin(k * z)
    system = dithered((x, y), drift, [[c, -s], [s, c]], [sp.cos(PHASE), sp.sin(PHASE)])
    return DitherProblem(system, FastStates((z,), (field - z,)), mu_omega=rate)


def left_over(found: Orders) -> float:
    """The power of ω with which dX/dτ, along the system in its own letters, approaches the average at X."""
    small, large = 10**8, 10**12
    return math.log(_left(found, large) / _left(found, small)) / math.log(large / small)


def _left(found: Orders, omega: int) -> float:
    problem, system = found.problem, found.problem.system
    change = [entry.subs(found.fast, simultaneous=True) for entry in found.transformed]
    moving = problem.fast if problem.fast and problem.mu_omega is not None else None
    root = sp.sqrt(OMEGA)
    rates: dict[sp.Symbol, sp.Expr] = {TIME: sp.S.One, PHASE: OMEGA}
    for row, symbol in enumerate(system.state):
        waves = (field[row] * dither for field, dither in zip(system.fields, system.dithers, strict=True))
        rates[symbol] = system.drift[row] + root * sp.Add(*waves)
    values: dict[sp.Symbol, Any] = {TIME: sp.Rational(3, 7), PHASE: sp.Rational(4, 9)}
    values |= dict(zip(system.state, (sp.Rational(2, 7), sp.Rational(5, 11)), strict=False))
    if moving is not None and problem.mu_omega is not None:
        rates |= {z: OMEGA * rate / problem.mu_omega for z, rate in zip(moving.state, moving.rate, strict=True)}
        steady = sp.solve([_concrete([rate])[0] for rate in moving.rate], moving.state, dict=True)[0]
        for place, fast in enumerate(moving.state):
            values[fast] = (steady[fast] + sp.Rational(3 + place, 5) / root).subs(values).subs(OMEGA, omega)
    along = [sp.Add(*(sp.diff(entry, symbol) * rate for symbol, rate in rates.items())) for entry in change]
    numbers = _numbers([*along, *change], values, omega)
    speeds, there = numbers[: len(along)], numbers[len(along) :]
    moved = values | dict(zip(system.state, there, strict=True))
    means = _numbers(list(found.system.rhs), moved, omega)
    return float(mpmath.norm([speed - mean for speed, mean in zip(speeds, means, strict=True)]))


def _concrete(expressions: Any) -> Any:
    """With polynomials in place of the unknown functions."""
    functions = set().union(*(entry.atoms(AppliedUndef) for entry in expressions))
    values = {}
    for place, node in enumerate(sorted(functions, key=str)):
        names = sorted({other.func for other in functions if other.func == node.func}, key=str)
        own = node.args
        assert names
        values[node] = sum((i + 2 + place) * a / 7 for i, a in enumerate(own)) + math.prod(own) / 3 + own[-1] ** 3 / 5
    return substitute(expressions, values)


def _numbers(expressions: Any, values: Any, omega: int) -> Any:
    mpmath.mp.dps = 90
    parameters = {symbol: sp.Rational(2 + i, 3) for i, symbol in enumerate(_parameters(expressions, values))}
    exact = [entry.subs(parameters).subs(OMEGA, omega) for entry in _concrete(expressions)]
    own = {symbol: sp.sympify(value).subs(parameters).evalf(90) for symbol, value in values.items()}
    return [entry.doit().subs(own, simultaneous=True).evalf(80) for entry in exact]


def _parameters(expressions: Any, values: Any) -> list[sp.Symbol]:
    free = set().union(*(entry.free_symbols for entry in expressions)) - values.keys() - {OMEGA}
    free |= set().union(*(sp.sympify(value).free_symbols for value in values.values())) - {OMEGA}
    return sorted((symbol for symbol in free if symbol.is_positive), key=str)
