"""What a claim says, as one text that is the same in every process: claims are told apart by it, not by their ids."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import declared


def digest(*values: Any) -> str:
    """The SHA-256 of statements, assumptions, expressions, texts and flags, in this order.

    Letters count with what they are declared to be; of a symbol without a name of its own (``Dummy``) only where it
    stands counts.

    >>> x, d, e = sp.Symbol("x", real=True), sp.Dummy(real=True), sp.Dummy(real=True)
    >>> digest(x + d) == digest(x + e), digest(x) == digest(sp.Symbol("x", positive=True)), digest(x) == digest(x + 1)
    (True, False, False)
    """
    return hashlib.sha256("".join(_pieces(values, {})).encode()).hexdigest()


def _pieces(value: Any, unnamed: dict[sp.Dummy, int]) -> Iterator[str]:
    match value:
        case sp.Dummy():
            yield f"?{unnamed.setdefault(value, len(unnamed))}{_kind(value)}"
        case sp.Basic() if (known := _named(value)) is not None:
            yield known
        case sp.MatrixBase():
            yield f"Matrix{value.shape}"
            yield from _listed(tuple(value), unnamed)
        case sp.Basic() if value.args:
            yield _head(value)
            yield from _listed(value.args, unnamed)
        case sp.Basic():
            yield sp.srepr(value)
        case tuple() | list():
            yield from _listed(value, unnamed)
        case _ if is_dataclass(value):
            yield type(value).__name__
            yield from _listed([getattr(value, entry.name) for entry in fields(value) if entry.compare], unnamed)
        case _:
            yield repr(value)


def _listed(values: Any, unnamed: dict[sp.Dummy, int]) -> Iterator[str]:
    yield "("
    for value in values:
        yield from _pieces(value, unnamed)
        yield ","
    yield ")"


@lru_cache(maxsize=2**16)
def _named(node: sp.Basic) -> str | None:
    """The text or hash of an expression all of whose letters have names, of which the statements share many parts.

    None with a letter that has none, and for a matrix, which is told by its entries.
    """
    if isinstance(node, sp.Dummy | sp.MatrixBase):
        return None
    if isinstance(node, sp.Symbol):
        return f"{node.name!r}{_kind(node)}"
    if not node.args:
        return str(sp.srepr(node))
    parts = [_named(entry) if isinstance(entry, sp.Basic) else None for entry in node.args]
    if None in parts:
        return None
    return hashlib.sha256(f"{_head(node)}({','.join(map(str, parts))})".encode()).hexdigest()


def _head(node: sp.Basic) -> str:
    """What a node is, without its arguments."""
    if isinstance(node, AppliedUndef):
        return f"{node.func.__name__!r}{_kind(node)}"
    return f"{type(node).__module__}.{type(node).__qualname__}"


def _kind(letter: Any) -> str:
    return str(sorted(declared(letter).items()))
