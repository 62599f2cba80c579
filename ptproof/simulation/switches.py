"""The instants at which the rates of a system jump or have a kink by the time alone: a run is integrated between them.

A method with error control can step over a jump and not notice, since its rates before and after may agree.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, reduce
from typing import TypeAlias

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.kinks import is_kink, level, switching
from ptproof.simulation.plan import Array
from ptproof.simulation.quantities import select
from ptproof.system import System

_POINTS, _MOST = 2**13, 2**20
_MODULES = [
    {  # SymPy's own Max of numbers and arrays is for arrays of one shape, and NumPy's select is slow
        "amax": lambda sides, axis: reduce(np.maximum, sides),
        "amin": lambda sides, axis: reduce(np.minimum, sides),
        "select": select,
    },
    "numpy",
]
Signs: TypeAlias = tuple[tuple[Callable[..., Array], tuple[str, ...]], ...]


@lru_cache(maxsize=64)
def _signs(system: System, known: tuple[Relational, ...]) -> Signs:
    """The functions that switch when they change their sign, of time and of parameters of these names."""
    moving, parameters = {system.time, *system.state}, system.parameters or ()
    met = {condition.lhs - condition.rhs for condition in known}
    found: dict[sp.Expr, None] = {}
    for node in (node for entry in system.rhs for node in sp.preorder_traversal(entry)):
        if is_kink(node, {system.time}):
            counted = level(node)
            for side in switching(node) if counted is None else [sp.sin(sp.pi * counted)]:
                if side.free_symbols & moving == {system.time} and not {side, -side} & met:
                    found.setdefault(side)
    used = [tuple(symbol for symbol in parameters if symbol in side.free_symbols) for side in found]
    return tuple(
        (sp.lambdify([system.time, *symbols], side, modules=_MODULES), tuple(symbol.name for symbol in symbols))
        for side, symbols in zip(found, used, strict=True)
    )


def between_switches(
    system: System, edges: Array, table: Mapping[str, Array], known: tuple[Relational, ...] = ()
) -> Array:
    """The edges (q × N) with the switches between them, of members whose parameters are in the table (N values a name).

    The switches are told to rounding, by signs on two grids, which are refined until both have many points between two
    changes and see as many; a change that is taken back between two points of both is not seen. Of conditions that are
    ``known`` the edges say already when they change. The end is repeated where a member switches less often than
    another.

    Raises
    ------
    InputError
        Where there are more than 2¹⁶ of them.
    """
    signs = _signs(system, known)
    if not signs:
        return edges
    names = tuple({name: None for _, used in signs for name in used})
    members = list(zip(*edges.tolist(), *(table[name].tolist() for name in names), strict=True))
    found = {member: _merged(signs, member[: len(edges)], dict(zip(names, member[len(edges) :], strict=True)))
             for member in dict.fromkeys(members)}  # fmt: skip
    most = max(map(len, found.values()))
    return np.array([np.pad(found[member], (0, most - len(found[member])), mode="edge") for member in members]).T


def _merged(signs: Signs, edges: tuple[float, ...], values: Mapping[str, float]) -> Array:
    """The edges of one member, and the instants between the first and the last that are none of them."""
    start, end = edges[0], edges[-1]
    every = np.unique(
        np.concatenate([_changes(sign, start, end, [values[name] for name in used]) for sign, used in signs])
    )
    near = 1e-12 * (end - start)
    every = every[np.diff(every, prepend=start) > near]
    apart = np.abs(every[:, None] - np.array(edges)).min(axis=1) > near
    return np.sort(np.concatenate([every[apart], edges]))


def _changes(sign: Callable[..., Array], start: float, end: float, values: list[float]) -> Array:
    def of(times: Array) -> Array:
        with np.errstate(all="ignore"):
            found = np.sign(np.broadcast_to(sign(times, *values), times.shape))
        return np.where(np.isnan(found), 2.0, found)  # where it has no value is a place too

    points = _POINTS
    while True:
        grids = [np.linspace(start, end, count) for count in (points, points * 7 // 5)]
        places = [np.flatnonzero(np.diff(_carried(of(grid)))) for grid in grids]
        if len(places[0]) == len(places[1]) < points / 16:
            break
        points *= 2
        if points > _MOST:
            raise InputError(
                f"the right-hand side switches more than {_MOST // 16} times between {start:g} and {end:g}; "
                "take a shorter span"
            )
    grid, place = grids[0], places[0]
    before, after = grid[place], grid[place + 1]
    side = of(before)
    for _ in range(60):
        middle = (before + after) / 2
        same = of(middle) == side
        before, after = np.where(same, middle, before), np.where(same, after, middle)
    return after


def _carried(signs: Array) -> Array:
    """A zero takes the sign before it: a point of the grid may be a root, and is one change all the same."""
    last = np.maximum.accumulate(np.where(signs != 0, np.arange(len(signs)), 0))
    return signs[last]
