"""Section 5, Assumption 1 for the seeker: the fields b₁, b₂ of (τ, x, z), the dithers, and the fast rate."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.proof import Evidence, Goal, Smooth, claim, eq, every, exact, integrals, le, reals, smooth
from ptproof.system import jacobian, lie_bracket

from .notation import F, k, position, tau, x1, x2, y_tilde, z
from .section2_averaging import layer_function_printed, mixed_derivative_printed, phase
from .section5a_1_reduction import fast_rate, quasi_steady_state, quasi_steady_state_solves
from .section5a_1b_general_form import b1, b2, dithered_fields, general_form, u1, u2
from .section5a_2_averaging import b1_printed, b2_printed, bracket, fields_split

SECTION = "5.1 Theorem, Steps 1 to 3: Assumption 1"

arguments = (tau, *position, z)


def norm(entries: Sequence[sp.Expr]) -> sp.Expr:
    """The root of the sum of the squares, of a vector or of all entries of a matrix."""
    return sp.sqrt(sum(entry**2 for entry in entries))


def derivatives(vector: Sequence[sp.Expr], by: Sequence[sp.Symbol]) -> sp.Expr:
    """The norm of the matrix of partial derivatives."""
    return norm(list(jacobian(vector, by)))


# --- The fields -------------------------------------------------------------------------------------------------------


@claim(
    "5/assumption-a-fields", "Assumption 1A: b₁ and b₂ are twice continuously differentiable in (τ, x, z)",
    Smooth((*b1, *b2), arguments, 2), place="Assumption 1A", uses=[general_form],
)  # fmt: skip
def assumption_a(goal: Goal) -> Evidence:
    """Sine and cosine of kz, on all of ℝ × ℝ² × ℝ."""
    return smooth(goal)


@claim(
    "5/assumption-b-fields", "Assumption 1B: b₁ and b₂ are unit vectors, so that A₁ = 1",
    every(*(eq(norm(field) ** 2, 1) for field in dithered_fields)), place="Assumption 1B", uses=[general_form],
)  # fmt: skip
def assumption_b_fields(goal: Goal) -> Evidence:
    """For all τ, x and z."""
    return exact(goal)


def _all_derivatives(field: Sequence[sp.Expr]) -> sp.Expr:
    """‖∂b/∂τ‖ + ‖∂b/∂x‖ + ‖∂b/∂z‖ + ‖∂²b/∂τ∂x‖ + ‖∂²b/∂τ∂z‖, and what A₅ and A₆ bound with z held."""
    held = lie_bracket(b1, b2, position)
    parts = [*((vector, by) for vector in (field, held) for by in ((tau,), position, (z,)))]
    parts += [([sp.diff(entry, tau) for entry in field], by) for by in (position, (z,))]
    return sp.Add(*(derivatives(vector, by) for vector, by in parts))


@claim(
    "5/assumption-b-field-derivatives", "Assumption 1B: all derivatives of b₁ and b₂ together are bounded by k",
    every(*(le(_all_derivatives(field), k) for field in dithered_fields)), place="Assumption 1B",
    uses=[general_form], corrects=mixed_derivative_printed,
)  # fmt: skip
def assumption_b_field_derivatives(goal: Goal) -> Evidence:
    """The sum of the norms of the derivatives by τ, by x, by z, of the two mixed ones, and of those of the bracket with
    z held is at most k, so that A₂, …, A₆ may all be k. Only ∂b/∂z differs from 0, and it has the norm k."""
    return reals(goal)


composed_bracket = lie_bracket(b1_printed, b2_printed, position)
hessian = [sp.diff(F, v, w) for v in position for w in position]


@claim(
    "5/assumption-b-bracket", "Assumption 1B: the bracket of the composed fields has the derivatives of k∇F",
    every(
        le(derivatives(composed_bracket, position) + derivatives(composed_bracket, (z,)), k * norm(hessian)),
        le(norm(composed_bracket) + derivatives(composed_bracket, (tau,)), k * norm([sp.diff(F, v) for v in position])),
    ),
    place="Assumption 1B", uses=[bracket, fields_split],
)  # fmt: skip
def assumption_b_bracket(goal: Goal) -> Evidence:
    """A₅ for the bracket that enters the average: k times the norm of the Hessian of F. It does not depend on τ, which
    is A₆, and k‖∇F‖ bounds it."""
    return reals(goal)


@claim(
    "5/assumption-b-bounds-are-continuous",
    "The bounds are made of what is continuous in x, so bounded on compact sets",
    Smooth((*(sp.diff(F, v) for v in position), *hessian), position, 0, ((F, 2),)),
    place="Assumption 1B", uses=[assumption_b_bracket],
)  # fmt: skip
def bounds_are_continuous(goal: Goal) -> Evidence:
    """F is in C² by Assumption 2; a continuous function is bounded on a compact set."""
    return smooth(goal)


# --- The dithers ------------------------------------------------------------------------------------------------------


@claim(
    "5/assumption-c", "Assumption 1C: the dithers are bounded by 1",
    every(le(sp.Abs(u1), 1), le(sp.Abs(u2), 1)), place="Assumption 1C", uses=[general_form],
)  # fmt: skip
def assumption_c(goal: Goal) -> Evidence:
    """M = 1. They are continuous, hence measurable, and functions of the phase alone, so that every positive Lipschitz
    constant in the slow time will do: the left side of that condition is 0."""
    return reals(goal)


_s = sp.Symbol("s", real=True)


@claim(
    "5/assumption-d-period", "Assumption 1D: the dithers have the period 2π",
    every(*(eq(sp.Subs(wave.subs(phase, _s), _s, phase + 2 * sp.pi), wave) for wave in (u1, u2))),
    place="Assumption 1D", uses=[general_form],
)  # fmt: skip
def assumption_d_period(goal: Goal) -> Evidence:
    """T_f = 2π in the phase ωτ."""
    return exact(goal)


@claim(
    "5/assumption-d-mean", "Assumption 1D: the dithers have zero mean",
    every(*(eq(sp.Integral(wave.subs(phase, _s), (_s, 0, 2 * sp.pi)), 0) for wave in (u1, u2))),
    place="Assumption 1D", uses=[general_form],
)  # fmt: skip
def assumption_d_mean(goal: Goal) -> Evidence:
    """Over one period."""
    return integrals(goal)


# --- The fast rate --------------------------------------------------------------------------------------------------


@claim(
    "5/assumption-e", "Assumption 1E: the fast rate is continuously differentiable, so locally Lipschitz",
    Smooth((fast_rate,), (x1, x2, z), 1, ((F, 2),)), place="Assumption 1E", uses=[general_form],
)  # fmt: skip
def assumption_e(goal: Goal) -> Evidence:
    """g(x, z) = F(x) − z with F in C²."""
    return smooth(goal)


@claim(
    "5/assumption-f", "Assumption 1F: the quasi-steady state is twice continuously differentiable",
    Smooth((F,), position, 2, ((F, 2),)), place="Assumption 1F", uses=[quasi_steady_state_solves, quasi_steady_state],
)  # fmt: skip
def assumption_f(goal: Goal) -> Evidence:
    """l = F; that it is the only one is a claim of Step 2."""
    return smooth(goal)


@claim(
    "5/assumption-layer-function", "ỹ²/2 has the derivative that Theorem 1 uses",
    Smooth((y_tilde**2 / 2,), (y_tilde,), 1), place="Theorem 1", corrects=layer_function_printed,
)  # fmt: skip
def layer_function(goal: Goal) -> Evidence:
    """The V of Step 5 is continuously differentiable; its bounds and its rate are claims of Step 5."""
    return smooth(goal)
