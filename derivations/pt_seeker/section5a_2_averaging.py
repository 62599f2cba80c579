"""Section 5, Theorem 2, Step 3: Lie bracket averaging, and the assumptions that it needs."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Smooth,
    claim,
    defeats_every_choice,
    eq,
    every,
    exact,
    ge,
    integrals,
    le,
    reals,
    refute,
    smooth,
)
from ptproof.system import lie_bracket

from . import chain
from .notation import (
    IN_FAST_TIME,
    IN_TAU,
    F,
    T,
    f,
    f_norm,
    k,
    mu,
    omega,
    position,
    t0,
    tau,
    tau_fast,
    x1,
    x2,
    z,
)  # fmt: skip
from .section2_averaging import iterated_integral, iterated_integrals, lie_bracket_system, phase
from .section5a_1_reduction import (
    f_fast,
    f_tau,
    fast_time,
    quasi_steady_state,
    reduced_model_seeker,
    slow,
    stretch,
    stretch_fast,
)  # fmt: skip

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
fields = (*b1_printed, *b2_printed)


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
    "5/step3-split", "The printed fields are those that the pipeline splits off",
    every(
        *(eq(sp.Matrix(printed), sp.Matrix(derived)) for printed, derived in
          zip((b1_printed, b2_printed), chain.dithered.fields, strict=True)),
        *(eq(printed, derived) for printed, derived in
          zip((sp.cos(chain.dithered.phase), sp.sin(chain.dithered.phase)), chain.dithered.dithers, strict=True)),
    ),
    labels=["eq:reduced_model_tau_2"], uses=[dithers],
)  # fmt: skip
def fields_split(goal: Goal) -> Evidence:
    """The coefficients of cos ωτ and sin ωτ in the reduced model."""
    return exact(goal)


# b₀ is the drift of the dithered system, from the pipeline; the term is what stands over the brace.
b0 = [entry.subs(tau, slow) for entry in chain.dithered.drift]
drift_term = [mu * f_fast[i] / stretch_fast**2 for i in (0, 1)]


@claim(
    "5/step3-drift-brace-printed", "The drift term is b₀/μ, as the brace under it says",
    eq(sp.Matrix(drift_term), sp.Matrix(b0) / mu), labels=["eq:reduced_model_tau_2"], expected="refuted",
)  # fmt: skip
def drift_brace_printed(goal: Goal) -> Evidence:
    """In the general system the drift enters as μb₀. The brace divides by μ where it should multiply; at μ = 1, where
    the Lie bracket system is written, the difference does not show."""
    return refute(goal, {f[0]: 1, f[1]: 0, x1: 0, x2: 0, t0: 0, tau_fast: 0, T: 1, mu: 2})


@claim(
    "5/step3-drift-brace", "The drift term is μb₀, with b₀ = f/(1 + (τ − t₀)/T)²",
    every(
        eq(sp.Matrix(drift_term), mu * sp.Matrix(b0)),
        eq(sp.Matrix([f_tau[i] / stretch**2 for i in (0, 1)]), sp.Matrix(chain.dithered.drift)),
    ),
    given=[*IN_FAST_TIME, *IN_TAU], labels=["eq:reduced_model_tau_2"], corrects=drift_brace_printed,
)  # fmt: skip
def drift_brace(goal: Goal) -> Evidence:
    """Comparing with the general form, b₀ carries no μ."""
    return exact(goal)


@claim(
    "5/step3-bracket", "[b₁, b₂] = k∇F",
    eq(k * chain.gradient_F, sp.Matrix(lie_bracket(b1_printed, b2_printed, position))),
    place="Step 3", uses=[dithers],
)  # fmt: skip
def bracket(goal: Goal) -> Evidence:
    """The two fields are a rotation of the plane by the angle −kF, which the bracket turns into the gradient."""
    return exact(goal)


@claim(
    "5/step3-coefficient", "v₂₁ = 1/2 for the seeker's dithers",
    eq(iterated_integral(sp.sin(phase), sp.cos(phase)), sp.Rational(1, 2)), place="Step 3", uses=[iterated_integrals],
)  # fmt: skip
def coefficient(goal: Goal) -> Evidence:
    """u₁ = cos and u₂ = sin, with the period 2π in the phase."""
    return integrals(goal)


averaged_printed = sp.Matrix([f_tau[i] / stretch**2 + k / 2 * chain.gradient_F[i] for i in (0, 1)])


@claim(
    "5/step3-lie-bracket-system", "The averaged system", eq(averaged_printed, chain.averaged_tau.vector),
    given=IN_TAU, labels=["eq:lie_bracket_system_real"],
    uses=[dithers, fields_split, bracket, coefficient, lie_bracket_system],
)  # fmt: skip
def averaged_system(goal: Goal) -> Evidence:
    """The end of the pipeline from the closed loop in t: drift over the square of the stretch, plus half of k∇F."""
    return exact(goal)


@claim(
    "5/step3-by-hand", "The averaged system from the printed fields, bracket and coefficient",
    eq(
        averaged_printed,
        sp.Matrix([f_tau[i] / stretch**2 for i in (0, 1)])
        + sp.Matrix(lie_bracket(b1_printed, b2_printed, position)) * sp.Rational(1, 2),
    ),
    given=IN_TAU, labels=["eq:lie_bracket_system_real"], uses=[bracket, coefficient],
)  # fmt: skip
def averaged_by_hand(goal: Goal) -> Evidence:
    """The same without the averaging engine: b₀ + [b₁, b₂] v₂₁."""
    return exact(goal)


# --- Assumption 1 for the seeker ----------------------------------------------------------------------------


@claim(
    "5/assumption-a-fields", "Assumption 1A: the dithered fields are twice continuously differentiable",
    Smooth(fields, position, 2, ((F, 2),)), place="Assumption 1A", uses=[fields_split],
)  # fmt: skip
def assumption_a(goal: Goal) -> Evidence:
    """Compositions of F, which Assumption 2 takes in C², with sine and cosine."""
    return smooth(goal)


@claim(
    "5/assumption-b-fields", "Assumption 1B: the dithered fields are bounded, with derivatives bounded by k‖∇F‖",
    every(
        *(le(entry**2, 1) for entry in fields),
        *(le(sp.diff(entry, v) ** 2, k**2 * sp.diff(F, v) ** 2) for entry in fields for v in position),
        *(eq(sp.diff(entry, tau), 0) for entry in fields),
    ),
    place="Assumption 1B", uses=[fields_split],
)  # fmt: skip
def assumption_b_fields(goal: Goal) -> Evidence:
    """On a compact set ∇F is bounded because it is continuous; the fields don't depend on time. The bracket k∇F has the
    continuous derivative k times the Hessian of F."""
    return reals(goal)


A = sp.Symbol("A", positive=True)


@claim(
    "5/assumption-b-drift-printed", "Assumption 1B asks for a bound of b₀ at every real τ",
    Exists((A,), (le(1 / stretch**2, A),), over=(tau,)), place="Assumption 1B", expected="refuted",
)  # fmt: skip
def assumption_b_drift_printed(goal: Goal) -> Evidence:
    """b₀ = f/(1 + (τ − t₀)/T)² has a pole at τ = t₀ − T, so with a drift the assumption fails as it is written, for all
    τ in ℝ. The theorem is applied on τ ≥ t₀ only, where it holds."""
    return defeats_every_choice(goal, {tau: t0 - T + T / (A + 1)})


@claim(
    "5/assumption-b-drift", "Assumption 1B on I_τ: the drift term is at most the drift",
    every(le(f_norm / stretch**2, f_norm), ge(f_norm / stretch**2, 0)), given=[ge(tau, t0)],
    place="Assumption 1B", corrects=assumption_b_drift_printed,
)  # fmt: skip
def assumption_b_drift(goal: Goal) -> Evidence:
    """From the initial time on the factor is at most 1."""
    return reals(goal)


@claim(
    "5/assumption-c", "Assumption 1C: the dithers are bounded by 1 and don't depend on the slow time",
    every(
        le(sp.cos(phase) ** 2, 1), le(sp.sin(phase) ** 2, 1),
        eq(sp.diff(sp.cos(phase), tau), 0), eq(sp.diff(sp.sin(phase), tau), 0),
    ),
    place="Assumption 1C",
)  # fmt: skip
def assumption_c(goal: Goal) -> Evidence:
    """So every positive Lipschitz constant in the slow time will do."""
    return reals(goal)


_s = sp.Symbol("s", real=True)


@claim(
    "5/assumption-d-period", "Assumption 1D: the dithers have the period 2π",
    every(*(eq(sp.Subs(wave(_s), _s, phase + 2 * sp.pi), wave(phase)) for wave in (sp.cos, sp.sin))),
    place="Assumption 1D",
)  # fmt: skip
def assumption_d_period(goal: Goal) -> Evidence:
    """T_f = 2π in the phase ωτ."""
    return exact(goal)


@claim(
    "5/assumption-d-mean", "Assumption 1D: the dithers have zero mean",
    every(eq(sp.Integral(sp.cos(_s), (_s, 0, 2 * sp.pi)), 0), eq(sp.Integral(sp.sin(_s), (_s, 0, 2 * sp.pi)), 0)),
    place="Assumption 1D",
)  # fmt: skip
def assumption_d_mean(goal: Goal) -> Evidence:
    """Over one period."""
    return integrals(goal)


@claim(
    "5/assumption-e", "Assumption 1E: the fast rate is continuously differentiable, so locally Lipschitz",
    Smooth((F - z,), (x1, x2, z), 1, ((F, 2),)), place="Assumption 1E", uses=[fast_time],
)  # fmt: skip
def assumption_e(goal: Goal) -> Evidence:
    """g(x, z) = F(x) − z with F in C²."""
    return smooth(goal)


@claim(
    "5/assumption-f", "Assumption 1F: the quasi-steady state is twice continuously differentiable",
    Smooth((F,), position, 2, ((F, 2),)), place="Assumption 1F", uses=[quasi_steady_state])  # fmt: skip
def assumption_f(goal: Goal) -> Evidence:
    """l = F; that it is the only one is a claim of Step 2."""
    return smooth(goal)


assumption_1 = (
    assumption_a, assumption_b_fields, assumption_b_drift, assumption_c, assumption_d_period, assumption_d_mean,
    assumption_e, assumption_f, quasi_steady_state,
)  # fmt: skip
