"""Beyond the paper: a filter that is as fast as the dither, μω = m, where the paper lets μ → 0 first.

With μ and ω on their own scales the average depends on m: the gradient comes weaker, and turned.
"""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import DitherProblem, FastStates, average_to_order, split_dithers
from ptproof.proof import Evidence, Goal, claim, eq, every, exact, limits, lt, reals
from ptproof.system import System, gradient

from .chain import averaged_tau, reduced_coordinates
from .notation import IN_TAU, F, k, m, mu, omega, position, tau, x1, x2, z
from .section5a_2_averaging import averaged_system

SECTION = "Beyond the paper"

# The closed loop in reduced coordinates, the filter kept: its rate times μ is F − z.
moving = split_dithers(System(tau, (x1, x2), reduced_coordinates.rhs[:2]), omega)
filtered = FastStates((z,), (sp.cancel(mu * reduced_coordinates.rhs[2]),))
finite = average_to_order(DitherProblem(moving, filtered, mu_omega=m))

slope = gradient(F, position)
turn = sp.ImmutableDenseMatrix([[0, -1], [1, 0]])
drift = sp.ImmutableDenseMatrix(moving.drift)
average = sp.ImmutableDenseMatrix(finite.averages[0])
seeking, paper = average - drift, averaged_tau.vector - drift  # what the dithers add, here and for m → 0


@claim(
    "beyond/finite-filter", "With μω = m the average is f/ν² + k/(2(1 + m²)) (I + mJ) ∇F",
    eq(average, drift + k / (2 * (1 + m**2)) * (sp.eye(2) + m * turn) * slope),
    given=IN_TAU,
)  # fmt: skip
def finite_filter(goal: Goal) -> Evidence:
    """J turns by a right angle. A filter that settles no faster than the dither turns sees only a part of what the
    dither does to the field, and sees it late: the gradient enters with the factor 1/(1 + m²) and turned by atan m.
    The change of variables behind the average is put back into the system and checked. $F$ and $f$ are unknown."""
    return exact(goal)


@claim(
    "beyond/finite-filter-limit", "For m → 0 the dithers add what the Lie bracket average says",
    every(*(eq(sp.Limit(seeking[i], m, 0, "+"), paper[i]) for i in (0, 1))), uses=[finite_filter, averaged_system],
)  # fmt: skip
def finite_filter_limit(goal: Goal) -> Evidence:
    """The paper's average is that of a filter that is infinitely fast; the drift is the same in both."""
    return limits(goal)


@claim(
    "beyond/finite-filter-first-order", "The turn is of first order in m, the loss of gain of second",
    eq(seeking - paper, k * m / (2 * (1 + m**2)) * (turn - m * sp.eye(2)) * slope), uses=[finite_filter],
)  # fmt: skip
def finite_filter_first_order(goal: Goal) -> Evidence:
    """What the paper's limit leaves out, exactly."""
    return exact(goal)


@claim(
    "beyond/finite-filter-climbs", "Without drift every average climbs, at any m",
    lt(0, (slope.T * seeking)[0]), given=[lt(0, slope[0] ** 2 + slope[1] ** 2)], uses=[finite_filter],
)  # fmt: skip
def finite_filter_climbs(goal: Goal) -> Evidence:
    """∇Fᵀ(I + mJ)∇F = ‖∇F‖², since J turns the gradient away from itself: the height is gained at the rate
    k‖∇F‖²/(2(1 + m²)). It is about the average, not about the vehicle."""
    return reals(goal)
