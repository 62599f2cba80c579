"""The labels of equations, on the ways in which LaTeX is written."""

import pytest

from ptproof.errors import InputError
from ptproof.reading.latex.source import read_paper
from ptproof.report.labels import all_labels, equation_labels

EQUATION = r"\begin{equation} x \label{eq:a} \end{equation}"

CASES = {
    "plain": (EQUATION, ["eq:a"]),
    "starred": (r"\begin{equation*} x \tag{1} \label{a} \end{equation*}", ["a"]),
    "any name": (r"\begin{equation} x \label{critical-V_0} \end{equation}", ["critical-V_0"]),
    "lines of align": (r"\begin{align} x \label{a} \\ y \label{b} \end{align}", ["a", "b"]),
    "line break with a length": (r"\begin{align} x \\[2pt] y \label{b} \end{align}", ["b"]),
    "multline": (r"\begin{multline} x \\ y \label{a} \end{multline}", ["a"]),
    "gather": (r"\begin{gather*} x \label{a} \end{gather*}", ["a"]),
    "eqnarray": (r"\begin{eqnarray} x &=& y \label{a} \end{eqnarray}", ["a"]),
    "alignat": (r"\begin{alignat}{2} x &=& y \label{a} \end{alignat}", ["a"]),
    "subequations, group and line": (
        r"\begin{subequations}\label{g}\begin{align} x \label{a} \\ y \label{b} \end{align}\end{subequations}",
        ["g", "a", "b"],
    ),
    "subequations, label at its end": (
        r"\begin{subequations}\begin{align} x \end{align}\label{g}\end{subequations}",
        ["g"],
    ),
    "nested aligned": (
        r"\begin{equation}\begin{aligned} x \label{a} \\ y \end{aligned} \label{b}\end{equation}",
        ["a", "b"],
    ),
    "matrix inside": (r"\begin{align} \begin{bmatrix} 1 \\ 2 \end{bmatrix} \label{a} \end{align}", ["a"]),
    "in a theorem": (r"\begin{theorem}\label{thm:a} " + EQUATION + r" \label{late}\end{theorem}", ["eq:a"]),
    "theorem in subequations": (
        r"\begin{subequations}\label{g}\begin{theorem}\label{thm}\end{theorem}\end{subequations}",
        ["g"],
    ),
    "figure": (r"\begin{figure}\caption{c}\label{fig:a}\end{figure}", []),
    "section": (r"\section{S}\label{sec:a}" + EQUATION, ["eq:a"]),
    "list item": (r"\begin{enumerate}[label=\roman*.]\item x \label{it:a}\end{enumerate}", []),
    "comment": ("% \\begin{equation} \\label{no} \\end{equation}\n" + EQUATION, ["eq:a"]),
    "comment behind a label": ("\\begin{equation} x % \\label{no}\n \\label{a} \\end{equation}", ["a"]),
    "percent sign": (r"\begin{equation} 5\% \label{a} \end{equation}", ["a"]),
    "line break, then a comment": ("\\begin{align} x \\\\% \\label{no}\n y \\label{a} \\end{align}", ["a"]),
    "verbatim": (r"\begin{verbatim}\begin{equation}\label{no}\end{equation}\end{verbatim}" + EQUATION, ["eq:a"]),
    "verb": (r"\verb|\begin{equation}\label{no}|" + EQUATION, ["eq:a"]),
    "iffalse": (r"\iffalse \begin{equation}\label{no}\end{equation} \fi" + EQUATION, ["eq:a"]),
    "iffalse with else": (r"\iffalse \begin{align}\label{no}\end{align} \else " + EQUATION + r"\fi", ["eq:a"]),
    "abbreviations": (
        r"\newcommand{\be}{\begin{equation}}\newcommand\ee{\end{equation}} \be x \label{a} \ee \label{no}",
        ["a"],
    ),
    "def with an argument": (r"\def\lab#1{\label{#1}}" + EQUATION, ["eq:a"]),
    "own environment": (
        r"\newenvironment{eqn}{\begin{equation}}{\end{equation}} \begin{eqn} x \label{a} \end{eqn} \label{no}",
        ["a"],
    ),
    "display with brackets": (r"\[ x \tag{1} \label{a} \] \label{no}", ["a"]),
    "twice": (EQUATION + EQUATION, ["eq:a"]),
    "behind the document": (r"\begin{document}" + EQUATION + r"\end{document}\begin{align}\label{no}", ["eq:a"]),
    "an end too many": (r"\end{equation}" + EQUATION, ["eq:a"]),
    "a label with a type": (r"\begin{equation} x \label[eq]{a} \end{equation}", ["a"]),
    "nothing": ("", []),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_labels(name):
    source, labels = CASES[name]
    assert list(equation_labels(source)) == labels


def test_all_labels_are_those_of_everything():
    assert all_labels(r"\section{S}\label{sec:a}" + EQUATION + r"\label{sec:a}") == ("sec:a", "eq:a")


def test_windows_line_ends():
    assert equation_labels("% \\label{no}\r\n\\begin{align}\r\n\\label{a}\r\n\\end{align}\r\n") == ("a",)


def test_inputs_are_followed(tmp_path):
    (tmp_path / "main.tex").write_text(r"\input{part} \input{glyphtounicode}" + EQUATION)
    (tmp_path / "part.tex").write_text(r"\begin{align} y \label{first} \end{align}")
    assert equation_labels(read_paper(tmp_path / "main.tex")) == ("first", "eq:a")


@pytest.mark.parametrize(
    ("content", "word"),
    [(None, "no such file"), (b"\x89PNG\r\n\x1a\n\0\0", "not a text file"), (rb"\include{gone}", "gone"),
     (rb"\input{paper}", "inputs itself")],
)  # fmt: skip
def test_bad_papers(tmp_path, content, word):
    path = tmp_path / "paper.tex"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=word):
        read_paper(path)


def test_a_folder_is_no_paper(tmp_path):
    with pytest.raises(InputError, match="folder"):
        read_paper(tmp_path)
