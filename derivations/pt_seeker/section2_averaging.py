"""Section 2.1: singularly perturbed Lie bracket averaging."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average
from ptproof.proof import (
    Evidence,
    Goal,
    Prose,
    cited,
    claim,
    definition,
    eq,
    every,
    exact,
    integrals,
    le,
    refute,
)
from ptproof.system import DitherSystem, System, lie_bracket

from .notation import mu, omega, rate_of, tau, tau_fast, x1, x2, z

SECTION = "2 Preliminaries"

# --- 2.1 Singularly perturbed Lie bracket averaging, for two slow states, one fast state and two dithers ------------

position = (x1, x2)
phase = sp.Symbol("phi", real=True)
slow = mu * tau_fast  # the paper's τ̄
b = [tuple(sp.Function(f"b{i}{j}", real=True)(slow, x1, x2, z) for j in (1, 2)) for i in (0, 1, 2)]
u = [sp.Function(f"u{i}", real=True)(slow, omega * slow) for i in (1, 2)]
g = sp.Function("g", real=True)(x1, x2, z)
l = sp.Function("l", real=True)(x1, x2)  # noqa: E741 - the paper's letter
y = sp.Symbol("y_tilde", real=True)


def _slow_rate(root: sp.Expr, steady: sp.Expr = z) -> sp.ImmutableDenseMatrix:
    """μ b₀ + μ √(root) Σ bᵢ uᵢ at z = steady."""
    rate = mu * sp.Matrix(b[0]) + mu * sp.sqrt(root) * (sp.Matrix(b[1]) * u[0] + sp.Matrix(b[2]) * u[1])
    return sp.ImmutableDenseMatrix(rate.subs(z, steady))


general_system = definition(
    "2.1/general-system",
    "Slow and fast states with dithers",
    every(
        eq(sp.Matrix([rate_of("x_1", tau_fast), rate_of("x_2", tau_fast)]), _slow_rate(omega)),
        eq(rate_of("z", tau_fast), g),
    ),
    labels=["eq:general_nominal_system"],
    prose="The class of systems that the theorem speaks of, written here for n = 2, m = 1 and N = 2; the rates are "
    "those in the fast time, and the slow time is μ times it.",
)


def _general() -> System:
    return System(tau_fast, (x1, x2, z), (*_slow_rate(omega), g), name="general system")


@claim(
    "2.1/boundary-layer",
    "The boundary layer model",
    eq(
        g.subs(z, y + l),
        _general().derivative_along(z - l).subs(z, y + l).subs(mu, 0),
    ),
    labels=["eq:boundary_layer_model"],
)
def boundary_layer(goal: Goal) -> Evidence:
    """The deviation ỹ = z − l(x) is differentiated along the general system, z is replaced by ỹ + l(x), and μ is
    set to 0: the terms with the slow rates vanish, and g(x, ỹ + l(x)) stays."""
    return exact(goal)


w = sp.Symbol("w", positive=True)
_reduced = _slow_rate(omega, l)


@claim(
    "2.1/reduced-model-printed",
    "The reduced model, as printed",
    eq(_slow_rate(w, l), _reduced),
    labels=["eq:reduced_model"],
    expected="refuted",
)
def reduced_model_printed(goal: Goal) -> Evidence:
    """The printed right-hand side carries √w, with a letter that is introduced nowhere, where substituting z = l(x)
    in the slow rates gives √ω. Read as a letter of its own, the equation is false as soon as w differs from ω."""
    # One constant field and one constant dither are enough to see the root.
    fields = {entry.func(tau, *position, z): sp.Integer(entry == b[1][0]) for field in b for entry in field}
    dithers = {entry.func(tau, phase): sp.Integer(entry == u[0]) for entry in u}
    numbers = {mu: 1, w: 1, omega: 4, tau_fast: 0, x1: 0, x2: 0}
    values = {**fields, **dithers, l: 0, **numbers}
    return refute(goal, values)


@claim(
    "2.1/reduced-model",
    "The reduced model",
    eq(_general().vector[:2, 0].subs(z, l), _slow_rate(omega, l)),
    labels=["eq:reduced_model"],
    corrects=reduced_model_printed,
)
def reduced_model(goal: Goal) -> Evidence:
    """On the quasi-steady state z = l(x) the slow rates of the general system are the reduced model, with √ω."""
    return exact(goal)


_fields = tuple(tuple(sp.Function(f"b{i}{j}", real=True)(tau, x1, x2) for j in (1, 2)) for i in (0, 1, 2))
_dithers = (sp.cos(phase), sp.sin(phase))
_general_average = average(DitherSystem(tau, phase, omega, position, _fields[0], _fields[1:], _dithers))
_s, _theta = sp.symbols("s vartheta", real=True)


def iterated_integral(outer: sp.Expr, inner: sp.Expr, period: sp.Expr = 2 * sp.pi) -> sp.Expr:
    """v_ji = (1/T_f) ∫₀^{T_f} u_j(θ) ∫₀^θ u_i(s) ds dθ, unevaluated, for dithers given in the phase."""
    inside = sp.Integral(inner.subs(phase, _s), (_s, 0, _theta))
    return sp.Integral(outer.subs(phase, _theta) * inside, (_theta, 0, period)) / period


@claim(
    "2.1/lie-bracket-system",
    "The Lie bracket system of arbitrary fields under cosine and sine",
    eq(
        sp.Matrix(_fields[0]) + sp.Matrix(lie_bracket(_fields[1], _fields[2], position)) / 2,
        _general_average.vector,
    ),
    labels=["eq:Lie_Bracket_System"],
)
def lie_bracket_system(goal: Goal) -> Evidence:
    """The averaging engine applied to two arbitrary smooth fields gives b₀ + [b₁, b₂] v₂₁, the printed sum for N = 2
    with v₂₁ = 1/2. The period is written T in the paper's formula for v_ji, the letter of the prescribed time; it is
    read as the period T_f of Assumption 1, and the sum as one over all pairs i < j."""
    return exact(goal)


@claim(
    "2.1/iterated-integrals",
    "v_ji of the dithers cos and sin",
    every(
        eq(iterated_integral(sp.sin(phase), sp.cos(phase)), sp.Rational(1, 2)),
        eq(iterated_integral(sp.cos(phase), sp.sin(phase)), -sp.Rational(1, 2)),
        eq(iterated_integral(sp.cos(phase), sp.cos(phase)), 0),
        eq(iterated_integral(sp.sin(phase), sp.sin(phase)), 0),
    ),
    place="Section 2.1",
)
def iterated_integrals(goal: Goal) -> Evidence:
    """v₂₁ = 1/2 is the constant that multiplies the bracket; v₁₂ = −v₂₁ and v_ii = 0 because the means vanish."""
    return integrals(goal)


_alpha = [sp.Function(f"alpha{i}", real=True)(sp.Symbol("s", nonnegative=True)) for i in (1, 2, 3)]
_Vy = sp.Function("V", real=True)(y)

blm_requirements = definition(
    "2.1/boundary-layer-requirements",
    "What is asked of the boundary layer",
    every(
        le(sp.Function("alpha1")(sp.Abs(y)), _Vy),
        le(_Vy, sp.Function("alpha2")(sp.Abs(y))),
        le(sp.Derivative(_Vy, y) * g.subs(z, y + l), -sp.Function("alpha3")(sp.Abs(y))),
    ),
    labels=["eq:blm_req_1", "eq:blm_req_2"],
    prose="Two class-K∞ bounds and a class-K rate of decrease; Step 5 shows them for the seeker's boundary layer.",
)

averaging_theorem = claim(
    "2.1/averaging-theorem",
    "Theorem 1: singularly perturbed Lie bracket averaging",
    Prose(
        "If Assumption 1 holds, a compact set is globally uniformly asymptotically stable for the Lie bracket system, "
        "and the boundary layer has a Lyapunov function as required, then the set is singularly semi-globally "
        "practically uniformly asymptotically stable for the general system"
    ),
    expected="cited",
    place="Theorem 1",
)(cited("Dürr, Krstić, Scheinker, Ebenbauer: singularly perturbed Lie bracket approximation; the paper's Theorem 1"))
