"""Section V.B, Step 3: the inequalities for dV/dt, and that V is a Lyapunov function."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Goal,
    Prose,
    cited,
    claim,
    eq,
    every,
    exact,
    exp_line,
    exp_line_strict,
    ge,
    gt,
    le,
    limits,
    lt,
    reals,
    refute,
    specialise,
)

from .notation import H, V_dot, alpha, b, d_h, lambda_P, norm_G, omega_0, omega_d, z1, z2
from .section5b_2_lyapunov import (
    STEP_3,
    V,
    V_rate,
    derivative_by_G,
    grown,
    least,
    least_positive,
    norm_greatest,
    norm_of_G,
    norm_squared,
    positive_definite,
    quadratic_form,
    square,
    zGz,
    zPz,
)  # fmt: skip

SECTION = "V.B Newton-based source seeking: analysis, Step 3, the inequalities"

# ‖G‖, λ_min(P) and b by their letters, and what the letters stand for.
is_norm, is_least = eq(norm_G**2, norm_squared), eq(lambda_P, least)
is_b = eq(b, norm_G**2 / (2 * lambda_P))
LETTERS = [is_norm, is_least, is_b]
AT = {alpha: 4, omega_0: 1, omega_d: 1, H: 1, norm_G: 1 + sp.sqrt(2)}


@claim(
    "newton/5-G-form", "|z̄ᵀGz̄| ≤ ‖G‖ ‖z̄‖²",
    every(le(zGz, norm_G * square), ge(zGz, -norm_G * square)), given=[is_norm], place=STEP_3,
    uses=[norm_of_G, norm_greatest],
)  # fmt: skip
def form_of_G(goal: Goal) -> Evidence:
    """The paper has the first; the second is what is needed where d̂ < 0."""
    return reals(goal)


@claim(
    "newton/5-b", "b > 0", gt(norm_G**2 / (2 * lambda_P), 0), given=[is_norm, is_least], labels=["eq:b_const"],
    uses=[least_positive],
)  # fmt: skip
def b_positive(goal: Goal) -> Evidence:
    """‖G‖² is at least 2."""
    return reals(goal)


def bound(growth: sp.Expr) -> sp.Expr:
    """The first upper bound of dV/dt, with ``growth`` for the factor of ‖G‖ ‖z̄‖²."""
    first = (-square - b * grown**2) / (1 + zPz)
    return first + (growth * norm_G * square - b * grown**2 * lambda_P * square) / (1 + zPz)


@claim(
    "newton/5-first-bound-printed", "The first upper bound of dV/dt, with (e^d̂ − 1)‖G‖",
    le(V_rate, bound(grown)), given=LETTERS, place=f"{STEP_3}, the first bound", expected="refuted", grade="error",
    wrong="For d̂ < 0 the factor e^d̂ − 1 is negative, and (e^d̂ − 1) z̄ᵀGz̄ is not bounded by (e^d̂ − 1)‖G‖ ‖z̄‖².",
    survives="Yes: with the absolute value of e^d̂ − 1 the bound holds, and so do the ones after it.",
)  # fmt: skip
def first_bound_printed(goal: Goal) -> Evidence:
    """z̄ᵀGz̄ reaches −‖G‖ ‖z̄‖²: at ω₀ = 1, α = 4 in the direction (1, 1 + √2), and there a small negative d̂ is
    enough."""
    lam = least.subs(AT)
    values = {**AT, lambda_P: lam, b: (1 + sp.sqrt(2)) ** 2 / (2 * lam), d_h: sp.log(sp.Rational(1, 2))}
    return refute(goal, {**values, z1: sp.Rational(1, 1000), z2: (1 + sp.sqrt(2)) / 1000})


# The same with one letter for each quadratic form, for ‖z̄‖² and for e^d̂.
q_P, square_of_z = sp.symbols("q_P N", nonnegative=True)
q_G = sp.Symbol("q_G", real=True)
E = sp.Symbol("E", positive=True)
MEANING = {q_P: zPz, q_G: zGz, square_of_z: square, E: sp.exp(d_h), V_dot: V_rate}
by_forms = eq(V_dot, (-square_of_z + (E - 1) * q_G) / (1 + q_P) - b * (E - 1) ** 2)
forms = (
    le(q_G, norm_G * square_of_z), ge(q_G, -norm_G * square_of_z), ge(q_P, lambda_P * square_of_z),
)  # fmt: skip


@claim(
    "newton/5-mixed-by-letters", "(e^d̂ − 1) z̄ᵀGz̄ ≤ |e^d̂ − 1| ‖G‖ ‖z̄‖²",
    le((E - 1) * q_G, sp.Abs(E - 1) * norm_G * square_of_z), given=forms[:2], place=STEP_3,
)  # fmt: skip
def mixed_by_letters(goal: Goal) -> Evidence:
    """Either sign of both factors."""
    return reals(goal)


def bound_by_letters(growth: sp.Expr) -> sp.Expr:
    """The first upper bound in those letters."""
    numerator = -square_of_z - b * (E - 1) ** 2
    return numerator / (1 + q_P) + (growth * norm_G * square_of_z - b * (E - 1) ** 2 * lambda_P * square_of_z) / (
        1 + q_P
    )


@claim(
    "newton/5-first-bound-by-letters", "The first upper bound of dV/dt, by letters",
    le(V_dot, bound_by_letters(sp.Abs(E - 1))), given=[by_forms, *forms], place=STEP_3, uses=[mixed_by_letters],
)  # fmt: skip
def first_bound_by_letters(goal: Goal) -> Evidence:
    """The denominator is positive, and b(e^d̂ − 1)² is multiplied by the bound of z̄ᵀPz̄ from below."""
    return reals(goal)


@claim(
    "newton/5-first-bound", "The first upper bound of dV/dt, with |e^d̂ − 1| ‖G‖",
    le(V_rate, bound(sp.Abs(grown))), given=LETTERS, place=STEP_3,
    uses=[derivative_by_G, form_of_G, quadratic_form, positive_definite, first_bound_by_letters],
    corrects=first_bound_printed,
)  # fmt: skip
def first_bound(goal: Goal) -> Evidence:
    """Both quadratic forms by their bounds."""
    return reals(goal, *specialise(goal, first_bound_by_letters, MEANING))


@claim(
    "newton/5-young", "(e^d̂ − 1)‖G‖ ‖z̄‖² ≤ ‖z̄‖²/2 + (e^d̂ − 1)² ‖G‖² ‖z̄‖²/2",
    every(*(
        le(growth * norm_G * square, square / 2 + grown**2 * norm_G**2 * square / 2)
        for growth in (grown, sp.Abs(grown))
    )),
    place=STEP_3,
)  # fmt: skip
def young(goal: Goal) -> Evidence:
    """As printed, and with the absolute value."""
    return reals(goal)


second_bound_printed = (-square / 2 - b * grown**2) / (1 + zPz) - grown**2 * square * (b * lambda_P - norm_G**2 / 2) / (
    1 + zPz
)


second_by_letters = (-square_of_z / 2 - b * (E - 1) ** 2) / (1 + q_P) - (E - 1) ** 2 * square_of_z * (
    b * lambda_P - norm_G**2 / 2
) / (1 + q_P)


@claim(
    "newton/5-second-bound-by-letters", "The second upper bound is not below the first, by letters",
    le(bound_by_letters(sp.Abs(E - 1)), second_by_letters), place=STEP_3, uses=[young],
)  # fmt: skip
def second_bound_by_letters(goal: Goal) -> Evidence:
    """Both over 1 + z̄ᵀPz̄."""
    return reals(goal)


@claim(
    "newton/5-second-bound", "The second upper bound of dV/dt",
    le(V_rate, second_bound_printed), given=LETTERS, place=STEP_3,
    uses=[first_bound, young, positive_definite, second_bound_by_letters],
)  # fmt: skip
def second_bound(goal: Goal) -> Evidence:
    """The inequality put into the bound with the absolute value."""
    return reals(goal, *specialise(goal, second_bound_by_letters, MEANING))


last_bound = (-square / 2 - b * grown**2) / (1 + zPz)


@claim(
    "newton/5-b-cancels", "With b = ‖G‖²/(2λ_min(P)) the last term is zero", eq(second_bound_printed, last_bound),
    given=LETTERS, place=STEP_3, uses=[positive_definite],
)  # fmt: skip
def b_cancels(goal: Goal) -> Evidence:
    """bλ_min(P) = ‖G‖²/2."""
    return reals(goal)


@claim(
    "newton/5-lyapunov-inequality", "dV/dt ≤ (−‖z̄‖²/2 − b(e^d̂ − 1)²)/(1 + z̄ᵀPz̄)",
    le(V_rate, last_bound), given=LETTERS, labels=["eq:Lyapunov_inequality"], uses=[second_bound, b_cancels],
)  # fmt: skip
def lyapunov_inequality(goal: Goal) -> Evidence:
    """For all z̄ and d̂."""
    return reals(goal)


@claim(
    "newton/5-P-form", "z̄ᵀPz̄ ≥ 0, and > 0 for z̄ ≠ 0", every(ge(zPz, 0), ge(zPz, least * square), gt(least, 0)),
    place=STEP_3, uses=[quadratic_form, least_positive],
)  # fmt: skip
def form_of_P(goal: Goal) -> Evidence:
    """By its least eigenvalue."""
    return reals(goal)


@claim(
    "newton/5-bound-definite", "The bound is negative but at the origin",
    lt((-square_of_z / 2 - b * (E - 1) ** 2) / (1 + q_P), 0),
    given=[gt(square_of_z + d_h**2, 0), eq(E, sp.exp(d_h))], place=STEP_3, uses=[form_of_P],
)  # fmt: skip
def bound_definite(goal: Goal) -> Evidence:
    """By letters; e^d̂ = 1 only at d̂ = 0: e^d̂ > 1 + d̂ and e^(−d̂) > 1 − d̂."""
    return reals(goal, exp_line_strict(d_h), exp_line_strict(-d_h))


_log = sp.log(1 + q_P)


@claim(
    "newton/5-V-definite", "V is positive but at the origin",
    gt(_log + b / omega_d * (sp.exp(d_h) - d_h - 1), 0),
    given=[gt(square_of_z + d_h**2, 0), ge(q_P, lambda_P * square_of_z)], place=STEP_3, uses=[form_of_P],
)  # fmt: skip
def V_definite(goal: Goal) -> Evidence:
    """By letters: e^d̂ > 1 + d̂ for d̂ ≠ 0, and ln(1 + s) ≥ s/(1 + s) since 1/(1 + s) is e to the power −ln(1 + s)."""
    return reals(goal, exp_line_strict(d_h), exp_line(d_h), exp_line(-_log))


@claim(
    "newton/5-V-zero", "V is 0 at the origin", eq(V.subs({z1: 0, z2: 0, d_h: 0}), 0), place=STEP_3,
)  # fmt: skip
def V_zero(goal: Goal) -> Evidence:
    """ln 1 = 0 and e⁰ = 1."""
    return exact(goal)


_s = sp.Symbol("s", positive=True)


@claim(
    "newton/5-V-grows", "e^d̂ − d̂ − 1 ≥ |d̂| − 1", ge(sp.exp(d_h) - d_h - 1, sp.Abs(d_h) - 1), place=STEP_3,
)  # fmt: skip
def V_grows(goal: Goal) -> Evidence:
    """e^d̂ ≥ (1 + d̂/2)² ≥ 2d̂ for d̂ ≥ 0."""
    return reals(goal, exp_line(d_h / 2))


@claim(
    "newton/5-V-unbounded", "V has no bound as ‖z̄‖ → ∞ or |d̂| → ∞",
    every(
        eq(sp.Limit(sp.log(1 + lambda_P * _s), _s, sp.oo), sp.oo),
        eq(sp.Limit(b / omega_d * (_s - 1), _s, sp.oo), sp.oo),
    ),
    place=STEP_3, uses=[form_of_P, V_grows],
)  # fmt: skip
def V_unbounded(goal: Goal) -> Evidence:
    """Bounds from below of its two parts, which are not negative, by s = ‖z̄‖² and s = |d̂|."""
    return limits(goal)


subsystem_stable = claim(
    "newton/5-subsystem-guas", "The origin of the subsystem (z̄, d̂) is globally uniformly asymptotically stable",
    Prose("A positive definite, radially unbounded function whose rate is bounded by a negative definite one"),
    uses=[lyapunov_inequality, bound_definite, V_definite, V_zero, V_unbounded], place=STEP_3, expected="cited",
)(cited("H. Khalil, Nonlinear Systems, 3rd edition, Theorem 4.9"))  # fmt: skip
