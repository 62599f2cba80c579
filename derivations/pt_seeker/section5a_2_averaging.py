"""Section 5, Theorem 2, Step 3: Lie bracket averaging."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, exact, integrals, refute
from ptproof.system import lie_bracket

from . import chain
from .notation import IN_FAST_TIME, IN_TAU, F, T, f, k, mu, omega, position, t0, tau, tau_fast, x1, x2, z
from .section2_averaging import phase
from .section2_lie_bracket import (
    HALF,
    bracket_of_composed_fields,
    coefficient_is_half,
    iterated_integral,
    iterated_integrals,
    lie_bracket_system,
    v21,
)  # fmt: skip
from .section5a_1_reduction import f_fast, f_tau, reduced_model_seeker, slow, stretch, stretch_fast
from .section5a_1b_general_form import b0, b1, b2, general_form

SECTION = "5.1 Theorem, Steps 1 to 3: the averaged system"

# --- Step 3 -------------------------------------------------------------------------------------------------

alpha, beta = sp.symbols("alpha beta", real=True)


@claim(
    "5/step3-trigonometry", "The addition theorems",
    every(
        eq(sp.cos(alpha + beta), sp.cos(alpha) * sp.cos(beta) - sp.sin(alpha) * sp.sin(beta)),
        eq(sp.sin(alpha + beta), sp.sin(alpha) * sp.cos(beta) + sp.cos(alpha) * sp.sin(beta)),
    ),
    place="Step 3",
)  # fmt: skip
def trigonometry(goal: Goal) -> Evidence:
    """As quoted, used with β = −kF(x)."""
    return exact(goal)


b1_printed = (sp.cos(k * F), -sp.sin(k * F))
b2_printed = (sp.sin(k * F), sp.cos(k * F))


@claim(
    "5/step3-dithers", "The reduced model by its dithers",
    eq(
        sp.Matrix([mu * f_fast[i] / stretch_fast**2 for i in (0, 1)])
        + mu * sp.sqrt(omega) * sp.Matrix(b1_printed) * sp.cos(omega * slow)
        + mu * sp.sqrt(omega) * sp.Matrix(b2_printed) * sp.sin(omega * slow),
        chain.reduced_model_fast.vector,
    ),
    given=IN_FAST_TIME, labels=["eq:reduced_model_tau_2"], uses=[trigonometry, reduced_model_seeker],
)  # fmt: skip
def dithers(goal: Goal) -> Evidence:
    """The printed fields and dithers, put together again, are the reduced model."""
    return exact(goal)


@claim(
    "5/step3-split", "The printed fields are those of the general form at z = l(x) = F(x)",
    every(
        *(eq(printed, sp.Subs(entry, z, F)) for printed, entry in
          zip((*b1_printed, *b2_printed), (*b1, *b2), strict=True)),
    ),
    labels=["eq:reduced_model_tau_2"], uses=[dithers, general_form],
)  # fmt: skip
def fields_split(goal: Goal) -> Evidence:
    """What stands over the braces is b₁(τ, x, z) and b₂(τ, x, z) of Step 2, composed with the quasi-steady state."""
    return exact(goal)


# b₀ is the drift of the dithered system, from the pipeline; the term is what stands over the brace.
b0_slow = [entry.subs(tau, slow) for entry in chain.dithered.drift]
drift_term = [mu * f_fast[i] / stretch_fast**2 for i in (0, 1)]


@claim(
    "5/step3-drift-brace-printed", "The drift term is b₀/μ, as the brace under it says",
    eq(sp.Matrix(drift_term), sp.Matrix(b0_slow) / mu), labels=["eq:reduced_model_tau_2"], expected="refuted",
    grade="misprint", wrong="The brace under the drift term divides b₀ by μ where it should multiply it.",
    survives="Yes: the Lie bracket system is written at μ = 1, where both are the same.",
)  # fmt: skip
def drift_brace_printed(goal: Goal) -> Evidence:
    """In the general system the drift enters as μb₀. The brace divides by μ where it should multiply; at μ = 1, where
    the Lie bracket system is written, the difference does not show."""
    return refute(goal, {f[0]: 1, f[1]: 0, x1: 0, x2: 0, t0: 0, tau_fast: 0, T: 1, mu: 2})


@claim(
    "5/step3-drift-brace", "The drift term is μb₀, with b₀ = f/(1 + (τ − t₀)/T)²",
    every(
        eq(sp.Matrix(drift_term), mu * sp.Matrix(b0_slow)),
        eq(sp.Matrix(b0), sp.Matrix(chain.dithered.drift)),
    ),
    given=[*IN_FAST_TIME, *IN_TAU], labels=["eq:reduced_model_tau_2"], corrects=drift_brace_printed,
)  # fmt: skip
def drift_brace(goal: Goal) -> Evidence:
    """Comparing with the general form, b₀ carries no μ."""
    return exact(goal)


@claim(
    "5/step3-bracket", "The bracket of the composed fields is k∇F",
    eq(k * chain.gradient_F, sp.Matrix(lie_bracket(b1_printed, b2_printed, position))),
    place="Step 3", uses=[dithers],
)  # fmt: skip
def bracket(goal: Goal) -> Evidence:
    """b₁ and b₂ at z = F(x) are the columns of a rotation by the angle −kF, which the bracket turns into the
    gradient."""
    return exact(goal)


@claim(
    "5/step3-coefficient", "v₂₁ = 1/2 for the seeker's dithers",
    eq(iterated_integral(*(wave.subs(chain.dithered.phase, phase) for wave in chain.dithered.dithers[::-1])), HALF),
    place="Step 3", uses=[iterated_integrals],
)  # fmt: skip
def coefficient(goal: Goal) -> Evidence:
    """The two dithers that the pipeline finds in the reduced model, the second outside, with the period 2π in the
    phase."""
    return integrals(goal)


averaged_printed = sp.Matrix([f_tau[i] / stretch**2 + k / 2 * chain.gradient_F[i] for i in (0, 1)])


@claim(
    "5/step3-lie-bracket-system", "The averaged system", eq(averaged_printed, chain.averaged_tau.vector),
    given=IN_TAU, labels=["eq:lie_bracket_system_real"],
    uses=[dithers, fields_split, bracket, coefficient, lie_bracket_system, bracket_of_composed_fields],
)  # fmt: skip
def averaged_system(goal: Goal) -> Evidence:
    """The end of the pipeline from the closed loop in t: drift over the square of the stretch, plus half of k∇F."""
    return exact(goal)


_drift = sp.Matrix([f_tau[i] / stretch**2 for i in (0, 1)])


@claim(
    "5/step3-bracket-at-z-printed", "The averaged system by the bracket of the fields of (τ, x, z), at z = F(x)",
    eq(
        averaged_printed,
        _drift + v21 * sp.Matrix([sp.Subs(entry, z, F) for entry in lie_bracket(b1, b2, position)]),
    ),
    given=[*IN_TAU, *coefficient_is_half], labels=["eq:lie_bracket_system_real"], uses=[general_form, coefficient],
    expected="refuted", grade="definition",
    wrong="As the Lie bracket system is defined, the seeker's bracket is formed with z held, and is 0.",
    survives="Yes: Step 3 forms the bracket after z = F(x) is put in, and averages the reduced model.",
)  # fmt: skip
def bracket_at_z_printed(goal: Goal) -> Evidence:
    """b₁(τ, x, z) and b₂(τ, x, z) depend on z alone, so that their bracket in x is 0 and nothing would pull to the
    source. All of k∇F comes from z = F(x)."""
    return refute(goal, {f[0]: 0, f[1]: 0, F: x1, v21: HALF, x1: 0, x2: 0, t0: 0, tau: 0, T: 1, k: 1})


@claim(
    "5/step3-by-hand", "The averaged system from the printed fields, bracket and coefficient",
    eq(averaged_printed, _drift + v21 * sp.Matrix(lie_bracket(b1_printed, b2_printed, position))),
    given=[*IN_TAU, *coefficient_is_half], labels=["eq:lie_bracket_system_real"], uses=[bracket, coefficient],
    corrects=bracket_at_z_printed,
)  # fmt: skip
def averaged_by_hand(goal: Goal) -> Evidence:
    """The same without the averaging engine: b₀ + [b₁, b₂] v₂₁ with the fields at z = F(x)."""
    return exact(goal)
