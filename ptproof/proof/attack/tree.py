"""Expressions taken apart once: what is evaluated at many points is found again by identity, not by comparing trees."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from ptproof.proof.attack.numbers import Exact

_MANY = 50_000  # nodes that are kept


class Node:
    """One node of an expression; there is one for all expressions that are equal, as long as it is kept.

    Attributes
    ----------
    expression
        What it stands for.
    handler
        What evaluates it, once that is known.
    """

    def __init__(self, expression: Any) -> None:
        self.expression = expression
        self.handler: Callable[[Any, Node, Any], Any] | None = None

    @cached_property
    def parts(self) -> tuple[Node, ...]:
        """The arguments."""
        return tuple(map(tree, self.expression.args))

    @cached_property
    def rational(self) -> Exact:
        """The value of a rational number."""
        return Exact(int(self.expression.p), int(self.expression.q))

    @cached_property
    def function(self) -> object:
        """A key for the undefined function that is applied: SymPy hashes these anew each time."""
        return _functions.setdefault(self.expression.func, object())


_nodes: dict[Any, Node] = {}
_functions: dict[Any, object] = {}


def tree(expression: Any) -> Node:
    """The node of an expression."""
    found = _nodes.get(expression)
    if found is None:
        if len(_nodes) > _MANY:
            _nodes.clear()
        found = _nodes[expression] = Node(expression)
    return found
