"""Section 2.1: singularly perturbed Lie bracket averaging; the Lie bracket system itself is in the next file."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Prose, Smooth, cited, claim, definition, eq, every, exact, le, refute, smooth
from ptproof.system import System

from .notation import mu, omega, rate_of, t, tau, tau_fast, x1, x2, z

SECTION = "2 Preliminaries"

# --- 2.1 Singularly perturbed Lie bracket averaging, for two slow states, one fast state and two dithers ------------

position = (x1, x2)
phase = sp.Symbol("phi", real=True)
slow = mu * tau_fast  # the paper's τ̄
# bᵢ as functions of (τ, x, z).
b = [tuple(sp.Function(f"b{i}{j}", real=True)(tau, x1, x2, z) for j in (1, 2)) for i in (0, 1, 2)]
u = [sp.Function(f"u{i}", real=True)(slow, omega * slow) for i in (1, 2)]
g = sp.Function("g", real=True)(x1, x2, z)
l = sp.Function("l", real=True)(x1, x2)  # noqa: E741 - the paper's letter
y = sp.Symbol("y_tilde", real=True)


def _at_slow_time(row: int, steady: sp.Expr = z) -> list[sp.Expr]:
    """One row of b₀, b₁, b₂ at the slow time, and at z = steady."""
    return [field[row].subs({tau: slow, z: steady}, simultaneous=True) for field in b]


_slow_rates = sp.ImmutableDenseMatrix(
    [
        mu * drift + mu * sp.sqrt(omega) * (first * u[0] + second * u[1])
        for drift, first, second in map(_at_slow_time, (0, 1))
    ]
)

general_system = definition(
    "2.1/general-system",
    "Slow and fast states with dithers",
    every(
        eq(sp.Matrix([rate_of("x_1", tau_fast), rate_of("x_2", tau_fast)]), _slow_rates),
        eq(rate_of("z", tau_fast), g),
    ),
    labels=["eq:general_nominal_system"],
    prose="The class of systems that the theorem speaks of, written here for n = 2, m = 1 and N = 2; the rates are "
    "those in the fast time, and the slow time is μ times it.",
)

general = System(tau_fast, (x1, x2, z), (*_slow_rates, g), name="general system")


@claim(
    "2.1/boundary-layer",
    "The boundary layer model",
    eq(g.subs(z, y + l), sp.Subs(general.derivative_along(z - l).subs(z, y + l), mu, 0)),
    labels=["eq:boundary_layer_model"],
)
def boundary_layer(goal: Goal) -> Evidence:
    """The rate of the deviation ỹ = z − l(x) along the general system, at z = ỹ + l(x), is continuous in μ. At μ = 0
    the terms with the slow rates vanish, and g(x, ỹ + l(x)) stays."""
    return exact(goal)


def _reduced(root: sp.Expr) -> sp.Matrix:
    """μ b₀ + μ √(root) Σ bᵢ uᵢ with l(x) for z, as printed."""
    rows = []
    for row in (0, 1):
        drift, *dithered = _at_slow_time(row, l)
        rows.append(mu * drift + sum(mu * sp.sqrt(root) * field * u[i] for i, field in enumerate(dithered)))
    return sp.Matrix(rows)


w = sp.Symbol("w", positive=True)


@claim(
    "2.1/reduced-model-printed",
    "The reduced model, as printed with √w",
    eq(_reduced(w), _slow_rates),
    given=[eq(z, l)],
    labels=["eq:reduced_model"],
    expected="refuted",
    grade="misprint",
    wrong="The letter w stands under the root where ω is meant.",
    survives="Yes: the reduced model of Section 5 has √ω.",
)
def reduced_model_printed(goal: Goal) -> Evidence:
    """The printed right-hand side carries √w, with a letter that is introduced nowhere, where substituting z = l(x)
    in the slow rates gives √ω. Read as a letter of its own, the equation is false as soon as w differs from ω."""
    # One constant field and one constant dither are enough to see the root.
    fields = {entry: sp.Integer(entry == b[1][0]) for field in b for entry in field}
    dithers = {entry.func(tau, phase): sp.Integer(entry == u[0]) for entry in u}
    numbers = {mu: 1, w: 1, omega: 4, tau_fast: 0, x1: 0, x2: 0, z: 0}
    return refute(goal, {**fields, **dithers, l: 0, **numbers})


@claim(
    "2.1/reduced-model",
    "The reduced model",
    eq(_reduced(omega), _slow_rates),
    given=[eq(z, l)],
    labels=["eq:reduced_model"],
    corrects=reduced_model_printed,
)
def reduced_model(goal: Goal) -> Evidence:
    """Where z is at its quasi-steady state, the rates of the slow states are those of the reduced model, with √ω."""
    return exact(goal)


# --- Assumption 1B, one letter of it --------------------------------------------------------------------------------


@claim(
    "2.1/mixed-derivative-printed",
    "Assumption 1B bounds ∂²b/∂t∂z, as printed, and so ∂²b/∂τ∂z",
    eq(sp.diff(b[1][0], t, z), sp.diff(b[1][0], tau, z)),
    place="Assumption 1B",
    expected="refuted",
    grade="misprint",
    wrong="The second mixed derivative is written with t, which is not an argument of b; τ is meant, as in the first.",
    survives="Yes: the bound is used, and holds, with τ.",
)
def mixed_derivative_printed(goal: Goal) -> Evidence:
    """b is a function of (τ, x, z). A derivative of it by another letter is 0, and a bound of that says nothing."""
    return refute(goal, {b[1][0]: tau * z, tau: 0, x1: 0, x2: 0, z: 0})


# --- What Theorem 1 asks of the boundary layer ------------------------------------------------------------------------

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


@claim(
    "2.1/layer-function-printed",
    "|ỹ|, which is continuous and lies between class-K∞ functions, has the derivative that is asked for",
    Smooth((sp.Abs(y),), (y,), 1),
    place="Theorem 1",
    expected="refuted",
    grade="misprint",
    wrong="V is taken continuous only, but its derivative is used; V in C¹ is meant.",
    survives="Yes: Step 5 takes ỹ²/2, which is smooth.",
)
def layer_function_printed(goal: Goal) -> Evidence:
    """V ∈ C admits V = |ỹ|. It has no derivative at 0, so that the second requirement has no meaning there."""
    return smooth(goal)


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
