"""Certified constants of a signal field: the best a₁, a₂, b₁, b₂ on a ball, an annulus or the whole space."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
