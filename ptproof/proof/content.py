"""What a claim says, as a hash: the statement, its assumptions, and what the claims that it uses say."""

from __future__ import annotations

import hashlib
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim


@lru_cache(maxsize=10_000)
def content(claim: Claim) -> str:
    """A hash of the content of a claim, the same in every run."""
    parts = [claim.id, _text(claim.statement), *map(_text, claim.assumptions), *map(content, claim.uses)]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def _text(value: Any) -> str:
    if is_dataclass(value):
        inner = ", ".join(f"{item.name}={_text(getattr(value, item.name))}" for item in fields(value))
        return f"{type(value).__name__}({inner})"
    if isinstance(value, tuple | list):
        return f"[{', '.join(map(_text, value))}]"
    return sp.srepr(value) if isinstance(value, sp.Basic) else repr(value)
