"""The formulas of a paper that are kept beside its derivation, as it prints them, and what ought to be printed instead.

``printed.toml`` has formulas and nothing else of the paper. It is never taken on trust: each is read again and held
against the claims that cover it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ptproof.errors import InputError
from ptproof.proof.load import Derivation
from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.notation import says_of
from ptproof.reading.latex.typeset import typeset
from ptproof.reading.tables import build_from, read_file
from ptproof.report.printed import compare_all, compare_correction
from ptproof.report.read import ReadSide, side_of, sides
from ptproof.report.stated import Printed, printed

FILE = "printed.toml"
_UNLABELLED = re.compile(r"(?:Front|Appendix|Section [\d.]+)(?:, text)? \(\d+\)")
_HEAD = """\
# The formulas of the paper as it prints them, by label or place: `ptproof coverage PAPER.tex --keep` writes [printed].
# [corrected] has what ought to be printed instead, by the claim that says so. All of it is read again for each report.
"""


@dataclass(frozen=True)
class Kept:
    """What the file has.

    Attributes
    ----------
    printed
        The LaTeX of a formula by its place.
    labels
        The labels of those formulas that have others than their place says.
    corrected
        LaTeX by the claim that corrects what is printed.
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


def kept(derivation: Derivation) -> Kept | None:
    """What is kept beside the derivation, or None.

    Raises
    ------
    InputError
        If the file is wrong, or names a correction that there is not.
    """
    for file in _files(derivation):
        if file.is_file():
            found = read_kept(read_file(file, "formulas of a paper"), str(file))
            corrections = {claim.id for claim in derivation.claims if claim.corrects is not None}
            if unknown := [id for id in found.corrected if id not in corrections]:
                raise InputError(f"{file}: [corrected] names {', '.join(unknown)}, which corrects nothing")
            return found
    return None


def read_kept(text: str, where: str) -> Kept:
    """What the text of such a file says."""

    def build(data: dict[str, dict[str, object]]) -> Kept:
        for table, kind in (("printed", str), ("labels", list), ("corrected", str)):
            for key, value in data.get(table, {}).items():
                if not isinstance(value, kind):
                    raise InputError(f"{table}.{key}: expected {'LaTeX' if kind is str else 'a list of labels'}")
        return Kept(**data)  # type: ignore[arg-type]

    return build_from(text, where, Kept, build)


def keep(derivation: Derivation, formulas: Formulas, source: Printed) -> Path:
    """Write the formulas of a paper that something covers beside the derivation; what it has as corrected stays.

    Raises
    ------
    InputError
        If the derivation is no folder, or cannot be written to.
    """
    files = list(_files(derivation))
    if not files:
        raise InputError("--keep needs a derivation that is a folder of its own")
    old = kept(derivation) or Kept()
    try:
        files[0].write_text(written_kept(formulas, source, old.corrected), encoding="utf-8")
    except OSError as error:
        raise InputError(f"{files[0]}: cannot be written ({error.strerror or error})") from None
    return files[0]


def written_kept(formulas: Formulas, source: Printed, corrected: Mapping[str, str]) -> str:
    """The text of the file."""
    said = [item for item in (*formulas.displayed, *formulas.running) if source.covering(item) and not item.broken]
    labels = {item.place: item.labels for item in said if item.labels != _own_labels(item.place)}
    lines = [_HEAD.rstrip(), "[printed]"]
    lines += [f"{_quoted(item.place)} = {_quoted(typeset(item.text, formulas.macros))}" for item in said]
    lines += ["", "[labels]", *(f"{_quoted(place)} = {json.dumps(found)}" for place, found in labels.items())]
    lines += ["", "[corrected]", *(f"{_quoted(id)} = {_quoted(text)}" for id, text in corrected.items())]
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False) if "'" in text else f"'{text}'"


def kept_sides(derivation: Derivation, found: Kept | None = None) -> dict[str, ReadSide]:
    """What becomes of each formula that is kept, by the claims and definitions that cover it, and of the corrections.

    Raises
    ------
    InputError
        If the file or the table of notation is wrong.
    """
    found = found or kept(derivation)
    if found is None:
        return {}
    source = printed(derivation)
    read = sides(compare_all(found.formulas, source), (), derivation)
    return {**read, **corrected_sides(derivation, found, source)}


def corrected_sides(derivation: Derivation, found: Kept, source: Printed) -> dict[str, ReadSide]:
    """What becomes of each formula that ought to be printed."""
    result: dict[str, ReadSide] = {}
    for claim in derivation.claims:
        if claim.id not in found.corrected or claim.corrects is None:
            continue
        places = (*claim.corrects.labels, *says_of(source.table, claim.corrects.id).at, claim.corrects.place)
        formula = replace(found.formula(next(filter(None, places), ""), found.corrected[claim.id]), labels=())
        result[claim.id] = side_of(claim.id, [compare_correction(claim, formula, source)])
    return result


def _files(derivation: Derivation) -> Iterable[Path]:
    """Where the formulas of the derivation may be kept."""
    for package in derivation.packages:
        if file := getattr(package, "__file__", None):
            yield Path(str(file)).parent / FILE
