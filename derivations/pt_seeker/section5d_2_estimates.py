"""Section 5, Proposition: the class-KL estimate with explicit functions, in both times, and its limit."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    Relation,
    claim,
    eq,
    every,
    ge,
    gt,
    instances,
    le,
    limits,
    lt,
    power_monotone,
    power_nonnegative,
    reals,
    specialise,
    squeezed,
)

from .notation import T, a1, a2, d, kappa, nu, q, t, t0, tau
from .section5b_1_lyapunov import W
from .section5d_1_interval import (
    U_at,
    Z,
    beta,
    bounds_at,
    comparison_functions,
    denominator,
    distance,
    distance_in_t,
    elapsed,
    end,
    falls,
    first,
    fixed,
    gamma,
    half,
    halved,
    input_gain,
    low,
    m,
    middle_bound,
    rate_of,
    regular,
    s,
    second,
    start,
    zeta_at,
    zeta_suprema,
)
from .section5d_1_one_interval import one_interval

SECTION = "5.4 Proposition: the estimate in both times"

duration_in_t = (t - t0) / nu(t - t0)


def whole(order: sp.Expr) -> list[ForAll]:
    """The inequality for V on the whole of [t₀, τ]."""
    return falls(order, zeta_at(s, order), ge(s, t0), le(s, tau))


def everywhere(order: sp.Expr) -> list[Relation]:
    """eq:Ux_bounds at both ends of both halves."""
    return [*bounds_at(order, half, t0), *bounds_at(order, tau, half)]


def inner(order: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """The bound for the distance at the middle: β of the initial distance plus the gain of the first half's input."""
    return beta(distance(t0), duration / 2, order) + gamma(input_gain(order) * d, order)


def input_in_t(order: sp.Expr) -> sp.Expr:
    """The bound of ζ on the second half, in the original time."""
    return input_gain(order) * d / (1 + (t - t0) / (2 * T * nu(t - t0))) ** 2


slope = sp.Symbol("V_dot", real=True)
low_input, high_input, size, pull = sp.symbols("zeta_1 zeta_2 p_x P", nonnegative=True)


@claim(
    "prop/larger-input", "The inequality for V with a larger input", le(slope, 2 * kappa * (high_input * size - pull)),
    given=[le(slope, 2 * kappa * (low_input * size - pull)), le(low_input, high_input)],
    place="Proof of the Proposition",
)  # fmt: skip
def larger_input(goal: Goal) -> Evidence:
    """Its factor is not negative."""
    return reals(goal)


def with_input(order: sp.Expr, forcing: sp.Expr) -> Callable[[Goal, sp.Expr], list[Fact]]:
    """What shows the inequality for V with the constant input ``forcing``, at an arbitrary time."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        power, pulled = W(point) ** q(order), rate_of(order) * W(point) ** (2 * q(order))
        said = [
            *instances(there, point), power_nonnegative(W(point), q(order)), power_nonnegative(W(point), 2 * q(order)),
            *specialise(there, zeta_suprema, {kappa: order, s: point, elapsed: 0}),
        ]  # fmt: skip
        if forcing.has(tau):
            later = {kappa: order, elapsed: point - half}
            said += specialise(there, zeta_suprema, later)
        values = {
            kappa: order, slope: sp.Derivative(W(point), point), low_input: zeta_at(point, order),
            high_input: forcing, size: power, pull: pulled,
        }  # fmt: skip
        return [*said, *specialise(there, larger_input, values, said)]

    return along


def two_halves(order: sp.Expr, tag: str, words: str, upper_bound: Claim) -> tuple[Claim, Claim]:
    """The estimate on each half of [t₀, τ]."""
    g = input_gain(order)
    first_part = le(distance(half), beta(distance(t0), (tau - t0) / 2, order) + gamma(g * d, order))
    second_part = le(distance(tau), beta(distance(half), (tau - t0) / 2, order) + gamma(halved(tau, order), order))

    @claim(
        f"prop/upper-bound-first-half-{tag}", f"The estimate on the first half ({words})", first_part,
        given=[ge(tau, t0), *whole(order), le(a2, a1), *bounds_at(order, half, t0)],
        labels=["eq:upper_bound1"], uses=[upper_bound, zeta_suprema, larger_input],
    )  # fmt: skip
    def upper_bound_1(goal: Goal) -> Evidence:
        """From t₀ to the middle, where ζ is at most h₂ times the largest bound of the drift."""
        values = {start: t0, tau: half, Z: g * d}
        return reals(goal, *specialise(goal, upper_bound, values, along=with_input(order, g * d)))

    @claim(
        f"prop/upper-bound-second-half-{tag}", f"The estimate on the second half ({words})", second_part,
        given=[ge(tau, t0), *whole(order), le(a2, a1), *bounds_at(order, tau, half)],
        labels=["eq:upper_bound2"], uses=[upper_bound, zeta_suprema, larger_input],
    )  # fmt: skip
    def upper_bound_2(goal: Goal) -> Evidence:
        """From the middle on, where ζ has become small."""
        values, forcing = {start: half, Z: halved(tau, order)}, halved(tau, order)
        return reals(goal, *specialise(goal, upper_bound, values, along=with_input(order, forcing)))

    return upper_bound_1, upper_bound_2


def both_times(
    order: sp.Expr, tag: str, words: str, halves: tuple[Claim, Claim], decay_monotone: Claim
) -> tuple[Claim, Claim]:
    """Both halves together, in τ and in t."""
    root, (upper_bound_1, upper_bound_2) = 1 / (2 * order), halves

    @claim(
        f"prop/finale-{tag}", f"Both halves together ({words})",
        le(distance(tau), beta(middle_bound, (tau - t0) / 2, order) + gamma(halved(tau, order), order)),
        given=[eq(middle_bound, inner(order, tau - t0)), ge(tau, t0), *whole(order), le(a2, a1), *everywhere(order)],
        labels=["eq:finale"], uses=[upper_bound_1, upper_bound_2, decay_monotone],
    )  # fmt: skip
    def finale(goal: Goal) -> Evidence:
        """β increases with its first argument, so the estimate at the middle may be put into it. X abbreviates what is
        printed there: β of the initial distance plus the gain of the first half's input."""
        low_end, high_end, duration = a1**root * distance(half), a1**root * middle_bound, (tau - t0) / 2
        return reals(
            goal, *specialise(goal, upper_bound_1, {}), *specialise(goal, upper_bound_2, {}),
            *specialise(goal, decay_monotone, {first: low_end, second: high_end, elapsed: duration}),
            *regular(order, low_end, duration), *regular(order, high_end, duration),
        )  # fmt: skip

    @claim(
        f"prop/finale-in-t-{tag}", f"The estimate in the original time ({words})",
        le(distance_in_t(t), beta(middle_bound, duration_in_t / 2, order) + gamma(input_in_t(order), order)),
        given=[
            ge(t, t0), lt(t, t0 + T), le(a2, a1),
            eq(distance_in_t(t), distance(end)), eq(middle_bound, inner(order, duration_in_t)),
            *falls(order, zeta_at(s, order), ge(s, t0), le(s, end)),
            *(part.map(lambda side: side.subs(tau, end)) for part in everywhere(order)),
        ],
        labels=["eq:finale_t"], uses=[finale],
    )  # fmt: skip
    def finale_in_t(goal: Goal) -> Evidence:
        """The same signal on the other clock: τ − t₀ is replaced by (t − t₀)/ν, also in X."""
        return reals(goal, *specialise(goal, finale, {tau: end}))

    return finale, finale_in_t


def uniform(order: sp.Expr, tag: str, words: str) -> Claim:
    """β for κ ≥ 2 has a bound that does not depend on the distance."""
    h, root = rate_of(order), 1 / (2 * order)

    @claim(
        f"prop/beta-uniform-{tag}", f"β has a bound that does not depend on the distance ({words})",
        le(beta(second, low, order), fixed(low, order)), place="Proof of the Proposition",
    )  # fmt: skip
    def beta_uniform(goal: Goal) -> Evidence:
        """The power law forgets where it started: (w₀/D)^(2κ−2) is below 1/((2κ − 2)h₁ times the time)."""
        power = 2 * order - 2
        value = a1**root * second
        ratio = value**power / denominator(value, low, order)
        return reals(goal, power_monotone(ratio, 1 / (power * h * low), 1 / power))

    return beta_uniform


def in_the_limit(
    order: sp.Expr, tag: str, words: str, finals: tuple[Claim, Claim], second_half: Claim, bounded: tuple[Claim, ...]
) -> tuple[Claim, Claim]:
    """The bound tends to 0, and so does the distance; ``bounded`` is what says that β forgets it, for κ ≥ 2."""
    linear, root, (finale, finale_in_t) = order == 1, 1 / (2 * order), finals
    if linear:
        decayed = beta(inner(order, tau - t0), (tau - t0) / 2, order)
        decayed_in_t = beta(inner(order, duration_in_t), duration_in_t / 2, order)
    else:
        decayed, decayed_in_t = fixed((tau - t0) / 2, order), fixed(duration_in_t / 2, order)
    after_all = decayed + gamma(halved(tau, order), order)
    towards_zero = decayed_in_t + gamma(input_in_t(order), order)
    roots = [
        ForAll((s,), le(a2**root * distance(s), U_at(s, order)), (ge(s, t0),)),
        ForAll((s,), le(U_at(s, order), a1**root * distance(s)), (ge(s, t0),)),
    ]
    clock = ForAll((s,), eq(distance_in_t(s), distance(end.subs(t, s))), (ge(s, t0), lt(s, t0 + T)))

    @claim(
        f"prop/finale-limit-{tag}", f"The bound tends to 0 in both times ({words})",
        every(eq(sp.Limit(after_all, tau, sp.oo, "-"), 0), eq(sp.Limit(towards_zero, t, t0 + T, "-"), 0)),
        labels=["eq:finale", "eq:finale_t"], uses=[finale, finale_in_t, *bounded],
    )  # fmt: skip
    def finale_limit(goal: Goal) -> Evidence:
        """For κ ≥ 2 with β replaced by its bound that does not depend on the distance, which also covers a drift that
        is zero."""
        return limits(goal)

    @claim(
        f"prop/convergence-{tag}", f"The averaged vehicle reaches the source in the prescribed time ({words})",
        eq(sp.Limit(distance_in_t(t), t, t0 + T, "-"), 0),
        given=[*falls(order, zeta_at(s, order), ge(s, t0)), *roots, clock, le(a2, a1)],
        labels=["proposition"], uses=[finale_in_t, second_half, finale_limit, *bounded],
    )  # fmt: skip
    def convergence(goal: Goal) -> Evidence:
        """The statement of the Proposition: the distance lies between 0 and a bound that tends to 0 as t tends to
        t₀ + T. For κ ≥ 2 the estimate on the second half alone is enough, since β forgets the distance."""

        def facts(there: Goal) -> list[Fact]:
            middle = half.subs(tau, end)
            points = instances(there, t0, middle, end, t)
            if linear:
                return [*specialise(there, finale_in_t, {middle_bound: inner(order, duration_in_t)}), *points]
            values = {second: distance(middle), low: duration_in_t / 2}
            last = specialise(there, second_half, {tau: end})
            return [*last, *specialise(there, bounded[0], values), *points]

        return squeezed(goal, towards_zero, [gt(t, t0), lt(t, t0 + T)], facts)

    return finale_limit, convergence


def estimates(order: sp.Expr, tag: str, words: str) -> tuple[Claim, ...]:
    """The claims about β and γ for one kind of κ."""
    functions = comparison_functions(order, tag, words)
    decay_monotone = functions[1]
    on_one = one_interval(order, tag, words, decay_monotone)
    halves = two_halves(order, tag, words, on_one[1])
    finals = both_times(order, tag, words, halves, decay_monotone)
    bounded = () if order == 1 else (uniform(order, tag, words),)
    limit = in_the_limit(order, tag, words, finals, halves[1], bounded)
    return (*functions, *on_one, *halves, *finals, *bounded, *limit)


kappa_1 = estimates(sp.Integer(1), "kappa-1", "κ = 1")
kappa_2 = estimates(m + 1, "kappa-2", "κ ≥ 2")
