"""The notation of a derivation: the letters that its ``notation`` module lists, and their glyphs."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any
from xml.etree.ElementTree import Element

from ptproof.errors import InputError
from ptproof.proof.load import Derivation
from ptproof.report.formula import element, latex


@dataclass(frozen=True)
class Letter:
    """One letter: its glyph as LaTeX, its unit and what it stands for."""

    glyph: str
    unit: str
    meaning: str

    @property
    def key(self) -> str:
        """How the glyph is spelled where it stands in a formula; empty for one that is not set."""
        return spelled(self.glyph)


@dataclass(frozen=True)
class Notation:
    """The letters of a derivation in their order, the glyph of each symbol, and the letter of each that has one."""

    letters: tuple[Letter, ...] = ()
    glyphs: Mapping[Any, str] = ()  # type: ignore[assignment]
    by_symbol: Mapping[Any, Letter] = ()  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for name in ("glyphs", "by_symbol"):
            object.__setattr__(self, name, dict(getattr(self, name)))


@lru_cache(maxsize=4096)
def spelled(glyph: str) -> str:
    """A formula in one spelling, by which the pages look letters up: ``msub(a,1)``; empty where it is not set."""
    found = element(glyph)
    return "" if found is None else _spelled(found)


def _spelled(node: Element) -> str:
    if not len(node):
        return (node.text or "").strip()
    inside = [_spelled(child) for child in node]
    return "".join(inside) if node.tag in ("math", "mrow", "mstyle", "mpadded") else f"{node.tag}({','.join(inside)})"


def notation_of(derivation: Derivation) -> Notation:
    """What the ``notation`` modules of the derivation list.

    Such a module may have ``NOTATION``, a sequence of entries with ``symbol``, ``glyph``, ``unit`` and ``meaning``,
    and ``GLYPHS``, a mapping from symbol to LaTeX; each may be left out.
    """
    letters: dict[Letter, None] = {}
    glyphs: dict[Any, str] = {}
    by_symbol: dict[Any, Letter] = {}
    for package in derivation.packages:
        module = sys.modules.get(f"{package.__name__}.notation")
        entries = list(getattr(module, "NOTATION", ()))
        for entry in entries:
            if missing := [name for name in ("symbol", "glyph", "unit", "meaning") if not hasattr(entry, name)]:
                raise InputError(
                    f"{getattr(module, '__file__', '')}: {entry!r} in NOTATION has no {', no '.join(missing)}"
                )
        for entry in entries:
            glyphs.setdefault(entry.symbol, str(entry.glyph))
        for symbol, glyph in dict(getattr(module, "GLYPHS", {})).items():
            glyphs.setdefault(symbol, str(glyph))
        for entry in entries:
            glyph = str(entry.glyph) or latex(entry.symbol, glyphs)
            letter = Letter(glyph, str(entry.unit), str(entry.meaning))
            letters.setdefault(letter)
            by_symbol.setdefault(entry.symbol, letter)
    return Notation(tuple(letters), glyphs, by_symbol)


def title_of(derivation: Derivation) -> str:
    """The first line of the documentation of the derivation's packages."""
    titles = [(package.__doc__ or "").strip().split("\n")[0].rstrip(".") for package in derivation.packages]
    return "; ".join(title for title in titles if title)
