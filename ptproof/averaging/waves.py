"""Functions of phase, slow and fast states: waves in the phase, polynomials in the fast, anything in the slow."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.averaging.phases import Harmonics, Key, Phases
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.ring import Coefficient, Ring
from ptproof.balls.arithmetic import collected
from ptproof.proof.kinks import innermost

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
