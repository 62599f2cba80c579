"""When Python looks for circles of objects that nobody needs."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def collecting(wanted: bool) -> Iterator[None]:
    """Whether it looks for them meanwhile, in this process and in its copies.

    What is loaded and set stays to the end: to look through all of it again and again takes a tenth of the time, and
    finds next to nothing. A proof, which takes memory for as long as it likes, wants it.
    """
    before = gc.isenabled()
    (gc.enable if wanted else gc.disable)()
    try:
        yield
    finally:
        (gc.enable if before else gc.disable)()
