"""Numbers from outside: given as numbers, exact expressions or text, by name or by symbol."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.expressions import parse

LARGEST = 1e15


def as_float(value: Any, where: str) -> float:
    """A finite number from a number, exact expression or text; refused otherwise."""
    if isinstance(value, str):
        value = parse(value, where=where)
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{where}: expected a number, got {value!r}") from None
    if not abs(number) <= LARGEST:
        raise InputError(f"{where}: expected a finite number up to {LARGEST:g}, got {value}")
    return number


def by_name(values: Mapping[Any, Any]) -> dict[str, Any]:
    """The same mapping with symbols as keys replaced by their names."""
    return {key.name if isinstance(key, sp.Symbol) else str(key): value for key, value in values.items()}


def as_floats(values: Any, size: int, where: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """``size`` finite numbers (N) from an array, or from any sequence of what :func:`as_float` takes."""
    if isinstance(values, np.ndarray) and values.dtype.kind in "iuf":
        found = values.astype(float)
    elif isinstance(values, str) or not hasattr(values, "__len__"):
        raise InputError(f"{where}: expected (low, high) or {size} values, got {values!r}")
    else:
        found = np.array([as_float(value, where) for value in values])
    if found.shape != (size,):
        raise InputError(f"{where}: expected (low, high) or {size} values, got shape {found.shape}")
    if not np.isfinite(found).all():
        raise InputError(f"{where}: contains NaN or infinity")
    return found
