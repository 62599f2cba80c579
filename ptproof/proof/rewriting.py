"""Rewriting of expressions part by part, each part once: what is claimed and assumed has most parts in common."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import sympy as sp

_KEPT = 2**15


def everywhere(kinds: type[Any] | tuple[type[Any], ...], change: Callable[[Any], Any]) -> Callable[[sp.Expr], sp.Expr]:
    """As SymPy's ``replace`` of every node of these kinds by ``change`` of it; what came of a part is remembered.

    >>> squared = everywhere(sp.sin, lambda node: node**2)
    >>> x = sp.Symbol("x")
    >>> squared(1 + sp.sin(x))
    sin(x)**2 + 1
    """

    @lru_cache(maxsize=_KEPT)
    def rewritten(node: sp.Basic) -> sp.Basic:
        if isinstance(node, kinds):
            return node.replace(lambda part: isinstance(part, kinds), change)
        return _rebuilt(node, rewritten)

    return rewritten


@lru_cache(maxsize=_KEPT)
def carried_out(node: sp.Basic) -> sp.Basic:
    """As SymPy's ``doit(integrals=False)``: derivatives are taken and values put in; each part's is remembered."""
    if not node.args:
        return node
    if isinstance(node, sp.Add | sp.Mul):
        return node.func(*map(carried_out, node.args))
    if type(node).doit is sp.Basic.doit:
        return node.func(*(carried_out(part) if isinstance(part, sp.Basic) else part for part in node.args))
    return node.doit(integrals=False)


def _rebuilt(node: sp.Basic, change: Callable[[sp.Basic], sp.Basic]) -> sp.Basic:
    parts = tuple(map(change, node.args))
    return node if parts == node.args else node.func(*parts)
