"""The steps of a proof before its engine: which claim was put to use at which values; noted while somebody listens.

Nothing rests on them. They are hints for who proves the same claim again by other means.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any, TypeAlias


@dataclass(frozen=True)
class Anywhere:
    """An assumption of a used claim, shown at an arbitrary ``point`` by the ``steps``; no point: it is assumed."""

    point: tuple[Any, ...] = ()
    steps: tuple[Step, ...] = ()


@dataclass(frozen=True)
class Put:
    """A claim that is used, by its content, with values for its letters; and its quantified assumptions."""

    content: str
    values: tuple[tuple[Any, Any], ...] = ()
    assumed: tuple[Anywhere, ...] = ()


@dataclass(frozen=True)
class At:
    """The goal's own quantified assumptions at a point: an expression for each variable."""

    point: tuple[Any, ...]


@dataclass(frozen=True)
class Lemma:
    """An implication of the library."""

    says: Any


@dataclass(frozen=True)
class Chosen:
    """Values that are shown to exist: an expression for each letter."""

    values: tuple[tuple[Any, Any], ...]


Step: TypeAlias = Put | At | Lemma | Chosen
_noted: ContextVar[list[Any] | None] = ContextVar("noted", default=None)


@contextmanager
def noting() -> Iterator[list[Any]]:
    """What is noted meanwhile."""
    found: list[Any] = []
    token = _noted.set(found)
    try:
        yield found
    finally:
        _noted.reset(token)


def note(step: Step | Anywhere) -> None:
    """Note a step, if somebody listens."""
    if (found := _noted.get()) is not None:
        found.append(step)


def put(content: str, values: Mapping[Any, Any], assumed: list[Any]) -> None:
    """Note that a claim is put to use."""
    note(Put(content, tuple(values.items()), tuple(assumed)))
