"""The papers' own sources against the derivations, where somebody has them; of the second a few formulas as printed."""

import os
from functools import lru_cache
from pathlib import Path

import pytest

from ptproof.proof.load import load
from ptproof.proof.shipped import shipped
from ptproof.reading.latex.formulas import find_formulas
from ptproof.reading.latex.source import read_paper
from ptproof.report.printed import compare_all
from ptproof.report.stated import printed

PAPERS = {"pt_seeker": "PTPROOF_PAPER", "newton_seeker": "PTPROOF_NEWTON_PAPER"}
PRINTED = {
    "eq:J_0_def": r"J_0 = \begin{bmatrix} 0 & \omega_0 \\ -\omega_0 & 0 \end{bmatrix}",
    "eq:sub_r": r"\dot{r} = -h r + H \bar{z}^\top (J_0 + \tilde{\Lambda} e^{\hat{d}}) \bar{z}",
    "eq:sub_d": r"\dot{\hat{d}} = -\omega_d (e^{\hat{d}} - 1)",
    "eq:ev_zbar_newton": r"\lambda_{1,2}(J_{\text{n}}) = -\frac{\alpha}{2} \pm \frac{1}{2}"
    r" \sqrt{\left(\frac{\alpha}{2}\right)^2 - (2\omega_0)^2}",
    "eq:b_const": r"b = \frac{\left\lVert G \right\rVert^2}{2 \lambda_{\text{min}}(P)} > 0",
    "eq-d-to-dtilde": r"\tilde{d} = \ln(d), \qquad d > 0",
    "Section 1 (7)": r"\left|J_0\right| \le 1",
}
CHANGED = {
    "eq:J_0_def": [(r"0 & \omega_0", r"0 & \omega_d"), (r"-\omega_0", r"\omega_0")],
    "eq:sub_r": [("-h", "h"), (r"H \bar", r"H^2 \bar"), (r"\hat{d}", r"\tilde{d}"), ("=", r"\le")],
    "eq:sub_d": [("- 1", "- 2"), (r"\omega_d", r"\omega_0")],
    "eq:ev_zbar_newton": [
        (r"\pm", "-"),
        (r"(2\omega", r"(3\omega"),
        (r"\frac{1}{2}", r"\frac{1}{4}"),
        (")^2 -", ")^3 -"),
    ],
    "eq:b_const": [("> 0", "< 0"), ("^2", "")],
    "eq-d-to-dtilde": [("d > 0", "d < 0"), (r"\ln", r"\exp")],
}


def source(**changed):
    rows = {**PRINTED, **changed}.items()
    shown = (rf"\begin{{equation}} {text} \label{{{name}}} \end{{equation}}" for name, text in rows if "(" not in name)
    unlabelled = (rf"\begin{{equation}} {text} \end{{equation}}" for name, text in rows if "(" in name)
    return "\n".join([r"\begin{document} \section{One}", *shown, *unlabelled, r"\end{document}"])


@lru_cache
def derivation():
    found = load([shipped() / "newton_seeker"])
    return found, printed(found)


def read(text):
    return {item.formula.place: item for item in compare_all(find_formulas(text), derivation()[1])}


def test_printed_formulas_are_equal_and_what_nothing_covers_is_not_read():
    found = read(source())
    assert {place: item.read for place, item in found.items()} == {
        **dict.fromkeys(PRINTED, "equal"), "Section 1 (7)": "not read",
    }  # fmt: skip


@pytest.mark.parametrize(("place", "before", "after"), [(p, *pair) for p, pairs in CHANGED.items() for pair in pairs])
def test_one_change_is_noticed(place, before, after):
    changed = PRINTED[place].replace(before, after, 1)
    assert changed != PRINTED[place]
    assert read(source(**{place: changed}))[place].read != "equal"


@pytest.mark.parametrize("name", PAPERS)
def test_at_least_four_fifths_are_read_and_equal_and_none_is_different(name):
    paper = os.environ.get(PAPERS[name], "")
    if not paper:
        pytest.skip(f"the LaTeX source of the paper is not here: {PAPERS[name]}=FILE.tex names it")
    compared = compare_all(find_formulas(read_paper(Path(paper))), printed(load([shipped() / name])))
    assert [item.formula.place for item in compared if item.read == "different"] == []
    assert sum(item.read == "equal" for item in compared) >= 4 / 5 * len(compared)
