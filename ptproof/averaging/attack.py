"""Attacking an average: the coefficients by quadrature, the brackets by exact derivatives at exact points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from ptproof.averaging.average import Derived
from ptproof.averaging.second import PoweredAverage
from ptproof.proof.attack import insist
from ptproof.proof.claim import Goal
from ptproof.proof.statement import Relation


def coefficient_goals(derived: Derived) -> Iterator[Goal]:
    """v_ji = (1/P) ∫₀^P u_j(θ) ∫₀^θ u_i(s) ds dθ for each pair, the integrals left as they are."""
    system = derived.dithered
    inner = sp.Dummy("s", real=True)
    for (j, i), value in derived.v.items():
        first = system.dithers[i - 1].xreplace({system.phase: inner})
        double = sp.Integral(
            system.dithers[j - 1] * sp.Integral(first, (inner, 0, system.phase)), (system.phase, 0, system.period)
        )
        yield Goal(f"v_{j}{i}", Relation(double / system.period, "=", value), where_defined=True)


def average_goal(derived: Derived) -> Goal:
    """dx/dτ = b₀ + Σ v_ji ((∂b_j/∂x) b_i − (∂b_i/∂x) b_j), the derivatives left as they are."""
    system, total = derived.dithered, list(derived.dithered.drift)
    for (j, i), value in derived.v.items():
        bracket = _left_bracket(system.fields[i - 1], system.fields[j - 1], system.state)
        total = [entry + value * own for entry, own in zip(total, bracket, strict=True)]
    return Goal(
        f"average of {system.name}", Relation(sp.Matrix(derived.system.rhs), "=", sp.Matrix(total)), where_defined=True
    )


def unshaken(derived: Derived, *, points: int = 6, coefficients: int | None = None) -> Derived:
    """The average, if an attack on it is in vain; raises as :func:`attack_average`."""
    attack_average(derived, points=points, coefficients=coefficients)
    return derived


def attack_average(derived: Derived, *, points: int = 6, coefficients: int | None = None) -> int:
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


def attack_powered(found: PoweredAverage, *, points: int = 6) -> int:
    """At how many points the average of a system with powers was attacked in vain; raises as :func:`attack_average`.

    What is attacked is f₀ + Σ lim γ_ij [f_i, f_j] + Σ lim γ_ijm [[f_i, f_j], f_m], the derivatives left as they are.
    """
    plain, state = found.dithered.plain, found.dithered.state
    total = list(plain.drift)
    for letters, gamma in found.gammas.items():
        if gamma.limit:
            nested = plain.fields[letters[0] - 1]
            for letter in letters[1:]:
                nested = _left_bracket(nested, plain.fields[letter - 1], state)
            total = [entry + gamma.limit * value for entry, value in zip(total, nested, strict=True)]
    goal = Goal(found.system.name, Relation(sp.Matrix(found.system.rhs), "=", sp.Matrix(total)), where_defined=True)
    return insist(f"the average of {plain.name} is the second-order Lie bracket system", goal, points=points).points


def _left_bracket(f: Sequence[sp.Expr], g: Sequence[sp.Expr], state: Sequence[sp.Symbol]) -> tuple[sp.Expr, ...]:
    """(∂g/∂x) f − (∂f/∂x) g with derivatives that nobody carries out."""

    def along(entries: Sequence[sp.Expr], direction: Sequence[sp.Expr], row: int) -> sp.Expr:
        slopes = (sp.Derivative(entries[row], variable, evaluate=False) for variable in state)
        return sp.Add(*(slope * speed for slope, speed in zip(slopes, direction, strict=True) if speed != 0))

    return tuple(along(g, f, row) - along(f, g, row) for row in range(len(state)))
