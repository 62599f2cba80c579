"""Systems integrated: one door to several engines, outcomes as values, ensembles, and the checks that use them.

The names below are imported when they are first used, so that importing this package costs nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ptproof.simulation.blocks import compare_figure, figure_loop, linearize_at_source, to_control
    from ptproof.simulation.order import GapOrder, gap_order, hover_radius
    from ptproof.simulation.plan import Outcome
    from ptproof.simulation.run import simulate
    from ptproof.simulation.trajectory import Ensemble, Trajectory
    from ptproof.simulation.translate import to_function

_HOME = {
    "Ensemble": "trajectory",
    "GapOrder": "order",
    "Outcome": "plan",
    "Trajectory": "trajectory",
    "compare_figure": "blocks",
    "figure_loop": "blocks",
    "gap_order": "order",
    "hover_radius": "order",
    "linearize_at_source": "blocks",
    "simulate": "run",
    "to_control": "blocks",
    "to_function": "translate",
}
__all__ = [
    "Ensemble",
    "GapOrder",
    "Outcome",
    "Trajectory",
    "compare_figure",
    "figure_loop",
    "gap_order",
    "hover_radius",
    "linearize_at_source",
    "simulate",
    "to_control",
    "to_function",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"ptproof.simulation.{_HOME[name]}"), name)
