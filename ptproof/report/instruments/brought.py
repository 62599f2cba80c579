"""The instruments that a derivation brings along."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from ptproof.errors import InputError
from ptproof.proof.load import Derivation
from ptproof.report.instruments.instrument import Instrument


def instruments_of(derivation: Derivation) -> Iterator[Instrument]:
    """What the function ``instruments`` gives in a module ``instruments`` beside the claims, where there is one.

    Raises
    ------
    InputError
        If it gives something else, or two of one name.
    """
    names: set[str] = set()
    for package in derivation.packages:
        module = sys.modules.get(f"{package.__name__}.instruments")
        for item in getattr(module, "instruments", tuple)():
            if not isinstance(item, Instrument) or item.name in names:
                raise InputError(f"instruments() gives instruments, each of a name of its own, got {item!r:.80}")
            names.add(item.name)
            yield item
