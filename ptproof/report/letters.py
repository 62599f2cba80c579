"""The notation of a derivation: the letters that its ``notation`` module lists, and their glyphs."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from ptproof.proof.claim import Claim
from ptproof.report.formula import latex


@dataclass(frozen=True)
class Letter:
    """One letter: its glyph as LaTeX, its unit and what it stands for."""

    glyph: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Notation:
    """The letters of a derivation in their order, and the glyph of each symbol."""

    letters: tuple[Letter, ...] = ()
    glyphs: Mapping[Any, str] = ()  # type: ignore[assignment]

    def __post_init__(self) -> None:
        object.__setattr__(self, "glyphs", dict(self.glyphs))


def notation_of(claims: Iterable[Claim]) -> Notation:
    """What the ``notation`` modules beside the claims' modules list.

    Such a module may have ``NOTATION``, a sequence of entries with ``symbol``, ``glyph``, ``unit`` and ``meaning``,
    and ``GLYPHS``, a mapping from symbol to LaTeX; each may be left out.
    """
    letters: dict[Letter, None] = {}
    glyphs: dict[Any, str] = {}
    for package in packages_of(claims):
        module = sys.modules.get(f"{package.__name__}.notation")
        entries = list(getattr(module, "NOTATION", ()))
        for entry in entries:
            glyphs.setdefault(entry.symbol, str(entry.glyph))
        for symbol, glyph in dict(getattr(module, "GLYPHS", {})).items():
            glyphs.setdefault(symbol, str(glyph))
        for entry in entries:
            glyph = str(entry.glyph) or latex(entry.symbol, glyphs)
            letters.setdefault(Letter(glyph, str(entry.unit), str(entry.meaning)))
    return Notation(tuple(letters), glyphs)


def title_of(claims: Iterable[Claim]) -> str:
    """The first line of the documentation of the packages that the claims come from."""
    titles = [(package.__doc__ or "").strip().split("\n")[0].rstrip(".") for package in packages_of(claims)]
    return "; ".join(title for title in titles if title)


def packages_of(claims: Iterable[Claim]) -> Iterator[ModuleType]:
    """The packages in which the proofs were written, or the module where it is a single file, each once."""
    seen: set[str] = set()
    for item in claims:
        name = getattr(item.prove, "__module__", None) or ""
        if not name.startswith("ptproof_derivation_"):  # such as the proof that `cited` makes
            continue
        name = name.split(".")[0]
        if name not in seen and name in sys.modules:
            seen.add(name)
            yield sys.modules[name]
