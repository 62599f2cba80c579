"""Rigorous enclosures of single runs: a proposal in floating-point numbers for each step, and its proof in balls.

The names below are imported when they are first used, so that importing this package costs nothing.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
