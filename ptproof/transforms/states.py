"""States exchanged for others, or solved for and removed."""

from __future__ import annotations

from collections.abc import Mapping
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
    return change_variables(system, {replaced: backward}, {by: forward})


def change_variables(
    system: System, backward: Mapping[sp.Symbol, sp.Expr], forward: Mapping[sp.Symbol, sp.Expr]
) -> System:
    """Exchange several states at once, such as a position for the same in a frame that turns.

    Parameters
    ----------
    backward
        The old states, in terms of the new ones, the states that stay, and time.
    forward
        The new states, letters that the system does not use, in terms of the old ones, those that stay, and time. The
        n-th of them takes the place of the n-th old state.

    Raises
    ------
    InputError
        As :func:`change_variable` does, or if there are not as many new states as old ones.
    """
    backward = {old: sp.sympify(value) for old, value in backward.items()}
    forward = {new: sp.sympify(value) for new, value in forward.items()}
    where = f"{system.name}: {', '.join(f'{letter} = {value}' for letter, value in (forward | backward).items())}"
    if len(forward) != len(backward):
        raise InputError(f"{where}: {len(forward)} states for {len(backward)}")
    for replaced in backward:
        _check_state(system, replaced)
    for by in forward:
        fresh(by, system.symbols, system.name)
    _check_inverse(system, backward, forward, where)
    rates = {by: sp.expand(_put(system.derivative_along(value), backward)) for by, value in forward.items()}
    stay = {
        state: _put(rate, backward)
        for state, rate in zip(system.state, system.rhs, strict=True)
        if state not in backward
    }
    names = dict(zip(backward, forward, strict=True))
    states = tuple(names.get(state, state) for state in system.state)
    return replace(system, state=states, rhs=tuple((rates | stay)[state] for state in states), parameters=None)


def _check_inverse(
    system: System, backward: Mapping[sp.Symbol, sp.Expr], forward: Mapping[sp.Symbol, sp.Expr], where: str
) -> None:
    """Refuse what does not undo each other, is not differentiable, or has values of another kind."""
    old, new = set(backward), set(forward)
    if any(new & value.free_symbols for value in forward.values()) or any(
        old & value.free_symbols for value in backward.values()
    ):
        new_names, old_names = (", ".join(map(str, letters)) for letters in (forward, backward))
        raise InputError(f"{where}: {new_names} has to be given by {old_names}, and {old_names} by {new_names}")
    there_and_back = [
        *(_put(value, backward) - by for by, value in forward.items()),
        *(_put(value, forward) - replaced for replaced, value in backward.items()),
    ]
    if not all(map(vanishes, there_and_back)):
        raise InputError(f"{where} do not undo each other")
    stay = [symbol for symbol in (system.time, *system.state) if symbol not in old]
    if not all(
        is_differentiable(value, [*stay, *letters])
        for values, letters in ((forward, backward), (backward, forward))
        for value in values.values()
    ):
        raise InputError(f"{where} are not shown to be differentiable for all values of time and states")
    if not all(is_of_kind(letter, value) for values in (forward, backward) for letter, value in values.items()):
        raise InputError(f"{where} are not shown to have values of the kind that the letters are declared to be")


def _put(expression: sp.Expr, values: Mapping[sp.Symbol, sp.Expr]) -> sp.Expr:
    return expression.subs(values, simultaneous=len(values) > 1)


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
