"""Scalar differential inequalities and the closed-form bounds that follow from them.

Each function takes an inequality du/dτ ≤ R(τ, u) and returns a frozen bound whose formula has been checked,
by exact algebra, to start where u starts and to satisfy the equation dv/dτ = R(τ, v), or to lie above it.
The direction of the conclusion (u ≤ v from there on) is the comparison lemma: R is locally Lipschitz in u > 0
and continuous in τ, so a u that starts at or below v cannot cross it.
"""

from __future__ import annotations

from ptproof.comparison.damped import DampedBound, LinearBound, fading_input
from ptproof.comparison.dilated import DilatedBound
from ptproof.comparison.power import PowerBound, power_bound

__all__ = ["DampedBound", "DilatedBound", "LinearBound", "PowerBound", "fading_input", "power_bound"]
