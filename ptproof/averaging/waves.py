"""Functions of phase, slow and fast states: waves in the phase, polynomials in the fast, anything in the slow.

A basis function of the phase is named by a key; what multiplies it is a polynomial of :mod:`ptproof.averaging.ring`.
Sines and cosines have one basis, dithers with jumps and kinks another (:mod:`ptproof.averaging.damped`).
"""

from __future__ import annotations

import functools
import operator
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.ring import Coefficient, Ring
from ptproof.averaging.signal import read_signal
from ptproof.balls.arithmetic import collected
from ptproof.proof.kinks import innermost

Key = tuple[Any, ...]
Terms = tuple[tuple[Key, Coefficient], ...]


class Phases(ABC):
    """The functions of the phase that a calculation needs.

    ``multiply`` and ``primitive`` give (key, coefficient) pairs, each calculated once.
    ``primitive`` is the antiderivative of zero mean of the function less its mean.
    """

    def __init__(self, ring: Ring, phase: sp.Symbol, period: sp.Expr) -> None:
        self.ring, self.phase, self.period = ring, phase, period
        self.multiply = functools.cache(self._multiply)
        self.primitive = functools.cache(self._primitive)
        self.mean = functools.cache(self._mean)

    @property
    @abstractmethod
    def one(self) -> Terms:
        """The function 1."""

    @abstractmethod
    def read(self, expression: sp.Expr, where: str) -> Terms:
        """A function of the phase, with coefficients that may contain anything else."""

    @abstractmethod
    def expression(self, terms: Mapping[Key, sp.Expr]) -> sp.Expr:
        """The sum with these coefficients, for all phases."""

    @abstractmethod
    def _multiply(self, first: Key, second: Key) -> Terms: ...

    @abstractmethod
    def _mean(self, key: Key) -> Coefficient: ...

    @abstractmethod
    def _primitive(self, key: Key) -> Terms: ...


class Harmonics(Phases):
    """cos(r ν φ) with the key (r, 0) and sin(r ν φ) with (r, 1), where ν = 2π/period and r is a whole number."""

    def __init__(self, ring: Ring, phase: sp.Symbol, period: sp.Expr) -> None:
        super().__init__(ring, phase, period)
        self.base = sp.radsimp(sp.simplify(2 * sp.pi / period))
        self._faster, self._slower = ring.read(self.base), ring.read(1 / self.base)

    @property
    def one(self) -> Terms:
        return (((0, 0), self.ring.one),)

    def rate(self, key: Key) -> Coefficient:
        """r ν."""
        return key[0] * self._faster

    def read(self, expression: sp.Expr, where: str) -> Terms:
        signal = read_signal(expression, self.phase, self.period, where)
        result: list[tuple[Key, Coefficient]] = []
        for (_, rate), values in signal.pieces[0].terms.items():
            turns = int(sp.radsimp(sp.simplify(rate / self.base)))
            for kind, value in enumerate(values):
                if value != 0:
                    result.append(((turns, kind), self.ring.read(value)))
        return tuple(result)

    def expression(self, terms: Mapping[Key, sp.Expr]) -> sp.Expr:
        functions = (sp.cos, sp.sin)
        return sp.Add(*(value * functions[kind](r * self.base * self.phase) for (r, kind), value in terms.items()))

    def _multiply(self, first: Key, second: Key) -> Terms:
        (r, a), (q, b) = first, second
        half = self.ring.number(sp.Rational(1, 2))
        # 2 cos cos = cos(−) + cos(+), 2 sin sin = cos(−) − cos(+), 2 sin cos = sin(+) + sin(−), with r − q for (−).
        if a == b:
            items = [(r - q, 0, half), (r + q, 0, -half if a else half)]
        else:
            items = [(r - q, 1, half if a else -half), (r + q, 1, half)]
        return self._collected(items)

    def _collected(self, items: Iterable[tuple[int, int, Coefficient]]) -> Terms:
        sums: dict[Key, Coefficient] = {}
        for r, kind, value in items:
            if r < 0 and kind:
                value = -value
            if r or not kind:
                key = (abs(r), kind)
                sums[key] = sums.get(key, self.ring.zero) + value
        return tuple((key, value) for key, value in sums.items() if value != 0)

    def derivative(self, key: Key) -> Terms:
        """The derivative of a basis function."""
        r, kind = key
        return () if r == 0 else (((r, 1 - kind), self.rate(key) if kind else -self.rate(key)),)

    def _mean(self, key: Key) -> Coefficient:
        return self.ring.one if key == (0, 0) else self.ring.zero

    def _primitive(self, key: Key) -> Terms:
        r, kind = key
        if r == 0:
            return ()
        value = self.ring.number(sp.Rational(1, r)) * self._slower
        return (((r, 1 - kind), -value if kind else value),)


Powers = tuple[int, ...]
Wave = Mapping[tuple[Key, Powers], Coefficient]


@dataclass(frozen=True)
class Waves:
    """The algebra in which averages are expanded: exact sums, products and derivatives of ``Wave`` values.

    A ``Wave`` is Σ c(x) · u(φ) · y^α as {(key of u, α): c}; {} is 0. Nothing is changed in place.
    """

    ring: Ring
    phases: Phases
    fast: tuple[sp.Symbol, ...] = ()

    @property
    def _still(self) -> Powers:
        return (0,) * len(self.fast)

    def total(self, parts: Iterable[Wave]) -> Wave:
        """The sum."""
        sums = collected(item for part in parts for item in part.items())
        return {key: value for key, value in sums.items() if value != 0}

    def scaled(self, wave: Wave, factor: Coefficient) -> Wave:
        """``wave`` times a coefficient that is free of phase and fast states."""
        products = {key: self.ring.reduced(value * factor) for key, value in wave.items()}
        return {key: value for key, value in products.items() if value != 0}

    def negative(self, wave: Wave) -> Wave:
        return {key: -value for key, value in wave.items()}

    def product(self, first: Wave, second: Wave) -> Wave:
        sums: dict[tuple[Key, Powers], Coefficient] = {}
        for (key, powers), value in first.items():
            for (other, more), factor in second.items():
                found = self.phases.multiply(key, other)
                if not found:
                    continue
                both, total = self.ring.reduced(value * factor), tuple(map(operator.add, powers, more))
                for result, number in found:
                    entry = (result, total)
                    sums[entry] = sums[entry] + both * number if entry in sums else both * number
        reduced = {key: self.ring.reduced(value) for key, value in sums.items()}
        return {key: value for key, value in reduced.items() if value != 0}

    def constant(self, value: Coefficient) -> Wave:
        """A function of the slow states alone."""
        return {(key, self._still): number * value for key, number in self.phases.one} if value != 0 else {}

    def along_slow(self, wave: Wave, symbol: sp.Symbol) -> Wave:
        """∂/∂symbol for a slow state."""
        found = {key: self.ring.derivative(value, symbol) for key, value in wave.items()}
        return {key: value for key, value in found.items() if value != 0}

    def along_fast(self, wave: Wave, index: int) -> Wave:
        """∂/∂y_index."""
        result: dict[tuple[Key, Powers], Coefficient] = {}
        for (key, powers), value in wave.items():
            if powers[index]:
                lower = tuple(power - (i == index) for i, power in enumerate(powers))
                result[key, lower] = value * powers[index]
        return result

    def along_phase(self, wave: Wave) -> Wave:
        """∂/∂φ, of sines and cosines."""
        if not isinstance(self.phases, Harmonics):
            raise AveragingUndecided("a phase that the states turn is covered with sines and cosines only")
        derivative = self.phases.derivative
        return self.total(
            {(result, powers): self.ring.reduced(value * number)}
            for (key, powers), value in wave.items()
            for result, number in derivative(key)
        )

    def read(self, expression: sp.Expr, where: str) -> Wave:
        """The wave of an expression: a sum of coefficients times functions of the phase, polynomial in the fast states.

        Raises
        ------
        AveragingUndecided
            If it is not of this kind.
        """
        parts: list[Wave] = []
        for term in together(expression, self.phases.phase):
            factor, moving = term.as_independent(self.phases.phase, *self.fast, as_Add=False)
            number = self.ring.read(factor)
            for powers, rest in self._by_powers(moving, where):
                for entry in together(rest, self.phases.phase):
                    inner, function = entry.as_independent(self.phases.phase, as_Add=False)
                    own = number * self.ring.read(inner)
                    terms = self.phases.read(function, where) if function != 1 else self.phases.one
                    parts.append({(key, powers): self.ring.reduced(own * value) for key, value in terms})
        return self.total(parts)

    def _by_powers(self, expression: sp.Expr, where: str) -> Iterable[tuple[Powers, sp.Expr]]:
        """The coefficient of each power of the fast states."""
        if not expression.free_symbols & set(self.fast):
            return [(self._still, expression)]
        apart, inside = expression.as_independent(*self.fast, as_Add=False)
        try:
            terms = sp.Poly(inside, *self.fast).terms()
        except sp.PolynomialError:
            terms = [((), inside)]
        if any(value.free_symbols & set(self.fast) for _, value in terms):
            raise AveragingUndecided(f"{where}: {expression} is not a polynomial in the fast states")
        return [(tuple(map(int, powers)), apart * value) for powers, value in terms]

    def expression(self, wave: Wave) -> sp.Expr:
        """The wave as a SymPy expression."""
        by_powers: dict[Powers, dict[Key, sp.Expr]] = {}
        for (key, powers), value in wave.items():
            by_powers.setdefault(powers, {})[key] = self.ring.expression(value)
        return sp.Add(
            *(
                sp.Mul(*map(operator.pow, self.fast, powers)) * self.phases.expression(terms)
                for powers, terms in sorted(by_powers.items())
            )
        )

    def mean(self, wave: Wave) -> Coefficient:
        """The mean over the phase of the part that is free of the fast states."""
        still = self._still
        values = (self.phases.mean(key) * value for (key, powers), value in wave.items() if powers == still)
        return self.ring.reduced(sum(values, self.ring.zero))

    def primitive(self, wave: Wave) -> Wave:
        """The antiderivative in the phase, of zero mean, of a wave of zero mean that is free of the fast states."""
        return self.total(
            {(result, powers): self.ring.reduced(value * number)}
            for (key, powers), value in wave.items()
            for result, number in self.phases.primitive(key)
        )


def together(expression: sp.Expr, phase: sp.Symbol) -> list[sp.Expr]:
    """The terms of a sum, those with jumps or powers of the phase joined where they differ by a number.

    A saw, φ/π − 2 floor(φ/2π) − 1, is periodic as a whole only.
    """
    groups: dict[sp.Expr, list[sp.Expr]] = {}
    for term in sp.Add.make_args(expression):
        factor, function = term.as_independent(phase, as_Add=False)
        numbers = sp.Mul(*(part for part in sp.Mul.make_args(factor) if part.is_number))
        groups.setdefault(factor / numbers if numbers != 0 else sp.S.One, []).append(numbers * function)
    result = []
    for factor, functions in groups.items():
        jumping = [function for function in functions if not _is_smooth(function, phase)]
        result += [factor * function for function in functions if _is_smooth(function, phase)]
        if jumping:
            result.append(sp.Mul(factor, sp.Add(*jumping), evaluate=False))
    return result


def _is_smooth(function: sp.Expr, phase: sp.Symbol) -> bool:
    """Whether the phase stands in sines and cosines only."""
    waves = {node: sp.Dummy() for node in function.atoms(sp.sin, sp.cos)}
    return phase not in function.xreplace(waves).free_symbols and innermost(function, {phase}) is None


def degree(powers: Sequence[int]) -> int:
    """The total degree of y^α."""
    return sum(powers)
