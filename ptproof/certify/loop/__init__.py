"""Guarantees for the vehicle in closed loop, not for its average."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
