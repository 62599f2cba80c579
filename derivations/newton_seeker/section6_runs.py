"""Section VI: the runs. What is proved of them, and what is observed for the rates h of the filter that are possible.

The averaged position and the averaged Riccati filter do not depend on h, so that their runs are those of the paper.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from ptproof.certify import enclosed
from ptproof.proof import Claim, Evidence, Goal, Relation, Runs, claim, eq, exact, ge, gt, le, lt, reals
from ptproof.simulation.observed import Statement
from ptproof.simulation.observed import observed as observation
from ptproof.system import System

from . import chain
from .notation import F_x, Y, alpha_t, d, d_plus, h, nu, omega, omega_d, rotated, t, x1, x2, xs1, xs2, z, z1, z2
from .section4_gradient import average_gradient
from .section5a_design import average_newton, closed_loop
from .section6_simulation import NUMBERS, PLACE, START
from .section8_gradient_average import gains

SECTION = "VI Simulation results: the runs"

# --- The averages from the paper's start -----------------------------------------------------------------------------

offset = sp.Matrix([x1 - xs1, x2 - xs2]).subs(START)


@claim(
    "newton/6-start-in-z", "At t = 0 the start is z = (3, 3)",
    eq(Y(sp.S.Zero).T * offset, sp.Matrix([3, 3])), place=PLACE,
)  # fmt: skip
def start_in_z(goal: Goal) -> Evidence:
    """z = Yᵀ(0)(x₀ − x*)."""
    return exact(goal)


def run(system: System, count: int, parts: Sequence[Relation], during: tuple[int, int]) -> Runs:
    """What holds on the run of the first states of an averaged system from the paper's start."""
    first, last = map(sp.Integer, during)
    state, rates = system.state[:count], tuple(rate.subs(NUMBERS) for rate in system.rhs[:count])
    starts = tuple(eq(symbol, {**dict.fromkeys(rotated, 3), **START}[symbol]) for symbol in state)
    return Runs(t, state, rates, (sp.S.Zero, last), starts, tuple(parts), (first, last))


squared = z1**2 + z2**2


@claim(
    "newton/6-average-converges", "The averaged Newton seeker is at the source, and its estimate at 1/H, by t = 30",
    run(chain.newton_averaged, 3, [lt(10**5 * squared, 1), lt(sp.Abs(d - 100), 2)], (30, 30)), place=PLACE,
    uses=[average_newton, start_in_z],
)  # fmt: skip
def average_converges(goal: Goal) -> Evidence:
    """From 3√2 to less than 0.0032, and from 1 to 98.8, whatever h is."""
    return enclosed(goal)


@claim(
    "newton/6-average-stays", "From there it does not go away again: d‖z̄‖²/dt ≤ 0 while d̄ ≥ 0",
    le((z.T * sp.Matrix(chain.newton_averaged.rhs[:2]))[0], 0), given=[ge(d, 0)], place=PLACE, uses=[average_newton],
)  # fmt: skip
def average_stays(goal: Goal) -> Evidence:
    """It is −αHd̄z̄₂² for twice that; J₀ turns without changing ‖z̄‖."""
    return reals(goal)


@claim(
    "newton/6-gradient-average-is-far", "The averaged gradient seeker is farther than 3 from the source until t = 60",
    run(chain.gradient_averaged, 2, [gt(squared, 9)], (0, 60)), place=PLACE, uses=[average_gradient, start_in_z],
)  # fmt: skip
def gradient_far(goal: Goal) -> Evidence:
    """It comes from 3√2 to 3.14."""
    return enclosed(goal)


# --- The rate h ------------------------------------------------------------------------------------------------------


@claim(
    "newton/6-inverse-is-linear", "1/d obeys a linear equation",
    eq(
        -chain.newton.rhs[2].subs(d, d_plus) / d_plus**2,
        -omega_d / d_plus + omega_d * 8 * omega**2 / alpha_t**2 * (F_x - nu) * sp.cos(2 * omega * t),
    ),
    place=PLACE, uses=[closed_loop],
)  # fmt: skip
def inverse_is_linear(goal: Goal) -> Evidence:
    """So that d grows without bound where 1/d comes to zero, and whether it does is a matter of F − ν: of how fast the
    filter of rate h removes what F − ν is at the start."""
    return exact(goal)


def vehicle(rate: sp.Expr, until: sp.Expr, *parts: Relation) -> Runs:
    """What the Newton seeker's run from the paper's start has at that instant, with that rate of the filter."""
    values = {**NUMBERS, **{key: START[key] for key in START if key not in chain.newton.state}, h: rate}
    rates = tuple(entry.subs(gains).subs(values) for entry in chain.newton.rhs)
    starts = tuple(eq(symbol, START[symbol]) for symbol in chain.newton.state)
    return Runs(t, chain.newton.state, rates, (sp.S.Zero, until), starts, parts, (until, until))


@claim(
    "newton/6-run-too-slow", "With h = 3/10 the state d is above 350 at t = 3.497",
    vehicle(sp.Rational(3, 10), sp.Rational(3497, 1000), gt(d, 350)), place=PLACE, uses=[closed_loop],
)  # fmt: skip
def run_too_slow(goal: Goal) -> Evidence:
    """It is 370 there and on its way to ten thousand, so that it was not this h with which d came to 100."""
    return enclosed(goal, width="1e-2")


def made(name: str, *arguments: Any) -> Statement:
    """The named statement of :mod:`.experiments.observations`, which is read only now."""
    from .experiments import observations

    found: Statement = getattr(observations, name)(*arguments)
    return found


def observed(id: str, title: str, text: str, name: str, *arguments: Any, place: str = PLACE) -> Claim:
    """One statement about simulations."""
    return observation(id, title, text, place, made, name, *arguments, section=SECTION)


estimate = observed(
    "newton/6-observed-estimate", "The Riccati filter estimates the inverse of the Hessian, for h from 0.4 to 5",
    "From t = 40 to 60 the state d is within 5% of 100", "estimates", place="Section VI, fig:hessian",
)  # fmt: skip
too_slow = observed(
    "newton/6-observed-too-slow", "For h of 0.38 and less it does not",
    "Before t = 15 the state d passes a hundred times 1/H", "too_slow",
)  # fmt: skip
published = observed(
    "newton/6-observed-published", "The h of the figures is 1",
    "Until t = 1.6 the run with h = 1 has the published d and positions to 1%, that of no other h to 2%",
    "published", place="Section VI, fig:hessian",
)  # fmt: skip
threshold = observed(
    "newton/6-observed-threshold", "Up to an h near 0.388 the state d passes a hundred times 1/H on its way",
    "Between h = 0.3875 and 0.3878 lies the rate from which on the state d stays below a hundred times 1/H",
    "threshold",
)  # fmt: skip
too_fast = observed(
    "newton/6-observed-too-fast", "For h of 10 and more the estimate is too large",
    "From t = 40 to 60 the state d is above 110", "too_fast",
)  # fmt: skip
faster = observed(
    "newton/6-observed-faster", "The Newton seeker converges much faster than the gradient seeker",
    "Until the distance stays below 1 the gradient seeker takes more than 20 times as long", "faster",
    place="Section VI, fig:states_and_F",
)  # fmt: skip
gradient_gap = observed(
    "newton/6-observed-gradient-gap", "The gap of the gradient seeker to its average falls like ω^(−(1 − p))",
    "For p = 0.61, 0.75 and 0.9 the slope over ω is at most −(1 − p) + 0.01", "gap", "gradient",
    place="Section IV, Proposition 1",
)  # fmt: skip
newton_gap = observed(
    "newton/6-observed-newton-gap",
    "The gap of the Newton seeker to its average falls like ω^(−(1 − p)) or ω^(−(2p − 1)), whichever is slower",
    "For p = 0.61, 0.75 and 0.9 the slope over ω is at most the negative of the smaller exponent + 0.01", "gap",
    "newton", place="Section V.A, Proposition 2",
)  # fmt: skip
