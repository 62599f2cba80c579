"""Whether values are of the declared kind, and whether relations hold at a point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

import sympy as sp

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.scope import Scope
from ptproof.proof.attack.tree import Node, tree
from ptproof.proof.statement import Relation

HOLDS: Mapping[str, Callable[[int], bool]] = {
    "=": lambda sign: sign == 0,
    "!=": lambda sign: sign != 0,
    "<=": lambda sign: sign <= 0,
    "<": lambda sign: sign < 0,
    ">=": lambda sign: sign >= 0,
    ">": lambda sign: sign > 0,
}
_TESTS: Mapping[str, Callable[[Any], bool]] = {
    "positive": lambda value: value > 0,
    "negative": lambda value: value < 0,
    "nonnegative": lambda value: value >= 0,
    "nonpositive": lambda value: value <= 0,
    "zero": lambda value: value == 0,
    "nonzero": lambda value: value != 0,
    "integer": lambda value: value.denominator == 1,
    "noninteger": lambda value: value.denominator != 1,
    "even": lambda value: value.denominator == 1 and value.numerator % 2 == 0,
    "odd": lambda value: value.denominator == 1 and value.numerator % 2 == 1,
    "prime": lambda value: value.denominator == 1 and bool(sp.isprime(int(value.numerator))),
    "composite": lambda value: value.denominator == 1 and value > 1 and not sp.isprime(int(value.numerator)),
}
_SIGNS = ("positive", "negative", "nonnegative", "nonpositive", "zero", "nonzero")
_EVERY_RATIONAL = {
    "rational": True, "irrational": False, "algebraic": True, "transcendental": False, "real": True, "imaginary": False,
}  # fmt: skip


@lru_cache(maxsize=4096)
def _tests(atom: Any) -> tuple[frozenset[int], tuple[tuple[Callable[[Any], bool], bool], ...]]:
    """What the declaration of an atom asks of a value: its sign, and what else every rational does not have."""
    known = {word: truth for word, truth in atom.assumptions0.items() if word in _TESTS or word in _EVERY_RATIONAL}
    if any(_EVERY_RATIONAL[word] is not known[word] for word in known if word in _EVERY_RATIONAL):
        return frozenset(), ()
    signs = {n for n in (-1, 0, 1) if all(_TESTS[w](Fraction(n)) is known[w] for w in known if w in _SIGNS)}
    rest = ((_TESTS[w], known[w]) for w in known if w not in _SIGNS and w not in _EVERY_RATIONAL)
    return frozenset(signs), tuple(rest)


def fits_kind(atom: Any, value: Any) -> bool:
    """Whether an exact value is of the kind that a symbol or an applied function was declared with."""
    signs, tests = _tests(atom)
    top = value.numerator
    return (top > 0) - (top < 0) in signs and all(test(value) is truth for test, truth in tests)


class Sides(NamedTuple):
    """A scalar relation as the evaluator takes it."""

    left: Node
    right: Node
    test: Callable[[int], bool]

    @classmethod
    def of(cls, relation: Relation) -> Sides:
        return cls(tree(relation.left), tree(relation.right), HOLDS[relation.sign])

    def hold(self, evaluator: Evaluator, scope: Scope) -> bool:
        """Whether the relation holds there; raises where that cannot be told."""
        numbers = evaluator.calculus.numbers
        left, right = evaluator.plain(self.left, scope), evaluator.plain(self.right, scope)
        return self.test(numbers.sign(numbers.sub(left, right)))


def holds(relation: Relation, evaluator: Evaluator) -> bool:
    """Whether a scalar relation holds at the evaluator's point; raises where that cannot be told."""
    return Sides.of(relation).hold(evaluator, evaluator.point)
