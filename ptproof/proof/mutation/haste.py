"""Proofs that may give up early: most of what they are asked about here is false."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import ptproof.proof.engines.quantified
import ptproof.proof.engines.reals
import ptproof.proof.settling


@contextmanager
def in_haste(seconds: float) -> Iterator[None]:
    """Within, z3 has ``seconds`` for each question that names no limit of its own, and no witness is looked for.

    That can only lose proofs. It holds for the whole process.
    """
    limits: dict[tuple[Any, str], float] = {
        (ptproof.proof.engines.reals, "SECONDS"): seconds,
        (ptproof.proof.engines.quantified, "_SECONDS"): seconds,
        (ptproof.proof.settling, "SEARCH_SECONDS"): 0.0,
    }
    usual = {place: getattr(*place) for place in limits}
    try:
        for (module, name), value in limits.items():
            setattr(module, name, value)
        yield
    finally:
        for (module, name), value in usual.items():
            setattr(module, name, value)
