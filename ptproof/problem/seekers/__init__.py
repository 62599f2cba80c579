"""The seekers, one file each; each is a record that the rest of the package finds by its name."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
