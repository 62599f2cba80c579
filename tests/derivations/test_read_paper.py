"""The paper's own source against the derivation, where somebody has the paper: it is no part of this repository."""

import os
from pathlib import Path

import pytest

PAPER = os.environ.get("PTPROOF_PAPER", "")


@pytest.mark.skipif(not PAPER, reason="the LaTeX source of the paper is not here: PTPROOF_PAPER=FILE.tex names it")
def test_at_least_four_fifths_are_read_and_equal_and_none_is_different():
    from ptproof.commands import options
    from ptproof.proof.shipped import shipped
    from ptproof.reading.latex.formulas import find_formulas
    from ptproof.reading.latex.source import read_paper
    from ptproof.report.printed import compare_all
    from ptproof.report.stated import printed

    formulas = find_formulas(read_paper(Path(PAPER)))
    with options.loaded((str(shipped() / "pt_seeker"),)) as derivation:
        compared = compare_all(formulas, printed(derivation))
    assert [item.formula.place for item in compared if item.read == "different"] == []
    assert sum(item.read == "equal" for item in compared) >= 4 / 5 * len(compared)
