"""Whether values are of the declared kind, and whether relations hold at a point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.scope import Scope
from ptproof.proof.statement import Relation

HOLDS: Mapping[str, Callable[[int], bool]] = {
    "=": lambda sign: sign == 0,
    "!=": lambda sign: sign != 0,
    "<=": lambda sign: sign <= 0,
    "<": lambda sign: sign < 0,
    ">=": lambda sign: sign >= 0,
    ">": lambda sign: sign > 0,
}
_TESTS: Mapping[str, Callable[[Fraction], bool]] = {
    "positive": lambda value: value > 0,
    "negative": lambda value: value < 0,
    "nonnegative": lambda value: value >= 0,
    "nonpositive": lambda value: value <= 0,
    "zero": lambda value: value == 0,
    "nonzero": lambda value: value != 0,
    "integer": lambda value: value.denominator == 1,
    "noninteger": lambda value: value.denominator != 1,
    "rational": lambda value: True,
    "irrational": lambda value: False,
    "algebraic": lambda value: True,
    "transcendental": lambda value: False,
    "even": lambda value: value.denominator == 1 and value.numerator % 2 == 0,
    "odd": lambda value: value.denominator == 1 and value.numerator % 2 == 1,
    "prime": lambda value: value.denominator == 1 and bool(sp.isprime(value.numerator)),
    "composite": lambda value: value.denominator == 1 and value > 1 and not sp.isprime(value.numerator),
    "real": lambda value: True,
    "imaginary": lambda value: False,
}


@lru_cache(maxsize=4096)
def _tests(atom: Any) -> tuple[tuple[Callable[[Fraction], bool], bool], ...]:
    """What the declaration of an atom asks of a value."""
    return tuple((_TESTS[word], truth) for word, truth in atom.assumptions0.items() if word in _TESTS)


def fits_kind(atom: Any, value: Fraction) -> bool:
    """Whether an exact value is of the kind that a symbol or an applied function was declared with."""
    return all(test(value) is truth for test, truth in _tests(atom))


def holds(relation: Relation, evaluator: Evaluator, scope: Scope | None = None) -> bool:
    """Whether a scalar relation holds at the evaluator's point; raises where that cannot be told."""
    scope = evaluator.point if scope is None else scope
    numbers = evaluator.calculus.numbers
    left, right = evaluator.number(relation.left, scope), evaluator.number(relation.right, scope)
    return HOLDS[relation.sign](numbers.sign(numbers.sub(left, right)))
