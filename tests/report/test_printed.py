"""A small paper against a small derivation: what is equal, what one changed sign makes of it, what is not read."""

import json

import pytest

from ptproof.commands.cli import main
from ptproof.report.sameness import same

PAPER = r"""
\newcommand{\norm}[1]{\left\lVert#1\right\rVert}
\begin{document}
\section{System}
\begin{subequations}\label{eq:system}
\begin{align}
  \dot{x}_1 &= -k x_1 + \frac{x_2}{\nu(t)} \label{eq:first} \\
  \dot{x}_2 &= - x_1 - k x_2
\end{align}
\end{subequations}
\begin{equation} V = \frac{1}{2} \norm{x}^2 \label{eq:function} \end{equation}
\begin{equation}
  \dot{V} \le - 2 k V, \quad \forall k \ge 1 \label{eq:rate}
\end{equation}
\begin{equation} k^2 \in \mathcal{S} \label{eq:set} \end{equation}
\begin{equation} g = k \label{eq:unknown} \end{equation}
In the text, $V = \frac{x^\top x}{2}$ and $V = k$.
\end{document}
"""
DERIVATION = '''
import sympy as sp
from ptproof.proof import claim, definition, eq, every, exact, ge, le

x1, x2, t, V = sp.symbols("x1 x2 t V", real=True)
k = sp.Symbol("k", positive=True)
first, second = -k * x1 + x2 / (1 + t**2), -(x1 + k * x2)
d1 = definition("s/function", "V", eq(V, (x1**2 + x2**2) / 2), labels=["eq:function"])
d2 = definition("s/set", "A set", eq(k, k), labels=["eq:set", "eq:unknown"])

@claim("s/system", "The rates", every(eq(first, first), eq(second, second)), labels=["eq:system", "eq:first"])
def system(goal):
    """Themselves."""
    return exact(goal)

@claim("s/rate", "The rate", le(sp.Derivative(sp.Function("V")(t), t), -2 * k * V), given=[ge(k, 1)],
       labels=["eq:rate"], expected="undecided")
def rate(goal):
    """Not shown."""
    return exact(goal)

@claim("s/later", "What else may hold", ge(V, (x1**2 + x2**2) / 2), labels=["eq:function"], expected="undecided")
def later(goal):
    """Not shown."""
    return exact(goal)

@claim("s/corrected", "The rate, corrected", le(V, -3 * k * V), labels=["eq:rate"], corrects=rate, expected="undecided")
def corrected(goal):
    """Not shown."""
    return exact(goal)
'''
TABLE = r"""
times = ["t"]
dot = "t"
letters = { k = "k", t = "t", x_1 = "x1", x_2 = "x2", x = ["x1", "x2"], V = "V" }
functions = { '\nu' = "nu" }
means = { "nu(_s)" = "1 + _s**2" }
[[says]]
claims = ["s/sys*"]
left = ['\dot{x}_1', '\dot{x}_2']
"""
BAD_HEAD = TABLE.replace(r"\dot{x}_2'", r"\foo'")
EQUAL = ["eq:first", "eq:system (2)", "eq:function", "eq:rate"]
CHANGES = {
    "the opposite, which a later claim says": ("eq:function", "V = ", r"V \ge "),
    "a sign": ("eq:first", "= -k x_1", "= k x_1"),
    "a sign between": ("eq:system (2)", "x_1 - k x_2", "x_1 + k x_2"),
    "an index": ("eq:first", "-k x_1", "-k x_2"),
    "an index of the left side": ("eq:first", r"\dot{x}_1 &", r"\dot{x}_2 &"),
    "an exponent": ("eq:function", r"\norm{x}^2", r"\norm{x}^3"),
    "a number": ("eq:function", "{2}", "{3}"),
    "a letter": ("eq:rate", "k V", "t V"),
    "a relation": ("eq:rate", r"\dot{V} \le", r"\dot{V} \ge"),
    "strict": ("eq:rate", r"\dot{V} \le", r"\dot{V} <"),
    "an argument": ("eq:first", r"\nu(t)", r"\nu(2t)"),
    "what is corrected": ("eq:rate", "- 2 k", "- 3 k"),
    "a condition": ("eq:rate", r"k \ge 1", r"k \ge 2"),
    "a missing term": ("eq:system (2)", "- k x_2", ""),
    "a dot": ("eq:rate", r"\dot{V}", "V"),
}


def command(tmp_path, capsys, paper=PAPER, table=TABLE):
    folder = tmp_path / "derivation"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "part.py").write_text(DERIVATION)
    if table is not None:
        (folder / "notation.toml").write_text(table)
    (tmp_path / "paper.tex").write_text(paper)
    with pytest.raises(SystemExit) as ended:
        main(["coverage", str(tmp_path / "paper.tex"), str(folder), "--json"])
    captured = capsys.readouterr()
    read = json.loads(captured.out) if captured.out else {}
    return ended.value.code, {item["place"]: item for item in read.get("formulas", [])}, captured.err, read


def test_what_is_printed_is_what_is_claimed(tmp_path, capsys):
    status, found, _, _ = command(tmp_path, capsys)
    assert [place for place, item in found.items() if item["read"] == "equal"] == EQUAL
    assert found["eq:first"]["claims"] == ["s/system"]
    assert found["eq:rate"]["line"] == 13
    assert status == 0


def test_running_text_is_counted_and_listed(tmp_path, capsys):
    _, _, _, read = command(tmp_path, capsys)
    running = read["running"]
    assert (running["found"], running["read"], running["equal"]) == (2, 2, 1)
    assert running["items"][0]["claims"] == ["s/function"]


def test_in_running_text_different_is_said_only_where_the_table_names_the_place(tmp_path, capsys):
    table = TABLE + "[[says]]\nclaims = ['s/function']\nat = ['Section 1, text (2)']"
    status, _, _, read = command(tmp_path, capsys, table=table)
    assert read["running"]["items"][1]["read"] == "different"
    assert status == 1


def test_a_place_that_the_paper_does_not_have_is_named(tmp_path, capsys):
    table = TABLE + "[[says]]\nclaims = ['s/function']\nat = ['Section 1 (9)']"
    status, _, error, _ = command(tmp_path, capsys, table=table)
    assert status == 1
    assert "Section 1 (9)" in error


def test_what_is_not_read_says_why(tmp_path, capsys):
    _, found, _, _ = command(tmp_path, capsys)
    assert (found["eq:set"]["read"], found["eq:set"]["kind"]) == ("not read", "relation")
    assert "g" in found["eq:unknown"]["detail"]


@pytest.mark.parametrize("name", CHANGES)
def test_one_change_is_noticed_and_nothing_else(tmp_path, capsys, name):
    place, before, after = CHANGES[name]
    paper = PAPER.replace(before, after, 1)
    assert paper != PAPER
    status, found, _, _ = command(tmp_path, capsys, paper)
    assert found[place]["read"] == "different"
    assert "the paper: " in found[place]["detail"]
    assert [item["place"] for item in found.values() if item["read"] == "equal"] == [p for p in EQUAL if p != place]
    assert status == 1


@pytest.mark.parametrize(
    ("before", "after"), [(r"\frac{x_2}{", r"\frac{x_2"), ("+ \\frac", r"+ \foo\frac"), ("-k x_1", "-k x_7")]
)
def test_a_broken_formula_stops_no_other(tmp_path, capsys, before, after):
    _, found, _, _ = command(tmp_path, capsys, PAPER.replace(before, after, 1))
    assert found["eq:first"]["read"] == "not read"
    assert "line 7" in found["eq:first"]["detail"]
    assert [item["place"] for item in found.values() if item["read"] == "equal"] == EQUAL[1:]


def test_sides_may_be_swapped(tmp_path, capsys):
    paper = PAPER.replace(r"V = \frac{1}{2} \norm{x}^2", r"\frac{\norm{x}^2}{2} = V")
    assert command(tmp_path, capsys, paper)[1]["eq:function"]["read"] == "equal"


def test_without_a_table_nothing_is_read(tmp_path, capsys):
    status, found, _, _ = command(tmp_path, capsys, table=None)
    assert {item["kind"] for item in found.values()} == {"notation"}
    assert status == 0


@pytest.mark.parametrize(
    ("table", "word"),
    [("letter = {}", "letters"), ("division = 'both'", "product"), (BAD_HEAD, "foo"),
     ("letters = { '{' = 'k' }", "LaTeX"), (TABLE.replace('"1 + _s**2"', '"nu(_s) + 1"'), "by itself"),
     ("letters = { k = 'k + ' }", "cannot read")],
)  # fmt: skip
def test_a_wrong_table_is_bad_input(tmp_path, capsys, table, word):
    status, _, error, _ = command(tmp_path, capsys, table=table)
    assert status == 2
    assert word in error


@pytest.mark.parametrize("name", ["pt_seeker", "newton_seeker"])
def test_a_table_stands_beside_the_derivation_that_ships(name):
    from importlib.resources import files

    from ptproof.reading.latex.grammar import Grammar
    from ptproof.reading.latex.notation import notation, read_table, vocabulary
    from ptproof.reading.latex.tokens import read

    text = (files(f"derivations.{name}") / "notation.toml").read_text()
    table = read_table(text, "notation.toml")
    letters = notation(table, vocabulary(table, {}), "", "notation.toml")
    heads = [head for item in table.says for head in (*item.left, *item.right) if head and " = " not in head]
    assert len(heads) > 20
    for head in heads:
        Grammar(read(head, 0, {}), letters).expression()


@pytest.mark.parametrize(
    ("left", "right", "equal"), [("x*(x + 1)", "x**2 + x", True), ("x*(x - 1)", "x**2 + x", False)]
)
def test_same_is_exact(left, right, equal):
    import sympy as sp

    x = sp.Symbol("x", real=True)
    assert same(sp.sympify(left, {"x": x}), sp.sympify(right, {"x": x})) is equal
