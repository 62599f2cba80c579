"""What engines say, in the letters of the paper."""

import pytest
import sympy as sp

from ptproof.proof.statement import eq, ge
from ptproof.report.spoken import Letters, plain, spoken

LETTERS = {"xs1": "x∗₁", "tau": "τ", "gap": "g", "E_norm": "‖E‖", "x1": "x₁"}


@pytest.mark.parametrize(
    ("source", "text"),
    [
        (r"x^*_1", "x∗₁"), (r"\tilde{\tau}", "τ̃"), (r"\|\nabla F\|", "‖∇F‖"),
        (r"\Vert d\Vert _{[t_0,\tau]}", "‖d‖_[t₀,τ]"), (r"\nu_{\min}", "νₘᵢₙ"), ("T_f", "T_f"),
        (r"\mathrm{gap}", "gap"), (r"\dot{V}", "V̇"), (r"c_{\kappa_{1}}", "c_κ₁"),
    ],
)  # fmt: skip
def test_a_letter_as_plain_text(source, text):
    assert plain(source) == text


@pytest.mark.parametrize(
    ("said", "written"),
    [
        ("F(xs1, x1) >= 0", "F(x∗₁, x₁) ≥ 0"),
        ("a gap is left, gap >= 0", "a gap is left, g ≥ 0"),
        ("where gap, or (gap)", "where gap, or (g)"),
        ("2*tau**2 != 0", "2·τ² ≠ 0"),
        ("x1**(1/2)", "x₁^(1/2)"),
        ("x1**2/4 != 0", "x₁²/4 ≠ 0"),
        ("sqrt(tau)/2 + sqrt(2*tau)", "√τ/2 + √(2·τ)"),
        ("Derivative(F(x1), x1)**2 > 0", "(∂F(x₁)/∂x₁)² > 0"),
        ("Derivative(F(x1), (x1, 2), tau)", "∂³F(x₁)/∂x₁²∂τ"),
        ("Subs(Derivative(F(x1), x1), x1, 0)", "[∂F(x₁)/∂x₁]|_x₁ = 0"),
        ("Derivative(F(x1)", "Derivative(F(x₁)"),
        ("at E_norm = 0", "at ‖E‖ = 0"),
        ("with 5/step-tau and tau", "with 5/step-tau and τ"),
        ("nobody.py", "nobody.py"),
        ("2 parts", "2 parts"),
        ("tau_0 = pi/2, v2 = 1", "τ₀ = π/2, v2 = 1"),
    ],
)
def test_names_become_letters_where_they_are_letters(said, written):
    assert spoken(said, LETTERS, ["5/step-tau"]) == written


def test_the_letters_are_those_of_the_notation_and_of_the_statement():
    x, tau, F = sp.Symbol("x", real=True), sp.Symbol("tau", real=True), sp.Function("F_e")
    names = {x: r"\bar x"}
    assert Letters(names).of([]) == {"x": "x̅"}
    assert Letters(names).of([ge(F(x), 0), eq(tau, x)]) == {"x": "x̅", "tau": "τ", "F_e": "Fₑ"}
