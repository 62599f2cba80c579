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
from ptproof.reading.latex.formulas import find_formulas
from ptproof.reading.latex.kept import FILE, written_kept
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
    source = read_paper(paper)
    read = read_with_guesses(source)
    if not read.said:
        raise InputError(f"{paper}: no formula is displayed in it; name the LaTeX source of the paper")
    items, functions = items_of(read)
    printed = written_kept((item.formula for item in items if item.kind != "gap"), find_formulas(source).macros)
    files = {**texts(read, items, functions, Path(paper).name), FILE: printed}
    return Draft(files, items, absent_inputs(paper))
