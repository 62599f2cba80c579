"""Section IV: the averaged gradient seeker linearised, and its eigenvalues."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Relation, claim, eq, every, exact, ge, gt, le, lt, reals, refute

from . import chain
from .notation import F_star, H, J_g, alpha, h, lambda_1, lambda_2, lambda_3, nu, omega_0, rotated

SECTION = "IV Gradient-based source seeking: linearisation"

equilibrium = {rotated[0]: 0, rotated[1]: 0, nu: F_star}
deviation = sp.Matrix([*rotated, nu])


@claim(
    "newton/4-equilibrium", "z̄ = 0, ν̄ = F* is an equilibrium of the averaged system",
    eq(sp.Matrix([0, 0, 0]), chain.gradient_averaged.vector.subs(equilibrium)), place="Section IV",
)  # fmt: skip
def is_equilibrium(goal: Goal) -> Evidence:
    """All rates are zero there."""
    return exact(goal)


@claim(
    "newton/4-linearisation", "The linear system with the matrix J_g",
    eq(J_g * deviation, chain.gradient_averaged.linearization(equilibrium) * deviation),
    labels=["eq:gradient_seeker_lin"], uses=[is_equilibrium],
)  # fmt: skip
def linearisation(goal: Goal) -> Evidence:
    """For every state: J_g is the derivative of the averaged system at its equilibrium. The state of the linear system,
    printed as (z̄, ν̄), is the deviation (z̄, ν̄ − F*)."""
    return exact(goal)


def characteristic(matrix: sp.Matrix, value: sp.Expr) -> sp.Expr:
    """det(J − λI)."""
    return sp.expand((matrix - value * sp.eye(matrix.rows)).det())


def is_root(matrix: sp.Matrix, real: sp.Expr, imaginary: sp.Expr) -> list[Relation]:
    """det(J − λI) = 0 for λ = real ± i·imaginary, by real and imaginary part."""
    a, b = sp.symbols("a b", real=True)
    parts = characteristic(matrix, a + sp.I * b).as_real_imag()
    return [eq(sp.expand(part).subs({a: real, b: imaginary}), 0) for part in parts]


decay = alpha * H / 2
discriminant = decay**2 - (2 * omega_0) ** 2
ROOT = {alpha: 2, H: 4, omega_0: 1, h: 7}


def both(middle: sp.Expr, under_root: sp.Expr) -> list[Relation]:
    """λ₁ and λ₂ as printed: ``middle`` ± √(…)/2."""
    signs = ((lambda_1, 1), (lambda_2, -1))
    return [eq(value, middle + sign * sp.Rational(1, 2) * sp.sqrt(under_root)) for value, sign in signs]


@claim(
    "newton/4-eigenvalues-printed", "λ₁, λ₂ = −αH/2 ± √((αH/2)² − (2ω₀)²)/2 are eigenvalues of J_g",
    every(*(eq(characteristic(J_g, value), 0) for value in (lambda_1, lambda_2))),
    given=[ge(discriminant, 0), *both(-decay, discriminant)], labels=["eq:ev_zbar_grad"],
    uses=[linearisation], expected="refuted", grade="error",
    wrong="The eigenvalues begin with −αH/2 where it is −αH/4.",
    survives="Yes for what is concluded, that convergence depends on H; where the root is imaginary, its rate is half "
    "of what is printed.",
)  # fmt: skip
def eigenvalues_printed(goal: Goal) -> Evidence:
    """Their sum would be −αH, and the trace of that block is −αH/2."""
    return refute(goal, {**ROOT, lambda_1: sp.sqrt(3) - 4, lambda_2: -sp.sqrt(3) - 4})


@claim(
    "newton/4-eigenvalues", "λ₁, λ₂ = −αH/4 ± √((αH/2)² − (2ω₀)²)/2, where they are real",
    every(*(eq(characteristic(J_g, value), 0) for value in (lambda_1, lambda_2))),
    given=[ge(discriminant, 0), *both(-decay / 2, discriminant)], labels=["eq:ev_zbar_grad"], uses=[linearisation],
    corrects=eigenvalues_printed,
)  # fmt: skip
def eigenvalues(goal: Goal) -> Evidence:
    """The roots of λ² + (αH/2) λ + ω₀²."""
    return exact(goal)


@claim(
    "newton/4-eigenvalues-complex", "λ₁, λ₂ have the real part −αH/4 where they are not real",
    every(*is_root(J_g, -decay / 2, sp.sqrt(-discriminant) / 2)), given=[le(discriminant, 0)],
    labels=["eq:ev_zbar_grad"], uses=[linearisation],
)  # fmt: skip
def eigenvalues_complex(goal: Goal) -> Evidence:
    """det(J_g − λI) by real and imaginary part; with λ its conjugate is a root."""
    return exact(goal)


@claim(
    "newton/4-third-eigenvalue", "λ₃ = −h", eq(characteristic(J_g, lambda_3), 0), given=[eq(lambda_3, -h)],
    place="Section IV", uses=[linearisation],
)  # fmt: skip
def third_eigenvalue(goal: Goal) -> Evidence:
    """The filter is alone in the linear part."""
    return exact(goal)


@claim(
    "newton/4-stable", "All eigenvalues have negative real parts",
    every(lt(-decay / 2 + sp.sqrt(discriminant) / 2, 0), gt(h, 0)), given=[ge(discriminant, 0)], place="Section IV",
    uses=[eigenvalues],
)  # fmt: skip
def stable(goal: Goal) -> Evidence:
    """The real ones; the others have the real part −αH/4."""
    return reals(goal)
