"""Gain conditions, critical values, thresholds, residuals under a clipped gain, and bounds that are tight.

:func:`gains` answers for given constants; :func:`ptproof.gains.tight.tight_bound` encloses the averaged distance of
a given problem.
"""

from __future__ import annotations

from ptproof.gains.answer import Gains, gains
from ptproof.gains.clipped import Horizon
from ptproof.gains.data import GainData
from ptproof.gains.numbers import NotApplicable, Quantity

__all__ = ["GainData", "Gains", "Horizon", "NotApplicable", "Quantity", "gains"]
