"""Figures and tables that a derivation brings along: drawn when they are asked for, none where there are none.

A derivation may have a module ``figures`` beside its claims, with functions ``figures()`` and ``tables()``. They
return objects with the attributes of :class:`~ptproof.report.content.Figure` and
:class:`~ptproof.report.content.Table`, so the module need not import this package.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from typing import Any

from ptproof.proof.claim import Claim
from ptproof.report.content import Figure, Table
from ptproof.report.letters import packages_of


def figures_of(claims: Iterable[Claim]) -> tuple[Figure, ...]:
    """The figures of the derivations that the claims come from; this is where simulations run."""
    found = [item for function in _functions(claims, "figures") for item in function()]
    return tuple(Figure(item.name, item.caption, item.content) for item in found)


def tables_of(claims: Iterable[Claim]) -> tuple[Table, ...]:
    """The tables of the appendix."""
    found = [item for function in _functions(claims, "tables") for item in function()]
    return tuple(
        Table(item.title, item.caption, tuple(item.head), tuple(tuple(map(str, row)) for row in item.rows))
        for item in found
    )


def has_figures(claims: Iterable[Claim]) -> bool:
    """Whether there is anything to draw."""
    claims = tuple(claims)
    return bool(_functions(claims, "figures") or _functions(claims, "tables"))


def _functions(claims: Iterable[Claim], name: str) -> list[Callable[[], Iterable[Any]]]:
    modules = (sys.modules.get(f"{package.__name__}.figures") for package in packages_of(claims))
    return [function for module in modules if callable(function := getattr(module, name, None))]
