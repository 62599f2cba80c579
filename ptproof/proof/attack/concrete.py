"""A concrete function that stands for an undefined one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.tree import Name, Node, named, tree


@dataclass(frozen=True)
class Concrete:
    """A smooth function as an expression in ``arguments``; other symbols in it are those of the point."""

    arguments: tuple[sp.Symbol, ...]
    body: sp.Expr

    @cached_property
    def places(self) -> tuple[Node, ...]:
        """The arguments, taken apart."""
        return tuple(map(tree, self.arguments))

    @cached_property
    def given(self) -> frozenset[Node]:
        """The arguments as a set."""
        return frozenset(self.places)

    @cached_property
    def core(self) -> Node:
        """The body, taken apart."""
        return tree(self.body)

    @cached_property
    def inside(self) -> frozenset[Any]:
        """The undefined functions in it."""
        return frozenset(node.func for node in self.body.atoms(AppliedUndef))

    @cached_property
    def through(self) -> frozenset[Name]:
        """The names of these."""
        return frozenset(map(named, self.inside))
