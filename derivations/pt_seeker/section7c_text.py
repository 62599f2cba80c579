"""Section 7.3: the numbers of the running text."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, exact

from .notation import epsilon
from .section7c_saturated import chosen

SECTION = "7.3 Simulation: saturated angular acceleration"


@claim(
    "7.3/epsilon-over-mu", "In the example ε/μ = 2/5", eq(chosen[epsilon] / sp.Rational("0.001"), sp.Rational(2, 5)),
    place="Section 7.3",
)  # fmt: skip
def epsilon_over_mu(goal: Goal) -> Evidence:
    """The text asks for ε ≪ μ, that the angular velocity follow its steady state; the simulated ε = 0.0004 is smaller
    than μ = 0.001 by a factor of 2.5 only."""
    return exact(goal)
