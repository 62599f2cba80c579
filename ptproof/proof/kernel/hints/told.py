"""What is known on the way to a goal, with the lines for Coq that led there, and which of it may matter."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.names import Names, as_identifier, fresh
from ptproof.proof.kernel.terms import SIGNS, term
from ptproof.proof.statement import Relation


@dataclass
class Told:
    """Lines for Coq, and what is known after them. ``names`` are those of the claim and of what the lines introduce."""

    names: dict[Any, str]
    known: list[Relation]
    lines: list[str]

    def inside(self) -> Told:
        """The same for a goal inside this one."""
        return Told(dict(self.names), list(self.known), [])

    def new(self, name: str) -> str:
        """A name that nothing else has."""
        found = fresh(name, self.names)
        self.names[found] = found
        return found

    def spoken(self, relation: Relation) -> Relation:
        """The relation, once letters that are bound in it have names: putting in values makes new ones."""
        letters = sp.Tuple(relation.left, relation.right).atoms(sp.Symbol) - relation.free_symbols
        for letter in sorted(letters - set(self.names), key=str):
            self.names[letter] = fresh(as_identifier(letter.name), self.names)
        return relation


def relevant(wanted: Relation, known: Iterable[Relation]) -> list[Relation]:
    """What is known that speaks of the same values of functions, or of nothing but the same symbols."""
    known = list(dict.fromkeys(known))
    calls, symbols = _calls_in(wanted), wanted.free_symbols
    for _ in range(2):
        found = [
            item for item in known if _calls_in(item) & calls or (not _calls_in(item) and item.free_symbols <= symbols)
        ]
        calls = calls.union(*map(_calls_in, found))
        symbols = symbols.union(*(item.free_symbols for item in found))
    return found


def _calls_in(relation: Relation) -> set[sp.Basic]:
    return relation.left.atoms(AppliedUndef, sp.Derivative) | relation.right.atoms(AppliedUndef, sp.Derivative)


def sides_of(relation: Relation) -> tuple[sp.Basic, sp.Basic]:
    """The left and the right side."""
    return relation.left, relation.right


def alike(one: sp.Basic, other: sp.Basic) -> bool:
    """Whether both are the same but for how exponents, and sums and products, are written."""
    return bool(one == other or sp.expand(_plain(one) - _plain(other)) == 0)


@lru_cache(maxsize=4096)
def _plain(expression: sp.Basic) -> sp.Basic:
    """The expression with exponents, and arguments of functions, in one form."""
    if not expression.args or isinstance(expression, sp.Derivative | sp.Subs | sp.Integral):
        return expression
    if isinstance(expression, sp.Pow) and not expression.exp.is_number:
        return _plain(expression.base) ** sp.factor(sp.together(expression.exp))
    if isinstance(expression, sp.exp | AppliedUndef):
        return expression.func(*(sp.factor(sp.together(item)) for item in expression.args))
    return expression.func(*map(_plain, expression.args))


def in_other_words(wanted: Relation, known: Iterable[Relation]) -> Relation | None:
    """What is known that says the same, turned as what is wanted is."""
    upright = wanted.standard()
    for item in map(Relation.standard, known):
        if item.sign == upright.sign and all(map(alike, sides_of(item), sides_of(upright))):
            return Relation(item.right, wanted.sign, item.left) if wanted != upright else item
    return None


def text_of(relation: Relation, names: Names) -> str:
    """The relation for Coq."""
    return f"{term(relation.left, names)} {SIGNS[relation.sign]} {term(relation.right, names)}"
