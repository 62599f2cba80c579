"""Values of single expressions by the attacker's evaluator, for promises that are not written as a goal."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy as sp

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.functions import Concrete
from ptproof.proof.attack.numbers import Ball, NotReal, Number, Undefined, Unsure, context
from ptproof.proof.attack.scope import Inadmissible, Scope
from ptproof.proof.attack.series import Calculus

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
        self._evaluator = Evaluator(digits, functions or {})
        self._evaluator.point = Scope(dict(values))
        self.calculus: Calculus = self._evaluator.calculus

    def value(self, expression: sp.Expr) -> Number:
        """The value of the expression here."""
        return self._evaluator.number(sp.sympify(expression), self._evaluator.point)

    def sign(self, expression: sp.Expr) -> int:
        """The sign of the expression here."""
        return self.calculus.numbers.sign(self.value(expression))

    def exceeds(self, value: Number, limit: float | Fraction) -> bool:
        """Whether a value is certainly larger than an exact limit."""
        numbers = self.calculus.numbers
        try:
            return numbers.sign(numbers.sub(value, Fraction(limit))) > 0
        except Unsure:
            return False


def as_float(value: Number) -> float:
    """A value for people and for searches, not for decisions."""
    return float(value.middle) if isinstance(value, Ball) else float(value)


def text(value: Number, digits: int = 20) -> str:
    """The value for people."""
    if isinstance(value, Ball):
        return str(context(digits + 10).nstr(value.middle, digits))
    return str(value) if len(str(value)) <= 40 else f"{float(value):.17g}"
