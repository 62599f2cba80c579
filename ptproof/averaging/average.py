"""The Lie bracket system of a dithered system."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from ptproof.averaging.brackets import SparseField, Vector, sparse_bracket, tidy
from ptproof.averaging.coefficients import Coefficients, v_matrix
from ptproof.averaging.powers import PoweredSystem
from ptproof.averaging.refusal import check_form
from ptproof.averaging.second import derive_powered
from ptproof.system import DitherSystem, System

Pair = tuple[int, int]


@dataclass(frozen=True)
class Derived:
    """A dither system, its coefficients v_ji, the Lie brackets that enter, and the averaged system."""

    dithered: DitherSystem
    system: System
    v: Coefficients
    brackets: Mapping[Pair, Vector] = field(repr=False)

    def _repr_latex_(self) -> str:
        return self.system._repr_latex_()


def average(system: DitherSystem | PoweredSystem) -> System:
    """The Lie bracket system dx/dτ = b₀ + Σ_{i<j} [b_i, b_j] v_ji, in readable form.

    Of a :class:`~ptproof.averaging.powers.PoweredSystem` it is the one of second order
    (:func:`~ptproof.averaging.second.derive_powered`).

    Parameters
    ----------
    system
        n states, N fields and dithers; undefined functions stay as they are, with their derivatives.

    Returns
    -------
    System
        In the same time and states. Equal to the definition (eq:Lie_Bracket_System) by exact algebra only:
        exact v_ji, derivatives, and reduction modulo sin² + cos² = 1.

    Raises
    ------
    AveragingRefused
        If the system is not of the class: non-zero mean, a period that is not one, a drift that depends on
        the phase, fields that contain the frequency.
    AveragingUndecided
        If a dither is outside the class that is integrated exactly.

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> average(seeker).rhs
    (Derivative(F(x), x)/2,)
    """
    return derive_powered(system).system if isinstance(system, PoweredSystem) else derive(system).system


def derive(system: DitherSystem) -> Derived:
    """As :func:`average`, with the coefficients and the brackets; only brackets with v_ji ≠ 0 are formed.

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> derived = derive(seeker)
    >>> derived.v, derived.brackets
    ({(2, 1): 1/2}, {(1, 2): (Derivative(F(x), x),)})
    """
    check_form(system)
    v = v_matrix(system)
    fields = [SparseField(entries, system.state) for entries in system.fields]
    brackets: dict[Pair, Vector] = {}
    sums: list[list[sp.Expr]] = [[] for _ in system.state]
    for (j, i), value in v.items():
        if value == 0 or not (fields[i - 1].entries and fields[j - 1].entries):
            continue
        bracket = sparse_bracket(fields[i - 1], fields[j - 1])
        brackets[i, j] = bracket.vector
        for row, entry in bracket.entries.items():
            sums[row].append(value * entry)
    added = (tidy(sp.Add(*terms)) if len(terms) > 1 else sp.Add(*terms) for terms in sums)
    rhs = tuple(map(operator.add, system.drift, added))
    averaged = System(system.time, system.state, rhs, name=f"average of {system.name}")
    return Derived(system, averaged, v, brackets)
