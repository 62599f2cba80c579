"""Statements as LaTeX lines, and LaTeX as MathML."""

from xml.etree import ElementTree

import pytest
import sympy as sp

from ptproof.proof.statement import All, Exists, ForAll, Prose, Relation, Runs, Smooth, eq, every, ge, gt, le, lt
from ptproof.report.formula import _wide, domain_of, latex, mathml, statement_lines, width

x, y = sp.symbols("x y", real=True)
k = sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)


def lines(statement, names=None):
    return [line.latex for line in statement_lines(statement, names or {})]


def test_a_relation_is_one_line():
    assert lines(le(x, y)) == [r"x \le y"]


def test_both_sides_are_kept_where_they_are_equal():
    assert lines(eq(x, x)) == ["x = x"]


def test_glyphs_are_used():
    assert lines(eq(x**2, y), {x: r"\bar x"}) == [r"\bar x^{2} = y"]


def test_a_glyph_with_a_superscript_is_put_in_parentheses():
    assert latex(x**2, {x: "x^*_1"}) == r"\left(x^*_1\right)^{2}"


@pytest.mark.parametrize("glyph", [r"\|\bar x - x^*\|", "F(x^*)"])
def test_what_has_its_own_brackets_gets_no_others(glyph):
    assert latex(x**2, {x: glyph}) == f"{{{glyph}}}^{{2}}"


def test_the_value_of_a_derivative_has_a_dot():
    assert latex(sp.Symbol("V_dot", real=True), {}) == r"\dot{V}"
    assert latex(sp.Symbol("V_dot", real=True), {sp.Symbol("V", positive=True): r"\bar V"}) == r"\dot{\bar V}"


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("deficit", r"\mathrm{deficit}"), ("gap_m", r"\mathrm{gap}_{m}"), ("c_kappa1", r"c_{\kappa_{1}}"),
        ("tau_0", r"\tau_{0}"), ("ab", "ab"), ("T_f", "T_{f}"),
    ],
)  # fmt: skip
def test_a_letter_without_a_glyph_is_a_letter_or_an_upright_word(name, shown):
    assert latex(sp.Symbol(name), {}) == shown


def test_a_glyph_is_left_as_it_is():
    assert latex(sp.Symbol("deficit"), {sp.Symbol("deficit"): "def"}) == "def"


def test_powers_with_symbolic_exponents_keep_their_places():
    n = sp.Symbol("n", positive=True)
    assert latex(k ** (-n) * x * sp.exp(-n * k), {}) == r"x k^{- n} e^{- k n}"
    assert latex(x * k ** (-2), {}) == r"\frac{x}{k^{2}}"


def test_a_power_in_another_is_not_taken_for_it():
    a, m, n = sp.symbols("a m n", positive=True)
    assert latex(a**-m * (1 + k * a**-m) ** -n, {}) == r"a^{- m} \left(1 + k a^{- m}\right)^{- n}"
    assert latex(k * a**-m, {}) == r"k a^{- m}"


def test_runs_are_a_system_with_its_starts_and_what_follows():
    t = sp.Symbol("t", real=True)
    said = Runs(t, (x, y), (-y, x), (0, 3), (eq(x, 1), eq(y, 0)), (lt(x, 0),), (2, 3))
    assert lines(said) == [
        r"\frac{d}{d t} x = - y", r"\frac{d}{d t} y = x", r"\text{where, at}\ t = 0:", "x = 1", "y = 0",
        r"\text{exists until}\ 3\text{, and at}\ t \in [2, 3]:", "x < 0",
    ]  # fmt: skip


def test_every_part_has_its_line():
    assert len(lines(every(le(x, y), ge(x, 0), gt(k, 0)))) == 3


def test_a_sum_opens_with_a_positive_term():
    assert latex(x - k, {}) == "x - k"
    assert latex(-x - k, {}).startswith("-")


def test_a_long_relation_is_broken_before_its_sign_and_between_terms():
    total = sum(sp.Symbol(f"alpha{i}") * sp.cos(i * x) for i in range(30))
    found = statement_lines(eq(total, y), {})
    assert found[-1].latex == "= y"
    assert all(line.indent for line in found[1:])
    assert all(width(line.latex) < 100 for line in found)


def test_breaking_loses_no_term():
    symbols = sp.symbols("b1:60")
    text = " ".join(lines(eq(sum(symbols), y)))
    assert all(latex(symbol, {}) in text for symbol in symbols)


def test_a_wide_column_is_shown_entry_by_entry():
    wide = sum(sp.symbols("b1:40"))
    found = lines(eq(sp.Matrix([wide, x]), sp.Matrix([y, k])))
    assert found[-1] == "x = k"


def test_existence_names_its_variables_and_ranges():
    found = lines(Exists((k,), (ge(k, x),), (x,)))
    assert found[0] == r"\exists\, k > 0\ \ \forall\, x \in \mathbb{R}:"


def test_smoothness_and_assumptions_on_functions():
    assert "C^{2}" in lines(Smooth((x**2,), (x,), 2))[0]
    assert r"\forall\, x" in lines(ForAll((x,), ge(F(x), 0), (ge(x, 1),)))[0]


def test_words_have_no_lines():
    assert lines(Prose("in words")) == []


def test_domains_say_what_the_symbols_stand_for():
    n = sp.Symbol("n", integer=True, positive=True)
    z = sp.Symbol("z")
    found = domain_of([All((eq(F(x), k + n + z),))], [], {})
    assert found == (" > 0".join(["k", ""]), r"n \in \mathbb{N}", r"x \in \mathbb{R}", r"z \in \mathbb{C}",
                     r"F\ \text{arbitrary function}")  # fmt: skip


def test_bound_variables_are_not_free():
    assert domain_of([eq(k, x)], [k], {}) == (r"x \in \mathbb{R}",)


EXPRESSIONS = [
    x**2 / (1 + k), sp.sqrt(x), sp.Abs(x), sp.Derivative(F(x), x), sp.Integral(F(x), (x, 0, y)),
    sp.Limit(F(x), x, 0, "-"), sp.Piecewise((x, x > 0), (y, True)), sp.Max(x, y), sp.sign(x), sp.exp(-x),
    sp.Matrix([[x, y], [k, 1]]), sp.Subs(sp.Derivative(F(x), x), x, y + 1), sp.log(x), sp.atan2(x, y), sp.oo,
    sp.Sum(x**k, (k, 0, 3)), F(x).diff(x, 2), sp.Function("f_1")(x, y), sp.floor(x), x * sp.cos(x) ** 2,
]  # fmt: skip


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
def test_mathml_of_every_form_is_well_formed(expression):
    found = mathml(latex(expression, {}), display=True)
    assert ElementTree.fromstring(found).tag == "math"


@pytest.mark.parametrize(
    "glyph", ["x^*_1", r"\|\bar x - x^*\|", r"\tilde\tau", r"\|d\|_{[t_0,\tau]}", r"V(x_0)", r"E_{12}", r"F(x^*)"]
)
def test_mathml_of_glyphs(glyph):
    assert mathml(glyph).startswith("<math")


@pytest.mark.parametrize("sign", [le, ge, gt, lt, lambda a, b: Relation(a, "!=", b), eq])
def test_mathml_of_every_sign(sign):
    assert ElementTree.fromstring(mathml(lines(sign(x, y))[0])).tag == "math"


def test_limits_go_below():
    assert "<munder>" in mathml(latex(sp.Limit(F(x), x, 0), {}))


def test_a_function_keeps_its_distance():
    assert "mspace" in mathml(latex(k * sp.cos(x), {}))


@pytest.mark.parametrize("source", [r"\frac{", r"\left(", r"x^", "a & b", r"\nonsense{<script>}"])
def test_bad_latex_is_shown_and_escaped(source):
    found = mathml(source)
    assert "<script" not in found
    ElementTree.fromstring(found)


@pytest.mark.parametrize(
    "long",
    [
        sp.Add(*(sp.sin(n * x) ** n / (y + n) for n in range(1, 30))),
        sp.Matrix([[sp.log(x) ** n / (y + n), sp.Add(*(x**k * sp.cos(n * y) for k in range(9)))] for n in range(6)]),
        sp.Matrix([[x], [sp.Add(*((-1) ** n * sp.exp(-n * x) / (y + n) for n in range(20)))]]),
    ],
)
def test_what_is_long_is_as_wide_as_its_parts(long: sp.Basic) -> None:
    whole = latex(long, {})
    assert len(whole) > 250
    assert _wide(long, whole, {}) == pytest.approx(width(whole))
