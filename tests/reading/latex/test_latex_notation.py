"""A table of notation: spellings of letters, rules, and where letters mean something else."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.latex.notation import meanings, notation, read_table, says_of, spelled, vocabulary
from ptproof.reading.latex.rewrite import RATE, function

TABLE = r"""
times = ["t"]
letters = { a = "a", x = "x", t = "t" }
means = { "nu(_s)" = "1 - _s", "f(t, _b)" = "g(_b)", R = "sqrt(x**2)", "X(t)" = "x" }
positive = { P = "V(x)" }
[[where]]
formulas = ["eq:two*"]
letters = { a = "b" }
[[says]]
claims = ["c/*"]
has = { k = "a" }
[[says]]
claims = ["c/one"]
has = { k = "x" }
left = ['a']
"""
a, b, x, t = sp.symbols("a b x t", real=True)


def table(text=TABLE):
    written = read_table(text, "table")
    return written, vocabulary(written, {})


@pytest.mark.parametrize(
    ("one", "other"),
    [("c^2_{k,1}", "c_{k, 1}^{2}"), (r"\bar{x}", r"\bar{ x }"), ("x^*", "x^{*}"), (r"q_\kappa", r"q_{\kappa}")],
)
def test_two_spellings_of_one_letter(one, other):
    assert spelled(one, "") == spelled(other, "")


@pytest.mark.parametrize(("one", "other"), [("a_1", "a_2"), ("a_1", "a^1"), (r"\bar{x}", "x"), ("x^*", "x")])
def test_two_letters(one, other):
    assert spelled(one, "") != spelled(other, "")


MEANT = {
    "a free argument": (function("nu")(a + b), 1 - a - b),
    "an argument that is given": (function("f")(t, b), function("g")(b)),
    "another argument": (function("f")(a, b), function("f")(a, b)),
    "a name": (sp.Symbol("R"), sp.Abs(x)),
    "inside of a function": (function("h")(function("nu")(a)), function("h")(1 - a)),
    "a rate": (sp.Derivative(sp.Function("x")(t), t), RATE(x, t)),
    "the letter of a state": (sp.Derivative(sp.Function("X")(t), t), RATE(x, t)),
    "a derivative that is none along a time": (sp.Derivative(function("nu")(a), a), sp.Integer(-1)),
    "what is positive": (sp.sqrt(function("V")(x)) ** 2, sp.Symbol("P", positive=True)),
}


@pytest.mark.parametrize("name", MEANT)
def test_what_names_stand_for(name):
    given, meant = MEANT[name]
    written, names = table()
    assert meanings(written, names, "", {}, "table")(given) == meant


def test_letters_mean_something_else_where_the_table_says_so():
    written, names = table()
    assert [notation(written, names, place, "").letters["a"] for place in ("eq:one", "eq:two (1)")] == [a, b]


def test_what_is_said_first_of_a_claim_wins():
    says = says_of(table()[0], "c/one")
    assert (says.has, says.left) == ({"k": "a"}, ["a"])
    assert says_of(table()[0], "d/one").has == {}


def test_a_circle_is_refused():
    written, names = table('means = { a = "b + 1", b = "a + 1" }')
    with pytest.raises(InputError, match="by itself"):
        meanings(written, names, "", {}, "table")(a)
