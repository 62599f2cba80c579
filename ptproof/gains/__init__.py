"""Gain conditions, critical values, thresholds, residuals under a clipped gain, and bounds that are tight.

:func:`gains` answers for given constants, :func:`tight_bound` encloses the averaged distance of a given problem, and
:func:`study` does both for a problem, with the constants of its own field.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
