"""Beyond the paper: where the drift is never stronger than the feedback, the average converges for every κ.

The condition on the drift is ∇F·f ≥ −(k/2)‖∇F‖² at every time and position. It holds for f = E∇F if
(k/2)I + (E + Eᵀ)/2 is positive semidefinite, and so whenever k ≥ 2‖E‖.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    ge,
    instances,
    le,
    power_nonnegative,
    reals,
    specialise,
)
from ptproof.proof.substitution import Substitution

from .notation import E12, E21, E, E_norm, F, T, b1, b2, c, f, k, kappa, position, q, t, tau, x1, x2
from .section5a_1_reduction import stretch
from .section5b_0_trajectory import (
    EXAMPLE,
    F_1,
    F_2,
    X1,
    X2,
    V_along,
    V_rate,
    assumption_2,
    at,
    derivative,
    gradient_bounds,
    here,
    later,
    s,
    solves,
    start,
    v_nonnegative,
)
from .section5b_0_with_drift import gradient_drift_given, in_time, instant
from .section5b_1_lyapunov import n
from .section6b_3_only import f_now, g, rate_by_norm, rho
from .section9_1_gain import image

SECTION = "Beyond the paper"

square = F_1**2 + F_2**2
never_stronger = ForAll((t, *position), ge(F_1 * f[0] + F_2 * f[1] + k / 2 * square, 0), in_time)


@claim(
    "beyond/rate-without-c2",
    "If the drift is never stronger, V of the average falls at the rate (k/2)(1 − ρ)‖∇F‖² at least",
    le(V_rate, at(-k / 2 * (1 - 1 / stretch**2) * square, tau)),
    given=[*solves(tau), *later, never_stronger], uses=[derivative], example=EXAMPLE,
)  # fmt: skip
def rate_without_c2(goal: Goal) -> Evidence:
    """Of the feedback's k/2 the share ρ = 1/(1 + (τ − t₀)/T)² pays for the drift, the rest remains."""
    return reals(goal, *specialise(goal, derivative, {}), *instances(goal, instant(tau)))


def decay(order: sp.Expr, time: sp.Expr) -> sp.Expr:
    """k c₁²/2 times what remains of the feedback after the share that the drift may take, from τ₀ on."""
    return k * c(1, order) ** 2 / 2 * (1 - 1 / (1 + (time - start) / T) ** 2)


def trajectory_inequality(order: sp.Expr) -> sp.Expr:
    """−decay · V^(2q) on the trajectory."""
    return -decay(order, tau) * V_along ** (2 * q(order))


@claim(
    "beyond/v-inequality", "Then V satisfies an inequality without c₂",
    le(V_rate, trajectory_inequality(kappa)), given=[*solves(tau), *later, never_stronger, *assumption_2],
    uses=[rate_without_c2, gradient_bounds, v_nonnegative], example=EXAMPLE,
)  # fmt: skip
def v_inequality(goal: Goal) -> Evidence:
    """The gradient's lower bound, and a factor that is larger the later the trajectory starts."""
    return reals(
        goal, *specialise(goal, rate_without_c2, {}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_along, q()),
    )  # fmt: skip


# --- The scalar bounds ------------------------------------------------------------------------------------------------

V = sp.Function("V", real=True)
length = tau - start
saved = length**2 / (T + length)  # the integral of 1 − 1/(1 + (s − τ₀)/T)²
never_negative = ForAll((s,), ge(V(s), 0))
above = n + 1  # κ ≥ 2
sigma = n / (n + 1)


def scalar_inequality(order: sp.Expr) -> ForAll:
    """dV/ds ≤ −decay · V^(2q) on [τ₀, τ]."""
    relation = le(sp.Derivative(V(s), s), -decay(order, s) * V(s) ** (2 * q(order)))
    return ForAll((s,), relation, (ge(s, start), le(s, tau)))


def bound(order: sp.Expr, value: sp.Expr) -> sp.Expr:
    """The bound of V(τ) for V(τ₀) = ``value``: of class KL in the value and τ − τ₀."""
    paid = k * c(1, order) ** 2 / 2 * saved
    if order == 1:
        return value * sp.exp(-paid)
    return value * (1 + sigma * value**sigma * paid) ** (-1 / sigma)


@claim(
    "beyond/v-bound-kappa-1", "What the inequality gives for κ = 1", le(V(tau), bound(sp.S.One, V(start))),
    given=[ge(tau, start), scalar_inequality(sp.S.One), never_negative],
)  # fmt: skip
def v_bound_one(goal: Goal) -> Evidence:
    """A linear comparison equation: exponential in (τ − τ₀)²/(T + τ − τ₀), which is about τ − τ₀ for long times."""
    return comparison(goal, bound(sp.S.One, V(start)).subs(tau, s), denominators=[1 + (s - start) / T, T + s - start])


@claim(
    "beyond/v-bound-kappa-2", "What the inequality gives for κ = n + 1 ≥ 2", le(V(tau), bound(above, V(start))),
    given=[ge(tau, start), scalar_inequality(above), never_negative, ge(V(start), 0)],
)  # fmt: skip
def v_bound_above(goal: Goal) -> Evidence:
    """A comparison equation of Bernoulli's type; V(τ₀) = 0 is included."""
    passed = s - start
    base = 1 + sigma * V(start) ** sigma * k * c(1, above) ** 2 / 2 * passed**2 / (T + passed)
    root = power_nonnegative(V(start), sigma)
    return comparison(goal, V(start) * base ** (-1 / sigma), denominators=[base], lemmas=[root])


# --- The trajectories -------------------------------------------------------------------------------------------------


def for_order(items: Sequence[ForAll], order: sp.Expr) -> list[ForAll]:
    """The assumptions for this κ."""
    return [ForAll(item.variables, item.relation.map(lambda side: side.subs(kappa, order)), item.domain)
            for item in items]  # fmt: skip


def on_trajectories(order: sp.Expr, tag: str, words: str, scalar: Claim, example: dict[sp.Expr, sp.Expr]) -> Claim:
    """V along every averaged trajectory, for one kind of κ."""

    @claim(
        f"beyond/every-order-{tag}", f"A drift that is never stronger: V along every averaged trajectory, {words}",
        le(V_along, bound(order, V_along.subs(tau, start))),
        given=[*solves(tau), *later, never_stronger, *for_order(assumption_2, order)],
        uses=[v_inequality, v_nonnegative, scalar], example=example,
    )  # fmt: skip
    def every_order(goal: Goal) -> Evidence:
        """From every start and every initial time τ₀ ≥ t₀, as long as the trajectory exists; since V is bounded on
        it, it exists for all times. The bound is of class KL and does not depend on τ₀: Step 4 holds for this κ,
        too."""

        def nonnegative(there: Goal, time: sp.Expr) -> list[Fact]:
            return specialise(there, v_nonnegative, {kappa: order, position[0]: X1(time), position[1]: X2(time)})

        def along(there: Goal, time: sp.Expr) -> list[Fact]:
            if le(time, tau) not in there.assumptions:
                return nonnegative(there, time)
            return [*nonnegative(there, time), *specialise(there, v_inequality, {kappa: order, tau: time})]

        moved = {V(s): V_along.subs(tau, s)}
        begins = nonnegative(goal, start)
        roots = [] if order == 1 else [power_nonnegative(V_along.subs(tau, start), sigma)]
        said = specialise(goal, scalar, moved, begins, along=along)
        return reals(goal, *said, *begins, *nonnegative(goal, tau), *roots)

    return every_order


at_rest = {X1(s): 0, x1: 0}  # a vehicle that starts at the source stays there
quartic = {F: -((x1**2 + x2**2) ** 2), b1: 4, b2: 4, n: 1}
every_order_one = on_trajectories(sp.S.One, "kappa-1", "κ = 1", v_bound_one, EXAMPLE)
every_order_above = on_trajectories(above, "kappa-2", "κ ≥ 2", v_bound_above, {**EXAMPLE, **quartic, **at_rest})


# --- Where the drift is never stronger --------------------------------------------------------------------------------

matrix = E + k / 2 * sp.eye(2)
semidefinite = (  # (k/2)I + (E + Eᵀ)/2, by its principal minors
    ge(matrix[0, 0], 0), ge(matrix[1, 1], 0), ge(matrix[0, 0] * matrix[1, 1] - ((E12 + E21) / 2) ** 2, 0),
)  # fmt: skip
pushed = sp.symbols("Eg1 Eg2", real=True)
form_11, form_12, form_22 = sp.symbols("s11 s12 s22", real=True)


@claim(
    "beyond/semidefinite-form", "A symmetric form with principal minors that are not negative is not negative",
    ge(form_11 * g[0] ** 2 + 2 * form_12 * g[0] * g[1] + form_22 * g[1] ** 2, 0),
    given=[ge(form_11, 0), ge(form_22, 0), ge(form_11 * form_22 - form_12**2, 0)],
)  # fmt: skip
def semidefinite_form(goal: Goal) -> Evidence:
    """In two dimensions."""
    return reals(goal)


length_squared = g[0] ** 2 + g[1] ** 2


@claim(
    "beyond/form-by-norm", "Then g·Eg ≥ −‖E‖‖g‖²",
    ge(g[0] * pushed[0] + g[1] * pushed[1] + E_norm * length_squared, 0),
    given=[le(pushed[0] ** 2 + pushed[1] ** 2, E_norm**2 * length_squared)], uses=[rate_by_norm],
)  # fmt: skip
def form_by_norm(goal: Goal) -> Evidence:
    """The drift against the gradient, at its full size."""
    return reals(goal, *specialise(goal, rate_by_norm, {f_now[0]: pushed[0], f_now[1]: pushed[1], rho: 1}))


At: TypeAlias = Callable[[Goal, dict[sp.Symbol, sp.Expr]], list[Fact]]


def corollary(
    general: Claim, order: sp.Expr, tag: str, words: str, drift: Sequence[Assumption], uses: Sequence[Claim], says: At
) -> Claim:
    """What holds for every drift that is never stronger, for f = E∇F; ``says`` knows the form at a gradient."""

    @claim(
        f"beyond/{tag}", f"If {words}, V of the average under f = E∇F has that bound, too",
        general.statement, given=[*solves(tau), *later, *gradient_drift_given, *drift, *for_order(assumption_2, order)],
        uses=[general, v_nonnegative, *uses], example=dict(general.example),
    )  # fmt: skip
    def on_trajectory(goal: Goal) -> Evidence:
        """Such a drift is never stronger than the feedback: the class-KL bound holds along every averaged trajectory,
        from every start and every initial time."""

        def along(there: Goal, point: sp.Tuple) -> list[Fact]:
            put = Substitution(dict(zip((t, *position), point, strict=True))).into
            return says(there, dict(zip((*g, *pushed), map(put, (F_1, F_2, *f)), strict=True)))

        begins = specialise(goal, v_nonnegative, {kappa: order, position[0]: X1(start), position[1]: X2(start)})
        root = power_nonnegative(V_along.subs(tau, start), sigma)
        return reals(goal, *specialise(goal, general, {}, along=along), *begins, root)

    return on_trajectory


def form_of_minors(there: Goal, now: dict[sp.Symbol, sp.Expr]) -> list[Fact]:
    """The semidefinite form at a gradient."""
    minors = {form_11: matrix[0, 0], form_22: matrix[1, 1], form_12: (E12 + E21) / 2}
    return specialise(there, semidefinite_form, {**minors, **{letter: now[letter] for letter in g}})


def form_of_norm(there: Goal, now: dict[sp.Symbol, sp.Expr]) -> list[Fact]:
    """The form at a gradient, by the norm."""
    here = {letter: now[letter] for letter in g}
    values = {**here, **dict(zip(pushed, E * sp.Matrix(list(here.values())), strict=True))}
    return [*instances(there, tuple(here.values())), *specialise(there, form_by_norm, values)]


# ‖E‖ is a number with ‖Eg‖ ≤ ‖E‖‖g‖ for all g, as the spectral norm is.
norm_bounds = ForAll(g, le(image[0] ** 2 + image[1] ** 2, E_norm**2 * length_squared))
KINDS = ((every_order_one, sp.S.One, "kappa-1", "κ = 1"), (every_order_above, above, "kappa-2", "κ ≥ 2"))
for_definite = tuple(
    corollary(general, order, f"semidefinite-{tag}", f"(k/2)I + (E + Eᵀ)/2 is positive semidefinite and {words}",
              semidefinite, [semidefinite_form], form_of_minors)
    for general, order, tag, words in KINDS
)  # fmt: skip
for_norm = tuple(
    corollary(general, order, f"gain-twice-the-norm-{tag}", f"k ≥ 2‖E‖ and {words}", [norm_bounds, ge(k, 2 * E_norm)],
              [form_by_norm], form_of_norm)
    for general, order, tag, words in KINDS
)  # fmt: skip
