"""What a claim says, as one text that is the same in every process: claims are told apart by it, not by their ids."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
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
        case sp.Symbol():
            yield f"{value.name!r}{_kind(value)}"
        case sp.MatrixBase():
            yield f"Matrix{value.shape}"
            yield from _listed(tuple(value), unnamed)
        case AppliedUndef():
            yield f"{value.func.__name__!r}{_kind(value)}"
            yield from _listed(value.args, unnamed)
        case sp.Basic() if value.args:
            yield f"{type(value).__module__}.{type(value).__qualname__}"
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


def _kind(letter: Any) -> str:
    return str(sorted(declared(letter).items()))
