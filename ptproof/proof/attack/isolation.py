"""An atom isolated in a difference that is linear in it as it is written, or as multiplied out."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import sympy as sp

from ptproof.proof.attack.tree import Node, tree


@dataclass(frozen=True)
class Isolated:
    """``atom`` sign ``-rest/factor``, if the factor is positive; the other way round, if it is negative."""

    atom: Any
    factor: sp.Expr
    rest: sp.Expr

    @cached_property
    def bound(self) -> sp.Expr:
        if self.factor is sp.S.NegativeOne:
            return self.rest
        return -self.rest if self.factor is sp.S.One else -self.rest / self.factor

    @cached_property
    def letter(self) -> Node:
        """The atom, taken apart, as the next ones are."""
        return tree(self.atom)

    @cached_property
    def end(self) -> Node:
        return tree(self.bound)

    @cached_property
    def divisor(self) -> Node:
        return tree(self.factor)

    @cached_property
    def plain(self) -> bool:
        """Whether the factor is a number."""
        return bool(self.factor.is_number)


def isolated(difference: sp.Expr, atom: Any) -> Isolated | None:
    """The difference as factor·atom + rest, where it is written so."""
    letter, with_it, rest = tree(atom), [], []
    for term in sp.Add.make_args(difference):
        if letter not in tree(term).letters:
            rest.append(term)
            continue
        factors = list(sp.Mul.make_args(term))
        if factors.count(atom) != 1:
            return None
        factors.remove(atom)
        other = sp.Mul(*factors)
        if letter in tree(other).letters:
            return None
        with_it.append(other)
    factor = sp.Add(*with_it)
    return None if factor == 0 else Isolated(atom, factor, sp.Add(*rest))


@lru_cache(maxsize=4096)
def isolated_in(expression: sp.Expr, atoms: tuple[Any, ...]) -> tuple[Isolated | None, ...]:
    """Each of the atoms isolated, also where that takes a product to be multiplied out."""
    found = [isolated(expression, atom) for atom in atoms]
    hopeful = (one is None and _may_become_linear(expression, atom) for one, atom in zip(found, atoms, strict=True))
    if any(hopeful) and expression.count_ops() < 80:
        expanded = sp.expand_mul(expression)
        found = [one or isolated(expanded, atom) for one, atom in zip(found, atoms, strict=True)]
    return tuple(found)


def _may_become_linear(expression: sp.Expr, atom: Any) -> bool:
    """Whether the atom stands in sums and products only: multiplying out does not get it out of anything else."""
    if expression == atom or tree(atom) not in tree(expression).letters:
        return True
    return isinstance(expression, sp.Add | sp.Mul) and all(_may_become_linear(part, atom) for part in expression.args)
