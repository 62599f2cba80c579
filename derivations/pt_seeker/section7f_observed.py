"""Section 7: what the paper says of its simulations, as observations over all initial headings.

The paper leaves the initial heading and the filter's start open. Each statement is looked at for an even grid of
headings with z₀ = F(x₀) and gets a criterion that decides whether the numbers support it. None of this is a proof, and
nothing that is proved uses it.
"""

from __future__ import annotations

from typing import Any

from ptproof.proof import Claim
from ptproof.simulation.observed import Statement
from ptproof.simulation.observed import observed as observation

SECTION = "7.4 Simulation: what is observed"

HEADINGS = 12  # for the saturated seeker, whose runs are long


def made(name: str, *arguments: Any) -> Statement:
    """The named statement of :mod:`.experiments.observations`, which is read only now."""
    from .experiments import observations

    found: Statement = getattr(observations, name)(*arguments)
    return found


def observed(id: str, title: str, text: str, place: str, name: str, *arguments: Any) -> Claim:
    """One statement about simulations, over initial headings."""
    return observation(id, title, text, place, made, name, *arguments, section=SECTION)


vanishing_reaches = observed(
    "7.1/observed-reaches", "The seeker reaches a neighbourhood of the source in time T, against the vanishing drift",
    "From every heading the distance at T is at most two hover radii, and so is the field close to its peak",
    "Section 7.1, fig:trajectories", "reaches_source", "vanishing",
)  # fmt: skip
vanishing_away = observed(
    "7.1/observed-asymptotic-away", "The asymptotic seeker moves away from the source",
    "From every heading the distance at T is larger than at the start", "Section 7.1, fig:trajectories", "moves_away",
)  # fmt: skip
nonvanishing_reaches = observed(
    "7.2/observed-reaches", "The seeker reaches a neighbourhood of the source in time T, against the bounded drift",
    "From every heading the distance at T is at most two hover radii, and so is the field close to its peak",
    "Section 7.2, fig:trajectories_bounded", "reaches_source", "nonvanishing",
)  # fmt: skip
nonvanishing_oscillates = observed(
    "7.2/observed-asymptotic-oscillates", "The asymptotic seeker is bounded and oscillates above the source",
    "From every heading x₂ stays positive, the field below its peak, and the distance bounded, late in the run",
    "Section 7.2, fig:trajectories_bounded", "oscillates",
)  # fmt: skip
saturated_reaches = observed(
    "7.3/observed-reaches", "With the time-varying gain the saturated seeker reaches the peak in time T",
    "From every heading the distance falls to two hover radii before T", "Section 7.3, fig:field_sat",
    "saturated_reaches", HEADINGS,
)  # fmt: skip
three_times = observed(
    "7.3/observed-three-times", "With the constant gain it takes longer, from some headings about three times T",
    "From every heading the time to two hover radii is more than T, and from some it lies between 2.5 T and 3.5 T",
    "Section 7.3, fig:field_sat", "three_times_longer", HEADINGS,
)  # fmt: skip
effort = observed(
    "7.3/observed-effort", "The control effort is greater with the constant gain",
    "From every heading the integral of |sat| over [0, T] is larger with the constant gain",
    "Section 7.3, fig:acc_sat", "acceleration_saturates", HEADINGS,
)  # fmt: skip
