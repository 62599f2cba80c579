"""What formulas say: each construct once, what has two readings, and LaTeX that is not understood."""

import pytest
import sympy as sp

from ptproof.reading.latex.formulas import find_formulas
from ptproof.reading.latex.notation import notation, read_table, vocabulary
from ptproof.reading.latex.statements import read_formula
from ptproof.reading.latex.tokens import NotUnderstood

TABLE = r"""
times = ["t"]
dot = "t"
division = "product"
counts = { N = 3 }
state = ["a", "b"]
functions = { Y = [["y11", "y12"], ["y21", "y22"]], F = "F", f = ["f1", "f2"], '\nu' = "nu" }
norms = { E = "norm_E" }
[letters]
a = "a"
b = "b"
k = "k"
t = "t"
t_0 = "t0"
V = "V"
a_1 = "a1"
a_2 = "a2"
a_3 = "a3"
'c_{k,1}' = "c"
'\omega' = "w"
x = ["x1", "x2"]
'x^*' = ["s1", "s2"]
'\bar{x}' = ["m1", "m2"]
E = [["p", "q"], ["r", "s"]]
'\lambda(E)' = "lam"
'g' = ["b", "0"]
'h' = ["0", "a"]
"""
MACROS = r"\newcommand{\norm}[1]{\left\lVert#1\right\rVert} \def\half{\frac12}\newcommand{\R}{\mathbb{R}} "
SAID = {
    r"a = b + k": "a = b + k",
    r"a = -b\,k": "a = -b*k",
    r"a = \frac{b}{k}": "a = b/k",
    r"a = \half b": "a = b/2",
    r"a = 0.3^2": "a = 9/100",
    r"a = \sqrt[3]{k} + \sqrt{b}": "a = sqrt(b) + k**(1/3)",
    r"a = b^{1/2k}": "a = b**(1/(2*k))",
    r"a = k b/2k": "a = b/2",
    r"a = c^2_{k,1}": "a = c**2",
    r"a = \sin^2(\omega t)": "a = sin(t*w)**2",
    r"a = \sin \omega t + \cos(t)": "a = sin(t*w) + cos(t)",
    r"a = {\rm e}^{-k t}": "a = exp(-k*t)",
    r"a = \nu^2(t - t_0)": "a = nu(t - t0)**2",
    r"a = \norm{x - x^*}": "a = sqrt((-s1 + x1)**2 + (-s2 + x2)**2)",
    r"a = \norm{E} |b|": "a = norm_E*Abs(b)",
    r"a = x^\top x": "a = x1**2 + x2**2",
    r"x = E \bar{x}": "x1 = m1*p + m2*q, x2 = m1*r + m2*s",
    r"x = \begin{bmatrix} a \\ b \end{bmatrix}": "x1 = a, x2 = b",
    r"\dot{x} = f(t,x)": "rate(x1, t) = f1(t, x1, x2), rate(x2, t) = f2(t, x1, x2)",
    r"\frac{\text{d} V}{{\rm d} t} \le 0": "rate(V, t) <= 0",
    r"a = \nabla F(x)^\top x": "a = x1*Derivative(F(x1, x2), x1) + x2*Derivative(F(x1, x2), x2)",
    r"a = \sum_{i=1}^{N} a_i k^i": "a = a1*k + a2*k**2 + a3*k**3",
    r"a = \int_{0}^{k} \sin(b) \text{d} b": "a = Integral(sin(b), (b, 0, k))",
    r"a = \max(b, k)": "a = Max(b, k)",
    r"x = [g, h]": "x1 = -a, x2 = b",
    r"x = Y^\top(t) x": "x1 = x1*y11(t) + x2*y21(t), x2 = x1*y12(t) + x2*y22(t)",
    r"a \leq b < k": "a <= b, b < k",
    r"a = b, \quad b = k": "a = b, b = k",
    r"\begin{aligned} a &= b \\ &\quad + k \\ b &= k \end{aligned}": "a = b + k, b = k",
    r"a = \left( b \right. \\ \left. + k \right)": "a = b + k",
    r"a = \underbrace{b k}_{V}": "a = b*k",
    # Cases, both signs, sets.
    r"a = \begin{cases} b, & k > 0, \\ -b, & \text{otherwise.} \end{cases}": "a = Piecewise((b, k > 0), (-b, True))",
    r"a = \begin{cases} 1 & \text{if } b < k \\ 0 & \text{else} \end{cases}":
        "a = Piecewise((1, b < k), (0, True))",
    r"a = b \pm k": "a = b + k, a = b - k",
    r"a_{1,2} = b \pm k \mp t": "a1 = b + k - t, a2 = b - k + t",
    r"a \in (b, k]": "a > b, a <= k",
    r"a \in [0, \infty)": "a >= 0",
    r"a, b \in \R_{>0}": "a > 0, b > 0",
    # Ranges.
    r"a = \sum_{\substack{1 \le i < N \\ i < j \le N}} a_i a_j": "a = a1*a2 + a1*a3 + a2*a3",
    r"a = \sum_{1 \le i < j \le N} a_i a_j": "a = a1*a2 + a1*a3 + a2*a3",
    r"a = \sum_{i=1}^{2} \frac12 a_i + \frac1k": "a = a1/2 + a2/2 + 1/k",
    r"a = \sum_{i=1}^{2} \sum_{j=i+1}^{3} a_i a_j": "a = a1*a2 + a1*a3 + a2*a3",
    r"x = \lim_{k \to \infty} k g": "x1 = Limit(b*k, k, oo, dir='-'), x2 = 0",
    # Calculus.
    r"\ddot{a} = b": "rate(rate(a, t), t) = b",
    r"a = \frac{\text{d}^2 V}{\text{d} t^2}": "a = rate(rate(V, t), t)",
    r"a = \frac{\partial^2 F(x)}{\partial a \partial b}": "a = 0",
    r"x = \frac{\partial^2 F(x)}{\partial x^2} g": (
        "x1 = b*Derivative(F(x1, x2), (x1, 2)), x2 = b*Derivative(F(x1, x2), x1, x2)"
    ),
    r"a = \int_0^k \int_0^b t a \, da \, db": "a = Integral(a*t, (a, 0, b), (b, 0, k))",
    r"a = \norm{x}_1 + \norm{x}_\infty": "a = Abs(x1) + Abs(x2) + Max(Abs(x1), Abs(x2))",
    r"a = \norm{x}_2^2": "a = x1**2 + x2**2",
    r"x = [a, b]^\top": "x1 = a, x2 = b",
    r"x = \dot{Y}^\top(t) x": "x1 = x1*Derivative(y11(t), t) + x2*Derivative(y21(t), t), "
        "x2 = x1*Derivative(y12(t), t) + x2*Derivative(y22(t), t)",
    r"a = \lambda(E)": "a = lam",
}  # fmt: skip
NOT_READ = {
    r"a = q": ("letter", "q"),
    r"a = b_4": ("letter", "b_4"),
    r"a = \foo": ("macro", r"\foo"),
    r"a = \frac{b": ("bad LaTeX", "not closed"),
    r"a = b}": ("bad LaTeX", "without"),
    r"a = (b": ("bad LaTeX", "end with"),
    r"a = \sqrt": ("bad LaTeX", "lacks an argument"),
    r"a = ": ("grammar", "missing"),
    r"a = b +": ("grammar", "missing"),
    r"a \in \R": ("relation", "membership"),
    r"a \in \mathcal{S}": ("relation", "membership"),
    r"a \in \{1, 2\}": ("grammar", "not expected"),
    r"x \in [0, 1]": ("relation", "column"),
    r"a \in (0, 1": ("bad LaTeX", "not end"),
    r"a \in \R_+": ("two readings", "whether 0"),
    r"a = b, k": ("no relation", "a part of it"),
    r"a = a": ("no relation", "letter for letter"),
    r"a = \lambda(k)": ("letter", "lambda"),
    r"a = \sum_{\substack{i=1 \\ j=i+1}}^{N} a_i a_j": ("two readings", "go on"),
    r"a = \sum_{i \in E} a_i": ("sum", "this range"),
    r"a = \sum_{i=1}^{999999999} a_i": ("sum", "so many"),
    r"a = \norm{x}_k": ("norm", "with an index"),
    r"a = \begin{cases} 1 & E \\ 2 & k > 0 \end{cases}": ("cases", "no condition"),
    r"a = \begin{cases} 1 & k > 0 \\ 2 & \text{maybe} \end{cases}": ("letter", "maybe"),
    r"a = \frac{\text{d}^2 V}{\text{d} t}": ("derivative", "orders"),
    r"a = \nabla^2 F(x)": ("derivative", "second order"),
    r"a b": ("no relation", "no relation"),
    r"a = x": ("matrix", "shapes"),
    r"a = x x": ("matrix", "product"),
    r"x < E": ("matrix", "shapes"),
    r"x = [g, k]": ("Lie bracket", "no vector fields"),
    r"a = \sum_{i=1}^{M} a_i": ("sum", "how many"),
    r"a = \begin{cases} 1 & k > 0 \end{cases}": ("cases", "single"),
    r"a = f": ("letter", "without arguments"),
    r"a = \sin^{-1}(b)": ("two readings", "reciprocal"),
}  # fmt: skip


def reading(text, table=TABLE):
    formulas = find_formulas(MACROS + f"\\begin{{equation}}\n{text}\n\\end{{equation}}")
    written = read_table(table, "table")
    return read_formula(formulas.displayed[0], formulas.macros, notation(written, vocabulary(written, {}), "", "table"))


@pytest.mark.parametrize("text", SAID)
def test_what_it_says(text):
    assert str(reading(text)) == SAID[text]


@pytest.mark.parametrize("text", NOT_READ)
def test_what_is_not_understood_is_named_with_its_line(text):
    kind, word = NOT_READ[text]
    with pytest.raises(NotUnderstood) as refused:
        reading(text)
    assert refused.value.kind == kind
    assert word in str(refused.value)
    assert "line 2" in str(refused.value)


@pytest.mark.parametrize(("division", "value"), [("product", "a = k/(2*b)"), ("factor", "a = b*k/2")])
def test_what_a_slash_divides_by_is_said_by_the_table(division, value):
    assert str(reading("a = k/2b", TABLE.replace('"product"', f'"{division}"'))) == value


def test_a_slash_with_two_readings_is_not_read():
    with pytest.raises(NotUnderstood, match="can mean"):
        reading("a = k/2b", TABLE.replace('division = "product"', ""))


def test_braces_name_a_part():
    (brace,) = reading(r"a = \underbrace{b k}_{V}").braces
    assert str(brace) == "V = b*k"


def test_a_condition_stands_apart():
    (condition,) = reading(r"a \le b, \quad \forall k \ge 1").conditions
    assert str(condition) == "k >= 1"


def test_a_value_at_a_point():
    (pair,) = reading(r"\left. \frac{\partial V}{\partial a} \right|_{a=0} = k").pairs
    assert pair.right == sp.Symbol("k", real=True)


def test_a_macro_that_stands_for_itself_ends():
    formulas = find_formulas(r"\newcommand{\a}{\a b}\[ \a = 1 \]")
    table = read_table("", "table")
    with pytest.raises(NotUnderstood, match="does not come to an end"):
        read_formula(formulas.displayed[0], formulas.macros, notation(table, vocabulary(table, {}), "", "table"))
