"""The formulas that are kept beside each derivation: all are what is claimed, and one change in any of them is noticed.

Each run reads a part of them; ``PTPROOF_EVERY_FORM=1`` has all of them read.
"""

from __future__ import annotations

import os
import re
import zlib
from collections.abc import Iterator
from functools import lru_cache

import pytest

from ptproof.proof.load import Derivation, load
from ptproof.proof.shipped import shipped
from ptproof.reading.latex.formulas import Formulas
from ptproof.reading.latex.kept import Kept
from ptproof.report.kept import corrected_sides, kept
from ptproof.report.printed import compare
from ptproof.report.stated import Printed, printed

PAPERS = ["pt_seeker", "newton_seeker"]
EVERY = 1 if os.environ.get("PTPROOF_EVERY_FORM") else 8
# Each makes another formula of most formulas; the first that a formula has is made.
CHANGES = [
    (r"(?<![\^{(=\s])\s\+\s", " - "), (r"\s-\s", " + "), (r"\\leq?(?![a-z])", r"\\ge"), (r"\\geq?(?![a-z])", r"\\le"),
    (r"\\cos", r"\\sin"), (r"\\sin", r"\\cos"), (r"=(.*\S)", r"= 2(\1)"), (r"=", "= 2"), (">", "<"), ("<", ">"),
]  # fmt: skip


@lru_cache
def opened(name: str) -> tuple[Derivation, Kept, Printed]:
    derivation = load([shipped() / name])
    found = kept(derivation)
    assert found is not None
    return derivation, found, printed(derivation)


def read(name: str, place: str, text: str) -> str:
    """What becomes of one formula."""
    _, found, source = opened(name)
    return compare(found.formula(place, text), Formulas((), ()), source).read


def corrected(name: str, id: str, text: str) -> str:
    derivation, found, source = opened(name)
    return corrected_sides(derivation, Kept(found.printed, found.labels, {id: text}), source)[id].read


def twins(text: str) -> Iterator[str]:
    for before, after in CHANGES:
        changed = re.sub(before, after, text, count=1)
        if changed != text:
            yield changed


def chosen(name: str) -> list[tuple[str, str]]:
    return [item for item in opened(name)[1].printed.items() if zlib.crc32(item[0].encode()) % EVERY == 0]


@pytest.mark.parametrize("name", PAPERS)
def test_what_is_kept_is_what_is_claimed_and_one_change_is_noticed(name: str) -> None:
    forms = chosen(name)
    assert len(forms) > 5
    found = {place: read(name, place, text) for place, text in forms}
    assert [place for place, word in found.items() if word == "different"] == []
    equal = [(place, text) for place, text in forms if found[place] == "equal"]
    assert len(equal) > 0.8 * len(forms)
    assert [place for place, text in equal if read(name, place, next(twins(text))) == "equal"] == []


@pytest.mark.parametrize("name", PAPERS)
def test_each_correction_is_what_its_claim_says_and_one_change_is_noticed(name: str) -> None:
    forms = opened(name)[1].corrected
    assert len(forms) > 5
    assert [id for id, text in forms.items() if corrected(name, id, text) != "equal"] == []
    assert [id for id, text in forms.items() if corrected(name, id, next(twins(text))) == "equal"] == []
