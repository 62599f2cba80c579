"""Section VI: the numbers of the simulation, and what follows from them for the averaged systems.

The rate h of the measurement's filter is not given, so that the figures cannot be repeated from the text alone. What
h was is found from the data that the authors published with the paper: newton/6-observed-published.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact, ge, gt, limits, lt, reals

from . import chain
from .notation import F_star, F_x, H, alpha, d, nu, omega, omega_0, omega_d, p, t, x1, x2, xs1, xs2
from .section4_linear import discriminant as gradient_discriminant
from .section4_linear import eigenvalues_complex as gradient_eigenvalues
from .section5a_design import average_newton
from .section5a_design import discriminant as newton_discriminant
from .section5a_design import eigenvalues_complex as newton_eigenvalues
from .section8_newton_average import POWERS

SECTION = "VI Simulation results"
PLACE = "Section VI"

NUMBERS = {
    omega: 15,
    omega_0: 1,
    alpha: 2,
    omega_d: sp.Rational(3, 10),
    p: sp.Rational(61, 100),
    H: sp.Rational(1, 100),
}
START = {x1: 4, x2: -4, xs1: 1, xs2: -1, F_star: 5, nu: 0, d: 1}
parameters = definition(
    "newton/6-parameters", "The parameters of the simulation",
    every(*(eq(letter, value) for letter, value in {**NUMBERS, **START}.items())), labels=[],
    prose="Of x, ν and d at the start. The rate h of the measurement's filter is not given.",
)  # fmt: skip


@claim(
    "newton/6-inverse-hessian", "H⁻¹ = 100", eq(1 / H, 100), given=[eq(H, NUMBERS[H])], place=PLACE,
)  # fmt: skip
def inverse_hessian(goal: Goal) -> Evidence:
    """Of H = 1/100."""
    return exact(goal)


@claim(
    "newton/6-exponent", "p = 0.61 is between 1/2 and 1",
    every(gt(p, sp.Rational(1, 2)), lt(p, 1)), given=[eq(p, NUMBERS[p])], place=PLACE,
)  # fmt: skip
def exponent(goal: Goal) -> Evidence:
    """As the Propositions ask for."""
    return reals(goal)


@claim(
    "newton/6-condition", "At p = 0.61 four times p₃ is 3 or more",
    ge(4 * POWERS[2], 3), given=[eq(p, NUMBERS[p])], place=PLACE, uses=[exponent],
)  # fmt: skip
def condition(goal: Goal) -> Evidence:
    """So that the last condition of Assumption 2 speaks of f₃, and does not hold: see
    newton/A2-condition-on-quadruples-printed. It is 3.12."""
    return reals(goal)


@claim(
    "newton/6-start", "The vehicle starts at the distance 3√2, where the field is 4.91",
    every(
        eq(sp.sqrt((x1 - xs1) ** 2 + (x2 - xs2) ** 2).subs(START), 3 * sp.sqrt(2)),
        eq(F_x.subs(START).subs(NUMBERS), sp.Rational(491, 100)),
    ),
    place=PLACE,
)  # fmt: skip
def start(goal: Goal) -> Evidence:
    """From x₀ = (4, −4), with the source at (1, −1) and F* = 5."""
    return exact(goal)


@claim(
    "newton/6-complex", "The eigenvalues λ₁, λ₂ of both seekers are not real",
    every(lt(gradient_discriminant.subs(NUMBERS), 0), lt(newton_discriminant.subs(NUMBERS), 0)), place=PLACE,
)  # fmt: skip
def not_real(goal: Goal) -> Evidence:
    """So that their real parts are −αH/4 and −α/4."""
    return reals(goal)


@claim(
    "newton/6-faster", "On average the Newton seeker comes near a hundred times as fast as the gradient seeker",
    every(
        eq((alpha * H / 4).subs(NUMBERS), sp.Rational(1, 200)), eq((alpha / 4).subs(NUMBERS), sp.Rational(1, 2)),
        eq((alpha / 4 / (alpha * H / 4)).subs(NUMBERS), 100),
    ),
    place=PLACE, uses=[not_real, gradient_eigenvalues, newton_eigenvalues],
)  # fmt: skip
def faster(goal: Goal) -> Evidence:
    """By the real parts of the eigenvalues at the equilibrium: 0.005/s and 0.5/s."""
    return exact(goal)


# The averaged Riccati filter from d₀ = 1.
estimate = 1 / (H + (1 - H) * sp.exp(-omega_d * t))


@claim(
    "newton/6-estimate", "The averaged Riccati filter from d₀ = 1 is 1/(H + (1 − H) e^(−ω_d t))",
    every(
        eq(sp.diff(estimate, t), chain.newton_averaged.rhs[2].subs(d, estimate)),
        eq(estimate.subs(t, 0), 1),
    ),
    given=[lt(H, 1), ge(t, 0)], place=PLACE, uses=[average_newton],
)  # fmt: skip
def riccati_estimate(goal: Goal) -> Evidence:
    """Put into its equation."""
    return exact(goal)


@claim(
    "newton/6-estimate-limit", "It tends to H⁻¹", eq(sp.Limit(estimate, t, sp.oo), 1 / H), given=[lt(H, 1)],
    place=PLACE, uses=[riccati_estimate],
)  # fmt: skip
def estimate_limit(goal: Goal) -> Evidence:
    """Here from 1 to 100."""
    return limits(goal)


@claim(
    "newton/6-half-way", "It is half of H⁻¹ at t = ln(1/H − 1)/ω_d",
    eq(estimate.subs(t, sp.log(1 / H - 1) / omega_d), 1 / (2 * H)), given=[lt(H, 1)], place=PLACE,
    uses=[riccati_estimate],
)  # fmt: skip
def half_way(goal: Goal) -> Evidence:
    """Here at 15.3: how long the estimate takes depends on H, of which only the rate at the source is free."""
    return exact(goal)
