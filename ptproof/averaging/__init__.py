"""Lie bracket averaging of dithered systems.

>>> import sympy as sp
>>> from ptproof.averaging import average
>>> from ptproof.system import DitherSystem
>>> tau, theta, x = sp.symbols("tau theta x", real=True)
>>> omega, k = sp.symbols("omega k", positive=True)
>>> F = sp.Function("F", real=True)(x)
>>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), (sp.cos(theta), sp.sin(theta)))
>>> average(seeker).rhs
(k*Derivative(F(x), x)/2,)
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
