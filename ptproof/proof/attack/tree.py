"""Expressions taken apart once: what is evaluated at many points is found again by identity, not by comparing trees."""

from __future__ import annotations

import atexit
from collections.abc import Callable
from functools import cached_property
from typing import Any
from weakref import WeakValueDictionary

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.declared import tests
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
    constant
        Its value, if it is a rational number.
    symbol
        Whether it is a symbol.
    programs
        The steps that evaluate it, by the letters that have other values than around; None stands for all letters.
    """

    def __init__(self, expression: Any) -> None:
        self.expression = expression
        self.constant = Exact(int(expression.p), int(expression.q)) if expression.is_Rational else None
        self.symbol = bool(expression.is_Symbol)
        self.programs: dict[frozenset[Node] | None, Any] = {}

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
    def whole(self) -> int | None:
        """The value of an integer that is a power as one multiplies it out."""
        expression = self.expression
        return int(expression) if expression.is_Integer and abs(expression.p) < 10**6 else None

    @cached_property
    def function(self) -> Name:
        """The undefined function that is applied."""
        return named(self.expression.func)

    @cached_property
    def tests(self) -> tuple[frozenset[int], tuple[tuple[Callable[[Any], bool], bool], ...]]:
        """What the declaration of a letter asks of an exact value."""
        return tests(self.expression)

    @cached_property
    def put(self) -> tuple[Node, tuple[Node, ...], tuple[Node, ...], frozenset[Node]]:
        """Of a substitution: in what, for which letters, by what; and the letters as a set."""
        inner, letters, values = self.expression.args
        nodes = tuple(map(tree, letters))
        return tree(inner), nodes, tuple(map(tree, values)), frozenset(nodes)

    @cached_property
    def asked(self) -> tuple[bool | None, frozenset[int] | None]:
        """What the declaration of an undefined function asks of its values."""
        return asked(self.expression)

    @cached_property
    def moved(self) -> frozenset[Node]:
        """Of a derivative: the letters by which it is taken."""
        return frozenset(variable for variable, _, _ in self.levels)

    @cached_property
    def levels(self) -> tuple[tuple[Node, int | None, bool], ...]:
        """Of a derivative: each variable, how often it is taken, and whether it is an applied function that moves."""
        counts = self.expression.variable_count
        alone = len(counts) == 1 and not self.expression.args[0].has(*BINDERS)
        return tuple(
            (tree(variable), int(count) if count.is_Integer else None, alone and isinstance(variable, AppliedUndef))
            for variable, count in counts
        )


class Name:
    """An undefined function: there is one for all that are equal, since SymPy hashes these anew each time."""

    __slots__ = ("function",)

    def __init__(self, function: Any) -> None:
        self.function = function


_nodes: dict[Any, Node] = {}
_letters: WeakValueDictionary[Any, Node] = WeakValueDictionary()  # a scope knows its letters by their nodes
_functions: dict[Any, Name] = {}
atexit.register(_letters.clear)  # later SymPy could not compare any more what a dying node is looked up by


def named(function: Any) -> Name:
    """The name of an undefined function."""
    found = _functions.get(function)
    if found is None:
        found = _functions[function] = Name(function)
    return found


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
