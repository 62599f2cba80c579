"""The one import of a derivation: statements, claims, the engines that prove them, lemmas, and what runs them.

>>> import sympy as sp
>>> from ptproof.proof import Evidence, Goal, claim, decide, eq, exact
>>> x = sp.Symbol("x", real=True)
>>> @claim("double-angle", "The double angle", eq(sp.cos(2 * x), 1 - 2 * sp.sin(x) ** 2))
... def double_angle(goal: Goal) -> Evidence:
...     return exact(goal)
>>> print(decide([double_angle]).results[0].verdict)
proved

The names stand in ``__init__.pyi``, and each is imported when it is first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
