"""What an evaluation is handed on with: the values of the symbols, and who evaluates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import sympy as sp

from ptproof.proof.attack.numbers import Number
from ptproof.proof.attack.series import Calculus, Series, Value
from ptproof.proof.attack.tree import Node, tree


@dataclass(slots=True)
class Scope:
    """Values of letters, and of what was evaluated with them before.

    Attributes
    ----------
    known
        The value of each node that has one here.
    given
        The letters that are given a value here.
    outer
        The scope around this one: what is free of the letters that are given here is worth the same there.
    """

    known: dict[Node, Value]
    given: frozenset[Node]
    outer: Scope | None = None

    @classmethod
    def of(cls, known: dict[Node, Value]) -> Scope:
        """The scope in which these symbols and applied functions have values, and no others."""
        return cls(known, frozenset(known))

    def joined(self, letter: Node, value: Value) -> Scope:
        """The same values and one more, and nothing evaluated yet: of what has no value before, much may depend."""
        known = {node: self.known[node] for node in self.given}
        known[letter] = value
        return Scope(known, frozenset(known))

    def with_values(self, values: Mapping[Any, Value]) -> Scope:
        """The same with other symbols, or with other values of the same ones."""
        return self.around({tree(letter): value for letter, value in values.items()})

    def around(self, known: dict[Node, Value], given: frozenset[Node] | None = None) -> Scope:
        """The same with values of these letters, which are ``given``, by their nodes."""
        return Scope(known, frozenset(known) if given is None else given, self)

    def value_of(self, letter: Node) -> Value | None:
        """The value that a letter is given here, or around."""
        scope: Scope | None = self
        while scope is not None:
            if letter in scope.given:
                return scope.known[letter]
            scope = scope.outer
        return None

    @property
    def moves(self) -> bool:
        """Whether a derivative is being taken: a letter has a series for a value."""
        scope: Scope | None = self
        while scope is not None:
            if any(type(scope.known[letter]) is Series for letter in scope.given):
                return True
            scope = scope.outer
        return False


class Valuer(Protocol):
    """Whoever gives expressions values."""

    calculus: Calculus
    work: Work

    def number(self, expression: sp.Expr, scope: Scope) -> Number:
        """The value where no derivative is taken."""
        ...

    def plain(self, node: Node, scope: Scope) -> Number:
        """The same of an expression that was taken apart before."""
        ...


@dataclass
class Work:
    """How many nodes have been evaluated: what an attack costs, the same on every machine."""

    steps: int = 0
    limit: int = 10**9

    @property
    def left(self) -> int:
        """How many more may be."""
        return self.limit - self.steps


class Inadmissible(Exception):
    """A concrete function takes a value that the function was not declared to take."""
