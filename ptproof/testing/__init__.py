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

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
