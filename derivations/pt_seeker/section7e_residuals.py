"""Section 6.4 for the examples: which residual of the average is certain when ν decays down to 0.2 or 0.3 only."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    enclosures,
    eq,
    every,
    ge,
    instances,
    le,
    reals,
    specialise,
)

from .notation import C, F, T, a1, b1, d, f, k, t, t0, x1, x2
from .section6c_feasibility import lowest
from .section6d_2_clipped_bounded import V_t, bounded_final
from .section6d_clipped import average_with_gain, clipped, total, with_gain
from .section6e_after_the_clip import X_t, residual_exact
from .section7b_nonvanishing import drift, field, slope, square
from .section7e_bounded_drift import damping, pt_falls, pull, pulled, size, turn_1, turn_2

SECTION = "6.4 Discussion: what is certain in the examples"

s = sp.Symbol("s", real=True)
levels = (sp.Rational("0.3"), sp.Rational("0.2"))
X1, X2 = (sp.Function(name, real=True) for name in ("X_1", "X_2"))


# --- 7.3: F = −‖x‖²/2 without drift -----------------------------------------------------------------------------------

saturated = {k: sp.Rational("1.4"), T: sp.S.One}
left = tuple(sp.exp(-k / 2 * total).subs({**saturated, lowest: level}) for level in levels)


def moves(level: sp.Expr) -> ForAll:
    """A coordinate of the average without drift for the field of 7.3, under the gain that is clipped there."""
    gain = clipped(s).subs({lowest: level, T: 1})
    return ForAll((s,), eq(sp.Derivative(X_t(s), s), -gain * saturated[k] / 2 * X_t(s)), (ge(s, t0), le(s, t0 + 1)))


def share(name: str, level: sp.Expr, words: str, number: sp.Expr) -> Claim:
    """What is left of a coordinate of the average of 7.3."""

    @claim(
        f"7.3/residual-{name}", f"Without the saturation, {words} of each coordinate of the average is left at T",
        eq(X_t(t0 + 1), X_t(t0) * number), given=[moves(level)], place="Section 6.4", uses=[residual_exact],
    )  # fmt: skip
    def residual(goal: Goal) -> Evidence:
        """The exact average, for the field, the gain k = 1.4 and the time T = 1 of 7.3."""
        return reals(goal, *specialise(goal, residual_exact, {**saturated, lowest: level}))

    return residual


share_03 = share("03", levels[0], "the share e^(−119/30)", left[0])
share_02 = share("02", levels[1], "the share e^(−63/10)", left[1])


@claim(
    "7.3/residual-numbers", "These shares are 1.9 % and 0.19 %, rounded up",
    every(le(left[0], sp.Rational("0.019")), le(left[1], sp.Rational("0.0019"))), place="Section 6.4",
    uses=[share_03, share_02],
)  # fmt: skip
def residual_numbers(goal: Goal) -> Evidence:
    """From the start (2, 2) the average ends at a distance of about 0.054 for ν_min = 0.3, and 0.0052 for 0.2."""
    return enclosures(goal)


# --- 7.2: the bounded drift -------------------------------------------------------------------------------------------

average = with_gain.with_values({F: field})
at_most_two = [relation for entry in f for relation in (le(entry, 2), ge(entry, -2))]


@claim(
    "7.2/drift-entries", "The entries of the drift are at most 2 in size",
    every(*(relation for entry in drift.rate for relation in (le(entry, 2), ge(entry, -2)))), place="Section 7.2",
)  # fmt: skip
def drift_entries(goal: Goal) -> Evidence:
    """1 + sin 3t is at most 2, and a cosine at most 1."""
    return reals(goal)


@claim(
    "7.2/clipped-average-falls", "The rate of the squared distance of the average of 7.2 under the gain C",
    le(average.derivative_along(square), 16 / (C * k) - C * k / 2 * square), given=at_most_two, place="Section 6.4",
    uses=[average_with_gain, pull, pt_falls],
)  # fmt: skip
def clipped_falls(goal: Goal) -> Evidence:
    """For every drift with entries of at most 2. The pull is at least k C times the squared distance, and half of it
    pays for the drift."""
    values = {
        pulled: x1 * slope[0] + x2 * slope[1], size: sp.Integer(2), damping: sp.S.One, turn_1: f[0] / 2,
        turn_2: f[1] / 2, k: C * k,
    }  # fmt: skip
    return reals(goal, *specialise(goal, pull, {}), *specialise(goal, pt_falls, values))


example = {k: sp.S.One, T: sp.Integer(2)}
end = t0 + 2


def on_x(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in t and the position, on the trajectory."""
    return expression.subs({t: time, x1: X1(time), x2: X2(time)}, simultaneous=True)


def squared(name: str, level: sp.Expr, start: sp.Expr, rest: sp.Expr) -> Claim:
    """What is left of the squared distance of the average of 7.2."""

    def gain(time: sp.Expr) -> sp.Expr:
        return clipped(time).subs({lowest: level, T: 2})

    solves = [
        ForAll((s,), eq(sp.Derivative(X(s), s), on_x(rate.subs({C: gain(s), k: 1}), s)), (ge(s, t0), le(s, end)))
        for X, rate in zip((X1, X2), average.rhs, strict=True)
    ]
    bounded = [ForAll((t, x1, x2), relation) for relation in at_most_two]

    @claim(
        f"7.2/residual-{name}", f"The squared distance of the average of 7.2 at T with ν down to {float(level)}",
        le(on_x(square, end), on_x(square, t0) * start + rest), given=[*solves, *bounded], place="Section 6.4",
        uses=[clipped_falls, bounded_final, drift_entries],
        example={X1(s): 0, X2(s): 0, f[0]: 0, f[1]: 0, t0: 0, t: 0, x1: 0, x2: 0},
    )  # fmt: skip
    def residual(goal: Goal) -> Evidence:
        """For every drift with entries of at most 2, k = 1 and T = 2, from the averaged equation."""

        def along(here: Goal, time: sp.Expr) -> list[Fact]:
            place = {t: time, x1: X1(time), x2: X2(time)}
            drifts = instances(here, (time, X1(time), X2(time)))
            return [*drifts, *specialise(here, clipped_falls, {C: gain(time), k: sp.S.One, **place}, drifts)]

        values = {
            **example, lowest: level, a1: sp.Rational(1, 2), b1: sp.S.One, d: sp.Integer(4),
            V_t(s): on_x(square, s),
        }  # fmt: skip
        return reals(goal, *specialise(goal, bounded_final, values, along=along))

    return residual


decays = tuple((sp.exp(-total.subs({T: 2, lowest: n}) / 2), 32 * (sp.exp(-1 / n) + n**4)) for n in levels)
squared_03 = squared("03", levels[0], *decays[0])
squared_02 = squared("02", levels[1], *decays[1])


@claim(
    "7.2/residual-numbers", "From the squared distance 2 of the example at most 1.42 and 0.27 are left",
    every(*(
        le(2 * decay + rest, bound)
        for (decay, rest), bound in zip(decays, (sp.Rational("1.42"), sp.Rational("0.27")), strict=True)
    )),
    place="Section 6.4", uses=[squared_03, squared_02],
)  # fmt: skip
def bounded_numbers(goal: Goal) -> Evidence:
    """On the average. With ν_min = 0.3 this bound says little: the distance falls from 1.42 to less than 1.2; with 0.2
    to less than 0.52."""
    return enclosures(goal)
