"""Whether values are of the declared kind, and whether relations hold at a point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.numbers import Exact
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


def fits_kind(letter: Node, value: Any) -> bool:
    """Whether an exact value is of the kind that a symbol or an applied function was declared with."""
    signs, tests = letter.tests
    top = value.numerator
    return (1 if top > 0 else -1 if top else 0) in signs and all(test(value) is truth for test, truth in tests)


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
        return self.test(numbers.sign(left if type(right) is Exact and not right else numbers.sub(left, right)))


def holds(relation: Relation, evaluator: Evaluator) -> bool:
    """Whether a scalar relation holds at the evaluator's point; raises where that cannot be told."""
    return Sides.of(relation).hold(evaluator, evaluator.point)
