"""Assertions for anybody's test suite, and the pytest plugin.

Each assertion passes only when its statement is proved. It fails with an ``AssertionError`` that shows the two sides,
their difference in simplest form and a witness where there is one; "undecided" is a failure that says so. The
names below are imported when they are first used: pytest imports this package in every run.

>>> import sympy as sp
>>> from ptproof.testing import assert_identity
>>> x = sp.Symbol("x", real=True)
>>> assert_identity(sp.cos(2 * x), 1 - 2 * sp.sin(x) ** 2)
>>> assert_identity(sp.cos(2 * x), 1 - sp.sin(x) ** 2)
Traceback (most recent call last):
    ...
AssertionError: the two sides are not equal: refuted
  left:       cos(2*x)
  right:      1 - sin(x)**2
  difference: -sin(x)**2  (left - right)
  witness:    x = 1: left cos(2) = -0.41614684 ± 3.46e-9, right 1 - sin(1)**2 = 0.29192658 ± 1.73e-9
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ptproof.proof.statement import eq, ge, gt, le, lt
    from ptproof.testing.averages import assert_average
    from ptproof.testing.convergence import assert_converges_to_average
    from ptproof.testing.fields import assert_field_bounds
    from ptproof.testing.gain_conditions import assert_gain_condition
    from ptproof.testing.relations import assert_identity, assert_inequality

_HOME = {
    "assert_average": "ptproof.testing.averages",
    "assert_converges_to_average": "ptproof.testing.convergence",
    "assert_field_bounds": "ptproof.testing.fields",
    "assert_gain_condition": "ptproof.testing.gain_conditions",
    "assert_identity": "ptproof.testing.relations",
    "assert_inequality": "ptproof.testing.relations",
    "eq": "ptproof.proof.statement",
    "ge": "ptproof.proof.statement",
    "gt": "ptproof.proof.statement",
    "le": "ptproof.proof.statement",
    "lt": "ptproof.proof.statement",
}
__all__ = [
    "assert_average",
    "assert_converges_to_average",
    "assert_field_bounds",
    "assert_gain_condition",
    "assert_identity",
    "assert_inequality",
    "eq",
    "ge",
    "gt",
    "le",
    "lt",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)
