"""Section 5, Proposition: functions of class K and KL, and the estimate on one interval.

κ = 1 has an exponential decay, κ ≥ 2 a power law; both families of claims come from one text, the second with
κ = m + 1 for every m ≥ 1.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    Relation,
    claim,
    comparison,
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
    power_positive,
    power_strict,
    reals,
    specialise,
    superadditive,
)

from . import chain
from .notation import T, a1, a2, c, d, h2, k, kappa, q, t0, tau
from .section5b_1_lyapunov import W

SECTION = "5.4 Proposition: the estimate in both times"

m = sp.Symbol("m", positive=True, integer=True)  # κ = m + 1 where κ ≥ 2
start = sp.Symbol("p_t", real=True)  # the time p of eq:upper_bound
s = sp.Symbol("s", real=True)
Z = sp.Symbol("Z", nonnegative=True)  # the supremum of ζ from p to τ
first, second, elapsed = sp.symbols("s_1 s_2 varsigma", nonnegative=True)
low = sp.Symbol("s_low", positive=True)
middle_bound = sp.Symbol("X", nonnegative=True)  # what the first estimate gives for the distance at the middle
distance = sp.Function("R", nonnegative=True)
distance_in_t = sp.Function("R_t", nonnegative=True)
H = sp.Symbol("h", positive=True)  # h₁ where its own letters do not matter
half = (t0 + tau) / 2
end = chain.clock.to_tau


def rate_of(order: sp.Expr) -> sp.Expr:
    """h₁ for κ = order."""
    return k * c(1, order) ** 2 / (4 * order)


def input_gain(order: sp.Expr) -> sp.Expr:
    """h₂ for κ = order."""
    return c(2, order) / (2 * order)


def gamma(value: sp.Expr, order: sp.Expr) -> sp.Expr:
    """The gain as printed: (a₁/a₂²)^(1/2κ) (s/h₁)^(1/r)."""
    return (a1 / a2**2) ** (1 / (2 * order)) * (value / rate_of(order)) ** (1 / (2 * order - 1))


def denominator(value: sp.Expr, after: sp.Expr, order: sp.Expr, rate: sp.Expr | None = None) -> sp.Expr:
    """1 + (r − 1) h₁ w₀^(r−1) times the time."""
    rate = rate_of(order) if rate is None else rate
    return 1 + (2 * order - 2) * rate * value ** (2 * order - 2) * after


def decay(value: sp.Expr, after: sp.Expr, order: sp.Expr, rate: sp.Expr | None = None) -> sp.Expr:
    """The solution of w' = −h₁ w^r at the time ``after``, from ``value``; ``rate`` is h₁."""
    rate = rate_of(order) if rate is None else rate
    if order == 1:
        return value * sp.exp(-rate * after)
    return value * denominator(value, after, order, rate) ** (-1 / (2 * order - 2))


def beta(value: sp.Expr, after: sp.Expr, order: sp.Expr) -> sp.Expr:
    """A class-KL function for eq:upper_bound: the decay of U, between the bounds of U by the distance."""
    return a2 ** (-1 / (2 * order)) * decay(a1 ** (1 / (2 * order)) * value, after, order)


def fixed(after: sp.Expr, order: sp.Expr) -> sp.Expr:
    """A bound of β for κ ≥ 2 that does not depend on the distance."""
    return a2 ** (-1 / (2 * order)) * ((2 * order - 2) * rate_of(order) * after) ** (-1 / (2 * order - 2))


def zeta_at(time: sp.Expr, order: sp.Expr) -> sp.Expr:
    """ζ with the largest bound of the drift on the whole of [t₀, τ]."""
    return input_gain(order) * d / (1 + (time - t0) / T) ** 2


def halved(time: sp.Expr, order: sp.Expr) -> sp.Expr:
    """The bound of ζ on the second half of the way to τ."""
    return input_gain(order) * d / (1 + (time - t0) / (2 * T)) ** 2


@claim(
    "prop/zeta-suprema", "ζ on the first and on the second half of [t₀, τ]",
    every(le(zeta_at(s, kappa), h2 * d), le(zeta_at(half + elapsed, kappa), halved(tau, kappa))),
    given=[ge(tau, t0), ge(s, t0)], place="Proof of the Proposition",
)  # fmt: skip
def zeta_suprema(goal: Goal) -> Evidence:
    """ζ is at most its value at the beginning of each half, because its denominator grows."""
    return reals(goal)


@claim(
    "prop/input-vanishes", "The second input tends to 0",
    eq(sp.Limit(h2 * d / (1 + (tau - t0) / (2 * T)) ** 2, tau, sp.oo, "-"), 0),
    place="Proof of the Proposition", uses=[zeta_suprema],
)  # fmt: skip
def input_vanishes(goal: Goal) -> Evidence:
    """With the largest bound of the drift on the whole interval in place of the one up to τ, which is at most that."""
    return limits(goal)


def U_at(time: sp.Expr, order: sp.Expr) -> sp.Expr:
    """U = V^(1/2κ) at an instant, where W stands for V along a trajectory."""
    return W(time) ** (1 / (2 * order))


def bounds_at(order: sp.Expr, below: sp.Expr | None = None, above: sp.Expr | None = None) -> list[Relation]:
    """eq:Ux_bounds at single times, the lower one and the upper one."""
    found = []
    if below is not None:
        found.append(le(a2 ** (1 / (2 * order)) * distance(below), U_at(below, order)))
    if above is not None:
        found.append(le(U_at(above, order), a1 ** (1 / (2 * order)) * distance(above)))
    return found


def falls(order: sp.Expr, forcing: sp.Expr, *domain: Relation, rate: sp.Expr | None = None) -> list[ForAll]:
    """eq:lyapunov_derivative_inequality_bounded for V, at all times of the domain, by the letters of U; and V ≥ 0.

    U has no derivative at the source, V has: c₂‖d‖/(1 + (τ − t₀)/T)² is 2κζ, and k c₁²/2 is 2κh₁.
    """
    rate = rate_of(order) if rate is None else rate
    slope = 2 * order * (forcing * W(s) ** q(order) - rate * W(s) ** (2 * q(order)))
    return [ForAll((s,), le(sp.Derivative(W(s), s), slope), domain), ForAll((s,), ge(W(s), 0), domain)]


def smaller(order: sp.Expr, low: sp.Expr, high: sp.Expr, after: sp.Expr) -> list[Fact]:
    """The decay from a smaller value is smaller, as far as powers are concerned."""
    if order == 1:
        return []
    power = 2 * order - 2
    below, above = (value**power / denominator(value, after, order) for value in (low, high))
    return [power_monotone(low, high, power), power_monotone(below, above, 1 / power)]


def regular(order: sp.Expr, value: sp.Expr, after: sp.Expr, rate: sp.Expr | None = None) -> list[Fact]:
    """The denominator of the decay, and its root, are positive."""
    return [] if order == 1 else [power_positive(denominator(value, after, order, rate), 1 / (2 * order - 2))]


def comparison_functions(order: sp.Expr, tag: str, words: str) -> tuple[Claim, Claim, Claim, Claim]:
    """γ is of class K, the decay is monotone, β vanishes and is of class KL, for one kind of κ."""
    linear, h, root, exponent = order == 1, rate_of(order), 1 / (2 * order), 2 * order - 1

    @claim(
        f"prop/gamma-class-k-{tag}", f"γ is of class K ({words})",
        every(
            eq(gamma(sp.S.Zero, order), 0), lt(0, gamma(low, order)), lt(gamma(low, order), gamma(second, order)),
        ),
        given=[lt(low, second)], place="Proof of the Proposition",
    )  # fmt: skip
    def gamma_class_k(goal: Goal) -> Evidence:
        """A root: 0 at 0, strictly increasing, and continuous. The gain is printed with h₁ in its denominator."""
        inverse = 1 / exponent
        lemmas = [] if linear else [power_strict(low / h, second / h, inverse)]
        return reals(goal, *lemmas)

    @claim(
        f"prop/decay-monotone-{tag}", f"The decay from a smaller value is smaller ({words})",
        le(decay(first, elapsed, order), decay(second, elapsed, order)), given=[le(first, second)],
        place="Proof of the Proposition",
    )  # fmt: skip
    def decay_monotone(goal: Goal) -> Evidence:
        """For κ ≥ 2 the power 2κ − 2 of the decay is y/(1 + cy) with y = w₀^(2κ−2), which increases with y."""
        return reals(goal, *smaller(order, first, second, elapsed))

    @claim(
        f"prop/beta-zero-{tag}", f"β is 0 at the source and tends to 0 with time ({words})",
        eq(sp.Limit(beta(low, elapsed, order), elapsed, sp.oo, "-"), 0),
        place="Proof of the Proposition",
    )  # fmt: skip
    def beta_vanishes(goal: Goal) -> Evidence:
        """From every distance other than 0."""
        return limits(goal)

    @claim(
        f"prop/beta-class-kl-{tag}", f"β is 0 at 0, increases with the distance, decreases with time ({words})",
        every(
            eq(beta(sp.S.Zero, elapsed, order), 0),
            lt(0, beta(low, elapsed, order)),
            lt(beta(low, elapsed, order), beta(second, elapsed, order)),
            lt(sp.diff(beta(low, elapsed, order), elapsed), 0),
        ),
        given=[lt(low, second)], place="Proof of the Proposition", uses=[beta_vanishes],
    )  # fmt: skip
    def beta_class_kl(goal: Goal) -> Evidence:
        """Strictly, and continuously: with the limit, this is what class KL asks for."""
        if linear:
            return reals(goal)
        power = 2 * order - 2
        near, far = (a1**root * value for value in (low, second))
        before, after = (value**power / denominator(value, elapsed, order) for value in (near, far))
        return reals(goal, power_strict(near, far, power), power_strict(before, after, 1 / power))

    return gamma_class_k, decay_monotone, beta_vanishes, beta_class_kl


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
