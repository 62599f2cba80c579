"""The formulas of a paper that are kept beside its derivation, as it prints them, and what ought to be printed instead.

``printed.toml`` has formulas and nothing else of the paper. It is never taken on trust: each is read again and held
against the claims that cover it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ptproof.errors import InputError
from ptproof.proof.load import Derivation, load
from ptproof.reading.latex.formulas import Formulas
from ptproof.reading.latex.kept import FILE, Kept, read_kept, written_kept
from ptproof.reading.latex.notation import says_of
from ptproof.reading.tables import read_file
from ptproof.report.printed import compare_all, compare_correction
from ptproof.report.read import ReadSide, side_of, sides
from ptproof.report.stated import Printed, printed


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


def keeps(derivation: Derivation) -> bool:
    """Whether any formula is kept beside the derivation."""
    return any(file.is_file() for file in _files(derivation))


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
    covered = [item for item in (*formulas.displayed, *formulas.running) if source.covering(item)]
    try:
        files[0].write_text(written_kept(covered, formulas.macros, old.corrected), encoding="utf-8")
    except OSError as error:
        raise InputError(f"{files[0]}: cannot be written ({error.strerror or error})") from None
    return files[0]


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


def kept_json(derivations: Sequence[Sequence[str]]) -> list[dict[str, Any]]:
    """The same of the derivations below each of these paths, as plain data."""
    found = (kept_sides(load(paths)) for paths in derivations)
    return [{id: side.to_json() for id, side in sides.items()} for sides in found]


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
