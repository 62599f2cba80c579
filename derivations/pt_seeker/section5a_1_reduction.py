"""Section 5, Theorem 2, Steps 1 and 2: change of variables, and singular perturbation."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.proof import (
    Evidence,
    Goal,
    claim,
    definition,
    eq,
    every,
    exact,
    limits,
    reals,
)
from ptproof.transforms.reduction import split
from ptproof.transforms.states import solve_state

from . import chain
from .notation import (
    IN_FAST_TIME,
    IN_TAU,
    IN_TIME,
    F,
    T,
    drift_at,
    k,
    mu,
    nu,
    omega,
    p,
    rate_of,
    t,
    t0,
    tau,
    tau_fast,
    theta,
    y_tilde,
    z,
)  # fmt: skip
from .section2_averaging import reduced_model
from .section4_design import closed_loop_in_t, closed_loop_in_tau, plant
from .section4_design import u1 as forward_velocity
from .section4_design import u2 as angular_velocity

SECTION = "5.1 Theorem, Steps 1 to 3: the averaged system"

# --- The feedback law of the theorem ------------------------------------------------------------------------

y = sp.Symbol("y", real=True)
measured = eq(y, F)  # the output of the unicycle, where a row is printed with y
K = 1 / nu(t - t0) ** 2
u1_printed = K * sp.sqrt(omega)
u2_printed = K * (omega - k / mu * (y - z))
z_rate_printed = K / mu * (y - z)

law = definition(
    "5/law", "The prescribed-time feedback law",
    every(eq(sp.Symbol("u1"), u1_printed), eq(sp.Symbol("u2"), u2_printed), eq(rate_of("z", t), z_rate_printed)),
    labels=["eq:pt_controlla", "eq:u1", "eq:u2", "eq:z"], prose="All three rates carry the gain 1/ν².",
)  # fmt: skip


@claim(
    "5/law-closes-the-loop", "The unicycle under this law is the closed loop",
    eq(sp.Matrix([*plant.rhs, z_rate_printed]), chain.closed_loop_t.vector),
    given=[*IN_TIME, measured, eq(forward_velocity, u1_printed), eq(angular_velocity, u2_printed)],
    labels=["eq:pt_controlla", "eq:u1", "eq:u2", "eq:z"], uses=[closed_loop_in_t],
)  # fmt: skip
def law_closes_the_loop(goal: Goal) -> Evidence:
    """The printed inputs are put into the unicycle, which has no inputs of its own; the filter is part of the law.
    Against the closed loop of the pipeline."""
    return exact(goal)


@claim(
    "5/forward-velocity-grows", "u₁ tends to infinity as t tends to t₀ + T",
    eq(sp.Limit(u1_printed, t, t0 + T, "-"), sp.oo), labels=["eq:u1"],
)  # fmt: skip
def forward_velocity_grows(goal: Goal) -> Evidence:
    """Without clipping the gain has no bound; Section 6.4 answers this."""
    return limits(goal)


# --- Step 1 -------------------------------------------------------------------------------------------------

stretch = 1 + (tau - t0) / T
f_tau = drift_at(chain.clock.to_t)
p0 = sp.Symbol("p0", real=True)


def _rate_of(state: sp.Symbol) -> sp.Expr:
    """The right-hand side of one state in the closed loop in τ."""
    return chain.closed_loop_tau.rhs[chain.closed_loop_tau.state.index(state)]


@claim(
    "5/step1-p-rate", "p = θ + kz turns at the constant rate ω",
    eq(omega, sp.Add(_rate_of(theta), k * _rate_of(z), evaluate=False)), place="Step 1", uses=[closed_loop_in_tau],
)  # fmt: skip
def p_rate(goal: Goal) -> Evidence:
    """The filter's rate, times k, is what the feedback takes from the heading."""
    return exact(goal)


@claim(
    "5/step1-p-solution", "p(τ) = ωτ + p₀ solves its equation",
    eq(sp.Derivative(omega * tau + p0, tau), chain.with_p.rhs[chain.with_p.state.index(p)]),
    place="Step 1", uses=[p_rate],
)  # fmt: skip
def p_solution(goal: Goal) -> Evidence:
    """Here p₀ is the value that p would have at τ = 0, so it is θ(t₀) + kz(t₀) − ωt₀."""
    return exact(goal)


@claim(
    "5/step1-reduced-coordinates", "The closed loop after the change of variables",
    eq(
        sp.Matrix([
            f_tau[0] / stretch**2 + sp.sqrt(omega) * sp.cos(omega * tau - k * z),
            f_tau[1] / stretch**2 + sp.sqrt(omega) * sp.sin(omega * tau - k * z),
            (y - z) / mu,
        ]),
        chain.reduced_coordinates.vector,
    ),
    given=[*IN_TAU, measured], labels=["eq:tau_pt_system"], uses=[p_solution, closed_loop_in_tau],
)  # fmt: skip
def reduced_coordinates(goal: Goal) -> Evidence:
    """θ = p − kz is substituted, and p by its solution with p₀ = 0; y = F(x)."""
    return exact(goal)


_with_phase = split_dithers(split(solve_state(chain.with_p, p, omega * tau + p0), [z], mu).reduced_model(), omega)


@claim(
    "5/step1-initial-phase", "The averaged system does not depend on p₀",
    eq(
        sp.Matrix([drift / stretch**2 + k / 2 * slope for drift, slope in zip(f_tau, chain.gradient_F, strict=True)]),
        average(_with_phase).vector,
    ),
    given=IN_TAU, place="Step 1", uses=[p_solution],
)  # fmt: skip
def initial_phase(goal: Goal) -> Evidence:
    """Setting p₀ = 0 loses nothing: with p₀ kept as a symbol, the average comes out as it is printed in Step 3."""
    return exact(goal)


# --- Step 2 -------------------------------------------------------------------------------------------------

slow = mu * tau_fast
f_fast = drift_at(chain.clock.to_t.subs(tau, slow))
stretch_fast = 1 + (slow - t0) / T


@claim(
    "5/step2-fast-time", "The closed loop in the fast time",
    eq(
        sp.Matrix([
            mu * f_fast[0] / stretch_fast**2 + mu * sp.sqrt(omega) * sp.cos(omega * slow - k * z),
            mu * f_fast[1] / stretch_fast**2 + mu * sp.sqrt(omega) * sp.sin(omega * slow - k * z),
            y - z,
        ]),
        chain.fast_time.vector,
    ),
    given=[*IN_FAST_TIME, measured], labels=["eq:tau_pt_system_eps", "eq:to_be_reduced_model"],
    uses=[reduced_coordinates],
)  # fmt: skip
def fast_time(goal: Goal) -> Evidence:
    """τ = μτ̃; the drift is again taken at the instant that belongs to the fast time."""
    return exact(goal)


fast_rate = chain.fast_time.rhs[2]  # g(x, z)


@claim(
    "5/step2-quasi-steady-state-solves", "The fast rate vanishes at l(x) = F(x)", eq(sp.Subs(fast_rate, z, F), 0),
    place="Step 2", uses=[fast_time],
)  # fmt: skip
def quasi_steady_state_solves(goal: Goal) -> Evidence:
    """g(x, l(x)) = 0: one half of the equivalence in Assumption 1F."""
    return exact(goal)


@claim(
    "5/step2-quasi-steady-state", "The fast rate vanishes at no other z", eq(z, F), given=[eq(0, fast_rate)],
    place="Step 2", uses=[fast_time],
)  # fmt: skip
def quasi_steady_state(goal: Goal) -> Evidence:
    """If g(x, z) = 0, then z = F(x): the other half, so that l = F is the only one."""
    return reals(goal)


# In the fast time, of which τ = μτ̃ is frozen as x is.
_layer_rate = sp.expand(mu * chain.reduced_coordinates.derivative_along(z - F)).subs(z, y_tilde + F)


@claim(
    "5/step2-boundary-layer", "The boundary layer",
    eq(-y_tilde, sp.Subs(_layer_rate, mu, 0)), given=IN_TAU, labels=["eq:blm_real"],
    uses=[quasi_steady_state_solves, quasi_steady_state],
)  # fmt: skip
def boundary_layer(goal: Goal) -> Evidence:
    """μ times the rate of ỹ = z − F(x) along the closed loop in τ is continuous in μ, also at μ = 0, where τ, x and ỹ
    are held: −ỹ is left, the same for every x."""
    return exact(goal)


_dither = omega * slow - k * F


@claim(
    "5/step2-reduced-model", "The reduced model",
    eq(
        sp.Matrix([
            mu * f_fast[0] / stretch_fast**2 + mu * sp.sqrt(omega) * sp.cos(_dither),
            mu * f_fast[1] / stretch_fast**2 + mu * sp.sqrt(omega) * sp.sin(_dither),
        ]),
        chain.reduced_model_fast.vector,
    ),
    given=IN_FAST_TIME, labels=["eq:reduced_model_tau"],
    uses=[quasi_steady_state_solves, quasi_steady_state, fast_time, reduced_model],
)  # fmt: skip
def reduced_model_seeker(goal: Goal) -> Evidence:
    """z is replaced by F(x) in the slow rates."""
    return exact(goal)
