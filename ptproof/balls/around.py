"""Midpoints and radii in arrays: products of intervals, and a sparse matrix times columns of intervals.

A sum of n products of floats, in whatever order and with or without fused operations, is off by at most
n u/(1 − n u) Σ|a||b| with u = 2⁻⁵³ (Higham, Accuracy and Stability, section 3.1), whatever the library does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Array, Intervals

_ONCE = 2.0**-50  # more than the rounding of a product, a sum and a conversion together
_SUMS = 2.0**-40  # more than n u/(1 − n u) for the n below
_MOST = 4000
_TINY = 1e-290  # more than any underflow here


@dataclass(frozen=True, eq=False)
class Around:
    """Intervals middle ± radius."""

    middle: Array
    radius: Array

    @staticmethod
    def of(value: Intervals) -> Around:
        """The smallest that are easily found."""
        middle = 0.5 * value.low + 0.5 * value.high
        wide = np.maximum(value.high - middle, middle - value.low)
        return Around(middle, wide * (1 + _ONCE) + np.abs(middle) * _ONCE + _TINY)

    def times(self, other: Around) -> Around:
        """Products, one by one."""
        middle = self.middle * other.middle
        radius = np.abs(self.middle) * other.radius + self.radius * (np.abs(other.middle) + other.radius)
        return Around(middle, (radius + _ONCE * np.abs(middle)) * (1 + 8 * _ONCE) + _TINY)


@dataclass(frozen=True, eq=False)
class Matrix:
    """A sparse matrix of intervals middle ± radius, to be multiplied by columns of intervals."""

    middle: Any
    size: Any  # |middle| + radius/_SUMS

    @staticmethod
    def of(middle: Array, radius: Array) -> Matrix:
        """From middles and radii (rows × columns)."""
        if middle.shape[1] > _MOST:
            raise Undefined(f"a matrix of more than {_MOST} columns, whose rounding is not bounded here")
        from scipy.sparse import csr_array

        size = (np.abs(middle) + radius / _SUMS) * (1 + 8 * _ONCE)
        rows, columns = np.nonzero(size)  # the same places in both, also where a middle is zero
        both = (csr_array((part[rows, columns], (rows, columns)), shape=part.shape) for part in (middle, size))
        return Matrix(*both)

    def times(self, columns: Around) -> Around:
        """The product: |C − M||x| + |M||x − m| + rounding, all in one more product."""
        middle = self.middle @ columns.middle
        radius = self.size @ (columns.radius + _SUMS * np.abs(columns.middle))
        return Around(middle, radius * (1 + 2 * _SUMS) + 4096 * _TINY)
