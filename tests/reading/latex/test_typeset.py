"""A formula as LaTeX that needs nothing of the paper, its rows, and what stands side by side in it."""

import pytest

from ptproof.reading.latex.formulas import find_formulas
from ptproof.reading.latex.tokens import definitions
from ptproof.reading.latex.typeset import pieces, rows, typeset

MACROS = definitions(r"\newcommand{\norm}[1]{\left\lVert#1\right\rVert} \newcommand{\R}{\mathbb{R}} \def\loop{\loop x}")


@pytest.mark.parametrize(
    ("written", "text"),
    [
        (r"\norm{x}^2 \le 1.", r"\left\lVert x\right\rVert^2 \le 1"),
        (r"\norm{\norm x} = 1 \label{eq:one}", r"\left\lVert\left\lVert x\right\rVert\right\rVert = 1"),
        (r"x~\in\R y", r"x \in\mathbb{R} y"),
        (r"\begin{aligned}[t] x &= 1, \\ y &= 2 \end{aligned} \nonumber", r"x &= 1, \\ y &= 2"),
        (r"\hspace*{-0.5cm} {\rm e}^{x} > 0,", r"\mathrm{e}^{x} > 0"),
        (r"\begin{bmatrix} 1 \\ 2 \end{bmatrix}", r"\begin{bmatrix} 1 \\ 2 \end{bmatrix}"),
    ],
)
def test_macros_are_put_in_and_numbers_left_out(written, text):
    assert typeset(written, MACROS) == text


def test_a_macro_that_stands_for_itself_comes_to_an_end():
    assert len(typeset(r"\loop", MACROS)) < 1000


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x = 1", (("x = 1", False),)),
        (r"x &= 1 \\ &+ 2", (("x  = 1", False), ("+ 2", True))),
        (r"x = 1 + \\ & y", (("x = 1 +", False), ("y", True))),
        (r"x = 1 \\ y = 2", (("x = 1", False), ("y = 2", False))),
        (r"\begin{bmatrix} 1 & 0 \\ 2 & 0 \end{bmatrix}", ((r"\begin{bmatrix} 1 & 0 \\ 2 & 0 \end{bmatrix}", False),)),
    ],
)
def test_rows(text, found):
    assert rows(text) == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (r"a = 1, \quad b = f(x, y)", ("a = 1", "b = f(x, y)")),
        (r"a \le b, \quad \forall c \ge 1", (r"a \le b, \quad \forall c \ge 1",)),
        (r"a = 1 \\ b = 2", ("a = 1", "b = 2")),
        (r"a = f\left(x \right. \\ & + y , \left. z \right), b",
         (r"a = f\left(x \right. \\ & + y , \left. z \right)", "b")),
        (r"[f_1, f_2] = x_{1,2}", (r"[f_1, f_2] = x_{1,2}",)),
    ],
)  # fmt: skip
def test_what_stands_side_by_side(text, found):
    assert pieces(text) == found


def test_a_row_that_goes_on_stays_a_row():
    paper = r"\begin{document}\begin{align} x &= 1 \nonumber \\ &+ 2 \\ y &= 3 \end{align}\end{document}"
    texts = [typeset(item.text, {}) for item in find_formulas(paper).displayed]
    assert [[row for row, _ in rows(text)] for text in texts] == [["x  = 1", "+ 2"], ["y  = 3"]]
