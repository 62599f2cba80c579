"""Changes of time: clocks that check themselves, the named ones, a cap on the rate of any of them."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
