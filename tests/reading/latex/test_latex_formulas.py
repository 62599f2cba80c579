"""Where formulas stand: displays of every kind, rows that go on, places, lines, and LaTeX that is broken."""

import pytest

from ptproof.reading.latex.formulas import find_formulas

ONE = {
    "equation": r"\begin{equation} a = b \end{equation}",
    "starred": r"\begin{equation*} a = b \end{equation*}",
    "brackets": r"\[ a = b \]",
    "dollars": "$$ a = b $$",
    "aligned inside": r"\begin{equation}\begin{aligned} a &= b \\ &+ c \end{aligned}\end{equation}",
    "cases inside": r"\begin{equation} a = \begin{cases} 1 & x > 0 \\ 2 & x < 0 \end{cases}\end{equation}",
    "multline": r"\begin{multline} a = b \\ + c \end{multline}",
    "matrix in align": r"\begin{align} a &= \begin{bmatrix} 1 \\ 2 \end{bmatrix} \end{align}",
    "array in align": r"\begin{align} a &= \left[\begin{array}{c} 1 \\ 2 \end{array}\right] \end{align}",
    "a row that goes on": r"\begin{align} a &= b \\ &\quad + c \end{align}",
    "a chain over rows": r"\begin{align} a &\le b \\ &\le c \end{align}",
    "no number": r"\begin{eqnarray} a &=& b \nonumber \\ && \times c \end{eqnarray}",
    "an operator at the end": r"\begin{align} a &= b + \\ & c \end{align}",
    "alignat": r"\begin{alignat}{2} a &= b \end{alignat}",
    "abbreviation": r"\newcommand{\be}{\begin{equation}}\newcommand{\ee}{\end{equation}} \be a = b \ee",
    "in a theorem": r"\begin{theorem}\begin{equation} a = b \end{equation}\end{theorem}",
    "beside a picture": r"\begin{tikzpicture}\node {$$ c $$};\end{tikzpicture} \[ a = b \]",
    "not what is commented out": "% \\[ c = d \\]\n\\[ a = b \\]",
}
SEVERAL = {
    "align": (r"\begin{align} a &= b \\ c &= d \end{align}", 2),
    "gather": (r"\begin{gather} a = b \\ c = d \end{gather}", 2),
    "eqnarray": (r"\begin{eqnarray} a &=& b \\ c &=& d \end{eqnarray}", 2),
    "a row that begins with a sign and is whole": (r"\begin{align} a &= b \\ -c &= d \end{align}", 2),
    "behind the document": (r"\begin{document}\[a = b\]\end{document}\[c = d\]", 1),
    "none": ("", 0),
}


@pytest.mark.parametrize("name", ONE)
def test_one_formula(name):
    assert len(find_formulas(ONE[name]).displayed) == 1


@pytest.mark.parametrize("name", SEVERAL)
def test_several_formulas(name):
    source, count = SEVERAL[name]
    assert len(find_formulas(source).displayed) == count


def test_places_are_labels_or_sections_and_numbers():
    source = (
        r"\section{A}\[x = 1\]\begin{equation} x = 2 \label{eq:two}\end{equation}"
        r"\section{B}\subsection{C}\[x = 3\]\section*{Appendix}\[x = 4\]"
    )
    places = [formula.place for formula in find_formulas(source).displayed]
    assert places == ["Section 1 (1)", "eq:two", "Section 2.1 (1)", "Appendix (1)"]


def test_a_group_gives_its_label_to_its_rows():
    source = r"\begin{subequations}\label{g}\begin{align} a &= b \\ c &= d \label{own}\end{align}\end{subequations}"
    assert [(f.place, f.labels) for f in find_formulas(source).displayed] == [("g (1)", ("g",)), ("own", ("own", "g"))]


def test_lines_are_those_of_the_source():
    source = (
        "% a comment\n\\begin{verbatim}\n\\[ no \\]\n\\end{verbatim}\n\\iffalse\nx\n\\fi\n"
        "\\begin{align}\n a &= b \\\\\n c &= d\n\\end{align}"
    )
    assert [formula.line for formula in find_formulas(source).displayed] == [9, 10]


@pytest.mark.parametrize(
    ("text", "count"),
    [("$a = b$ and $a < b$", 2), ("$x$ and $f(x)$", 0), (r"\(a \le b\)", 1), (r"costs 5\$ and $a \ge 0$", 1)],
)
def test_relations_in_running_text(text, count):
    assert len(find_formulas(text).running) == count


@pytest.mark.parametrize(
    "cut",
    [r"\begin{equation} a = ", r"\[ a = b", "$$ a = b", r"\begin{align} a &= b \\ c &="],
)
def test_a_formula_that_is_cut_is_named_and_the_next_one_found(cut):
    found = find_formulas(cut + "\n\n\\section{B}\n\\begin{equation} c = d \\label{eq:good}\\end{equation}").displayed
    assert found[-1].place == "eq:good"
    assert found[-2].broken == "its end is missing"
    assert not found[-1].broken
