"""A polynomial ring that is closed under derivatives: the coefficients of averages to any order.

What is not arithmetic in an expression (a value or a derivative of an undefined function, a sine, a root, the inverse
of a sum) becomes a generator when it is met, and so do its derivatives. Polynomials are FLINT's, over the rationals.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx

from ptproof.averaging.refusal import AveragingUndecided

Coefficient = Any  # flint.fmpq_mpoly: the library has no types that mypy reads


class RingFull(Exception):
    """More generators were met than there is room for; the same again in a larger ring."""


class Ring:
    """Polynomials over the rationals in generators that are found on the way.

    Guaranteed: :meth:`expression` of :meth:`read` equals what was read wherever that is defined, sums and products are
    exact, and :meth:`derivative` is the derivative. ``relations`` (sin² + cos² = 1, q · (1/q) = 1, (√b)² = b) shorten
    what they can; zero is not always recognised, which costs time and no soundness.

    >>> x, k = sp.symbols("x k", real=True)
    >>> ring = Ring(16)
    >>> wave = ring.read(sp.cos(k * x) / (1 + k**2))
    >>> ring.expression(ring.derivative(wave, x))
    -k*sin(k*x)/(k**2 + 1)
    """

    def __init__(self, room: int = 48) -> None:
        self._context = fmpq_mpoly_ctx.get([f"g{i}" for i in range(room)], Ordering.lex)
        # The last to be met is the first in the order, so that relations write it by what was there before.
        self._symbols = self._context.gens()[::-1]
        self._of: dict[sp.Expr, int] = {}
        self._meanings: list[sp.Expr] = []
        self._inverted: dict[int, Coefficient] = {}
        self._relations: list[tuple[int, int, Coefficient]] = []
        self._derivatives: dict[tuple[int, sp.Symbol], Coefficient] = {}
        self._read: dict[sp.Expr, Coefficient] = {}
        self.zero, self.one = self._context.constant(0), self._context.constant(1)

    def number(self, value: Any) -> Coefficient:
        """The constant polynomial of a rational number."""
        value = sp.Rational(value)
        return self._context.constant(fmpq(int(value.p), int(value.q)))

    def _generator(self, meaning: sp.Expr) -> int:
        if meaning not in self._of:
            if len(self._meanings) == len(self._symbols):
                raise RingFull
            self._of[meaning] = len(self._meanings)
            self._meanings.append(meaning)
        return self._of[meaning]

    def read(self, expression: sp.Expr) -> Coefficient:
        """The polynomial that stands for ``expression``."""
        if expression not in self._read:
            self._read[expression] = self._reading(sp.sympify(expression))
        return self._read[expression]

    def _reading(self, expression: sp.Expr) -> Coefficient:
        if expression.is_Rational:
            return self.number(expression)
        if expression.has(sp.Float, sp.nan, sp.zoo, sp.oo, sp.I):
            raise AveragingUndecided(f"{expression} is not an exact real number")
        if expression.is_Add:
            return sum(map(self.read, expression.args), self.zero)
        if expression.is_Mul:
            result = self.one
            for factor in expression.args:
                result = self.reduced(result * self.read(factor))
            return result
        if expression.is_Pow and expression.exp.is_Rational:
            return self._power(expression.base, expression.exp)
        if isinstance(expression, sp.sin | sp.cos):
            argument = expression.args[0]
            known = sp.sin(argument) in self._of
            sine, cosine = self._generator(sp.sin(argument)), self._generator(sp.cos(argument))
            if not known:
                self._relate(sine, 2, self._symbols[sine] ** 2 + self._symbols[cosine] ** 2 - 1)
            return self._symbols[sine if isinstance(expression, sp.sin) else cosine]
        return self._symbols[self._generator(expression)]

    def _power(self, base: sp.Expr, exponent: sp.Rational) -> Coefficient:
        if exponent.q == 1:
            value = self.read(base)
        else:
            root = base ** sp.Rational(1, exponent.q)
            known = root in self._of
            generator = self._generator(root)
            value = self._symbols[generator]
            if not known:
                self._relate(generator, exponent.q, value**exponent.q - self.read(base))
        if exponent.p < 0:
            value = self.inverse(value)
        return self.reduced(value ** abs(int(exponent.p)))

    def inverse(self, value: Coefficient) -> Coefficient:
        """1/value, by one generator for each irreducible factor."""
        if value == 0:
            raise AveragingUndecided("a denominator vanishes identically")
        content, factors = value.factor()
        result = self._context.constant(1 / fmpq(content))
        for factor, power in factors:
            meaning = 1 / self._terms(factor)
            known = meaning in self._of
            generator = self._generator(meaning)
            if not known:
                self._relate(generator, 1, self._symbols[generator] * factor - 1)
                self._split_fractions(generator, factor)
                self._inverted[generator] = factor
            result *= self._symbols[generator] ** power
        return result

    def _split_fractions(self, generator: int, factor: Coefficient) -> None:
        """Partial fractions: 1/(p q) = a/p + b/q where p and q are polynomials in the same generator alone."""
        own = self._variables(factor)
        if len(own) != 1:
            return
        variable = sp.Dummy()
        for other, second in self._inverted.items():
            if self._variables(second) == own:
                p, q = (self._univariate(entry, own[0], variable) for entry in (factor, second))
                b, a, _ = sp.gcdex(p, q)  # b p + a q = 1
                fractions = self._of_univariate(a, own[0]) * self._symbols[generator]
                fractions += self._of_univariate(b, own[0]) * self._symbols[other]
                self._relate(generator, 1, self._symbols[generator] * self._symbols[other] - fractions)

    def _univariate(self, value: Coefficient, generator: int, variable: sp.Symbol) -> sp.Poly:
        place = len(self._symbols) - 1 - generator
        terms = {(int(exponents[place]),): sp.Rational(int(c.p), int(c.q)) for exponents, c in value.terms()}
        return sp.Poly(terms, variable, domain=sp.QQ)

    def _of_univariate(self, polynomial: sp.Poly, generator: int) -> Coefficient:
        terms = (self.number(c) * self._symbols[generator] ** int(power) for (power,), c in polynomial.terms())
        return sum(terms, self.zero)

    def _variables(self, value: Coefficient) -> tuple[int, ...]:
        """The generators in a polynomial."""
        return tuple(i for i, degree in enumerate(self._degrees(value)) if degree > 0)

    def _degrees(self, value: Coefficient) -> tuple[int, ...]:
        """The degree in each generator, in the order in which these were met."""
        return tuple(value.degrees()[::-1])

    def _relate(self, generator: int, degree: int, relation: Coefficient) -> None:
        self._relations.append((generator, degree, relation))

    def reduced(self, value: Coefficient) -> Coefficient:
        """The same modulo the relations, in which no leading term of a relation divides a term."""
        if not self._relations or value == 0:
            return value
        degrees = self._degrees(value)
        for generator, degree, relation in self._relations:
            if degrees[generator] >= degree:
                value = divmod(value, relation)[1]
                if value == 0:
                    return value
                degrees = self._degrees(value)
        return value

    def derivative(self, value: Coefficient, symbol: sp.Symbol) -> Coefficient:
        """∂value/∂symbol."""
        total = self.zero
        for generator, degree in enumerate(self._degrees(value)):
            if degree > 0 and (inner := self._inner(generator, symbol)) != 0:
                total += value.derivative(len(self._symbols) - 1 - generator) * inner
        return self.reduced(total)

    def _inner(self, generator: int, symbol: sp.Symbol) -> Coefficient:
        """The derivative of a generator."""
        key = generator, symbol
        if key not in self._derivatives:
            meaning = self._meanings[generator]
            if symbol not in meaning.free_symbols:
                found = self.zero
            elif generator in self._inverted:
                found = -(self._symbols[generator] ** 2) * self.derivative(self._inverted[generator], symbol)
            else:
                found = self.read(sp.diff(meaning, symbol))
            self._derivatives[key] = found
        return self._derivatives[key]

    def expression(self, value: Coefficient) -> sp.Expr:
        """The polynomial as a SymPy expression: term by term, quotients with one denominator."""
        if value == 0:
            return sp.S.Zero
        degrees = self._degrees(value)
        # Quotients of parameters are brought together; others stay as they were given.
        inverses = [i for i in self._inverted if degrees[i] > 0 and self._is_constant(self._inverted[i])]
        together = {*inverses, *(v for i in inverses for v in self._variables(self._inverted[i]))}
        groups: dict[tuple[int, ...], Coefficient] = {}
        for exponents, number in value.terms():
            powers = [int(power) for power in exponents[::-1]]
            apart = tuple(0 if i in together else power for i, power in enumerate(powers))
            part = self._context.constant(number)
            for i in together - {*inverses}:
                part *= self._symbols[i] ** powers[i]
            for i in inverses:
                part *= self._inverted[i] ** (degrees[i] - powers[i])
            groups[apart] = groups.get(apart, self.zero) + part
        below = {i: degrees[i] for i in inverses}
        return sp.Add(*(self._monomial(apart) * self._quotient(part, below) for apart, part in groups.items()))

    def _is_constant(self, value: Coefficient) -> bool:
        """Whether it is a polynomial in positive symbols, which states are not."""
        return all(self._meanings[i].is_Symbol and self._meanings[i].is_positive for i in self._variables(value))

    def _monomial(self, exponents: Sequence[int]) -> sp.Expr:
        return sp.Mul(*(self._meanings[i] ** power for i, power in enumerate(exponents) if power))

    def _quotient(self, above: Coefficient, below: Mapping[int, int]) -> sp.Expr:
        """``above`` over the product of the inverted polynomials with these powers, without common factors."""
        if above == 0:
            return sp.S.Zero
        bottom: list[sp.Expr] = []
        for i, power in below.items():
            factor, left = self._inverted[i], power
            while left and (halves := divmod(above, factor))[1] == 0:
                above, left = halves[0], left - 1
            bottom.append(self._meanings[i] ** left)
        if len(above) == 1:
            return sp.Mul(self._terms(above), *bottom)
        content, factors = above.factor()
        top = (self._terms(factor) ** int(power) for factor, power in factors)
        return sp.Mul(sp.Rational(int(content.p), int(content.q)), *top, *bottom)

    def _terms(self, value: Coefficient) -> sp.Expr:
        return sp.Add(
            *(
                sp.Rational(int(number.p), int(number.q)) * self._monomial([int(power) for power in exponents[::-1]])
                for exponents, number in value.terms()
            )
        )
