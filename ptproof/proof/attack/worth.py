"""Values of single expressions by the attacker's evaluator, for promises that are not written as a goal."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import mpmath
import sympy as sp

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.magnitudes import as_float as as_float
from ptproof.proof.attack.numbers import Ball, NotReal, Number, Undefined, Unsure, exact, undisturbed
from ptproof.proof.attack.scope import Inadmissible, Scope
from ptproof.proof.attack.series import Calculus
from ptproof.proof.attack.tree import named, tree

NO_VALUE = (NotReal, Undefined)
NOT_KNOWN = (Unsure, Inadmissible, OverflowError, ValueError, RecursionError)


class Place:
    """A place at which expressions have values: exact ones of the symbols, at one precision.

    ``value`` raises one of :data:`NO_VALUE` where the expression has no real value, one of :data:`NOT_KNOWN` where it
    is not known.
    """

    def __init__(
        self, values: Mapping[Any, Number], functions: Mapping[Any, Concrete] | None = None, digits: int = 50
    ) -> None:
        self._evaluator = Evaluator(digits, {named(key): value for key, value in (functions or {}).items()})
        self._evaluator.point = Scope.of(
            {tree(key): value if type(value) is Ball else exact(value) for key, value in values.items()}
        )
        self.calculus: Calculus = self._evaluator.calculus

    def value(self, expression: sp.Expr) -> Number:
        """The value of the expression here."""
        with undisturbed():
            return self._evaluator.number(sp.sympify(expression), self._evaluator.point)

    def sign(self, expression: sp.Expr) -> int:
        """The sign of the expression here."""
        return self.calculus.numbers.sign(self.value(expression))

    def exceeds(self, value: Number, limit: float | Fraction) -> bool:
        """Whether a value is certainly larger than an exact limit."""
        numbers = self.calculus.numbers
        try:
            return numbers.sign(numbers.sub(value, exact(Fraction(limit)))) > 0
        except Unsure:
            return False


def text(value: Number, digits: int = 20) -> str:
    """The value for people."""
    if type(value) is Ball:
        own = mpmath.MPContext()
        own.dps = digits + 10
        mantissa, exponent = value.mid().man_exp()
        return str(own.nstr(own.ldexp(own.mpf(int(mantissa)), int(exponent)), digits))
    return str(value) if len(str(value)) <= 40 else f"{as_float(value):.17g}"
