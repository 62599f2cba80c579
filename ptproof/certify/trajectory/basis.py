"""Coordinates that tell the fast directions of a Jacobian from the slow ones; any would be right."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = Any
_FAST, _APART = 8.0, 2.0
_NEAR, _CHANGE = 5.0, 4.0  # in powers of 2


def split(jacobian: Array, length: float) -> tuple[Array, int]:
    """A basis (columns, n × n) with the slow directions first, and how many of these there are.

    A direction is fast if it dies out within the step. Each group is an invariant plane by Schur's decomposition of the
    balanced matrix, which does not mind eigenvectors that come close to each other; without fast directions, or where
    the groups can't be told apart, the basis has the axes, as the balanced matrix scales them.
    """
    from scipy import linalg

    n = len(jacobian)
    try:
        balanced, (scale, _) = linalg.matrix_balance(jacobian, permute=False, separate=True)
        everything = np.diag(scale), n
        rates = np.sort(np.linalg.eigvals(balanced).real)[::-1] * length
        slow = int(np.sum(rates >= -_FAST))
        if slow in (0, n) or rates[slow - 1] - rates[slow] < _APART:
            return everything
        shifted = balanced - (rates[slow - 1] + rates[slow]) / 2 / length * np.eye(n)
        columns = []
        for sort, size in (("rhp", slow), ("lhp", n - slow)):
            _, vectors, count = linalg.schur(shifted, sort=sort)
            if count != size:
                return everything
            columns.append(vectors[:, :size])
    except (np.linalg.LinAlgError, ValueError):
        return np.eye(n), n
    planes = np.concatenate(columns, axis=1)
    if not np.all(np.isfinite(planes)) or np.linalg.cond(planes) > 1e10:
        return everything
    return scale[:, None] * planes, slow


def scales(jacobians: Array, before: Array | None) -> Array:
    """Units of the states, powers of 2, for Jacobians (N × n × n) whose entries are of very different sizes.

    Only what is far off is scaled, and those from ``before`` are kept as long as they do: frames of errors do not like
    a change of units.
    """
    from scipy import linalg

    largest = np.abs(jacobians).max(axis=0)
    if not np.all(np.isfinite(largest)):
        return np.ones(len(largest)) if before is None else before
    _, (found, _) = linalg.matrix_balance(largest, permute=False, separate=True)
    powers = np.log2(found) - np.mean(np.log2(found))
    powers = np.round(np.sign(powers) * np.maximum(np.abs(powers) - _NEAR, 0.0))
    if before is not None and np.all(np.abs(powers - np.log2(before)) <= _CHANGE):
        return before
    return np.exp2(powers)


def slow_part(jacobian: Array, length: float, slow: int) -> Array | None:
    """The projection on the slow directions along the fast ones; None where there is none of that many."""
    basis, count = split(jacobian, length)
    if count != slow:
        return None
    keep = np.diag([1.0] * slow + [0.0] * (len(basis) - slow))
    return basis @ keep @ np.linalg.inv(basis)
