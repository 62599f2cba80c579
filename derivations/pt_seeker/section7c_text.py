"""Section 7.3: the numbers of the running text."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, exact, gt, lt, reals

from .notation import T, epsilon, mu, nu, t, t0
from .section7_clipping import clipped_gain, clipped_gain_final, in_time, minimum, printed_gain
from .section7c_saturated import chosen

SECTION = "7.3 Simulation: saturated angular acceleration"

printed_mu = sp.Rational("0.001")
filter_constant = mu / sp.Rational("11.11")  # of the filter's line of eq:sat_seeker with the constant gain


@claim(
    "7.3/epsilon-over-mu", "In the example ε is not small against μ, and larger than the filter's time constant",
    every(gt(epsilon, mu / 3), gt(epsilon, 4 * filter_constant)),
    given=[eq(epsilon, chosen[epsilon]), eq(mu, printed_mu)], place="Section 7.3",
)  # fmt: skip
def epsilon_over_mu(goal: Goal) -> Evidence:
    """The text asks for ε ≪ μ, that the angular velocity follow its steady state. The simulated ε = 0.0004 is smaller
    than μ = 0.001 by a factor of 2.5 only; and under the gain C the filter's time constant is μ/C, while the
    acceleration's is ε: with C = 11.11 it is more than four times the larger one."""
    return reals(goal)


# --- The control effort of the forward velocity, u₁ = C√ω -------------------------------------------------------------

constant = sp.Rational("11.11")  # k_h


varying, varying_squared = sp.Rational(17, 3) * T, sp.Rational(3973, 81) * T
gains = (1 / nu(t - t0) ** 2, 1 / minimum**2)


def spent(power: int) -> tuple[sp.Expr, sp.Expr]:
    """What is spent up to t before the clip, and after it: antiderivatives of a power of the gain."""
    stretch = 1 / nu(t - t0) ** (2 * power - 1)
    before = T * (stretch - 1) / (2 * power - 1)
    switch = t0 + (1 - minimum) * T
    return before, before.subs(t, switch) + (t - switch) / minimum ** (2 * power)


@claim(
    "7.3/effort-of-the-varying-gain", "The time-varying gain and its square, integrated up to the prescribed time",
    every(*(
        relation for power, total in ((1, varying), (2, varying_squared)) for relation in (
            *(eq(sp.Derivative(up_to, t), gain**power) for up_to, gain in zip(spent(power), gains, strict=True)),
            eq(spent(power)[0].subs(t, t0), 0), eq(spent(power)[1].subs(t, t0 + T), total),
        )
    )),
    given=[gt(nu(t - t0), 0)], place="Section 7.3", uses=[clipped_gain, clipped_gain_final],
)  # fmt: skip
def effort_of_varying(goal: Goal) -> Evidence:
    """In two pieces, before and after the clip: 17T/3, which is also the dilated time, and 49.05T. Times √ω and ω these
    are the integrals of u₁ and of u₁²."""
    return exact(goal)


@claim(
    "7.3/effort-of-the-constant-gain", "The forward velocity costs more with the constant gain, as the text says",
    every(lt(varying, constant * T), lt(varying_squared, constant**2 * T)), place="Section 7.3",
    uses=[effort_of_varying],
)  # fmt: skip
def effort_of_constant(goal: Goal) -> Evidence:
    """11.11T against 5.67T, and 123.4T against 49.05T for the squares: about twice and two and a half times as much.
    This is about u₁ only. What the angular acceleration costs depends on the trajectory under the saturation and is
    not claimed."""
    return reals(goal)


@claim(
    "7.3/constant-gain-larger", "While ν² > 0.0901 the constant gain is the larger one",
    lt(printed_gain, constant), given=[*in_time, gt(nu(t - t0) ** 2, sp.Rational("0.0901"))], place="Section 7.3",
)  # fmt: skip
def constant_larger(goal: Goal) -> Evidence:
    """From then on it is smaller, as 11.11 is rounded down: by 1/900 at most."""
    return reals(goal)
