"""Section 5, Theorem 2: the initial time, the initial heading, and μ, none of which the average depends on."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import split_dithers
from ptproof.proof import Evidence, Goal, claim, eq, every, exact, ge, gt, le, reals, refute
from ptproof.system import System, jacobian, lie_bracket
from ptproof.transforms import scale_time, solve_state, split

from . import chain, extended
from .extended import p_solution, rho, sigma, sigma_fast, theta0, z0
from .notation import IN_TAU, F, T, f, k, mu, omega, p, position, t0, tau, tau_fast, x1, x2, z
from .section5a_1_reduction import f_fast, p0, reduced_model_seeker, slow, stretch, stretch_fast
from .section5a_1_reduction import p_solution as p_with_p0

SECTION = "5.1 Theorem, Steps 1 to 3: initial time, initial heading, and μ"

# --- The initial heading ----------------------------------------------------------------------------------------------


@claim(
    "5/step1-p-start", "p starts at θ₀ + kz₀, so p₀ = θ₀ + kz₀ − ωt₀",
    every(
        eq(sp.Derivative(p_solution, tau), chain.with_p.rhs[chain.with_p.state.index(p)]),
        eq(sp.Subs(p_solution, tau, t0), theta0 + k * z0),
        eq(p_solution, omega * tau + (theta0 + k * z0 - omega * t0)),
    ),
    place="Step 1", uses=[p_with_p0],
)  # fmt: skip
def p_start(goal: Goal) -> Evidence:
    """So p₀ = 0 is a choice of the initial heading and of the filter's initial state, which the definitions leave
    free. The claims below show what a p₀ other than 0 does."""
    return exact(goal)


@claim(
    "5/step1-phase-matters", "The closed loop with p₀ has the rates of the closed loop with p₀ = 0",
    eq(solve_state(chain.with_p, p, omega * tau + p0).vector[:2, 0], chain.reduced_coordinates.vector[:2, 0]),
    given=IN_TAU, expected="refuted",
)  # fmt: skip
def phase_matters(goal: Goal) -> Evidence:
    """Refuted: half a turn reverses the vehicle. That nothing is lost by p₀ = 0 needs an argument."""
    plain = {tau: 0, t0: 0, T: 1, x1: 0, x2: 0, z: 0, k: 1, omega: 1, mu: 1, p0: sp.pi}
    return refute(goal, {F: 0, f[0]: 0, f[1]: 0, **plain})


_with_phase = split(solve_state(chain.with_p, p, omega * tau + p0), [z], mu)
phased = split_dithers(System(tau, _with_phase.slow_state, _with_phase.slow_rhs, name="slow states"), omega)
composed = split_dithers(_with_phase.reduced_model(), omega)


@claim(
    "5/step3-bracket-with-phase", "The bracket of the composed fields is k∇F for every p₀",
    eq(k * chain.gradient_F, sp.Matrix(lie_bracket(composed.fields[0], composed.fields[1], position))),
    place="Step 3", uses=[p_start],
)  # fmt: skip
def bracket_with_phase(goal: Goal) -> Evidence:
    """p₀ turns both fields by the same angle, and the bracket does not see it."""
    return exact(goal)


@claim(
    "5/assumption-b-with-phase", "Assumption 1B: the bounds of b₁ and b₂ are the same for every p₀",
    every(*(
        le(sum(entry**2 for entry in what), bound)
        for field in phased.fields
        for what, bound in ((field, 1), (list(jacobian(field, (z,))), k**2), (list(jacobian(field, (p0,))), 1))
    )),
    place="Assumption 1B", uses=[p_start],
)  # fmt: skip
def bounds_with_phase(goal: Goal) -> Evidence:
    """‖bᵢ‖ ≤ 1, ‖∂bᵢ/∂z‖ ≤ k, and ‖∂bᵢ/∂p₀‖ ≤ 1, while neither depends on τ or x: one A₁, …, A₆ serves all initial
    headings."""
    return reals(goal)


# --- One system for all initial times and headings --------------------------------------------------------------------

turns = sp.Symbol("n", integer=True)
heading = theta0 + k * z0 - 2 * sp.pi * turns  # of θ + kz at the start, within the first turn for some n
fast_start = heading / (omega * mu)
tau_of_fast = t0 + mu * sigma_fast - heading / omega
damping = stretch ** sp.Rational(-1, 2)


@claim(
    "5/shift-takes-t0-out", "A shift of time takes t₀ out of the closed loop with gradient drift",
    eq(
        sp.Matrix([sp.Subs(rate, tau, t0 + sigma) for rate in extended.in_tau.rhs]),
        sp.Matrix([sp.Subs(rate, (t0, tau), (0, sigma)) for rate in extended.in_tau.rhs]),
    ),
    given=[ge(sigma, 0)], uses=[p_start],
)  # fmt: skip
def shift_takes_t0_out(goal: Goal) -> Evidence:
    """At τ = t₀ + σ the rates are those for t₀ = 0 at σ. So b₀ contains t₀, but all initial times give the same
    trajectories, run through later. This needs a drift that does not depend on time, as E∇F."""
    return exact(goal)


@claim(
    "5/drift-factor-as-a-state", "The drift's factor is ρ⁴, where ρ solves dρ/dτ = −ρ³/(2T) from 1",
    every(
        eq(sp.Derivative(damping, tau), -(damping**3) / (2 * T)), eq(sp.Subs(damping, tau, t0), 1),
        eq(sp.Subs(rho**4, rho, damping), 1 / stretch**2), gt(damping, 0), le(damping, 1),
    ),
    given=IN_TAU,
)  # fmt: skip
def drift_factor(goal: Goal) -> Evidence:
    """ρ = (1 + (τ − t₀)/T)^(−1/2): the factor is the fourth power of one more slow state, within (0, 1]."""
    return reals(goal)


@claim(
    "5/one-system", "In fast time, all initial times and headings are starts of one system, which contains neither",
    eq(
        sp.Matrix([sp.Subs(sp.Mul(mu, rate, evaluate=False), tau, tau_of_fast) for rate in extended.in_tau.rhs]),
        sp.Matrix([*extended.fast_time.rhs[:2], extended.fast_time.rhs[3]]).subs(rho, damping.subs(tau, tau_of_fast)),
    ),
    given=[ge(sigma_fast, fast_start)], uses=[p_start, drift_factor],
)  # fmt: skip
def one_system(goal: Goal) -> Evidence:
    """With the fast time counted from (θ₀ + kz₀ − 2πn)/(ωμ) at the start, the phase of the dithers is ω times the slow
    time, and with ρ as a state no t₀ is left. That the initial time is arbitrary in the definitions then covers every
    heading and every t₀: one ω₀ and one μ₀ serve them all, without a look into the proof of Theorem 1."""
    return exact(goal)


@claim(
    "5/one-start", "Its start lies at fast time 0 or later, and is t₀ on the seeker's clock",
    every(ge(fast_start, 0), eq(sp.Subs(tau_of_fast, sigma_fast, fast_start), t0)),
    given=[ge(heading, 0)], uses=[one_system],
)  # fmt: skip
def one_start(goal: Goal) -> Evidence:
    """Some n puts θ₀ + kz₀ − 2πn into [0, 2π)."""
    return reals(goal)


# --- μ ----------------------------------------------------------------------------------------------------------------


_dither = omega * slow - k * F
_waves = (sp.cos(_dither), sp.sin(_dither))
_printed = [mu * f_fast[i] / stretch_fast**2 + mu * sp.sqrt(omega) * _waves[i] for i in (0, 1)]


@claim(
    "5/step3-mu-one", "Scaling the fast time by μ turns the reduced model for μ into the one for μ = 1",
    eq(
        sp.Matrix([sp.Subs(rate, (mu, tau_fast), (1, tau)) for rate in _printed]),
        scale_time(chain.reduced_model_fast, 1 / mu, tau).vector,
    ),
    given=IN_TAU, place="Step 3", uses=[reduced_model_seeker],
)  # fmt: skip
def mu_one(goal: Goal) -> Evidence:
    """Exactly, not only qualitatively. On the left the printed reduced model with μ = 1, on the right the derived one
    for any μ in the time τ = μτ̃: every trajectory for μ is one for 1, run through at another speed."""
    return exact(goal)
