"""A seeking problem as data: field, drift, seeker and initial state, read exactly from TOML, and its closed loops."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
