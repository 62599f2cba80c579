"""Section 7: what the paper says of its simulations, as observations over all initial headings.

The paper leaves the initial heading and the filter's start open. Each statement is looked at for an even grid of
headings with z₀ = F(x₀) and gets a criterion that decides whether the numbers support it. None of this is a proof, and
nothing that is proved uses it.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from ptproof.proof import Claim, Evidence, Goal, Prose, Verdict, claim, engine

if TYPE_CHECKING:
    from .experiments.observations import Statement

SECTION = "7.4 Simulation: what is observed"

HEADINGS = 12  # for the saturated seeker, whose runs are long


@engine
def simulation(goal: Goal, statement: str, *arguments: str | int) -> Evidence:
    """Run the named statement of :mod:`.experiments.observations`; numbers that don't support it leave it open."""
    from .experiments import observations

    start = time.perf_counter()
    found: Statement = getattr(observations, statement)(*arguments)
    verdict = Verdict.OBSERVED if found.supported else Verdict.UNDECIDED
    return Evidence("simulation", verdict, _detail(found), time.perf_counter() - start)


def _detail(found: Statement) -> str:
    numbers = "; ".join(f"{name} {value:.4g}" for name, value in found.data.items())
    settings = ", ".join(f"{name} {value}" for name, value in found.settings.items())
    words = "supported" if found.supported else "not supported"
    remark = f" ({found.remark})" if found.remark else ""
    return f"{words}: {found.criterion}. {numbers}. Settings: {settings}{remark}"


def observed(
    id: str, title: str, text: str, place: str, statement: str, *arguments: str | int, expected: str = "observed"
) -> Claim:
    """One statement about simulations."""

    def prove(goal: Goal) -> Evidence:
        return simulation(goal, statement, *arguments)

    prove.__doc__ = "A numerical experiment over initial headings, repeated by `ptproof verify -k " + id + "`."
    return claim(id, title, Prose(text), expected=expected, place=place)(prove)


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
