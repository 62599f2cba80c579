"""Changes of time: clocks that check themselves, the named ones, a cap on the rate of any of them.

>>> import sympy as sp
>>> from ptproof import clocks
>>> t, tau = sp.symbols("t tau", real=True)
>>> T = sp.Symbol("T", positive=True)
>>> clocks.power_clock(t, tau, start=0, horizon=T, order=2).rate
T**3/(T - t)**3
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
