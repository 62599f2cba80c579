"""The file ``printed.toml`` beside a derivation: the formulas of a paper as it prints them, and nothing else of it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from ptproof.errors import InputError
from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.tokens import Macro
from ptproof.reading.latex.typeset import typeset
from ptproof.reading.tables import build_from

FILE = "printed.toml"
_UNLABELLED = re.compile(r"(?:Front|Appendix|Section [\d.]+)(?:, text)? \(\d+\)")
_HEAD = """\
# The formulas of the paper as it prints them, by label or place: `ptproof coverage PAPER.tex --keep` writes [printed].
# [corrected] has what ought to be printed instead, by the claim that says so. All of it is read again for each report.
"""


@dataclass(frozen=True)
class Kept:
    """What the file has: the LaTeX of printed formulas by their places, and ``labels`` where these are others.

    ``corrected`` has LaTeX by the claim that corrects what is printed.
    """

    printed: dict[str, str] = field(default_factory=dict)
    labels: dict[str, list[str]] = field(default_factory=dict)
    corrected: dict[str, str] = field(default_factory=dict)

    @property
    def formulas(self) -> Formulas:
        """The printed formulas as if they had just been found."""
        return Formulas(tuple(self.formula(place, text) for place, text in self.printed.items()), ())

    def formula(self, place: str, text: str) -> Formula:
        """A formula at a place of the paper."""
        return Formula(place, tuple(self.labels.get(place, _own_labels(place))), 0, text)


def _own_labels(place: str) -> tuple[str, ...]:
    """The labels that the place itself says: ``eq:rates (2)`` is the second formula of the group ``eq:rates``."""
    return () if _UNLABELLED.fullmatch(place) else (re.sub(r" \(\d+\)$", "", place),)


def read_kept(text: str, where: str) -> Kept:
    """What the text of such a file says."""

    def build(data: dict[str, dict[str, object]]) -> Kept:
        for table, kind in (("printed", str), ("labels", list), ("corrected", str)):
            for key, value in data.get(table, {}).items():
                if not isinstance(value, kind):
                    raise InputError(f"{table}.{key}: expected {'LaTeX' if kind is str else 'a list of labels'}")
        return Kept(**data)  # type: ignore[arg-type]

    return build_from(text, where, Kept, build)


def written_kept(
    formulas: Iterable[Formula], macros: Mapping[str, Macro], corrected: Mapping[str, str] | None = None
) -> str:
    """The text of the file."""
    said: dict[str, Formula] = {}
    for item in formulas:  # the first one that is called so
        if not item.broken:
            said.setdefault(item.place, item)
    labels = {place: item.labels for place, item in said.items() if item.labels != _own_labels(place)}
    lines = [_HEAD.rstrip(), "[printed]"]
    lines += [f"{_quoted(item.place)} = {_quoted(typeset(item.text, macros))}" for item in said.values()]
    lines += ["", "[labels]", *(f"{_quoted(place)} = {json.dumps(found)}" for place, found in labels.items())]
    lines += ["", "[corrected]", *(f"{_quoted(id)} = {_quoted(text)}" for id, text in (corrected or {}).items())]
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False) if "'" in text else f"'{text}'"
