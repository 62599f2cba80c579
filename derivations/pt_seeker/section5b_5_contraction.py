"""Section 5, Theorem 2, Steps 5 and 6: the averaging theorem, and back to the original time."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    Prose,
    Relation,
    cited,
    claim,
    eq,
    every,
    exact,
    ge,
    instances,
    le,
    lt,
    reals,
    specialise,
)

from . import chain, extended
from .chain import clock
from .notation import T, mu, t, t0, y_tilde
from .section2_averaging import averaging_theorem
from .section2_averaging import boundary_layer as general_boundary_layer
from .section2_change_of_time import contraction_rate, inverse_map
from .section2_ranges import dilation_range
from .section4_design import closed_loop_in_t
from .section5a_1_reduction import boundary_layer, quasi_steady_state
from .section5a_3_uniformity import bounds_with_phase, bracket_with_phase, mu_one, one_start, one_system
from .section5a_6_extended import extended_assumptions, extended_is_averaged, extended_other_data
from .section5a_bounds import assumption_1
from .section5b_2_gradient_drift import guas
from .section5b_4_all_starts import seeker_distance, stable_average
from .section5d_4_guas import guas_driftless
from .section8_1_definitions import image, matching_starts, matching_x, matching_z, start_x, start_z, t_f
from .section8_1_definitions import settling as tau_f
from .section8_2_contraction import equivalence
from .section8_3_printed import printed_met_for_x, printed_met_for_z

SECTION = "5.2 Theorem, Steps 4 to 6: stability"

# --- Step 5 -----------------------------------------------------------------------------------------------------------

V_layer = y_tilde**2 / 2


layers = (chain.boundary_layer, extended.boundary_layer)
size = sp.Symbol("s", nonnegative=True)


def _of_size(function: sp.Expr) -> sp.Expr:
    """A function of s at s = |ỹ|."""
    return sp.Subs(function, size, sp.Abs(y_tilde))


@claim(
    "5/step5-layer-rate", "The boundary layer's Lyapunov function",
    every(*(eq(-(y_tilde**2), sp.Derivative(V_layer, y_tilde) * layer.rhs[0]) for layer in layers)),
    labels=["eq:blm_req_2"], uses=[boundary_layer, general_boundary_layer],
)  # fmt: skip
def layer_rate(goal: Goal) -> Evidence:
    """V(ỹ) = ỹ²/2 decreases at the rate ỹ², along the boundary layer of the closed loop and of the system of all
    starts."""
    return exact(goal)


@claim(
    "5/step5-layer-bounds", "It lies between class-K∞ functions, and so does its rate",
    every(
        le(_of_size(size**2 / 2), V_layer), le(V_layer, _of_size(size**2 / 2)),
        *(le(sp.Derivative(V_layer, y_tilde) * layer.rhs[0], -_of_size(size**2)) for layer in layers),
    ),
    labels=["eq:blm_req_1", "eq:blm_req_2"], uses=[layer_rate],
)  # fmt: skip
def layer_bounds(goal: Goal) -> Evidence:
    """α₁ = α₂ = s²/2 and α₃ = s²."""
    return reals(goal)


step_five = claim(
    "5/step5-averaging-applies", "Theorem 1 for the seeker: the source is sSPUAS for the closed loop in dilated time",
    Prose("By Theorem 1 the set {x*} × [−1, 1] is singularly semi-globally practically uniformly asymptotically stable "
          "for the system of all starts in fast time, in both cases of Theorem 2: without drift for every κ, and with "
          "f = E∇F for κ = 1"),
    expected="cited", place="Step 5",
    uses=[
        averaging_theorem, *assumption_1, *extended_assumptions, quasi_steady_state, layer_bounds, guas,
        *guas_driftless, *stable_average, extended_is_averaged, extended_other_data, mu_one, bounds_with_phase,
        bracket_with_phase,
    ],
)(cited("the paper's Theorem 1, and nothing else: its hypotheses are the claims listed"))  # fmt: skip

# --- Step 6 -----------------------------------------------------------------------------------------------------------

s = sp.Symbol("s", real=True)
begin = sp.Symbol("sigma_0", nonnegative=True)  # the fast time at which the system of all starts begins
eps_x, eps_z = sp.symbols("epsilon_x epsilon_z", positive=True)
# ‖x − x*‖ and |z − F(x)| along the closed loop, in the fast time and in t.
x_fast, z_fast, x_time, z_time = (sp.Function(name, nonnegative=True) for name in ("D_x", "D_z", "X_t", "Z_t"))
tx, tz = sp.symbols("t_x t_z", real=True)


def fast(instant: sp.Expr) -> sp.Expr:
    """The fast time of the system of all starts that belongs to an instant t."""
    return begin + (clock.to_tau.subs(t, instant) - t0) / mu


in_time = (ge(s, t0), lt(s, t0 + T))
same_x = ForAll((s,), eq(x_time(s), x_fast(fast(s))), in_time)
same_z = ForAll((s,), eq(z_time(s), z_fast(fast(s))), in_time)
x_settled = ForAll((s,), lt(x_fast(s), eps_x), (ge(s, begin + t_f / mu),))
z_settled = ForAll((s,), lt(z_fast(s), eps_z), (ge(s, begin + t_f),))
same_trajectory = [same_x, same_z]
both_small = every(lt(x_time(tx), eps_x), lt(z_time(tz), eps_z))


def within(start_of_x: sp.Expr, start_of_z: sp.Expr) -> list[Relation]:
    """The two instants lie in the two intervals."""
    return [ge(tx, start_of_x), lt(tx, t0 + T), ge(tz, start_of_z), lt(tz, t0 + T)]


length = sp.Symbol("L", nonnegative=True)
d_fast, d_time = (sp.Function(name, nonnegative=True) for name in ("D", "D_t"))
eps = sp.Symbol("epsilon", positive=True)


@claim(
    "5/step6-image", "What is below ε from σ₀ + L on in fast time is so in t from the image of t₀ + μL on",
    lt(d_time(t), eps),
    given=[
        ForAll((s,), eq(d_time(s), d_fast(fast(s))), in_time),
        ForAll((s,), lt(d_fast(s), eps), (ge(s, begin + length),)), ge(t, image(t0 + mu * length)), lt(t, t0 + T),
    ],
    place="Step 6", uses=[inverse_map, dilation_range],
)  # fmt: skip
def image_of_fast_time(goal: Goal) -> Evidence:
    """The fast time L is the slow time μL, and the dilation increases: for a distance along any trajectory that is run
    through on both clocks."""
    return reals(goal, *instances(goal, t, fast(t)))


joints = [step_five, one_system, one_start, seeker_distance, closed_loop_in_t, contraction_rate, image_of_fast_time]


def shown(goal: Goal, of_x: sp.Expr, of_z: sp.Expr) -> Evidence:
    """That claim for x and for z, with these lengths."""
    values = [
        {d_fast(s): x_fast(s), d_time(s): x_time(s), eps: eps_x, t: tx, length: of_x},
        {d_fast(s): z_fast(s), d_time(s): z_time(s), eps: eps_z, t: tz, length: of_z},
    ]
    return reals(goal, *(fact for put in values for fact in specialise(goal, image_of_fast_time, put)))


@claim(
    "5/step6-stays", "What stays within ε_x and ε_z in fast time does so in t: stability and boundedness",
    both_small,
    given=[
        *same_trajectory, ForAll((s,), lt(x_fast(s), eps_x), (ge(s, begin),)),
        ForAll((s,), lt(z_fast(s), eps_z), (ge(s, begin),)), *within(t0, t0),
    ],
    place="Step 6", labels=["thm:main_theorem", "def:FxT-sSPUAS"], uses=joints,
)  # fmt: skip
def stays(goal: Goal) -> Evidence:
    """For the two properties that name no settling time. The radii δ and ε, ω₀ and μ₀ are the same on both clocks."""
    return shown(goal, sp.S.Zero, sp.S.Zero)


@claim(
    "5/main-theorem", "Theorem 2 for the matching definition: what Theorem 1 gives holds in t from the images on",
    both_small, given=[*same_trajectory, x_settled, z_settled, *within(matching_x, matching_z)],
    labels=["thm:main_theorem"], place="Theorem 2", uses=[*joints, stays, matching_starts, *equivalence],
)  # fmt: skip
def main_theorem(goal: Goal) -> Evidence:
    """Theorem 1 gives δ, ε, t_f, ω₀ and μ₀ for the system of all starts in fast time: without drift for every κ, with
    drift E∇F for κ = 1. A seeker in t with any initial time and heading is one of its trajectories, at the fast time
    σ₀ + (a(t) − t₀)/μ. So x is within ε_x from the image of t₀ + t_f on, and z within ε_z from that of t₀ + μt_f on,
    with the same δ, ε, ω₀ and μ₀. This is FxT-sSPUAS with t_f in [0, ∞)."""
    return shown(goal, t_f / mu, t_f)


@claim(
    "5/main-theorem-printed", "Theorem 2 for the printed definition: every τ_f > 0 serves as soon as μt_f ≤ τ_f",
    both_small,
    given=[*same_trajectory, x_settled, z_settled, le(mu * t_f, tau_f), *within(start_x, start_z)],
    labels=["thm:main_theorem", "def:FxT-sPUA"], place="Theorem 2",
    uses=[*joints, stays, printed_met_for_x, printed_met_for_z],
)  # fmt: skip
def main_theorem_printed(goal: Goal) -> Evidence:
    """So the theorem holds as printed, too: with the smaller of μ₀ and τ_f/t_f for μ₀, and a τ_f that may be taken from
    [0, T) whatever t_f is. But it then says nothing about when x arrives."""
    return shown(goal, t_f / mu, t_f)
