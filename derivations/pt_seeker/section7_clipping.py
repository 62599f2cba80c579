"""Section 7: the clipped gain, and what it does to the inputs."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.seekers import feedback, prescribed_time_gain
from ptproof.proof import Evidence, Goal, claim, enclosures, eq, every, ge, gt, le, limits, lt, reals

from .chain import clock
from .notation import T, k, mu, nu, omega, t, t0, z

SECTION = "7 Simulation: the clipped gain"

minimum = sp.Rational("0.3")
in_time = [ge(t, t0), lt(t, t0 + T)]  # I_t
gain = 1 / sp.Max(minimum, nu(t - t0)) ** 2  # with ν clipped, as the text prints it
printed_gain = sp.Min(1 / minimum**2, 1 / nu(t - t0) ** 2)
half_unit = sp.Rational("0.005")  # a number printed with two decimals is meant to within half a unit of the last one


@claim("7/clipped-gain", "The clipped gain as a minimum", eq(gain, printed_gain), given=in_time, labels=["eq:kt"])
def clipped_gain(goal: Goal) -> Evidence:
    """Replacing ν by max(0.3, ν) is the same as taking the smaller of the two gains, as long as ν is positive."""
    return reals(goal)


@claim(
    "7/clipped-gain-simulated", "The gain that is simulated is the clipped gain",
    eq(prescribed_time_gain(clock, minimum), gain), given=[ge(t, t0)], labels=["eq:kt"],
)  # fmt: skip
def clipped_gain_simulated(goal: Goal) -> Evidence:
    """The clock of the pipeline runs at its own rate until ν = 0.3 and at the rate that it has there from then on: the
    same, at all times and not only up to t₀ + T."""
    return reals(goal)


@claim(
    "7/clipped-gain-afterwards", "The minimum stops being the clipped gain after t₀ + 1.3T", lt(printed_gain, gain),
    given=[gt(t, t0 + sp.Rational("1.3") * T)], labels=["eq:kt"],
)  # fmt: skip
def clipped_gain_afterwards(goal: Goal) -> Evidence:
    """The paper states the identity up to t₀ + T only. Whoever keeps running should clip ν, not the gain: once ν
    falls below −0.3, the minimum of the two gains decreases again, while 1/max(0.3, ν)² stays at its largest value."""
    return reals(goal)


@claim(
    "7/clipped-gain-finite", "The clipped gain is finite as t tends to t₀ + T",
    every(gt(printed_gain, 0), le(printed_gain, 1 / minimum**2)), given=in_time, labels=["eq:kt"],
)  # fmt: skip
def clipped_gain_finite(goal: Goal) -> Evidence:
    """It never exceeds 1/0.3²."""
    return reals(goal)


@claim(
    "7/clipped-gain-final", "The clipped gain is 1/0.3² from ν = 0.3 on", eq(gain, 1 / minimum**2),
    given=[ge(t, t0 + sp.Rational("0.7") * T)], place="Section 7.3",
)  # fmt: skip
def clipped_gain_final(goal: Goal) -> Evidence:
    """So the largest value is attained, from t₀ + 0.7T on, and it is also the limit at t₀ + T."""
    return reals(goal)


@claim(
    "7.3/largest-gain-rounded", "1/0.3² = 11.11 to the digits given",
    le(sp.Abs(1 / minimum**2 - sp.Rational("11.11")), half_unit), place="Section 7.3", uses=[clipped_gain_finite],
)  # fmt: skip
def largest_gain_rounded(goal: Goal) -> Evidence:
    """The exact value is 100/9, a little more than the constant gain that it is compared with."""
    return enclosures(goal)


y = sp.Symbol("y", real=True)  # the measurement at one instant
law = feedback(y, z, k, omega, mu, gain)
spread = sp.Symbol("B", positive=True)  # a bound of |y − z|
unclipped = feedback(y, z, k, omega, mu, prescribed_time_gain(clock))


@claim(
    "7/inputs-bounded", "Clipping bounds the inputs",
    every(
        le(sp.Abs(law.forward), sp.sqrt(omega) / minimum**2),
        le(sp.Abs(law.angular), (omega + k * spread / mu) / minimum**2),
    ),
    given=[le(y - z, spread), le(z - y, spread)], place="Section 7.2",
)  # fmt: skip
def inputs_bounded(goal: Goal) -> Evidence:
    """The forward velocity has a bound of its own, √ω/0.09. The angular velocity has one wherever the filter's
    error y − z is bounded, which is a matter of the trajectory."""
    return reals(goal)


@claim(
    "7/inputs-unbounded", "Without clipping the forward velocity grows to infinity",
    eq(sp.Limit(unclipped.forward, t, t0 + T, "-"), sp.oo), place="Section 6.4",
)  # fmt: skip
def inputs_unbounded(goal: Goal) -> Evidence:
    """1/ν² has a pole at t₀ + T."""
    return limits(goal)
