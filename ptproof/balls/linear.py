"""Linear forms with a rest, in arrays: products of them, and a sparse matrix times columns of them.

On a box each number is middle + Σ slopes_i d_i ± radius with |d_i| ≤ 1. What a product has of the second order goes
into its radius. A sum of n products of floats, in whatever order and with or without fused operations, is off by at
most n u/(1 − n u) Σ|a||b| with u = 2⁻⁵³ (Higham, Accuracy and Stability, section 3.1), whatever the library does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Array, Intervals

_ONCE = 2.0**-50  # more than the rounding of a product, a sum and a conversion together
_SUMS = 2.0**-40  # more than n u/(1 − n u) for the n below
_MOST = 4000
_TINY = 1e-290  # more than any underflow here


def around(value: Intervals) -> tuple[Array, Array]:
    """Middles and radii of the smallest intervals middle ± radius that are easily found."""
    middle = 0.5 * value.low + 0.5 * value.high
    wide = np.maximum(value.high - middle, middle - value.low)
    return middle, wide * (1 + _ONCE) + np.abs(middle) * _ONCE + _TINY


@dataclass(frozen=True, eq=False)
class Linear:
    """middle + Σ slopes_i d_i ± radius; the axes come first in ``slopes``."""

    middle: Array
    slopes: Array
    radius: Array

    @property
    def reach(self) -> Array:
        """Σ|slopes_i|, nearly."""
        return np.asarray(np.abs(self.slopes).sum(axis=0))

    def rows(self, at: NDArray[np.intp]) -> Linear:
        """Some of them."""
        return Linear(self.middle[at], self.slopes[:, at], self.radius[at])

    def times(self, other: Linear) -> Linear:
        """Products, one by one."""
        middle = self.middle * other.middle
        slopes = self.middle * other.slopes + other.middle * self.slopes
        size, wide = np.abs(self.middle), self.reach
        size_other, wide_other = np.abs(other.middle), other.reach
        radius = wide * wide_other + (size + wide) * other.radius
        radius += self.radius * (size_other + wide_other + other.radius)
        radius += _ONCE * ((size + wide) * (size_other + wide_other))
        return Linear(middle, slopes, radius * (1 + 32 * _ONCE) + _TINY)

    def plus(self, factor: Array, other: Linear) -> Linear:
        """self + factor · other, one by one."""
        middle, slopes = self.middle + factor * other.middle, self.slopes + factor * other.slopes
        size = np.abs(factor)
        radius = self.radius + size * other.radius
        radius += _ONCE * (np.abs(self.middle) + self.reach + size * (np.abs(other.middle) + other.reach))
        return Linear(middle, slopes, radius * (1 + 32 * _ONCE) + _TINY)


@dataclass(frozen=True, eq=False)
class Matrix:
    """A sparse matrix of intervals middle ± radius, to be multiplied by columns of linear forms."""

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

    def times(self, columns: Linear) -> Linear:
        """The product: |C − M||x| + |M||x − m| + rounding, all in one more product."""
        middle = self.middle @ columns.middle
        slopes = np.stack([self.middle @ part for part in columns.slopes])
        radius = self.size @ (columns.radius + _SUMS * (np.abs(columns.middle) + columns.reach))
        return Linear(middle, slopes, radius * (1 + 2 * _SUMS) + 4096 * _TINY)
