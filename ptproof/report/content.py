"""Figures and tables that a derivation brings along for the report."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from ptproof.errors import InputError


@dataclass(frozen=True)
class Figure:
    """A picture with its caption.

    Attributes
    ----------
    name
        Names the file: letters, digits, dots, hyphens and underscores.
    caption
        What is seen, how it was made, and what it says.
    content
        The bytes of an SVG or PNG file.

    Raises
    ------
    InputError
        For another name, or bytes that are neither.
    """

    name: str
    caption: str
    content: bytes

    def __post_init__(self) -> None:
        if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", self.name):
            raise InputError(f"a figure is named by letters, digits, dots, hyphens and underscores, got {self.name!r}")
        if not self.content.startswith(b"\x89PNG") and b"<svg" not in self.content[:2000]:
            raise InputError(f"the figure {self.name} is neither SVG nor PNG")

    @property
    def title(self) -> str:
        """What is seen, in words: the caption to its first semicolon or full stop, or to the clause with a formula."""
        seen = re.split(r"; |\. |\.$", self.caption, maxsplit=1)[0]
        words, formula, _ = seen.partition("$")
        return (words.rpartition(",")[0] or words).strip() if formula else seen

    @property
    def kind(self) -> str:
        return "png" if self.content.startswith(b"\x89PNG") else "svg"

    @property
    def file(self) -> str:
        return self.name if self.name.endswith(f".{self.kind}") else f"{self.name}.{self.kind}"


@dataclass(frozen=True)
class Table:
    """A table of figures measured or computed elsewhere, for the appendix.

    Raises
    ------
    InputError
        If a row does not have as many cells as the head.
    """

    title: str
    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.head):
                raise InputError(f"table {self.title!r}: a row has {len(row)} cells, the head {len(self.head)}")


def brought(modules: Iterable[ModuleType], kind: str) -> Iterator[Any]:
    """The ``figures`` or ``tables`` that modules bring, drawn and computed as they are asked for.

    They are what the functions of these names give in a module ``figures`` beside the claims, where there is one.
    """
    for module in modules:
        for item in getattr(module, kind, tuple)():
            if not isinstance(item, Figure | Table):
                raise InputError(f"{kind}() gives figures and tables of ptproof.report.content, got {item!r}")
            yield item
