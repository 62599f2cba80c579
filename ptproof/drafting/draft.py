"""From a paper's LaTeX to the files of a derivation."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ptproof.drafting.items import Item, items_of
from ptproof.drafting.modules import texts
from ptproof.drafting.paper import read_with_guesses
from ptproof.errors import InputError
from ptproof.reading.latex.source import absent_inputs, read_paper


@dataclass(frozen=True)
class Draft:
    """The files of a derivation that was written from a paper, what each formula became, and inputs that are absent."""

    files: Mapping[str, str]
    items: tuple[Item, ...]
    absent: tuple[str, ...] = ()

    @property
    def counts(self) -> dict[str, int]:
        """How many definitions, claims and gaps there are."""
        found = Counter(item.kind for item in self.items)
        return {kind: found[kind] for kind in ("definition", "claim", "gap")}

    @property
    def gaps(self) -> tuple[Item, ...]:
        """What was not read, and why."""
        return tuple(item for item in self.items if item.kind == "gap")


def draft(paper: str | Path) -> Draft:
    """The derivation that the LaTeX file ``paper`` gives, as text; nothing is written and nothing of it is run.

    Raises
    ------
    InputError
        If the file cannot be read, or displays no formula.
    """
    read = read_with_guesses(read_paper(paper))
    if not read.said:
        raise InputError(f"{paper}: no formula is displayed in it; name the LaTeX source of the paper")
    items, functions = items_of(read)
    return Draft(texts(read, items, functions, Path(paper).name), items, absent_inputs(paper))
