"""States exchanged for others, or solved for and removed."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System


def change_variable(system: System, replaced: sp.Symbol, by: sp.Symbol, forward: sp.Expr, backward: sp.Expr) -> System:
    """Exchange one state for another, such as the heading θ for p = θ + kz.

    Parameters
    ----------
    replaced, by
        The old and the new state.
    forward
        The new state in terms of the old ones.
    backward
        The old state in terms of the new one and the states that stay.

    Raises
    ------
    InputError
        Unless ``forward`` and ``backward`` undo each other by exact algebra.
    """
    if not (vanishes(forward.subs(replaced, backward) - by) and vanishes(backward.subs(by, forward) - replaced)):
        raise InputError(f"{system.name}: {by} = {forward} and {replaced} = {backward} do not undo each other")
    old = {replaced: backward}
    rate = system.derivative_along(forward).subs(old)
    rhs = tuple(
        sp.expand(rate) if variable == replaced else entry.subs(old)
        for variable, entry in zip(system.state, system.rhs, strict=True)
    )
    return replace(system, state=tuple(by if v == replaced else v for v in system.state), rhs=rhs, parameters=None)


def solve_state(system: System, variable: sp.Symbol, solution: sp.Expr) -> System:
    """Remove a state whose equation has the closed-form ``solution`` in time.

    Raises
    ------
    InputError
        Unless the derivative of ``solution`` is the state's right-hand side by exact algebra.
    """
    rates = {state: rate.subs(variable, solution) for state, rate in zip(system.state, system.rhs, strict=True)}
    if not vanishes(sp.diff(solution, system.time) - rates.pop(variable)):
        raise InputError(f"{system.name}: {variable} = {solution} does not solve its equation")
    return System(system.time, tuple(rates), tuple(rates.values()), name=system.name)
