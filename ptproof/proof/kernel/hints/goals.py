"""A goal that hints are looked for: a relation, what is known, and the names that Coq has for its symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache

import sympy as sp

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation


@dataclass(frozen=True)
class Goal:
    """What is to be shown from what. The relations are hints: Coq has its own words for them."""

    relation: Relation
    known: tuple[Relation, ...]
    names: Names

    def text(self, expression: sp.Basic) -> str:
        """The expression as one argument of a tactic."""
        return term(expression, self.names)

    def relations(self) -> tuple[Relation, ...]:
        """The goal's relation and those that are known."""
        return (self.relation, *self.known)

    def atoms(self, *kinds: type) -> list[sp.Basic]:
        """The parts of these kinds of all relations, the outermost and simplest first, in a fixed order."""
        sides = (side for item in self.relations() for side in (item.left, item.right))
        found = {part for side in sides for part in side.atoms(*kinds)}
        return sorted(found, key=lambda part: (-sp.count_ops(part), sp.default_sort_key(part)))

    def map(self, change: Callable[[sp.Basic], sp.Basic], names: Names | None = None) -> Goal:
        """The same goal with every side changed; without what says nothing any more."""
        known = dict.fromkeys(item.map(change) for item in self.known)
        kept = tuple(item for item in known if not (item.left == item.right and item.sign == "="))
        return Goal(self.relation.map(change), kept, self.names if names is None else names)

    def replaced(self, old: sp.Basic, new: sp.Basic, names: Names | None = None) -> Goal:
        """The same goal with ``new`` for ``old``."""
        return self.map(lambda side: side.xreplace({old: new}), names)

    def with_known(self, *facts: Relation) -> Goal:
        """The same goal with more known."""
        return Goal(self.relation, tuple(dict.fromkeys((*self.known, *facts))), self.names)


Way = Callable[[Goal], Iterator[str]]


def one_of(hints: Iterable[str]) -> str:
    """The first of the tactics that proves the goal, or nothing is done."""
    tried = [f"solve [ {hint} ]" for hint in dict.fromkeys(hints)]
    return f"first [ {' | '.join([*tried, 'quickly; inequality'])} ]"


@lru_cache(maxsize=4096)
def as_factors(expression: sp.Basic) -> sp.Expr:
    """The quotient of products that it is: the ways to close a goal come back to the same expressions many times."""
    return sp.factor(expression)


def is_shown(expression: sp.Expr, strictly: bool = False) -> bool:
    """Whether the sign of the expression is plain from how it is written: then Coq's ``sign`` sees it, too."""
    return bool(expression.is_positive if strictly else expression.is_nonnegative)


def upright(product: sp.Expr) -> sp.Expr:
    """The same product, its minus taken into a factor without a plain sign."""
    constant, factors = product.as_coeff_mul()
    turned = next((part for part in factors if part.is_Add and not is_shown(part)), None)
    if constant >= 0 or turned is None:
        return product
    return sp.Mul(-constant, *(sp.expand(-part) if part is turned else part for part in factors))
