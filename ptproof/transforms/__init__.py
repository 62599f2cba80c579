"""Proof steps that are functions from system to system: changes of time and of states, reduction."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
