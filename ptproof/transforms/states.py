"""States exchanged for others, or solved for and removed."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System


def change_variable(
    system: System,
    replaced: sp.Symbol,
    by: sp.Symbol,
    forward: sp.Expr,
    backward: sp.Expr,
    name: str | None = None,
) -> System:
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
    renamed = replace(
        system, state=tuple(by if v == replaced else v for v in system.state), rhs=rhs, parameters=None,
        name=system.name if name is None else name,
    )  # fmt: skip
    return renamed


def solve_state(system: System, variable: sp.Symbol, solution: sp.Expr, name: str | None = None) -> System:
    """Remove a state whose equation has the closed-form ``solution`` in time.

    Raises
    ------
    InputError
        Unless the derivative of ``solution`` is the state's right-hand side by exact algebra.
    """
    index = system.state.index(variable)
    rate = system.rhs[index].subs(variable, solution)
    if not vanishes(sp.diff(solution, system.time) - rate):
        raise InputError(f"{system.name}: {variable} = {solution} does not solve its equation")
    keep = [i for i in range(system.dimension) if i != index]
    return System(
        system.time, tuple(system.state[i] for i in keep),
        tuple(system.rhs[i].subs(variable, solution) for i in keep), name=system.name if name is None else name,
    )  # fmt: skip
