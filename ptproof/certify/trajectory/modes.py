"""Right-hand sides with choices: those in time made piece by piece, those in the state mode by mode."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, cmp_to_key, lru_cache
from itertools import pairwise
from typing import Any

import flint
import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from ptproof.balls.ball import BALLS, ball_from, fraction
from ptproof.balls.pieces import VectorField
from ptproof.balls.tape import METHODS, Tape, Undefined, compile_tape
from ptproof.certify.trajectory.collocation import Rates
from ptproof.errors import InputError
from ptproof.system import System

_BENT = (sp.Max, sp.Min, sp.Abs)


@dataclass(frozen=True)
class Mode:
    """One smooth right-hand side, ready for balls and for floats; it holds where its guards are not negative."""

    choice: tuple[int, ...]
    field: VectorField
    rates: Rates
    guards: Tape
    plain: Tape


@dataclass(frozen=True)
class Choices:
    """A right-hand side without choices in time: its nodes Max, Min and Abs, inner ones first, and its modes."""

    system: System
    nodes: tuple[sp.Expr, ...]

    @cached_property
    def tape(self) -> Tape:
        """The whole right-hand side, kinks included."""
        return compile_tape(self.system.rhs, (self.system.time, *self.system.state))

    @cached_property
    def _arguments(self) -> Any:
        arguments = [argument for node in self.nodes for argument in node.args]
        return sp.lambdify([self.system.time, *self.system.state], arguments, modules="numpy", cse=True)

    def choice(self, time: float, state: Any) -> tuple[int, ...]:
        """What holds at a point, in floats."""
        values, made = iter(self._arguments(time, *state)), []
        for node in self.nodes:
            here = np.array([float(next(values)) for _ in node.args])
            best = np.argmax if isinstance(node, sp.Max) else np.argmin
            made.append(int(here[0] < 0) if isinstance(node, sp.Abs) else int(best(here)))
        return tuple(made)


@lru_cache(maxsize=256)
def mode_of(choices: Choices, choice: tuple[int, ...]) -> Mode:
    """The smooth right-hand side of a choice."""
    system, guards = choices.system, []
    made: dict[sp.Expr, sp.Expr] = {}
    for node, index in zip(choices.nodes, choice, strict=True):
        arguments = [argument.xreplace(made) for argument in node.args]
        if isinstance(node, sp.Abs):
            made[node] = -arguments[0] if index else arguments[0]
            guards.append(made[node])
            continue
        made[node] = chosen = arguments[index]
        sign = 1 if isinstance(node, sp.Max) else -1
        guards += [sign * (chosen - other) for k, other in enumerate(arguments) if k != index]
    rates = [entry.xreplace(made) for entry in system.rhs]
    symbols = (system.time, *system.state)
    return Mode(
        choice, VectorField.of(system.time, system.state, rates, guards),
        Rates.compiled(system.time, system.state, rates, guards), compile_tape(guards, symbols),
        compile_tape(rates, symbols),
    )  # fmt: skip


def stretches(system: System, start: sp.Expr, end: sp.Expr) -> list[tuple[sp.Expr, sp.Expr, Choices]]:
    """The time from ``start`` to ``end`` cut where a choice in time changes, each part with its right-hand side.

    Raises
    ------
    InputError
        For choices at instants that are not known, for jumps, and for what has no enclosure.
    """
    if system.undefined_functions:
        raise InputError(
            f"{system.name}: {', '.join(map(str, system.undefined_functions))} undefined; put them in first"
        )
    if system.parameters:
        raise InputError(f"{system.name}: no value for {', '.join(map(str, system.parameters))}")
    relations = sorted(set().union(*(entry.atoms(Relational) for entry in system.rhs)), key=str)
    inside = [instant for item in relations if (instant := _instant(system, item)) is not None]
    cuts = _sorted([start, end, *(instant for instant in inside if _less(start, instant) and _less(instant, end))])
    parts = []
    for first, last in pairwise(cuts):
        middle = _between(first, last)
        truth = {item: _holds(system, item, middle) for item in relations}
        rhs = tuple(entry.xreplace(truth) for entry in system.rhs)
        parts.append((first, last, _choices(System(system.time, system.state, rhs, name=system.name))))
    return parts


def _choices(system: System) -> Choices:
    moving = {system.time, *system.state}
    nodes: dict[sp.Expr, None] = {}
    for entry in system.rhs:
        for node in sp.postorder_traversal(entry):
            if not isinstance(node, sp.Expr) or not node.free_symbols & moving or node.is_Symbol:
                continue
            if isinstance(node, _BENT):
                nodes[node] = None
            elif not (node.is_Add or node.is_Mul or node.is_Pow or node.func in METHODS):
                raise InputError(
                    f"{system.name}: {node.func.__name__} may jump, and runs with jumps are not enclosed; write the "
                    f"right-hand side with smooth functions, Max, Min and Abs"
                )
    return Choices(system, tuple(nodes))


def _instant(system: System, relation: Relational) -> sp.Expr | None:
    """When a condition on the time alone changes; None if it does not."""
    difference = sp.expand(relation.lhs - relation.rhs)
    if difference.free_symbols & set(system.state) or relation.rel_op in ("==", "!="):
        raise InputError(
            f"{system.name}: the condition {relation} is about the state, and runs with jumps are not enclosed; write "
            f"the right-hand side with Max, Min and Abs"
        )
    if system.time not in difference.free_symbols:
        return None
    if not difference.is_polynomial(system.time) or sp.degree(difference, system.time) != 1:
        raise InputError(
            f"{system.name}: when the condition {relation} changes is not known; write it as time < instant"
        )
    slope = difference.coeff(system.time, 1)
    return sp.nsimplify(-difference.coeff(system.time, 0) / slope, rational=False)


def _holds(system: System, relation: Relational, time: sp.Expr) -> Any:
    sign = _order(*(side.subs(system.time, time) for side in (relation.lhs, relation.rhs)))
    if sign is None:
        raise InputError(f"{system.name}: whether {relation} holds at {time} is not decided")
    return sp.true if {"<": sign < 0, "<=": sign <= 0, ">": sign > 0, ">=": sign >= 0}[relation.rel_op] else sp.false


def _order(left: sp.Expr, right: sp.Expr) -> int | None:
    if left == right:
        return 0
    with flint.ctx.workprec(256):
        return BALLS.order(ball_from(left - right))


def _less(left: sp.Expr, right: sp.Expr) -> bool:
    sign = _order(left, right)
    if sign is None:
        raise InputError(f"whether {left} is before {right} is not decided")
    return sign < 0


def _sorted(instants: Sequence[sp.Expr]) -> list[sp.Expr]:
    ordered = sorted(instants, key=cmp_to_key(lambda first, second: -1 if _less(first, second) else 1))
    return [ordered[0], *(later for earlier, later in pairwise(ordered) if _less(earlier, later))]


def _between(first: sp.Expr, last: sp.Expr) -> sp.Expr:
    with flint.ctx.workprec(128):
        found = fraction(((ball_from(first) + ball_from(last)) / 2).mid())
    if not (_less(first, found) and _less(found, last)):
        raise Undefined("a stretch of time too short to be told apart")
    return found
