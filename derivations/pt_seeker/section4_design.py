"""Section 4: the feedback law is chosen in dilated time, and the closed loop is brought back."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact
from ptproof.system import System
from ptproof.transforms.time import contract, dilate

from .chain import clock, closed_loop_t, closed_loop_tau
from .notation import IN_TAU, IN_TIME, F, T, drift_at, f, k, mu, nu, omega, rate_of, t, t0, tau, theta, x1, x2, z
from .section2_change_of_time import contraction_rate, dilation_rate

SECTION = "4 Prescribed-time source seeking design"

u1 = sp.Function("u1", real=True)(t)
u2 = sp.Function("u2", real=True)(t)
stretch = 1 + (tau - t0) / T
f_tau = drift_at(clock.to_t)

plant = System(t, (x1, x2, theta), (f[0] + u1 * sp.cos(theta), f[1] + u1 * sp.sin(theta), u2), name="unicycle")
u1_tau, u2_tau = u1.subs(t, clock.to_t), u2.subs(t, clock.to_t)


@claim(
    "4/dilated-unicycle", "The unicycle in dilated time",
    eq(
        sp.Matrix([
            f_tau[0] / stretch**2 + u1_tau / stretch**2 * sp.cos(theta),
            f_tau[1] / stretch**2 + u1_tau / stretch**2 * sp.sin(theta),
            u2_tau / stretch**2,
        ]),
        dilate(plant, clock).vector,
    ),
    given=IN_TAU, labels=["eq:seeker_tau_to_be_designed"], uses=[dilation_rate],
)  # fmt: skip
def dilated_unicycle(goal: Goal) -> Evidence:
    """Every rate is multiplied by dt/dτ. The paper keeps the letters of signals in both scales: f(τ, x) is the drift at
    the instant t that belongs to τ, and u(τ) likewise."""
    return exact(goal)


forward = stretch**2 * sp.sqrt(omega)
angular = stretch**2 * (omega - k / mu * (F - z))
filter_rate = (F - z) / mu

law = definition(
    "4/law", "The feedback law in dilated time",
    every(eq(sp.Symbol("u1"), forward), eq(sp.Symbol("u2"), angular), eq(rate_of("z", tau), filter_rate)),
    labels=["eq:seeker_tau", "eq:filter_tau"],
    prose="A constant forward speed and a heading that is turned back by the filtered rate of the measurement, both "
    "multiplied by what the dilation divides by.",
)  # fmt: skip

s = sp.Symbol("s", positive=True)
Y, Z = sp.symbols("Y Z", real=True)


@claim(
    "4/washout-filter", "The filter's output is s/(μs + 1) times the measurement",
    eq((Y - Z) / mu, s / (mu * s + 1) * Y), given=[eq(Z, Y / (mu * s + 1))], labels=["eq:filter_tau"],
)  # fmt: skip
def washout_filter(goal: Goal) -> Evidence:
    """The transform of μ dz/dτ = y − z from rest gives Z = Y/(μs + 1); the signal (y − z)/μ is an approximate
    derivative of the measurement."""
    return exact(goal)


closed_tau_printed = sp.Matrix([
    f_tau[0] / stretch**2 + sp.sqrt(omega) * sp.cos(theta),
    f_tau[1] / stretch**2 + sp.sqrt(omega) * sp.sin(theta),
    omega - k / mu * (F - z),
    (F - z) / mu,
])  # fmt: skip


@claim(
    "4/closed-loop-tau", "The closed loop in dilated time", eq(closed_tau_printed, closed_loop_tau.vector),
    given=IN_TAU, labels=["eq:closed_loop_system_tau"], uses=[dilated_unicycle],
)  # fmt: skip
def closed_loop_in_tau(goal: Goal) -> Evidence:
    """The closed loop is built in the original time from plant and feedback, and dilated by the clock."""
    return exact(goal)


# The printed law at the τ that belongs to t, applied to the unicycle; its filter runs at the rate dτ/dt.
u1_law, u2_law, z_law = (entry.subs(tau, clock.to_tau) for entry in (forward, angular, filter_rate * clock.rate))
under_law = System(t, (x1, x2, theta, z), (*plant.with_values({u1: u1_law, u2: u2_law}).rhs, z_law), name="unicycle")


@claim(
    "4/closed-loop-tau-substituted", "The law put into the dilated unicycle gives the closed loop",
    eq(closed_tau_printed, dilate(under_law, clock).vector),
    given=IN_TAU, labels=["eq:closed_loop_system_tau", "eq:seeker_tau"], uses=[dilated_unicycle],
)  # fmt: skip
def closed_loop_substituted(goal: Goal) -> Evidence:
    """The second route, as the paper takes it: the printed law is applied to the unicycle at the instants that belong
    to it, and the loop that this closes is dilated."""
    return exact(goal)


K = 1 / nu(t - t0) ** 2
closed_t_printed = sp.Matrix([
    f[0] + K * sp.sqrt(omega) * sp.cos(theta),
    f[1] + K * sp.sqrt(omega) * sp.sin(theta),
    K * (omega - k / mu * (F - z)),
    K / mu * (F - z),
])  # fmt: skip
_printed_tau_system = System(tau, (x1, x2, theta, z), tuple(closed_tau_printed), name="printed closed loop")


@claim(
    "4/closed-loop-t", "The closed loop in the original time",
    eq(closed_t_printed, contract(_printed_tau_system, clock).vector),
    given=IN_TIME, labels=["eq:closed_loop_system_t"], uses=[closed_loop_in_tau, contraction_rate],
)  # fmt: skip
def closed_loop_in_t(goal: Goal) -> Evidence:
    """The printed closed loop in τ is contracted by the clock. The paper writes the gain with a Latin v; it is read as
    the ν of its definition."""
    return exact(goal)


@claim(
    "4/closed-loop-pipeline", "The printed closed loop is the one that the pipeline starts from",
    eq(closed_t_printed, closed_loop_t.vector), given=IN_TIME, labels=["eq:closed_loop_system_t"],
)  # fmt: skip
def closed_loop_pipeline(goal: Goal) -> Evidence:
    """Plant and feedback put together in the original time, without any change of time."""
    return exact(goal)


@claim(
    "4/round-trip", "Dilation and contraction undo each other on the closed loop",
    every(
        eq(contract(dilate(closed_loop_t, clock), clock).vector, closed_loop_t.vector),
        eq(dilate(contract(closed_loop_tau, clock), clock).vector, closed_loop_tau.vector),
    ),
    given=[*IN_TIME, *IN_TAU], place="Section 4", uses=[dilation_rate, contraction_rate],
)  # fmt: skip
def round_trip(goal: Goal) -> Evidence:
    """In both orders, with the field and the drift undefined functions."""
    return exact(goal)
