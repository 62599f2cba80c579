"""Section 7.2, Fig. of the inputs: a bound of the angular velocity under clipping, from the filter."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, ForAll, Goal, Relation, claim, comparison, eq, every, ge, le, reals, specialise
from ptproof.system import gradient

from .notation import C, F, G, f, f_norm, k, mu, omega, position, t, t0, tau, theta, z
from .section7_clipping import law, minimum, y

SECTION = "7 Simulation: the inputs"

s = sp.Symbol("s", real=True)
speed = sp.Symbol("H", nonnegative=True)
D = sp.Symbol("D", nonnegative=True)  # a bound of dy/dτ
g1, g2, h1, h2 = sp.symbols("g1 g2 h_1 h_2", real=True)
heading = (sp.cos(theta), sp.sin(theta))
moving = tuple(entry / C + sp.sqrt(omega) * turn for entry, turn in zip(f, heading, strict=True))


slope = gradient(F, position)
length, width = sp.symbols("N_1 N_2", nonnegative=True)


@claim(
    "7/product-below-lengths", "g·h is at most the product of two lengths", le(g1 * h1 + g2 * h2, length * width),
    given=[le(g1**2 + g2**2, length**2), le(h1**2 + h2**2, width**2)], place="Section 7.2",
)  # fmt: skip
def product(goal: Goal) -> Evidence:
    """The inequality of Cauchy and Schwarz."""
    return reals(goal)


@claim(
    "7/velocity", "The vehicle's velocity in dilated time is at most √ω + ‖f‖",
    le(moving[0] ** 2 + moving[1] ** 2, (sp.sqrt(omega) + f_norm) ** 2),
    given=[eq(f_norm**2, f[0] ** 2 + f[1] ** 2), ge(C, 1)], place="Section 7.2", uses=[product],
)  # fmt: skip
def velocity(goal: Goal) -> Evidence:
    """The gain C is at least 1 and divides the drift, since time is dilated by it."""
    values = dict(zip((g1, g2, h1, h2), (*heading, *(entry / C for entry in f)), strict=True))
    return reals(goal, *specialise(goal, product, {**values, length: sp.S.One, width: f_norm}))


@claim(
    "7/measurement-rate", "The measurement changes in dilated time by at most ‖∇F‖(√ω + ‖f‖)",
    every(
        le(slope[0] * moving[0] + slope[1] * moving[1], G * speed),
        ge(slope[0] * moving[0] + slope[1] * moving[1], -G * speed),
    ),
    given=[eq(G**2, slope.dot(slope)), le(moving[0] ** 2 + moving[1] ** 2, speed**2)], place="Section 7.2",
    uses=[product, velocity],
)  # fmt: skip
def measurement_rate(goal: Goal) -> Evidence:
    """H is a bound of the velocity."""
    lengths = {length: G, width: speed}
    return reals(goal, *(
        fact for sign in (1, -1)
        for fact in specialise(goal, product, {
            g1: sign * slope[0], g2: sign * slope[1], h1: moving[0], h2: moving[1], **lengths
        })
    ))  # fmt: skip


output, rate = sp.Function("Y_f", real=True), sp.Function("y_dot", real=True)


def on_way(relation: Relation) -> ForAll:
    """The relation from the start to τ."""
    return ForAll((s,), relation, (ge(s, t0), le(s, tau)))


@claim(
    "7/filter-output-above", "The filter's output stays below a bound of the measurement's rate",
    le(output(tau), D),
    given=[ge(tau, t0), le(output(t0), D), on_way(le(sp.Derivative(output(s), s), (D - output(s)) / mu))],
    labels=["eq:filter_tau"], place="Section 7.2",
)  # fmt: skip
def output_above(goal: Goal) -> Evidence:
    """The constant D solves the comparison equation."""
    return comparison(goal, D)


@claim(
    "7/filter-output", "The filter's output (y − z)/μ is never larger than the largest rate of the measurement",
    le(sp.Abs(output(tau)), D),
    given=[
        ge(tau, t0), le(sp.Abs(output(t0)), D),
        on_way(eq(sp.Derivative(output(s), s), (rate(s) - output(s)) / mu)),
        on_way(le(rate(s), D)), on_way(ge(rate(s), -D)),
    ],
    labels=["eq:filter_tau"], place="Section 7.2", uses=[output_above, measurement_rate],
)  # fmt: skip
def filter_output(goal: Goal) -> Evidence:
    """Whatever μ is: the output is the measurement's rate, averaged over the past. It starts at 0 if z starts at y."""
    both = (output(s), -output(s))
    return reals(goal, *(fact for value in both for fact in specialise(goal, output_above, {output(s): value})))


@claim(
    "7/angular-velocity-bounded", "Under clipping the angular velocity is at most (ω + kD)/0.3²",
    le(sp.Abs(law.angular), (omega + k * D) / minimum**2), given=[ge(t, t0), le(sp.Abs((y - z) / mu), D)],
    labels=["eq:u2", "eq:kt"], place="Section 7.2", uses=[filter_output],
)  # fmt: skip
def angular_bounded(goal: Goal) -> Evidence:
    """With D = ‖∇F‖(√ω + ‖f‖) at its largest along the way: both inputs stay bounded because the gain is clipped, as
    long as the vehicle stays where the gradient is bounded, which it does in finite time."""
    return reals(goal)
