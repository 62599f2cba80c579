"""The saturated seeker with the constant gain of its table, which the clipped one is compared with."""

from __future__ import annotations

from dataclasses import replace

from ptproof.problem.model import parameters
from ptproof.problem.seekers import saturated

SEEKER = replace(
    saturated.SEEKER, name="saturated-constant", words="as saturated, with a constant gain", gain=parameters.gain,
    rank=4,
)  # fmt: skip
