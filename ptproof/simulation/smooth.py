"""A system made ready for a method that needs smooth right-hand sides: choices in time made, constants apart."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.kinks import is_kink
from ptproof.simulation.plan import Batch, Plan
from ptproof.system import System


@lru_cache(maxsize=64)
def picker(system: System, conditions: tuple[Relational, ...]) -> Callable[[float, tuple[float, ...]], System]:
    """From an instant and the parameters to the system with its choices made as they are then.

    Parameters
    ----------
    conditions
        Those that change at known instants only.

    Raises
    ------
    InputError
        For other kinks, in a state or at an unknown instant: a method with long steps would not notice them.
    """
    moving, occurring = {system.time, *system.state}, set().union(*(entry.atoms(Relational) for entry in system.rhs))
    known = [condition for condition in conditions if condition in occurring]
    truth = sp.lambdify([system.time, system.parameters or ()], known, modules="math")
    made: dict[tuple[bool, ...], System | InputError] = {}

    def choose(key: tuple[bool, ...]) -> System | InputError:
        choices = dict(zip(known, map(sp.sympify, key), strict=True))
        rhs = tuple(entry.xreplace(choices) for entry in system.rhs)
        for node in (node for entry in rhs for node in sp.preorder_traversal(entry)):
            if is_kink(node, moving):
                where = "in the state" if node.free_symbols & set(system.state) else "in time at an unknown instant"
                return InputError(f"this method can't follow a kink {where}, {node.func}; use the engine casadi")
        return System(system.time, system.state, rhs, system.parameters, name=system.name) if key else system

    def pick(time: float, values: tuple[float, ...]) -> System:
        key = tuple(truth(time, values))
        if key not in made:
            made[key] = choose(key)
        if isinstance(chosen := made[key], InputError):
            raise chosen
        return chosen

    return pick


def pieces(plan: Plan, batch: Batch) -> list[tuple[int, System]]:
    """The smooth system of each piece that is not empty, with the piece's place among the edges.

    Raises
    ------
    InputError
        As :func:`picker`, and where some members have a kink in time that others have not.
    """
    systems, pick, values = [], picker(plan.system, plan.conditions), tuple(batch.parameters[:, 0].tolist())
    for row, (a, b) in enumerate(itertools.pairwise(batch.edges)):
        if np.all(b == a):
            continue
        if not np.all(b > a):
            raise InputError("some members have a kink in time where others have none; use the engine casadi")
        systems.append((row, pick(float((a[0] + b[0]) / 2), values)))
    return systems


def constants_apart(system: System) -> tuple[list[sp.Expr], dict[sp.Expr, sp.Symbol]]:
    """The right-hand side with a symbol for each part that depends on the parameters alone, and what they stand for."""
    constants: dict[sp.Expr, sp.Symbol] = {}
    moving = {system.time, *system.state}

    def apart(node: Any) -> Any:
        if not node.free_symbols & moving:
            if not isinstance(node, sp.Expr) or node.is_Symbol or node.is_number:
                return node
            return constants.setdefault(node, sp.Symbol(f"constant {len(constants)}", real=True))
        if not node.args:
            return node
        args = list(node.args)
        if isinstance(node, sp.Add | sp.Mul):
            fixed = [entry for entry in args if not entry.free_symbols & moving]
            args = [*([node.func(*fixed)] if fixed else []), *(entry for entry in args if entry.free_symbols & moving)]
        return node.func(*map(apart, args))

    return [apart(entry) for entry in system.rhs], constants
