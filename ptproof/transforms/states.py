"""States exchanged for others, or solved for and removed."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.names import fresh, is_differentiable, is_of_kind, moves_smoothly


def change_variable(system: System, replaced: sp.Symbol, by: sp.Symbol, forward: sp.Expr, backward: sp.Expr) -> System:
    """Exchange one state for another, such as the heading θ for p = θ + kz.

    Parameters
    ----------
    replaced, by
        The old state, and the new one: a letter that the system does not use.
    forward
        The new state in terms of the old ones, and of time.
    backward
        The old state in terms of the new one, the states that stay, and time.

    Raises
    ------
    InputError
        Unless ``forward`` and ``backward`` are differentiable for all values of time and states, have values of the
        kind that the letters are declared to be, and undo each other by exact algebra.
    """
    where = f"{system.name}: {by} = {forward} and {replaced} = {backward}"
    forward, backward = sp.sympify(forward), sp.sympify(backward)
    _check_state(system, replaced)
    fresh(by, system.symbols, system.name)
    if by in forward.free_symbols or replaced in backward.free_symbols:
        raise InputError(f"{where}: {by} has to be given by {replaced}, and {replaced} by {by}")
    if not (vanishes(forward.subs(replaced, backward) - by) and vanishes(backward.subs(by, forward) - replaced)):
        raise InputError(f"{where} do not undo each other")
    others = [symbol for symbol in (system.time, *system.state) if symbol != replaced]
    if not (is_differentiable(forward, [*others, replaced]) and is_differentiable(backward, [*others, by])):
        raise InputError(f"{where} are not shown to be differentiable for all values of time and states")
    if not (is_of_kind(by, forward) and is_of_kind(replaced, backward)):
        raise InputError(
            f"{where} are not shown to have values of the kind that {by} and {replaced} are declared to be"
        )
    old = {replaced: backward}
    rate = system.derivative_along(forward).subs(old)
    rhs = tuple(
        sp.expand(rate) if variable == replaced else entry.subs(old)
        for variable, entry in zip(system.state, system.rhs, strict=True)
    )
    return replace(system, state=tuple(by if v == replaced else v for v in system.state), rhs=rhs, parameters=None)


def solve_state(system: System, variable: sp.Symbol, solution: sp.Expr) -> System:
    """Remove a state whose equation has the closed-form ``solution``, in time and perhaps in the other states.

    What is shown is that the state stays at the solution once it is there, on every interval of time on which the
    solution is defined: its derivative along the motion of the other states is the state's rate.

    Raises
    ------
    InputError
        Unless that holds by exact algebra, for a solution that is differentiable where it is defined.
    """
    solution = sp.sympify(solution)
    _check_state(system, variable)
    if variable in solution.free_symbols:
        raise InputError(f"{system.name}: the solution {solution} of {variable} contains {variable} itself")
    rates = {state: rate.subs(variable, solution) for state, rate in zip(system.state, system.rhs, strict=True)}
    rate = rates.pop(variable)
    remaining = System(system.time, tuple(rates), tuple(rates.values()), name=system.name)
    if not (moves_smoothly(solution, (system.time, *rates)) and vanishes(remaining.derivative_along(solution) - rate)):
        raise InputError(f"{system.name}: {variable} = {solution} does not solve its equation")
    return remaining


def _check_state(system: System, variable: sp.Symbol) -> None:
    if variable not in system.state:
        raise InputError(f"{system.name}: {variable} is not one of the states {', '.join(map(str, system.state))}")
