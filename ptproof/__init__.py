"""Derives, decides and simulates prescribed-time source seeking from one symbolic source."""

import os

import lazy_loader

__version__ = "0.1.0"

# SymPy keeps a thousand results of each of its functions where it is not told otherwise, when it is imported; a paper's
# expressions are many more.
os.environ.setdefault("SYMPY_CACHE_SIZE", "50000")

# The public face stands in __init__.pyi, and each name is imported when it is first used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
