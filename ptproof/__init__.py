"""Derives, decides and simulates prescribed-time source seeking from one symbolic source."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ptproof.problem import Problem, example, load
    from ptproof.simulation import Ensemble, Outcome, Trajectory, simulate
    from ptproof.system import DitherSystem, System

__version__ = "0.1.0"

# The public face, imported when it is first used, so that ``import ptproof`` costs nothing.
_HOME = {
    "DitherSystem": "ptproof.system",
    "Ensemble": "ptproof.simulation",
    "Outcome": "ptproof.simulation",
    "Problem": "ptproof.problem",
    "System": "ptproof.system",
    "Trajectory": "ptproof.simulation",
    "example": "ptproof.problem",
    "load": "ptproof.problem",
    "simulate": "ptproof.simulation",
}
__all__ = [
    "DitherSystem",
    "Ensemble",
    "Outcome",
    "Problem",
    "System",
    "Trajectory",
    "__version__",
    "example",
    "load",
    "simulate",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)
