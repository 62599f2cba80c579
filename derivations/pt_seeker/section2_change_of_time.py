"""Section 2.2: control laws by a change of time."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Goal,
    claim,
    definition,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    limits,
    lt,
    reals,
)
from ptproof.system import System
from ptproof.transforms.time import contract, dilate

from .chain import clock
from .notation import IN_TAU, IN_TIME, T, k, nu, rate_of, t, t0, tau

SECTION = "2 Preliminaries"

# --- 2.2 Control laws by a change of time -----------------------------------------------------------------------------

x = sp.Symbol("x", real=True)
x0 = sp.Symbol("x0", real=True)
control = sp.Function("u", real=True)(t)
stretch = 1 + (tau - t0) / T

nominal = definition(
    "2.2/nominal",
    "The scalar example",
    eq(rate_of("x", t), control),
    labels=["eq:nominal_example_t"],
    prose="A single integrator; its input is to be chosen.",
)
nominal_system = System(t, (x,), (control,), name="scalar example")

nu_definition = definition(
    "2.2/nu", "The blow-down function ν", eq(sp.Function("nu")(t - t0), 1 - (t - t0) / T), labels=["eq:nu"],
    prose="Its properties are claims: value 1 at the start, value 0 at the end, decreasing, and affine.",
)  # fmt: skip
elapsed = sp.Symbol("s", real=True)


@claim(
    "2.2/nu-properties",
    "ν(0) = 1, ν(T) = 0",
    every(
        eq(sp.Subs(nu(elapsed), elapsed, 0), 1),
        eq(sp.Subs(nu(elapsed), elapsed, T), 0),
        eq(sp.Derivative(nu(elapsed), (elapsed, 2)), 0),
    ),
    labels=["eq:nu"],
)
def nu_properties(goal: Goal) -> Evidence:
    """Both end values, and a second derivative that vanishes: ν is affine."""
    return exact(goal)


@claim("2.2/nu-decreases", "ν decreases", lt(sp.Derivative(nu(elapsed), elapsed), 0), labels=["eq:nu"])
def nu_decreases(goal: Goal) -> Evidence:
    """The slope is −1/T."""
    return reals(goal)


@claim(
    "2.2/nu-positive", "0 < ν ≤ 1 before the prescribed time", every(gt(nu(t - t0), 0), le(nu(t - t0), 1)),
    given=[ge(t, t0), lt(t, t0 + T)], labels=["eq:nu"],
)  # fmt: skip
def nu_positive(goal: Goal) -> Evidence:
    """On I_t = [t₀, t₀ + T) the function stays in (0, 1], so 1/ν² is at least 1 and finite."""
    return reals(goal)


@claim(
    "2.2/time-map", "The clock undoes the printed time dilation",
    eq(sp.Subs(clock.to_t, tau, t0 + (t - t0) / nu(t - t0)), t), given=IN_TIME, labels=["eq:tau_to_t"],
)  # fmt: skip
def time_map(goal: Goal) -> Evidence:
    """The printed map, and the clock's way back, which every later step uses."""
    return exact(goal)


@claim(
    "2.2/time-map-from-gain", "It starts at t₀ and runs at the rate of the clock, which is the seeker's gain",
    every(
        eq(sp.Subs(t0 + (t - t0) / nu(t - t0), t, t0), t0),
        eq(sp.Derivative(t0 + (t - t0) / nu(t - t0), t), clock.rate),
    ),
    given=IN_TIME, labels=["eq:tau_to_t"],
)  # fmt: skip
def time_map_from_gain(goal: Goal) -> Evidence:
    """Dilating time and applying the gain are one thing."""
    return exact(goal)


@claim(
    "2.2/time-map-limit", "τ tends to infinity as t tends to t₀ + T",
    eq(sp.Limit(t0 + (t - t0) / nu(t - t0), t, t0 + T, "-"), sp.oo), place="Section 2.2", uses=[time_map],
)  # fmt: skip
def time_map_limit(goal: Goal) -> Evidence:
    """The numerator tends to T > 0 and ν falls to 0 from above."""
    return limits(goal)


@claim(
    "2.2/dilation-rate",
    "dt/dτ",
    eq(1 / (1 + (tau - t0) / T) ** 2, sp.diff(clock.to_t, tau)),
    given=IN_TAU,
    labels=["eq:dt_dtau"],
)
def dilation_rate(goal: Goal) -> Evidence:
    """The printed rate against the derivative of the clock's inverse."""
    return exact(goal)


@claim(
    "2.2/dilated-example", "The scalar example in dilated time",
    eq(control.subs(t, clock.to_t) / (1 + (tau - t0) / T) ** 2, dilate(nominal_system, clock).rhs[0]),
    given=IN_TAU, labels=["eq:nominal_example_tau"], uses=[dilation_rate],
)  # fmt: skip
def dilated_example(goal: Goal) -> Evidence:
    """A signal keeps its letter in both time scales: u(τ) is the input at the instant t that belongs to τ."""
    return exact(goal)


law_tau = definition(
    "2.2/law-tau", "The control law in dilated time", eq(sp.Function("u")(tau), -(stretch**2) * k * x),
    labels=["eq:u_tau"], prose="Chosen so that the factor of the dilated equation cancels.",
)  # fmt: skip
feedback_system = System(t, (x,), (-k * x / nu(t - t0) ** 2,), name="scalar example under feedback")


@claim(
    "2.2/example", "The example under the printed law is linear and time-invariant in τ",
    eq(-k * x, -(stretch**2) * k * x * clock.rate_back), given=IN_TAU,
    labels=["eq:u_tau", "eq:example"], uses=[dilated_example],
)  # fmt: skip
def example(goal: Goal) -> Evidence:
    """The law as printed in τ, times the clock's rate dt/dτ; what stays is −kx."""
    return exact(goal)


_solution_tau = x0 * sp.exp(-k * (tau - t0))
_solution_t = x0 * sp.exp(-k * (t - t0) / nu(t - t0))


@claim(
    "2.2/example-solution", "The solution in dilated time",
    every(
        eq(sp.Derivative(_solution_tau, tau), -k * _solution_tau),
        eq(sp.Subs(_solution_tau, tau, t0), x0),
    ),
    labels=["eq:example_solution"], uses=[example],
)  # fmt: skip
def example_solution(goal: Goal) -> Evidence:
    """It satisfies the equation and the initial condition."""
    return exact(goal)


@claim(
    "2.2/example-limit", "x(τ) tends to 0", eq(sp.Limit(_solution_tau, tau, sp.oo, "-"), 0), place="Section 2.2",
    uses=[example_solution],
)  # fmt: skip
def example_limit(goal: Goal) -> Evidence:
    """The exponent tends to −∞ because k > 0."""
    return limits(goal)


@claim(
    "2.2/inverse-map", "The time contraction undoes the time dilation",
    every(
        eq(sp.Subs(clock.to_tau, t, t0 + (tau - t0) / (1 + (tau - t0) / T)), tau),
        eq((t0 + (tau - t0) / (1 + (tau - t0) / T)).subs(tau, t0 + (t - t0) / nu(t - t0)), t),
        eq((t0 + (t - t0) / nu(t - t0)).subs(t, t0 + (tau - t0) / (1 + (tau - t0) / T)), tau),
    ),
    given=[*IN_TIME, *IN_TAU], labels=["eq:t_to_tau"],
)  # fmt: skip
def inverse_map(goal: Goal) -> Evidence:
    """The two printed maps are composed both ways, and the printed contraction with the clock's dilation."""
    return exact(goal)


@claim(
    "2.2/inverse-map-limit", "t tends to t₀ + T as τ tends to infinity",
    every(
        eq(sp.Limit(t0 + (tau - t0) / (1 + (tau - t0) / T), tau, sp.oo, "-"), t0 + T),
        eq(sp.Limit(t0 + (1 - t0 / tau) / (1 / T + (1 - t0 / T) / tau), tau, sp.oo, "-"), t0 + T),
    ),
    place="Section 2.2", uses=[inverse_map],
)  # fmt: skip
def inverse_map_limit(goal: Goal) -> Evidence:
    """Both forms that the text writes."""
    return limits(goal)


@claim(
    "2.2/inverse-map-forms", "The two forms of the contraction in the limit agree",
    eq((1 - t0 / tau) / (1 / T + (1 - t0 / T) / tau), (tau - t0) / (1 + (tau - t0) / T)),
    given=[*IN_TAU, gt(tau, 0)], place="Section 2.2",
)  # fmt: skip
def inverse_map_forms(goal: Goal) -> Evidence:
    """Numerator and denominator are divided by τ, which is positive for the large τ that the limit is about."""
    return exact(goal)


@claim(
    "2.2/contraction-rate",
    "dτ/dt",
    eq(1 / nu(t - t0) ** 2, sp.diff(clock.to_tau, t)),
    given=IN_TIME,
    labels=["eq:dtau_dt"],
)
def contraction_rate(goal: Goal) -> Evidence:
    """The printed rate against the derivative of the clock's map."""
    return exact(goal)


_example_tau = System(tau, (x,), (-k * x,), name="example")


@claim(
    "2.2/contracted-example", "The example in the original time",
    eq(-k * x / nu(t - t0) ** 2, contract(_example_tau, clock).rhs[0]),
    given=IN_TIME, labels=["eq:pt_example"], uses=[contraction_rate, example],
)  # fmt: skip
def contracted_example(goal: Goal) -> Evidence:
    """The linear system is contracted with the clock."""
    return exact(goal)


@claim(
    "2.2/law-t", "The control law in the original time",
    eq(-k * x / nu(t - t0) ** 2, (-(stretch**2) * k * x).subs(tau, clock.to_tau)),
    given=IN_TIME, labels=["eq:u_t"], uses=[contracted_example],
)  # fmt: skip
def law_t(goal: Goal) -> Evidence:
    """The law that was chosen in τ, at the τ that belongs to t."""
    return exact(goal)


@claim(
    "2.2/pt-solution", "The solution in the original time",
    every(
        eq(sp.Derivative(_solution_t, t), -k * _solution_t / nu(t - t0) ** 2),
        eq(sp.Subs(_solution_t, t, t0), x0),
        eq(_solution_t, sp.Subs(_solution_tau, tau, clock.to_tau)),
    ),
    given=IN_TIME, labels=["eq:pt_example_solution"], uses=[contracted_example, example_solution],
)  # fmt: skip
def pt_solution(goal: Goal) -> Evidence:
    """It solves the contracted equation, starts at x₀, and is the same signal as the solution in τ."""
    return exact(goal)


@claim(
    "2.2/pt-limit", "x(t) tends to 0 as t tends to t₀ + T", eq(sp.Limit(_solution_t, t, t0 + T, "-"), 0),
    place="Section 2.2", uses=[pt_solution],
)  # fmt: skip
def pt_limit(goal: Goal) -> Evidence:
    """The exponent −k(t − t₀)/ν tends to −∞."""
    return limits(goal)


@claim(
    "2.2/round-trip", "Dilation and contraction undo each other",
    every(
        eq(contract(dilate(feedback_system, clock), clock).vector, feedback_system.vector),
        eq(dilate(contract(_example_tau, clock), clock).vector, _example_tau.vector),
    ),
    given=[*IN_TIME, *IN_TAU], place="Section 2.2", uses=[inverse_map, dilation_rate, contraction_rate],
)  # fmt: skip
def round_trip(goal: Goal) -> Evidence:
    """Both orders, on the scalar example; the closed loop follows in Section 4."""
    return exact(goal)
