"""Section 7.3: the numbers of the running text."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, gt, reals

from .notation import epsilon, mu
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
