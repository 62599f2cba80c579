"""Functions of the phase over one period, as combinations of a basis: products, derivatives, means, antiderivatives.

A basis function is named by a key; what multiplies it is a polynomial of :mod:`ptproof.averaging.ring`. Sines and
cosines have one basis, dithers with jumps and kinks another (:mod:`ptproof.averaging.damped`).
"""

from __future__ import annotations

import functools
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp

from ptproof.averaging.ring import Coefficient, Ring
from ptproof.averaging.signal import read_signal

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
