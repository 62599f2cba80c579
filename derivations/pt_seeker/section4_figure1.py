"""Section 4, Fig. 1: the block diagram of the PT Seeker, block by block, against the closed loop."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Relation, claim, eq, exact, limits, refute
from ptproof.system import System

from .chain import closed_loop_t
from .notation import IN_TIME, F, T, f, k, mu, nu, omega, t, t0, theta, x1, x2, z

SECTION = "4 PT source seeking design: the block diagram"

laplace = sp.Symbol("s", positive=True)
gain = 1 / nu(t - t0) ** 2  # K(t), as the caption says


def washout(rate: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """The block of the filter: output (y − z)/μ, and the state's rate, ``rate`` times the output."""
    output = (F - z) / mu
    return rate * output, output


def block_diagram(filter_rate: sp.Expr) -> System:
    """Follow the signals of Fig. 1, once around."""
    forward = gain * sp.sqrt(omega)  # √ω through the block K(t)
    state_rate, output = washout(filter_rate)  # y = F(x) through the block s/(μs + 1)
    total = omega + (-k) * output  # through the block −k to the sum with ω
    angular = gain * total  # and through the second block K(t)
    rhs = (f[0] + forward * sp.cos(theta), f[1] + forward * sp.sin(theta), angular, state_rate)
    return System(t, (x1, x2, theta, z), rhs, name="Fig. 1")


as_drawn = block_diagram(sp.S.One)
with_scaled_filter = block_diagram(gain)
plain_filter = System(t, (z,), (washout(sp.S.One)[0],))
plant_output = washout(sp.S.One)[1]


def _transfer_function() -> sp.Expr:
    """C (s − A)⁻¹ B + D of the filter, its coefficients taken from its equations, with the measurement as input."""
    rate, output = (entry.subs(F, sp.Symbol("y")) for entry in (plain_filter.rhs[0], plant_output))
    A, B = rate.diff(z), rate.diff(sp.Symbol("y"))
    C, D = output.diff(z), output.diff(sp.Symbol("y"))
    return C * B / (laplace - A) + D


transfer_function = _transfer_function()


@claim(
    "4/washout-realisation", "dz/dt = (y − z)/μ with the output (y − z)/μ realises s/(μs + 1)",
    eq(transfer_function, laplace / (mu * laplace + 1)), labels=["fig:unicycle_pt_controller", "eq:filter_tau"],
    place="Section 4",
)  # fmt: skip
def washout_realisation(goal: Goal) -> Evidence:
    """The transfer function C(s − A)⁻¹B + D of the two equations, for s > 0: two rational functions that agree there
    are the same."""
    return exact(goal)


@claim(
    "4/washout-differentiates", "For small μ the washout filter differentiates",
    eq(sp.Limit(laplace / (mu * laplace + 1), mu, 0, "+"), laplace), place="Section 4",
    uses=[washout_realisation],
)  # fmt: skip
def washout_differentiates(goal: Goal) -> Evidence:
    """At every fixed s > 0 the transfer function tends to s."""
    return limits(goal)


def _closed_loop(drawn: System) -> Relation:
    return eq(drawn.vector, closed_loop_t.vector)


@claim(
    "4/figure-as-drawn", "The block diagram as drawn is the closed loop", _closed_loop(as_drawn),
    labels=["fig:unicycle_pt_controller"], uses=[washout_realisation], expected="refuted", grade="definition",
    wrong="The diagram lets the filter run in the time t; in the closed loop its rate carries the gain K(t) as well.",
    survives="Yes: the theorem and its proof are about the equations, not about the diagram.",
)  # fmt: skip
def figure_as_drawn(goal: Goal) -> Evidence:
    """In the diagram the filter s/(μs + 1) runs in the time t, at a constant rate; in eq:closed_loop_system_t its
    rate carries the gain K(t) as well. The two differ in the equation of z as soon as t > t₀."""
    values = {F: x1, f[0]: sp.S.Zero, f[1]: sp.S.Zero, t0: 0, t: 1, T: 2, omega: 30, k: 1, mu: 1, theta: 0, z: 0}
    return refute(goal, values | {x1: 1, x2: 0})


@claim(
    "4/figure-corrected", "With the filter's rate scaled by K(t) it is the closed loop",
    _closed_loop(with_scaled_filter), given=IN_TIME, labels=["fig:unicycle_pt_controller"], corrects=figure_as_drawn,
)  # fmt: skip
def figure_corrected(goal: Goal) -> Evidence:
    """The filter is then s/(μs + 1) in the dilated time τ, as in eq:filter_tau, and its output is still (y − z)/μ."""
    return exact(goal)
