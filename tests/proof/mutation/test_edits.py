"""Every kind of change makes what its name says, and keeps what is bound apart."""

import pytest
import sympy as sp

from ptproof.proof.mutation.edits import Edit, edits, similar

x, y, a1, a2 = sp.symbols("x y a1 a2", real=True)
n = sp.Symbol("n", integer=True, positive=True)
F, f1, f2 = sp.Function("F", real=True), sp.Function("f1", real=True), sp.Function("f2", real=True)
LETTERS = (x, y, a1, a2, n, f1(x), f2(x))

TABLE = [
    ("coefficient", 3 * x, 4 * x),
    ("coefficient", x + y, x / 2 + y),
    ("coefficient", x, 2 * x),
    ("sign", x + y, y - x),
    ("sign", sp.exp(x), sp.exp(-x)),
    ("sign", x, -x),
    ("term", x + y, y),
    ("term", x * y, y),
    ("exponent", x**2, x**3),
    ("exponent", sp.sqrt(x), sp.cbrt(x)),
    ("exponent", x, x**2),
    ("index", a1 * x, a2 * x),
    ("index", f1(x), f2(x)),
    ("index", sp.Derivative(F(x, y), x), sp.Derivative(F(x, y), y)),
    ("exchange", a1 / a2, a2 / a1),
    ("function", sp.sin(x), sp.cos(x)),
    ("function", sp.Max(x, y), sp.Min(x, y)),
    ("function", sp.Abs(x), x),
    ("function", sp.sqrt(x), x),
    ("order", sp.Derivative(F(x, y), x), sp.Derivative(F(x, y), (x, 2))),
    ("order", sp.Derivative(F(x, y), x), F(x, y)),
    ("order", x**n, x ** (n + 1)),
    ("order", sp.Integer(3), sp.Integer(4)),
    ("limit", sp.Limit(1 / x, x, 0, "+"), sp.Limit(1 / x, x, 0, "-")),
    ("limit", sp.Limit(1 / x, x, sp.oo), sp.Limit(1 / x, x, -sp.oo)),
    ("integral", sp.Integral(x, (x, 0, 2)), sp.Integral(x, (x, 0, 1))),
    ("integral", sp.Integral(x, (x, 0, 2)), sp.Integral(x, (x, 2, 0))),
    ("point", sp.Subs(F(x, y), x, 0), sp.Subs(F(x, y), x, 1)),
    ("plus", x, x + 1),
    ("plus", x, x + y / 100),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "old", "new"), TABLE, ids=[f"{kind}-{i}" for i, (kind, _, _) in enumerate(TABLE)])
def test_the_kind_makes_this_change(kind, old, new):
    assert new in [edit.apply(old) for edit in edits(old, LETTERS) if edit.kind == kind and _can(edit, old)]


def _can(edit, old):
    try:
        edit.apply(old)
    except (TypeError, ValueError):  # such as an integral over an expression
        return False
    return True


def test_each_change_says_what_it_is():
    assert all(edit.words for edit in edits(x + 2 * sp.sin(a1), LETTERS))


def test_a_long_expression_is_cut_in_words():
    long = sum(sp.Symbol(f"letter{i}") for i in range(50))
    assert max(len(edit.words) for edit in edits(long, ())) < 200


@pytest.mark.parametrize(
    ("name", "other"), [("x1", "x2"), ("E12", "E21"), ("V", "V0"), ("c_kappa1", "c_kappa2"), ("a1", "b1")]
)
def test_names_that_are_taken_for_each_other(name, other):
    assert similar(name, other)


@pytest.mark.parametrize(("name", "other"), [("x", "x"), ("k", "T"), ("omega", "mu"), ("kappa", "k")])
def test_names_that_are_not(name, other):
    assert not similar(name, other)


@pytest.mark.parametrize(
    ("letter", "expression"), [(x, sp.Limit(x, x, 0)), (x, sp.Subs(sp.cos(x), x, y)), (y, sp.Subs(F(x, y), y, x))]
)
def test_a_bound_variable_stays_a_symbol(letter, expression):
    edit = Edit("exponent", letter, letter**2)
    with pytest.raises(ValueError, match="bound variable"):
        edit.apply(expression)
