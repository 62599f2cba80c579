"""Which printed sides a machine has read: of a paper of five formulas and a derivation of five claims."""

import pytest

from ptproof.proof.load import load
from ptproof.report.read import read_sides

PAPER = r"""
\begin{document}
\section{First}
\begin{equation} V = \frac{1}{2} x^2 \label{eq:function} \end{equation}
\begin{align} y &= 2 x \label{eq:double} \\ z &= 3 x \label{eq:triple} \end{align}
\begin{equation} x \in \mathcal{S} \label{eq:set} \end{equation}
\begin{equation} z \le y + x \label{eq:sum} \end{equation}
\end{document}
"""
DERIVATION = '''
import sympy as sp
from ptproof.proof import claim, definition, eq, every, exact, ge, le

x, y, z, V = sp.symbols("x y z V", real=True)
d1 = definition("function", "V", eq(V, x**2 / 2), labels=["eq:function"])

def of(name, statement, labels, **more):
    @claim(name, name, statement, labels=labels, expected="undecided", **more)
    def proof(goal):
        """Not shown."""
        return exact(goal)
    return proof

both = of("both", every(eq(y, 2 * x), eq(z, 3 * x)), ["eq:double", "eq:triple"])
part = of("part", every(eq(y, 2 * x), ge(y, x)), ["eq:double"])
aside = of("aside", ge(V, 0), ["eq:function"])
set_ = of("set", eq(x, x), ["eq:set"])
bound = of("bound", le(z, y + x), ["eq:sum"])
corrected = of("corrected", le(z, y + 2 * x), ["eq:sum"], corrects=bound)
nowhere = of("nowhere", eq(y, y), [])
'''
TABLE = 'letters = { x = "x", y = "y", z = "z", V = "V" }'


@pytest.fixture(scope="module")
def derivation(tmp_path_factory):
    folder = tmp_path_factory.mktemp("derivation")
    (folder / "__init__.py").write_text("")
    (folder / "part.py").write_text(DERIVATION)
    (folder / "notation.toml").write_text(TABLE)
    return load([folder])


def test_each_claim_has_what_became_of_its_printed_side(derivation):
    found = read_sides(PAPER, derivation)
    assert {id: item.read for id, item in found.items()} == {
        "function": "equal", "both": "equal", "part": "equal", "aside": "not read", "set": "not read",
        "bound": "equal",
    }  # fmt: skip
    assert found["both"].places == ("eq:double", "eq:triple")
    assert (found["part"].detail, found["both"].detail) == ("1 of its 2 relations", "")
    assert "membership" in found["set"].detail


def test_a_claim_of_which_one_formula_was_not_read_was_not_read(derivation):
    paper = PAPER.replace(r"z &= 3 x \label{eq:triple}", r"z &\in Z \label{eq:triple}")
    found = read_sides(paper, derivation)
    assert (found["both"].read, found["both"].places) == ("not read", ("eq:triple",))


@pytest.mark.parametrize(
    ("before", "after", "id"),
    [("= 2 x", "= 4 x", "both"), (r"z \le y", r"z \ge y", "bound"), ("y + x", "y + 2 x", "bound"),
     ("x^2", "x^3", "function")],
)  # fmt: skip
def test_what_the_paper_says_otherwise_is_different(derivation, before, after, id):
    found = read_sides(PAPER.replace(before, after), derivation)
    assert [name for name, item in found.items() if item.read == "different"] == [id]


def test_without_a_formula_there_is_nothing(derivation):
    assert read_sides(r"\begin{document} \end{document}", derivation) == {}
