"""Substitutions, instances of assumptions, chain rules and solutions before Coq's kernel: each with a false twin."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import ForAll, claim, eq, every, exact, ge, gt, le, lt
from ptproof.proof import smooth as engine
from ptproof.proof.claim import Claim
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.statement import Smooth
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

EFFORT = "thorough"
x, y, s, t, p, q = sp.symbols("x y s t p q", real=True)
a, b = sp.symbols("a b", positive=True)
d, m, n = sp.symbols("d m n", nonnegative=True)
e = sp.Symbol("e", positive=True, integer=True)
G, H = (sp.Function(name, real=True) for name in "GH")
Y, Z = (sp.Function(name, real=True) for name in "YZ")
SHIFT = (s - x) / (1 - (s - x) / a)


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def put(expression: sp.Expr, **values: sp.Expr) -> sp.Expr:
    """The expression with values for symbols of these names, not carried out."""
    symbols = [symbol for symbol in expression.free_symbols if symbol.name in values]
    return sp.Subs(expression, symbols, [values[symbol.name] for symbol in symbols])


def slope(function: Any, first: sp.Expr, second: sp.Expr, number: int) -> sp.Expr:
    """The derivative of a function of two arguments by one of them, at a place."""
    letter = (x, y)[number]
    inner = function(letter, second) if number == 0 else function(first, letter)
    return sp.Subs(sp.Derivative(inner, letter), letter, (first, second)[number])


MOVED = x + SHIFT
INVERSE = put(x + (y - x) / (1 + (y - x) / a), y=MOVED)
BETWEEN = [ge(s, x), lt(s, x + a)]
SQUARES = x**2 + y**2
POWER = ForAll((x, y), le(a * SQUARES**e, G(x, y)))
ALONG = sp.Derivative(G(Y(t), Z(t)), t)
CHAIN = slope(G, Y(t), Z(t), 0) * sp.Derivative(Y(t), t) + slope(G, Y(t), Z(t), 1) * sp.Derivative(Z(t), t)
MEANWHILE = ge(s, p), le(s, t)
EQUATIONS = [
    ge(t, p),
    ForAll((s,), eq(sp.Derivative(Y(s), s), H(s, Y(s), Z(s)) - slope(G, Y(s), Z(s), 0)), MEANWHILE),
    ForAll((s,), eq(sp.Derivative(Z(s), s), -slope(G, Y(s), Z(s), 1)), MEANWHILE),
    ForAll((s, x, y), le(H(s, x, y) ** 2, d**2), (ge(s, p),)),
]
DECAY = [ge(t, p), ForAll((s,), eq(sp.Derivative(Y(s), s), -2 * a * s * Y(s)), MEANWHILE)]
GROWTH = [ge(t, p), ForAll((s,), eq(sp.Derivative(Y(s), s), 2 * s), MEANWHILE)]
LENGTHS = [le(p**2 + q**2, m**2 * (x**2 + y**2))]
POWERS = [le(a * m**e, n), le(n, b * m**e)]

PAIRS: dict[str, tuple[Any, Any, list[Any]]] = {
    "substitution": (eq(INVERSE, s), eq(INVERSE, s + x - 1), BETWEEN),
    "instance": (ge(G(p, q + 1), 0), gt(G(p, q + 1), 0), [POWER]),
    "instance-of-instance": (
        le(H(p, 1, 0), b), le(H(p, 1, 0), b - 1),
        [ForAll((s,), le(H(s, 1, 0), Y(s - 1)), (ge(s, 1),)), ForAll((t,), le(Y(t), b), (ge(t, 0),)), ge(p, 1)],
    ),
    "premise": (le(Y(p + a), b), le(Y(p - a), b), [ForAll((s,), le(Y(s), b), (ge(s, p),))]),
    "chain-rule": (eq(ALONG, CHAIN), eq(ALONG, CHAIN - 1), []),
    "along-equations": (
        le(ALONG, d**2 / 4), le(ALONG, d**2 / 5), EQUATIONS,
    ),
    "solution": (eq(sp.Abs(Y(t)), sp.exp(a * (p**2 - t**2)) * sp.Abs(Y(p))), eq(Y(t), Y(p)), DECAY),
    "integral": (eq(Y(t), Y(p) + t**2 - p**2), eq(Y(t), Y(p) + t**2), GROWTH),
    "cauchy": (le(p * x + q * y, m * (x**2 + y**2)), le(p * x + q * y, m * (x**2 + y**2) / 2), LENGTHS),
    "power-of-0": (
        every(le(a ** (1 / e) * m, n ** (1 / e)), le(n ** (1 / e), b ** (1 / e) * m)), le(n ** (1 / e), a * m), POWERS,
    ),
}  # fmt: skip
TRUE = [stated(name, right, given=given) for name, (right, _, given) in PAIRS.items()]
TRUE += [stated("cauchy-by-lengths", le(p * x + q * y, m * n), given=[le(p**2 + q**2, m**2), eq(n**2, x**2 + y**2)])]
NOT_CONFIRMED = [stated(f"{name}-false", wrong, given=given) for name, (_, wrong, given) in PAIRS.items()]


def test_functions_of_several_arguments_are_smooth() -> None:
    """Of one that is differentiated by its only argument nothing more is said: it may stand for a curve's value."""
    assert "smooth_at 1" in proposition(stated("composed", eq(ALONG, CHAIN))).text
    several, alone = sp.Derivative(G(x, y), x), sp.Derivative(sp.Function("H", real=True)(x), x)
    assert "smooth_at 1" in proposition(stated("several", eq(several, several))).text
    assert "smooth_at" not in proposition(stated("alone", eq(alone, alone))).text
    smooth = claim("smooth", "smooth", Smooth((ALONG,), (t,), 1, ((G(x, y), 2),)))(engine)
    assert "smooth_at 1 (fun p : R * R" not in proposition(smooth).text
