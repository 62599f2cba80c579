"""A claim's restatement for Coq, without Coq: names, terms, what has to be defined, declarations and assumptions."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

from ptproof.proof import claim, eq, exact, ge, gt, le, lt
from ptproof.proof.kernel import coq
from ptproof.proof.kernel.names import WORDS, identifiers
from ptproof.proof.kernel.obligations import obligations
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.statement import Exists, ForAll, every

x, y, s = sp.symbols("x y s", real=True)
a, b = sp.symbols("a b", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
V = sp.Function("V", positive=True)
F = sp.Function("F", real=True)
NAMES: dict[Any, str] = {x: "x", y: "y", s: "s", a: "a", b: "b", n: "n", V: "V", F: "F"}


def text(statement: Any, **options: Any) -> str:
    """The proposition in one line."""
    return " ".join(proposition(claim("id", "A claim", statement, **options)(exact)).text.split())


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (x**2 - y, "((x ^ 2) - y)"),
        (x / (2 * y**2), "(x / (2 * (y ^ 2)))"),
        (-x, "(- x)"),
        (sp.Rational(-3, 10), "((-3) / 10)"),
        (sp.sqrt(a) ** 3, "((sqrt a) ^ 3)"),
        (1 / sp.sqrt(a), "(/ (sqrt a))"),
        (a**n, "(Rpower a n)"),
        (x**n, "(rpow x n)"),
        (a ** (-n), "(/ (Rpower a n))"),
        (sp.exp(x) * sp.pi, "(PI * (exp x))"),
        (sp.Max(x, y), "(Rmax x y)"),
        (sp.Piecewise((1, x < y), (2, True)), "(if Rlt_dec x y then 1 else 2)"),
        (sp.Derivative(V(s), s), "(Derive (fun s => (V s)) s)"),
        (sp.Derivative(F(x, y), x, y), "(Derive (fun y => (Derive (fun x => (F x y)) x)) y)"),
        (sp.Integral(x * s, (s, 0, y)), "(RInt (fun s => (s * x)) 0 y)"),
        (sp.Subs(V(s), s, x + 1), "((fun s => (V s)) (x + 1))"),
    ],
)
def test_a_term(expression: sp.Basic, expected: str) -> None:
    assert term(expression, NAMES) == expected


@pytest.mark.parametrize(
    "expression",
    [sp.Float("0.5") * x, sp.I * x, sp.gamma(x), sp.Symbol("z"), sp.oo, sp.Piecewise((1, x < y)), sp.Limit(x, x, 0)],
)
def test_what_has_no_translation(expression: sp.Basic) -> None:
    with pytest.raises(NoTranslation):
        term(expression, NAMES)


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (x + y * sp.sin(x), []),
        (1 / x, ["x <> 0"]),
        (1 / (x - y) ** 2, ["(x - y) <> 0"]),
        (sp.sqrt(x), ["0 <= x"]),
        (1 / sp.sqrt(x), ["0 < x"]),
        (sp.log(x), ["0 < x"]),
        (sp.tan(x), ["(cos x) <> 0"]),
        (a**n, ["0 < a"]),
        (x**n, ["(0 < x \\/ (x = 0 /\\ 0 < n))"]),
        (sp.Piecewise((1 / x, x > 0), (1, True)), ["(x > 0 -> x <> 0)"]),
        (sp.Piecewise((1, x > 0), (1 / x, True)), ["(~ (x > 0) -> x <> 0)"]),
        (sp.Derivative(1 / s, s), ["locally s (fun s => s <> 0)", "ex_derive (fun s => (/ s)) s"]),
        (
            sp.Integral(1 / s, (s, 1, x)),
            ["(forall s : R, Rmin 1 x <= s <= Rmax 1 x -> s <> 0)", "ex_RInt (fun s => (/ s)) 1 x"],
        ),
        (sp.Subs(1 / s, s, x + 1), ["((fun s => s <> 0) (x + 1))"]),
    ],
)
def test_what_has_to_be_defined(expression: sp.Basic, expected: list[str]) -> None:
    assert [part.text for part in obligations(expression, NAMES)] == expected


def test_definedness_is_part_of_what_is_claimed() -> None:
    assert text(eq(x * (1 / x + 1), 1 + x)).endswith("x <> 0 /\\ (x * (1 + (/ x))) = (x + 1)")


def test_where_defined_makes_it_a_hypothesis() -> None:
    assert "x <> 0 -> (x *" in text(eq(x * (1 / x + 1), 1 + x), where_defined=True)


def test_an_assumption_allows_only_where_it_is_defined() -> None:
    assert text(gt(x, 0), given=[gt(1 / x, 0)]) == "forall x : R, x <> 0 -> (/ x) > 0 -> x > 0"


def test_declarations_are_hypotheses() -> None:
    assert text(gt(n * a, 0)) == "forall a n : R, 0 < a -> 0 < n -> is_integer n -> (a * n) > 0"


def test_a_quantified_assumption_is_quantified() -> None:
    given = ForAll((s,), le(V(s), s), (ge(s, x),))
    assert "(forall s : R, s >= x -> ((V s) <= s))" in text(le(V(x), x), given=[given])


def test_a_function_has_its_sign_where_it_is_applied() -> None:
    assert "(forall x : R, 0 < (V x))" in text(gt(V(x), 0))
    assert "(forall a : R, 0 < a -> 0 < (V a))" in text(gt(V(a), 0))
    assert "-> 0 < (V (a - b)) ->" in text(gt(V(a - b), 0))


def test_a_choice_comes_after_what_it_may_depend_on() -> None:
    statement = Exists((a,), (gt(a * x**2, y),), (x,))
    assert text(statement) == "forall y : R, (exists a : R, 0 < a /\\ (forall x : R, ((a * (x ^ 2)) > y)))"


def test_what_is_assumed_of_what_comes_after_a_choice_stands_inside() -> None:
    statement = Exists((a,), (gt(a * x**2, y),), (x,))
    said = "forall b y : R, 0 < b -> y > 0 -> (exists a : R, 0 < a /\\ (forall x : R, x >= b -> ((a * (x ^ 2)) > y)))"
    assert text(statement, given=[ge(x, b), gt(y, 0)]) == said


def test_what_is_chosen_is_not_restricted_by_an_assumption_of_a_letter_of_its_name() -> None:
    with pytest.raises(NoTranslation, match="what exists and what comes after"):
        text(Exists((a,), (gt(a * x**2, y),), (x,)), given=[ge(x, a)])


def test_a_limit_is_of_a_function_that_is_defined_near_the_place() -> None:
    said = text(eq(sp.Limit(1 / x, x, sp.oo), 0))
    assert (
        said
        == "(Rbar_locally p_infty) (fun x => x <> 0) /\\ filterlim (fun x => (/ x)) (Rbar_locally p_infty) (locally 0)"
    )


@pytest.mark.parametrize("name", ["lambda", "fun", "forall", "R", "sin", "x'", "a b", "λ", "1/nu", "", "PI", "exists"])
def test_names_mean_nothing_to_coq(name: str) -> None:
    symbol = sp.Symbol(name, real=True)
    (chosen,) = identifiers([symbol]).values()
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", chosen)
    assert chosen not in WORDS


def test_one_name_with_two_declarations_is_two_names() -> None:
    items = [
        sp.Symbol("x", real=True),
        sp.Symbol("x", positive=True),
        sp.Function("x", real=True),
        sp.Symbol("x'", real=True),
    ]
    assert len(set(identifiers(items).values())) == 4


def test_a_function_and_a_symbol_of_one_name_stay_apart() -> None:
    v = sp.Symbol("V", positive=True)
    assert text(gt(V(x) + v, 0)).startswith("forall V : R -> R, forall V_2 x : R,")


@pytest.mark.parametrize(
    "statement",
    [
        eq(sp.Symbol("z"), 1),
        eq(sp.Function("f")(x), 1),
        eq(sp.Limit(x, x, 0) + 1, 1),
        every(lt(x, 1), eq(sp.Symbol("w", positive=True) * sp.Symbol("z", complex=True), 1)),
    ],
)
def test_a_claim_without_a_translation_is_refused(statement: Any) -> None:
    with pytest.raises(NoTranslation):
        proposition(claim("id", "A claim", statement)(exact))


def test_no_name_of_the_library_is_given_twice() -> None:
    folder = Path(coq.__file__).parent / "theory"
    text = "\n".join((folder / f"{name}.v").read_text(encoding="utf-8") for name in coq.LIBRARY)
    names = re.findall(r"^(?:Ltac|Lemma|Definition|Theorem|with) (\w+)(?![^.]*?::=)", text, re.MULTILINE)
    assert len(names) > 100
    assert {name for name in names if names.count(name) > 1} == set()
    assert {file.stem for file in folder.glob("*.v")} == set(coq.LIBRARY)
