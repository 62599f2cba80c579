"""Coordinates that tell the fast directions of a Jacobian from the slow ones; any would be right."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = Any
_FAST = 3.0


def split(jacobian: Array, length: float) -> tuple[Array, int]:
    """A basis (columns, n × n) with the slow directions first, and how many of these there are.

    A direction is fast if it dies out within the step. Each group has orthonormal columns; all are slow where the
    groups can't be told apart.
    """
    n = len(jacobian)
    everything = np.eye(n), n
    try:
        values, vectors = np.linalg.eig(jacobian)
    except np.linalg.LinAlgError:
        return everything
    order = np.argsort(-values.real, kind="stable")
    rates = values.real[order] * length
    slow = n
    for k in range(1, n):
        if rates[k] < -_FAST and rates[k] < 3 * min(rates[k - 1], 0.0) - _FAST:
            slow = k
            break
    if slow == n or slow == 0:
        return everything
    groups = [order[:slow], order[slow:]]
    columns = []
    for group in groups:
        found = _plane(vectors[:, group])
        if found is None:
            return everything
        columns.append(found)
    basis = np.concatenate(columns, axis=1)
    if not np.all(np.isfinite(basis)) or np.linalg.cond(basis) > 1e8:
        return everything
    return basis, slow


def _plane(vectors: Array) -> Array | None:
    """An orthonormal basis of the real space that conjugate pairs of vectors span."""
    size = vectors.shape[1]
    parts = np.concatenate([vectors.real, vectors.imag], axis=1)
    left, values, _ = np.linalg.svd(parts)
    if len(values) > size and values[size] > 1e-8 * values[0]:
        return None
    return left[:, :size]


def slow_part(jacobian: Array, length: float, slow: int) -> Array | None:
    """The projection on the slow directions along the fast ones; None where there is none of that many."""
    basis, count = split(jacobian, length)
    if count != slow:
        return None
    keep = np.diag([1.0] * slow + [0.0] * (len(basis) - slow))
    return basis @ keep @ np.linalg.inv(basis)
