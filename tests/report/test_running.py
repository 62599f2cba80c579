"""Relations in running text: what states them, what only assumes them, what says nothing of them."""

import pytest
import sympy as sp

from ptproof.proof.load import load
from ptproof.reading.latex.formulas import find_formulas
from ptproof.report.running import hold_running
from ptproof.report.stated import with_table

DERIVATION = """
import sympy as sp
from ptproof.proof import claim, definition, eq, every, exact, ge, le

x, y, V, W = sp.symbols("x y V W", real=True)
k = sp.Symbol("k", positive=True)
d1 = definition("function", "V", eq(V, x**2 / 2), labels=[])

@claim("bound", "A bound", le(V, k), given=[ge(k, 1)], expected="undecided")
def bound(goal):
    return exact(goal)

@claim("chain", "Two equalities", every(eq(V, W + x), eq(W + x, 0), eq(W, 0)), expected="undecided")
def chain(goal):
    return exact(goal)

@claim("matrix", "A matrix", eq(sp.Matrix([[0, x], [y, 0]]), sp.Matrix([[0, k], [W, 0]])), expected="undecided")
def matrix(goal):
    return exact(goal)

@claim("corrected", "The bound, corrected", le(V, 2 * k), corrects=bound, expected="undecided")
def corrected(goal):
    return exact(goal)
"""
TABLE = r"""
letters = { x = "x", y = "y", k = "k", V = "V", W = "W", 'p_1' = "1 - k", A = [["0", "x"], ["y", "0"]] }
"""
HELD = {
    r"V = \frac{x^2}{2}": ("equal", ["function"]),
    r"V \le k": ("equal", ["bound"]),
    r"k \ge V": ("equal", ["bound"]),
    r"k \geq 1": ("restates", ["bound"]),
    r"k > 0": ("restates", []),
    r"p_1 = 1 - k": ("restates", []),
    r"V = 0": ("equal", ["chain"]),
    r"A = \begin{bmatrix} 0 & k \\ W & 0 \end{bmatrix}": ("equal", ["matrix"]),
    # One change in each of them, what is only corrected, and what a number alone connects.
    r"V = \frac{x^2}{3}": ("not claimed", []),
    r"V = -\frac{x^2}{2}": ("not claimed", []),
    r"V < k": ("not claimed", []),
    r"V \ge k": ("not claimed", []),
    r"V \le 2 k": ("not claimed", []),
    r"k \ge 2": ("not claimed", []),
    r"x > 0": ("not claimed", []),
    r"k < 0": ("not claimed", []),
    r"p_1 = k - 1": ("not claimed", []),
    r"V = W": ("not claimed", []),
    r"A = \begin{bmatrix} 0 & W \\ k & 0 \end{bmatrix}": ("not claimed", []),
    r"V = V": ("not read", []),
    r"q \le k": ("not read", []),
    r"V \le \foo{": ("not read", []),
}


@pytest.fixture(scope="module")
def derivation(tmp_path_factory):
    folder = tmp_path_factory.mktemp("derivation")
    (folder / "__init__.py").write_text("")
    (folder / "part.py").write_text(DERIVATION)
    return load([folder])


@pytest.mark.parametrize("text", HELD)
def test_it_is_looked_up_by_what_it_says(derivation, text):
    formulas = find_formulas(rf"\begin{{document}}\section{{A}} Here ${text}$ stands. \end{{document}}")
    source = with_table(derivation, TABLE, "table", {"k": sp.Symbol("k", positive=True)})
    (found,) = hold_running(formulas, source, derivation)
    assert (found.read, list(found.claims)) == HELD[text]
    assert found.formula.place == "Section 1, text (1)"
