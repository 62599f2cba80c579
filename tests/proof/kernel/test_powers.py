"""Powers, norms and angles before Coq's kernel: what is true is confirmed, its corrupted twin is not."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import claim, eq, exact, ge, le, lt
from ptproof.proof.claim import Claim
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y, u, v = sp.symbols("x y u v", real=True)
a, b, s = sp.symbols("a b s", positive=True)
c, d = sp.symbols("c d", nonnegative=True)
m = sp.Symbol("m", integer=True, positive=True)
F = sp.Function("F", real=True)
G = sp.Function("G", real=True)
norm = sp.Symbol("N", nonnegative=True)


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def root(base: sp.Expr) -> sp.Expr:
    return base ** (1 / (2 * m))


def decayed(start: sp.Expr) -> sp.Expr:
    return start / root(1 + a * start ** (2 * m))


def at_infinity(expression: sp.Expr, value: Any) -> Any:
    return eq(sp.Limit(expression, s, sp.oo), value)


F1, F2 = F(x / (1 + 1 / a), y), G(x / (1 + 1 / a), y)
H1, H2 = F(a * x / (a + 1), y), G(a * x / (a + 1), y)
DERIVATIVE = sp.Derivative(F(x, y), x), sp.Derivative(F(x, y), y)
INNER = sp.Integral(sp.cos(u), (u, 0, v))

TRUE = [
    stated("growth", lt(b * s ** (1 / (2 * m)), b * c ** (1 / (2 * m))), given=[lt(s, c)]),
    stated("growth-from-0", le(root(c), root(d)), given=[le(c, d)]),
    stated("decayed", le(decayed(c), decayed(d)), given=[le(c, d)]),
    stated("decayed-uniformly", le(decayed(c), 1 / root(a))),
    stated("root-decays", at_infinity(a / root(1 + b * s), 0)),
    stated("root-of-what-decays", at_infinity((c / (1 + s)) ** (1 / m), 0)),
    stated("negative-power", at_infinity((s - x) ** (-1 / (2 * m)), 0)),
    stated("norms", le(x * u + y * v, sp.sqrt(x**2 + y**2) * sp.sqrt(u**2 + v**2))),
    stated("same-calls", le(F1 * u + F2 * v, sp.sqrt(H1**2 + H2**2) * sp.sqrt(u**2 + v**2))),
    stated("norm-as-symbol", le(-a * (x * u + y * v), a * norm * sp.sqrt(u**2 + v**2)),
           given=[eq(norm, sp.sqrt(x**2 + y**2))]),
    stated("iterated", eq(sp.Integral(sp.sin(v) * INNER, (v, 0, 2 * sp.pi)), sp.pi)),
    stated("several-derivatives", eq(x * DERIVATIVE[0] + y * DERIVATIVE[1], y * DERIVATIVE[1] + x * DERIVATIVE[0])),
]  # fmt: skip
NOT_CONFIRMED = [
    stated("growth-of-nothing", lt(b * s ** (1 / (2 * m)), b * c ** (1 / (2 * m))), given=[le(s, c)]),
    stated("growth-reversed", le(root(d), root(c)), given=[le(c, d)]),
    stated("decayed-strictly", lt(decayed(c), decayed(d)), given=[le(c, d)]),
    stated("decayed-above", ge(decayed(c), 1 / root(a))),
    stated("root-decays-to-1", at_infinity(a / root(1 + b * s), 1)),
    stated("root-of-what-stays", at_infinity((c + 1 / (1 + s)) ** (1 / m), 0)),
    stated("root-of-a-negative", at_infinity((x / (1 + s)) ** (1 / m), 0)),
    stated("positive-power", at_infinity((s - x) ** (1 / (2 * m)), 0)),
    stated("norms-factor", le(2 * (x * u + y * v), sp.sqrt(x**2 + y**2) * sp.sqrt(u**2 + v**2))),
    stated("other-calls", le(F1 * u + F2 * v, sp.sqrt(H1**2 + F2**2) * sp.sqrt(u**2 + F(a * x, y) ** 2))),
    stated("iterated-twice", eq(sp.Integral(sp.sin(v) * INNER, (v, 0, 2 * sp.pi)), 2 * sp.pi)),
    stated("derivatives-exchanged", eq(x * DERIVATIVE[0] + y * DERIVATIVE[1], y * DERIVATIVE[0] + x * DERIVATIVE[1])),
]
