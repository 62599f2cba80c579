"""Beyond the paper: below the gain k = 2‖E‖ the average escapes, for κ ≥ 2.

The field is F = −‖x‖^(2κ) with κ = n + 1, for which a₁ = a₂ = 1 and b₁ = b₂ = 2κ, so that c₁ = c₂ = 2κ; the drift is
−‖E‖∇F, which points away from the source.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    ForAll,
    Goal,
    claim,
    eq,
    every,
    exact,
    exists_by,
    ge,
    gt,
    le,
    limits,
    lt,
    power_positive,
    reals,
    specialise,
)
from ptproof.system import gradient

from . import chain
from .notation import E_norm, F, T, a1, a2, b1, b2, c, f, k, position, q, t0, tau
from .section5b_0_trajectory import s
from .section5b_1_lyapunov import n
from .section9_1_gain import Z, alpha, beta, elapsed, integrated_rate

SECTION = "Beyond the paper"

order = n + 1
field = -((position[0] ** 2 + position[1] ** 2) ** order)
slope = gradient(field, position)
radial = chain.averaged_tau.with_values({F: field, f[0]: -E_norm * slope[0], f[1]: -E_norm * slope[1]})

square = position[0] ** 2 + position[1] ** 2
# The gradient as a polynomial in x and ‖x‖², which it is at the source, too.
steep = sp.Matrix([-2 * order * entry * square**n for entry in position])
steepness = sp.sqrt(steep.dot(steep))
field_distance = sp.sqrt(square)
constants = {a1: 1, a2: 1, b1: 2 * order, b2: 2 * order}


@claim(
    "beyond/escape-gradient", "The gradient of F = −‖x‖^(2κ) is −2κ‖x‖^(2κ − 2)x",
    eq(sp.Matrix([sp.Derivative(field, entry) for entry in position]), steep), given=[gt(square, 0)],
)  # fmt: skip
def escape_gradient(goal: Goal) -> Evidence:
    """The chain rule, away from the source, where both sides are 0."""
    return reals(goal)


@claim(
    "beyond/escape-field", "The field of the escape satisfies Assumption 2 for κ = n + 1, its source at the origin",
    Exists(
        tuple(constants),
        (
            le(-a1 * field_distance ** (2 * order), field), le(field, -a2 * field_distance ** (2 * order)),
            le(b1 * field_distance ** (2 * order - 1), steepness),
            le(steepness, b2 * field_distance ** (2 * order - 1)),
        ),
        over=position,
    ),
    labels=["eq:assumption2", "eq:assumption3"], uses=[escape_gradient],
)  # fmt: skip
def escape_field(goal: Goal) -> Evidence:
    """With a₁ = a₂ = 1 and b₁ = b₂ = 2κ, all four as equalities."""
    return exists_by(goal, constants)


@claim(
    "beyond/escape-constants", "With these constants c₁ = c₂ = 2κ, and eq:ass4 holds with equality on both sides",
    every(*(eq(c(index, order).subs(constants) * (-field) ** q(order), steepness) for index in (1, 2))),
    labels=["eq:ass4"], uses=[escape_field],
)  # fmt: skip
def escape_constants(goal: Goal) -> Evidence:
    """V^q = ‖x‖^(2κ − 1), of which the gradient is 2κ times the size. So what is lost elsewhere between c₁ and c₂ is
    not lost here, and the printed threshold for the gain is k = 2‖E‖, too."""
    return reals(goal)


# The coordinates are turned so that the vehicle starts at the right of the source; the motion is along a ray.
X = (sp.Function("X1", positive=True), sp.Function("X2", real=True))


def along(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """The expression on a trajectory X of the average."""
    moved = {position[0]: X[0](time), position[1]: X[1](time), tau: time}
    return expression.subs(moved, simultaneous=True)


def squared(time: sp.Expr) -> sp.Expr:
    """‖X‖²."""
    return X[0](time) ** 2 + X[1](time) ** 2


def excess(time: sp.Expr) -> sp.Expr:
    """‖E‖/(1 + (τ − t₀)/T)² − k/2: by how much the drift is stronger than the feedback."""
    return E_norm / (1 + (time - t0) / T) ** 2 - k / 2


moves = tuple(eq(sp.Derivative(X[i](s), s), along(radial.rhs[i], s)) for i in (0, 1))


@claim(
    "beyond/escape-radius", "How the squared distance moves on the average",
    eq(sp.Derivative(squared(s), s), 4 * order * excess(s) * squared(s) ** order),
    given=[*moves, ge(s, t0)],
)  # fmt: skip
def radius(goal: Goal) -> Evidence:
    """Radially: the sign is that of the drift's term against the feedback's."""
    return reals(goal)


@claim(
    "beyond/escape-bernoulli", "‖X‖^(−2n) moves at a rate that depends on time only",
    eq(sp.Derivative(squared(s) ** -n, s), -4 * n * order * excess(s)),
    given=[*moves, ge(s, t0)],
)  # fmt: skip
def bernoulli(goal: Goal) -> Evidence:
    """Bernoulli's substitution."""
    return reals(goal)


on = (ge(s, t0), le(s, tau))
trajectory = tuple(ForAll((s,), relation, on) for relation in moves)


def work(duration: sp.Expr) -> sp.Expr:
    """The integral of the excess over the time ``duration`` from the start."""
    return E_norm * T * duration / (T + duration) - k / 2 * duration


@claim(
    "beyond/escape-start", "A trajectory of this average that exists until τ started close enough to the source",
    lt(4 * n * order * work(elapsed) * squared(t0) ** n, 1), given=[ge(tau, t0), *trajectory],
    uses=[bernoulli, integrated_rate],
)  # fmt: skip
def start_of_survivors(goal: Goal) -> Evidence:
    """‖X‖^(−2n) is positive at τ, and it is at most ‖x₀‖^(−2n) − 4nκ∫(‖E‖/(1 + (s − t₀)/T)² − k/2)ds. So whoever starts
    farther out has no trajectory until τ."""
    rates = {Z(s): squared(s) ** -n, alpha: -4 * n * order * E_norm, beta: -2 * n * order * k}
    positive = [power_positive(squared(time), -n) for time in (t0, tau)]
    return reals(goal, *specialise(goal, integrated_rate, rates), *positive)


# --- The trajectory that escapes --------------------------------------------------------------------------------------

start, ray = sp.symbols("r_0 r", positive=True)
on_ray = {position[0]: ray, position[1]: 0}


@claim(
    "beyond/escape-ray", "A vehicle at (r, 0) moves along the ray on the average",
    eq(sp.Matrix([2 * order * excess(tau) * ray ** (2 * order - 1), 0]),
       radial.vector.subs(on_ray, simultaneous=True)),
    given=[ge(tau, t0)],
)  # fmt: skip
def along_ray(goal: Goal) -> Evidence:
    """So a solution of the scalar equation for r is a trajectory of the average."""
    return exact(goal)


left = 1 - 4 * n * order * work(s - t0) * start ** (2 * n)
distance = start * left ** (-1 / (2 * n))


@claim(
    "beyond/escape-solution", "The distance from the source, explicitly",
    eq(sp.Derivative(distance, s), 2 * order * excess(s) * distance ** (2 * order - 1)),
    given=[ge(s, t0), gt(left, 0)], uses=[along_ray],
)  # fmt: skip
def solution(goal: Goal) -> Evidence:
    """r = r₀(1 − 4nκ r₀^(2n)∫(‖E‖/(1 + (s − t₀)/T)² − k/2)ds)^(−1/(2n)), as long as the bracket is positive."""
    return exact(goal)


margin = sp.Symbol("m", positive=True)  # 2‖E‖ − k
below = {E_norm: (k + margin) / 2}
escape_after = T * margin / (2 * k + margin)  # T(2‖E‖ − k)/(2‖E‖ + k)
far = (n * order * T * margin**2 / (2 * k + margin)) ** (-1 / (2 * n))


@claim(
    "beyond/escape", "For every k < 2‖E‖ and κ ≥ 2 there is a start from which this average escapes in finite time",
    eq(sp.Limit(distance.subs(below).subs(start, far), s, t0 + escape_after, "-"), sp.oo),
    uses=[solution, start_of_survivors],
)  # fmt: skip
def escape(goal: Goal) -> Evidence:
    """m = 2‖E‖ − k is the margin by which the gain is too small. The start r₀ is chosen so that the instant of escape
    is t₀ + T(2‖E‖ − k)/(2‖E‖ + k), before T is over in τ."""
    return limits(goal)


@claim(
    "beyond/escape-exists-until", "Until that instant the trajectory exists",
    gt(left.subs(below).subs(start, far), 0), given=[ge(s, t0), lt(s, t0 + escape_after)], uses=[solution],
)  # fmt: skip
def exists_until(goal: Goal) -> Evidence:
    """The bracket decreases from 1 to 0: the drift's term is the larger one all the time."""
    return reals(goal)
