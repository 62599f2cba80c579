"""The letters of a paper as its derivation declares them: each symbol once, with what a reader is told of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy as sp


@dataclass(frozen=True)
class Entry:
    """One letter of a paper: its symbol, its glyph as LaTeX, its unit and what it stands for."""

    symbol: sp.Symbol
    glyph: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Alphabet:
    """The letters that have been declared, in their order; a ``notation`` module has them as its ``NOTATION``.

    >>> alphabet = Alphabet()
    >>> omega = alphabet.letter("omega", r"\\omega", "1/s", "dither frequency", positive=True)
    >>> omega.is_positive, [entry.unit for entry in alphabet.entries]
    (True, ['1/s'])
    """

    entries: list[Entry] = field(default_factory=list)

    def letter(self, name: str, glyph: str, unit: str, meaning: str, **known: bool) -> sp.Symbol:
        """Declare a symbol, real where nothing else is ``known`` of it, and record it."""
        symbol = sp.Symbol(name, **(known or {"real": True}))
        self.entries.append(Entry(symbol, glyph, unit, meaning))
        return symbol

    @property
    def glyphs(self) -> dict[sp.Symbol, str]:
        """How the printer writes the letters."""
        return {entry.symbol: entry.glyph for entry in self.entries}
