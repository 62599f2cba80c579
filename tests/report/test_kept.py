"""The formulas that are kept beside a derivation: written from a paper, read again, and shown where they are equal."""

import pytest

from ptproof.commands.cli import main
from ptproof.errors import InputError
from ptproof.proof.load import load
from ptproof.reading.latex.kept import read_kept
from ptproof.report.kept import kept_sides

PAPER = r"""
\newcommand{\twice}[1]{2 #1}
\begin{document}
\section{First}
\begin{equation} y \le \twice x, \qquad z = 3 x \label{eq:both} \end{equation}
\begin{subequations}\label{eq:group}
\begin{align} V &= x^2 \\ W &= {\rm e}^{x} \label{eq:last} \end{align}
\end{subequations}
\begin{equation} u = x \label{eq:nobody} \end{equation}
\end{document}
"""
DERIVATION = '''
import sympy as sp
from ptproof.proof import claim, definition, eq, every, exact, ge, le

x, y, z, V, W = sp.symbols("x y z V W", real=True)
d1 = definition("group", "V and W", every(eq(V, x**2), eq(W, sp.exp(x))), labels=["eq:group"])

def of(name, statement, labels, **more):
    @claim(name, name, statement, labels=labels, expected="undecided", **more)
    def proof(goal):
        """Not shown."""
        return exact(goal)
    return proof

upper = of("upper", le(y, 2 * x), ["eq:both"])
triple = of("triple", every(eq(z, 3 * x), ge(z, x)), ["eq:both"])
given = of("given", le(y, 3 * x), ["eq:both"], given=[le(y, 2 * x), eq(z, 3 * x)])
corrected = of("corrected", le(y, 4 * x), ["eq:both"], corrects=upper)
'''
TABLE = 'letters = { x = "x", y = "y", z = "z", V = "V", W = "W" }'
CORRECTED = "\n[corrected]\n'corrected' = 'y \\le 4 x'\n"


@pytest.fixture
def folder(tmp_path):
    found = tmp_path / "derivation"
    found.mkdir()
    (found / "__init__.py").write_text("")
    (found / "part.py").write_text(DERIVATION)
    (found / "notation.toml").write_text(TABLE)
    (tmp_path / "paper.tex").write_text(PAPER)
    with pytest.raises(SystemExit):
        main(["coverage", str(tmp_path / "paper.tex"), str(found), "--keep", "--json"])
    return found


def sides(folder):
    return kept_sides(load([folder]))


def changed(folder, before, after):
    text = (folder / "printed.toml").read_text()
    assert before in text
    (folder / "printed.toml").write_text(text.replace(before, after))


def test_formulas_are_kept_with_macros_put_in_and_nothing_else(folder):
    found = read_kept((folder / "printed.toml").read_text(), "printed.toml")
    assert found.printed == {
        "eq:both": r"y \le 2x, \qquad z = 3 x", "eq:group (1)": "V &= x^2", "eq:last": r"W &= \mathrm{e}^{x}",
    }  # fmt: skip
    assert found.labels == {"eq:last": ["eq:last", "eq:group"]}


def test_each_claim_has_the_part_that_it_states(folder):
    found = sides(folder)
    assert {id: (side.read, side.latex, side.whole) for id, side in found.items()} == {
        "group": ("equal", ("V &= x^2", r"W &= \mathrm{e}^{x}"), True),
        "upper": ("equal", (r"y \le 2x",), True),
        "triple": ("equal", ("z = 3 x",), False),
        "given": ("not read", (), True),
    }  # fmt: skip


def test_what_is_not_read_is_handed_on_as_it_is_printed(folder):
    changed(folder, "V &= x^2", r"V &= \oddly x^2")
    found = sides(folder)
    assert (found["group"].read, found["group"].unread) == ("not read", (r"V &= \oddly x^2",))
    assert found["given"].unread == (r"y \le 2x, \qquad z = 3 x",)
    assert found["upper"].unread == ()


@pytest.mark.parametrize(
    ("before", "after", "id"),
    [("2x", "3 y", "upper"), (r"\le 2", r"\ge 2", "upper"), ("3 x", "4 x", "triple"), ("x^2", "x^3", "group")],
)
def test_one_change_is_different_and_not_shown(folder, before, after, id):
    changed(folder, before, after)
    side = sides(folder)[id]
    assert (side.read, side.latex) == ("different", ())


def test_keeping_again_leaves_the_corrections(folder):
    changed(folder, "\n[corrected]\n", CORRECTED)
    before = (folder / "printed.toml").read_text()
    with pytest.raises(SystemExit):
        main(["coverage", str(folder.parent / "paper.tex"), str(folder), "--keep", "--json"])
    assert (folder / "printed.toml").read_text() == before


@pytest.mark.parametrize(
    ("text", "read"), [("y \\le 4 x", "equal"), ("y \\le 5 x", "different"), ("y \\le q", "not read")]
)
def test_a_correction_is_held_against_its_claim(folder, text, read):
    changed(folder, "\n[corrected]\n", CORRECTED.replace("y \\le 4 x", text))
    assert sides(folder)["corrected"].read == read


@pytest.mark.parametrize(
    ("before", "after", "word"),
    [("\n[corrected]\n", "\n[corrected]\nupper = 'x = y'\n", "corrects nothing"),
     ("[printed]", "[print]", "printed"), ("'V &= x^2'", "2", "expected LaTeX"),
     ('["eq:last", "eq:group"]', "'x'", "labels")],
)  # fmt: skip
def test_a_wrong_file_is_bad_input(folder, before, after, word):
    changed(folder, before, after)
    with pytest.raises(InputError, match=word):
        sides(folder)


def test_without_the_file_there_is_nothing(folder):
    (folder / "printed.toml").unlink()
    assert sides(folder) == {}
