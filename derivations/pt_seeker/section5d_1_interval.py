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
    eq,
    every,
    ge,
    le,
    limits,
    lt,
    power_monotone,
    power_positive,
    power_strict,
    reals,
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
