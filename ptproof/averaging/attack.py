"""Attacking an average: the coefficients by quadrature, the brackets by exact derivatives at exact points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol, TypeVar

import sympy as sp

from ptproof.proof.attack import insist
from ptproof.proof.claim import Goal
from ptproof.proof.statement import Relation
from ptproof.system import DitherSystem, System


class Averaged(Protocol):
    """What is attacked: a dither system with its average and its coefficients v_ji."""

    @property
    def dithered(self) -> DitherSystem:
        """The system that was averaged."""
        ...

    @property
    def system(self) -> System:
        """The average."""
        ...

    @property
    def v(self) -> Any:
        """{(j, i): v_ji}."""
        ...


A = TypeVar("A", bound=Averaged)


def coefficient_goals(derived: Averaged) -> Iterator[Goal]:
    """v_ji = (1/P) ∫₀^P u_j(θ) ∫₀^θ u_i(s) ds dθ for each pair, the integrals left as they are."""
    system = derived.dithered
    inner = sp.Dummy("s", real=True)
    for (j, i), value in derived.v.items():
        first = system.dithers[i - 1].xreplace({system.phase: inner})
        double = sp.Integral(
            system.dithers[j - 1] * sp.Integral(first, (inner, 0, system.phase)), (system.phase, 0, system.period)
        )
        yield Goal(f"v_{j}{i}", Relation(double / system.period, "=", value), where_defined=True)


def average_goal(derived: Averaged) -> Goal:
    """dx/dτ = b₀ + Σ v_ji ((∂b_j/∂x) b_i − (∂b_i/∂x) b_j), the derivatives left as they are."""
    system, state = derived.dithered, derived.dithered.state

    def slope(expression: sp.Expr, variable: sp.Symbol) -> sp.Expr:
        return sp.Derivative(expression, variable, evaluate=False)

    total = list(system.drift)
    for (j, i), value in derived.v.items():
        first, second = system.fields[i - 1], system.fields[j - 1]
        for row in range(len(state)):
            for column, variable in enumerate(state):
                total[row] += value * slope(second[row], variable) * first[column]
                total[row] -= value * slope(first[row], variable) * second[column]
    return Goal(
        f"average of {system.name}", Relation(sp.Matrix(derived.system.rhs), "=", sp.Matrix(total)), where_defined=True
    )


def unshaken(derived: A, *, points: int = 6, coefficients: int | None = None) -> A:
    """The average, if an attack on it is in vain; raises as :func:`attack_average`."""
    attack_average(derived, points=points, coefficients=coefficients)
    return derived


def attack_average(derived: Averaged, *, points: int = 6, coefficients: int | None = None) -> int:
    """At how many points the average, and ``coefficients`` of its v_ji (None: all), were attacked in vain.

    Raises
    ------
    WrongPromise
        With exact values, and concrete functions, at which the average or a coefficient is another.
    """
    name = derived.dithered.name
    count = insist(f"the average of {name} is the Lie bracket system", average_goal(derived), points=points).points
    for goal in list(coefficient_goals(derived))[:coefficients]:
        count += insist(f"the coefficient {goal.id} of {name} is {goal.statement}", goal, points=2).points
    return count
