"""Instruments: sliders in the report, and what follows them, printed from the expressions that are proved.

A derivation brings them in a module ``instruments`` beside its claims, with a function ``instruments()``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
