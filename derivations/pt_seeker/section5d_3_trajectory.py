"""Section 5, Proposition: the estimates for the averaged trajectory, from the averaged system and the assumptions."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Fact,
    Goal,
    claim,
    eq,
    ge,
    gt,
    le,
    lt,
    power_nonnegative,
    reals,
    specialise,
    squeezed,
)

from .notation import T, c, d, k, kappa, q, t, t0, tau, x1, x2
from .section5b_0_trajectory import X1, X2, V_along, assumption_2, at, s, solves
from .section5b_0_trajectory import distance as distance_of_x
from .section5b_0_trajectory import start as since
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_1_lyapunov import EXAMPLE_QUARTIC, W, along_X, at_order
from .section5c_1_proposition import PUSHED, assumption_3b, bounded_drift, constants_ordered, d_of, largest, u_bounds
from .section5d_1_interval import (
    Z,
    beta,
    distance,
    end,
    fixed,
    gamma,
    half,
    halved,
    low,
    m,
    middle_bound,
    rate_of,
    second,
    start,
    zeta_at,
)
from .section5d_2_estimates import (
    duration_in_t,
    high_input,
    inner,
    input_in_t,
    kappa_1,
    kappa_2,
    larger_input,
    low_input,
    pull,
    size,
    slope,
)

SECTION = "5.4 Proposition: the estimate in both times"

PUT_IN = {W(s): along_X, distance(s): at(distance_of_x, s)}
Along = Callable[[Goal, sp.Expr], list[Fact]]


def example(order: sp.Expr) -> dict[sp.Basic, object]:
    """A trajectory on which the assumptions are seen to hold: F = −‖x‖² for κ = 1, F = −‖x‖⁴ for κ = 2."""
    return (PUSHED if order == 1 else EXAMPLE_QUARTIC | {d_of(t): 0, m: 1}) | {start: 0, t: sp.Rational(1, 2)}


def example_middle(order: sp.Expr, value: sp.Expr) -> sp.Expr:
    """The value of X on that trajectory."""
    known = {key: entry for key, entry in example(order).items() if key.is_Symbol}
    return sp.sympify(value.subs(distance_at(t0), 1)).subs(known)


def distance_at(time: sp.Expr) -> sp.Expr:
    """‖X − x*‖ at an instant."""
    return at(distance_of_x, time)


def assumed(order: sp.Expr, until: sp.Expr | None, first: sp.Expr) -> list[Assumption]:
    """X solves the averaged system from ``first`` on, under Assumptions 2 and 3B."""
    return [*solves(until, first), *at_order(assumption_2, order), assumption_3b, largest(until)]


def at_times(goal: Goal, order: sp.Expr, *times: sp.Expr) -> list[Fact]:
    """At instants of the trajectory V ≥ 0, and U between multiples of the distance; and a₂ ≤ a₁."""
    found = [*specialise(goal, constants_ordered, {kappa: order})]
    for time in times:
        place = {kappa: order, x1: X1(time), x2: X2(time)}
        for used in (nonnegative, u_bounds):
            found += specialise(goal, used, place)
    return found


@claim(
    "prop/zeta-decreases", "ζ decreases where the bound of the drift stays",
    le(zeta_at(s, kappa), zeta_at(start, kappa)),
    given=[ge(start, t0), ge(s, start)], place="Proof of the Proposition",
)  # fmt: skip
def zeta_decreases(goal: Goal) -> Evidence:
    """Its denominator grows. So the supremum of ζ on [p, τ] is its value at p, with the largest bound up to τ."""
    return reals(goal)


@claim(
    "prop/bounded-drift-by-zeta", "The inequality for V by the letters of U",
    le(slope, 2 * kappa * (zeta_at(s, kappa) * size - rate_of(kappa) * pull)),
    given=[le(slope, c(2) * d / (1 + (s - t0) / T) ** 2 * size - k * c(1) ** 2 / 2 * pull), ge(s, t0)],
    place="Proof of the Proposition",
)  # fmt: skip
def by_zeta(goal: Goal) -> Evidence:
    """c₂‖d‖/(1 + (τ − t₀)/T)² is 2κζ, and k c₁²/2 is 2κh₁."""
    return reals(goal)


def falling(order: sp.Expr, first: sp.Expr, forcing: sp.Expr | None = None) -> Along:
    """What shows, at an arbitrary instant, that V along X satisfies the inequality with ζ, or with a larger input."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        value = V_along.subs(tau, point)
        power, square = value ** q(order), value ** (2 * q(order))
        said = [
            *specialise(there, nonnegative, {kappa: order, x1: X1(point), x2: X2(point)}),
            power_nonnegative(value, q(order)), power_nonnegative(value, 2 * q(order)),
        ]  # fmt: skip
        rate = sp.Derivative(value, point)
        values = {kappa: order, s: point, slope: rate, size: power, pull: square}
        said += [
            *specialise(there, bounded_drift, {kappa: order, tau: point, since: first}),
            *specialise(there, by_zeta, values, said),
        ]  # fmt: skip
        if forcing is None:
            return said
        values = {
            kappa: order, slope: rate, low_input: zeta_at(point, order), high_input: forcing, size: power,
            pull: rate_of(order) * square,
        }  # fmt: skip
        return [
            *said, *specialise(there, zeta_decreases, {kappa: order, s: point}),
            *specialise(there, larger_input, values, said),
        ]  # fmt: skip

    return along


def named(claims: tuple[Claim, ...], name: str) -> Claim:
    """The claim whose id begins so."""
    return next(item for item in claims if item.id.startswith(f"prop/{name}-kappa"))


def at_the_middle(order: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """What the first half's estimate gives for the distance at the middle."""
    return inner(order, duration).subs(distance(t0), distance_at(t0))


def on_the_trajectory(order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> tuple[Claim, Claim, Claim]:
    """The printed estimates along every solution, for one kind of κ."""
    basis = [bounded_drift, by_zeta, nonnegative, u_bounds, constants_ordered]
    upper_bound, finale = named(scalar, "upper-bound"), named(scalar, "finale")
    forcing = zeta_at(start, order)

    @claim(
        f"prop/solution-upper-bound-{tag}", f"The input-to-state estimate along every averaged solution ({words})",
        le(distance_at(tau), beta(distance_at(start), tau - start, order) + gamma(forcing, order)),
        given=[*assumed(order, tau, start), ge(start, t0), ge(tau, start)],
        labels=["eq:upper_bound"], uses=[upper_bound, *basis, zeta_decreases, larger_input], example=example(order),
    )  # fmt: skip
    def on_one_interval(goal: Goal) -> Evidence:
        """From the averaged system and the assumptions, from every time p ≥ t₀, whether the solution meets the source
        or not. This is input-to-state stability with the printed gain, and no theorem on it is needed."""
        return reals(
            goal, *at_times(goal, order, start, tau),
            *specialise(goal, upper_bound, {**PUT_IN, Z: forcing}, along=falling(order, start, forcing)),
        )  # fmt: skip

    @claim(
        f"prop/solution-finale-{tag}", f"The estimate from t₀ on along every averaged solution ({words})",
        le(distance_at(tau), beta(middle_bound, (tau - t0) / 2, order) + gamma(halved(tau, order), order)),
        given=[eq(middle_bound, at_the_middle(order, tau - t0)), *assumed(order, tau, t0), ge(tau, t0)],
        labels=["eq:finale"], uses=[finale, *basis],
        example=example(order) | {middle_bound: example_middle(order, at_the_middle(order, tau - t0))},
    )  # fmt: skip
    def on_both_halves(goal: Goal) -> Evidence:
        """With the initial distance of the solution. X abbreviates what is printed there: β of the initial distance
        plus the gain of the first half's input."""
        return reals(
            goal, *at_times(goal, order, t0, half, tau),
            *specialise(goal, finale, PUT_IN, along=falling(order, t0)),
        )  # fmt: skip

    @claim(
        f"prop/solution-finale-in-t-{tag}", f"The estimate in the original time for every averaged solution ({words})",
        le(distance_at(end), beta(middle_bound, duration_in_t / 2, order) + gamma(input_in_t(order), order)),
        given=[
            eq(middle_bound, at_the_middle(order, duration_in_t)), *assumed(order, end, t0), ge(t, t0), lt(t, t0 + T),
        ],
        labels=["eq:finale_t"], uses=[on_both_halves],
        example=example(order) | {middle_bound: example_middle(order, at_the_middle(order, duration_in_t))},
    )  # fmt: skip
    def on_both_halves_in_t(goal: Goal) -> Evidence:
        """x̄(t) is X at the dilated time of t: the same signal on the other clock."""
        return reals(goal, *specialise(goal, on_both_halves, {tau: end}))

    return on_one_interval, on_both_halves, on_both_halves_in_t


def reaches_the_source(
    order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...], estimates: tuple[Claim, Claim, Claim]
) -> Claim:
    """The statement of the Proposition along every solution, for one kind of κ."""
    on_one_interval, _, on_both_halves_in_t = estimates
    linear = order == 1
    if linear:
        decayed = beta(at_the_middle(order, duration_in_t), duration_in_t / 2, order)
    else:
        decayed = fixed(duration_in_t / 2, order)
    bounded: tuple[Claim, ...] = () if linear else (named(scalar, "beta-uniform"),)

    @claim(
        f"prop/solution-convergence-{tag}", f"Every averaged solution reaches the source in the time T ({words})",
        eq(sp.Limit(distance_at(end), t, t0 + T, "-"), 0), given=assumed(order, None, t0), labels=["proposition"],
        uses=[on_one_interval, on_both_halves_in_t, *bounded], example=example(order),
    )  # fmt: skip
    def convergence(goal: Goal) -> Evidence:
        """The statement of the Proposition, from its assumptions: a solution of the averaged system on all of I_τ,
        under a drift with a bound. For κ ≥ 2 the estimate on the second half alone is enough, since β forgets the
        distance."""

        def facts(there: Goal) -> list[Fact]:
            if linear:
                middle = {middle_bound: at_the_middle(order, duration_in_t)}
                return [*specialise(there, on_both_halves_in_t, middle)]
            middle_time = half.subs(tau, end)
            values = {second: distance_at(middle_time), low: duration_in_t / 2}
            return [
                *specialise(there, on_one_interval, {start: middle_time, tau: end}),
                *specialise(there, bounded[0], values),
            ]  # fmt: skip

        return squeezed(goal, decayed + gamma(input_in_t(order), order), [gt(t, t0), lt(t, t0 + T)], facts)

    return convergence


solution_1 = on_the_trajectory(sp.Integer(1), "kappa-1", "κ = 1", kappa_1)
solution_2 = on_the_trajectory(m + 1, "kappa-2", "κ ≥ 2", kappa_2)
convergence_1 = reaches_the_source(sp.Integer(1), "kappa-1", "κ = 1", kappa_1, solution_1)
convergence_2 = reaches_the_source(m + 1, "kappa-2", "κ ≥ 2", kappa_2, solution_2)
