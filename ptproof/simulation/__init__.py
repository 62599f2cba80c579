"""Systems integrated: one door to several engines, outcomes as values, ensembles, and the checks that use them.

The names below are imported when they are first used, so that importing this package costs nothing.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
