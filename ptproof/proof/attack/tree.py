"""Expressions taken apart once: what is evaluated at many points is found again by identity, not by comparing trees."""

from __future__ import annotations

import atexit
from collections.abc import Callable
from functools import cached_property
from typing import Any
from weakref import WeakValueDictionary

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.elementary import asked
from ptproof.proof.attack.numbers import Exact

_MANY = 50_000  # nodes that are kept
BINDERS = (sp.Derivative, sp.Integral, sp.Limit, sp.Sum, sp.Product, sp.Subs)


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
    def letters(self) -> frozenset[Node]:
        """The symbols and applied undefined functions in it, bound ones too: what its value may depend on."""
        inside = frozenset().union(*(part.letters for part in self.parts))
        return inside | {self} if _is_letter(self.expression) else inside

    @cached_property
    def free(self) -> tuple[Node, ...]:
        """The free symbols, in an order of their own."""
        return tuple(map(tree, sorted(self.expression.free_symbols, key=str)))

    @cached_property
    def rational(self) -> Exact:
        """The value of a rational number."""
        return Exact(int(self.expression.p), int(self.expression.q))

    @cached_property
    def whole(self) -> int | None:
        """The value of an integer that is a power as one multiplies it out."""
        expression = self.expression
        return int(expression) if expression.is_Integer and abs(expression.p) < 10**6 else None

    @cached_property
    def function(self) -> object:
        """A key for the undefined function that is applied: SymPy hashes these anew each time."""
        return _functions.setdefault(self.expression.func, object())

    @cached_property
    def asked(self) -> tuple[bool | None, frozenset[int] | None]:
        """What the declaration of an undefined function asks of its values."""
        return asked(self.expression)

    @cached_property
    def levels(self) -> tuple[tuple[Node, int | None, bool], ...]:
        """Of a derivative: each variable, how often it is taken, and whether it is an applied function that moves."""
        counts = self.expression.variable_count
        alone = len(counts) == 1 and not self.expression.args[0].has(*BINDERS)
        return tuple(
            (tree(variable), int(count) if count.is_Integer else None, alone and isinstance(variable, AppliedUndef))
            for variable, count in counts
        )


_nodes: dict[Any, Node] = {}
_letters: WeakValueDictionary[Any, Node] = WeakValueDictionary()  # a scope knows its letters by their nodes
_functions: dict[Any, object] = {}
atexit.register(_letters.clear)  # later SymPy could not compare any more what a dying node is looked up by


def tree(expression: Any) -> Node:
    """The node of an expression."""
    found = _nodes.get(expression)
    if found is None:
        if len(_nodes) > _MANY:
            _nodes.clear()
        found = _letters.get(expression) if _is_letter(expression) else None
        if found is None:
            found = Node(expression)
            if _is_letter(expression):
                _letters[expression] = found
        _nodes[expression] = found
    return found


def _is_letter(expression: Any) -> bool:
    return bool(expression.is_Symbol) or isinstance(expression, AppliedUndef)
