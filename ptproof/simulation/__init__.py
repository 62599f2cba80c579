"""Systems integrated: one door to several engines, outcomes as values, ensembles, and the checks that use them.

The names below are imported when they are first used, so that importing this package costs nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ptproof.simulation.plan import Outcome
    from ptproof.simulation.run import simulate
    from ptproof.simulation.trajectory import Ensemble, Trajectory

_HOME = {
    "Ensemble": "trajectory",
    "Outcome": "plan",
    "Trajectory": "trajectory",
    "simulate": "run",
}
__all__ = ["Ensemble", "Outcome", "Trajectory", "simulate"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"ptproof.simulation.{_HOME[name]}"), name)
