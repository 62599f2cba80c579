"""Section 5, Proposition: V below a barrier by comparison, the source included, and the estimate on one interval."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    Goal,
    claim,
    comparison,
    eq,
    ge,
    gt,
    instances,
    le,
    power_monotone,
    power_nonnegative,
    reals,
    specialise,
    superadditive,
)

from .notation import a1, a2, kappa, tau
from .section5b_1_lyapunov import W
from .section5d_1_interval import (
    H,
    U_at,
    Z,
    beta,
    bounds_at,
    decay,
    denominator,
    distance,
    elapsed,
    falls,
    first,
    gamma,
    rate_of,
    regular,
    s,
    second,
    start,
)

SECTION = "5.4 Proposition: the estimate in both times"


def barrier(order: sp.Expr, until: sp.Expr, rate: sp.Expr) -> sp.Expr:
    """(w + u*)^(2κ): w decays from U at the start, and at the level u* the input and the decrease balance."""
    level = (Z / rate) ** (1 / (2 * order - 1))
    return (decay(U_at(start, order), until - start, order, rate) + level) ** (2 * order)


def below_the_barrier(order: sp.Expr, tag: str, words: str) -> Claim:
    """V stays below the barrier, for one kind of κ; with an input and without one."""
    linear, exponent = order == 1, 2 * order - 1
    on_it = (ge(s, start), le(s, tau))
    begun, below = U_at(start, order), le(W(tau), barrier(order, tau, H))
    level, falling = (Z / H) ** (1 / exponent), decay(begun, s - start, order, H)
    denominators = [] if linear else [denominator(begun, s - start, order, H)]
    defined = [power_nonnegative(W(start), 1 / (2 * order)), power_nonnegative(begun, 2 * order - 2)]

    @claim(
        f"prop/v-estimate-with-input-{tag}", f"V stays below the barrier, where the input is not zero ({words})", below,
        given=[ge(tau, start), gt(Z, 0), *falls(order, Z, *on_it, rate=H)], place="Proof of the Proposition",
    )  # fmt: skip
    def with_input(goal: Goal) -> Evidence:
        """Powers of at least 1 are superadditive, so the barrier falls no faster than the inequality for V asks. It is
        positive: V can meet it away from the source only, and whether V is 0 at times does not matter."""
        lemmas = [
            superadditive(falling, level, exponent), power_monotone(begun, begun + level, 2 * order), *defined,
        ]  # fmt: skip
        return comparison(goal, (falling + level) ** (2 * order), denominators=denominators, lemmas=lemmas)

    @claim(
        f"prop/v-estimate-without-{tag}", f"V stays below its decay, where there is no input ({words})",
        le(W(tau), decay(begun, tau - start, order, H) ** (2 * order)),
        given=[ge(tau, start), *falls(order, sp.S.Zero, *on_it, rate=H)], place="Proof of the Proposition",
    )  # fmt: skip
    def without(goal: Goal) -> Evidence:
        """Then the rate is Lipschitz also at the source, and the barrier may be 0."""
        return comparison(goal, falling ** (2 * order), denominators=denominators, lemmas=defined)

    @claim(
        f"prop/v-estimate-zero-{tag}", f"The same with the letter of the input ({words})", below,
        given=[ge(tau, start), eq(Z, 0), *falls(order, Z, *on_it, rate=H)], place="Proof of the Proposition",
        uses=[without],
    )  # fmt: skip
    def zero(goal: Goal) -> Evidence:
        """The level is not negative."""
        then = decay(begun, tau - start, order, H)
        return reals(
            goal, *specialise(goal, without, {}), *instances(goal, start), *defined, power_monotone(
                then, then + level, 2 * order), *regular(order, begun, tau - start, H),
        )  # fmt: skip

    @claim(
        f"prop/v-estimate-{tag}", f"V stays below the barrier ({words})", below,
        given=[ge(tau, start), *falls(order, Z, *on_it, rate=H)], place="Proof of the Proposition",
        uses=[with_input, zero],
    )  # fmt: skip
    def either(goal: Goal) -> Evidence:
        """With an input, and without."""
        return reals(
            goal, *specialise(goal, with_input, {}), *specialise(goal, zero, {}), *instances(goal, start), *defined,
            *regular(order, begun, tau - start, H),
        )  # fmt: skip

    return either


some_v, some_u = sp.symbols("V_some U_some", nonnegative=True)


@claim(
    "prop/root-of-a-bound", "A bound of V by a power 2κ is one of U", le(some_v ** (1 / (2 * kappa)), some_u),
    given=[le(some_v, some_u ** (2 * kappa))], place="Proof of the Proposition",
)  # fmt: skip
def root_of_a_bound(goal: Goal) -> Evidence:
    """The root increases."""
    return reals(goal, power_monotone(some_v, some_u ** (2 * kappa), 1 / (2 * kappa)))


def one_interval(order: sp.Expr, tag: str, words: str, decay_monotone: Claim) -> tuple[Claim, Claim]:
    """The estimates of U and of the distance on [p, τ], for one kind of κ."""
    h, root, exponent = rate_of(order), 1 / (2 * order), 2 * order - 1
    v_estimate = below_the_barrier(order, tag, words)
    falling = falls(order, Z, ge(s, start), le(s, tau))
    begun = U_at(start, order)

    def known(goal: Goal) -> list[Fact]:
        """V ≥ 0 at both ends, and that the decay is defined."""
        return [
            *instances(goal, start, tau), power_nonnegative(W(start), root),
            power_nonnegative(begun, 2 * order - 2), *regular(order, begun, tau - start),
        ]  # fmt: skip

    @claim(
        f"prop/u-estimate-{tag}", f"U stays below its decay plus the level where ζ balances it ({words})",
        le(U_at(tau, order), decay(begun, tau - start, order) + (Z / h) ** (1 / exponent)),
        given=[ge(tau, start), *falling], place="Proof of the Proposition", uses=[v_estimate, root_of_a_bound],
    )  # fmt: skip
    def u_estimate(goal: Goal) -> Evidence:
        """This replaces the step that does not follow. Let w decay by w' = −h₁w^r and let u* be the level with
        h₁u*^r = Z. The comparison lemma puts V below (w + u*)^(2κ), which has derivatives where U has none: at the
        source."""
        bound = decay(begun, tau - start, order) + (Z / h) ** (1 / exponent)
        values, said = {kappa: order, some_v: W(tau), some_u: bound}, known(goal)
        return reals(
            goal, *said, *specialise(goal, v_estimate, {H: h}, said),
            *specialise(goal, root_of_a_bound, values, said),
        )  # fmt: skip

    @claim(
        f"prop/upper-bound-{tag}", f"The input-to-state estimate with the printed gain ({words})",
        le(distance(tau), beta(distance(start), tau - start, order) + gamma(Z, order)),
        given=[ge(tau, start), *falling, le(a2, a1), *bounds_at(order, tau, start)],
        labels=["eq:upper_bound"], uses=[u_estimate, decay_monotone],
    )  # fmt: skip
    def upper_bound(goal: Goal) -> Evidence:
        """The printed gain is right although the printed inequality before it is not: the direct comparison gives the
        gain a₂^(−1/2κ)(s/h₁)^(1/r), and the printed one is larger by (a₁/a₂)^(1/2κ) ≥ 1."""
        values, said = {first: begun, second: a1**root * distance(start), elapsed: tau - start}, known(goal)
        return reals(
            goal, *said, *specialise(goal, u_estimate, {}), *specialise(goal, decay_monotone, values, said),
            power_monotone(sp.S.One, a1 / a2, root), *regular(order, a1**root * distance(start), tau - start),
        )  # fmt: skip

    return u_estimate, upper_bound
