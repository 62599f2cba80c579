"""Singular perturbation: slow and fast states, quasi-steady state, boundary layer, reduced model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.solvers.solveset import NonlinearError

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.names import fresh


@dataclass(frozen=True)
class SlowFast:
    """μ·dz/dτ = g(x, z) beside dx/dτ = slow(τ, x, z): a system split into slow x and fast z.

    Attributes
    ----------
    time
        The slow time τ.
    slow_state, slow_rhs
        x and its rate, n each.
    fast_state, fast_rate
        z and g = μ·dz/dτ, m each.
    mu
        The small parameter.
    quasi_steady_state
        l(x), with g(x, l(x)) = 0; m expressions.
    unique
        Whether z = l(x) was shown to be the only solution of g(x, z) = 0 (g is affine in z with a constant
        regular matrix); False says that it was not shown.
    """

    time: sp.Symbol
    slow_state: tuple[sp.Symbol, ...]
    slow_rhs: tuple[sp.Expr, ...]
    fast_state: tuple[sp.Symbol, ...]
    fast_rate: tuple[sp.Expr, ...]
    mu: sp.Symbol
    quasi_steady_state: tuple[sp.Expr, ...]
    unique: bool
    name: str = "system"

    def boundary_layer(self, deviation: Sequence[sp.Symbol], fast_time: sp.Symbol) -> System:
        """dỹ/dτ̃ = g(x, ỹ + l(x)) with ỹ = z − l(x) and x frozen.

        Raises
        ------
        InputError
            If there are more or fewer deviations than fast states, or a letter is in use.
        """
        if len(deviation) != len(self.fast_state):
            raise InputError(f"{self.name}: {len(self.fast_state)} fast states but {len(deviation)} deviations")
        entries = (*self.fast_rate, *self.quasi_steady_state)
        frozen = set().union(self.slow_state, *(entry.free_symbols for entry in entries)) - set(self.fast_state)
        for letter in (*deviation, fast_time):
            fresh(letter, frozen, self.name)
        layers = zip(self.fast_state, deviation, self.quasi_steady_state, strict=True)
        moved = {symbol: away + steady for symbol, away, steady in layers}
        rhs = tuple(sp.expand(entry.subs(moved, simultaneous=True)) for entry in self.fast_rate)
        return System(fast_time, tuple(deviation), rhs, name=f"boundary layer of {self.name}")

    def reduced_model(self) -> System:
        """dx/dτ = slow(τ, x, l(x))."""
        steady = dict(zip(self.fast_state, self.quasi_steady_state, strict=True))
        rhs = tuple(entry.subs(steady, simultaneous=True) for entry in self.slow_rhs)
        return System(self.time, self.slow_state, rhs, name=f"reduced model of {self.name}")


def split(
    system: System,
    fast: Sequence[sp.Symbol],
    mu: sp.Symbol,
    quasi_steady_state: Sequence[sp.Expr] | None = None,
) -> SlowFast:
    """Split ``system`` into slow and ``fast`` states, and find or check its quasi-steady state.

    Raises
    ------
    InputError
        If a fast rate times μ still contains μ, a slow rate contains μ, no quasi-steady state is found, the given one
        contains a fast state or does not solve g(x, l(x)) = 0, or several are found (the theorem asks for a unique
        one).
    """
    index = {symbol: i for i, symbol in enumerate(system.state)}
    if missing := [symbol.name for symbol in fast if symbol not in index]:
        raise InputError(f"{system.name}: not among the states: {', '.join(missing)}")
    rates = tuple(sp.expand(mu * system.rhs[index[symbol]]) for symbol in fast)
    if any(mu in rate.free_symbols for rate in rates):
        raise InputError(f"{system.name}: the rate of the fast states is not of the form g(x, z)/{mu}")
    slow = [i for i, symbol in enumerate(system.state) if symbol not in fast]
    if fast_too := [system.state[i].name for i in slow if mu in system.rhs[i].free_symbols]:
        raise InputError(f"{system.name}: the rate of the slow state {', '.join(fast_too)} depends on {mu}")
    if quasi_steady_state is None:
        steady, unique = solve_quasi_steady_state(rates, fast, system.name)
    else:
        steady, unique = tuple(map(sp.sympify, quasi_steady_state)), _is_affine_regular(rates, fast)
        if len(steady) != len(fast) or any(entry.free_symbols & {*fast, mu} for entry in steady):
            raise InputError(f"{system.name}: the quasi-steady state {steady} is not one expression in the slow states "
                             "for each fast state")  # fmt: skip
        residual = [rate.subs(dict(zip(fast, steady, strict=True)), simultaneous=True) for rate in rates]
        if not all(vanishes(entry) for entry in residual):
            raise InputError(f"{system.name}: the quasi-steady state {steady} does not make the fast rates vanish")
    return SlowFast(
        system.time, tuple(system.state[i] for i in slow), tuple(system.rhs[i] for i in slow),
        tuple(fast), rates, mu, steady, unique, name=system.name,
    )  # fmt: skip


def solve_quasi_steady_state(
    rates: Sequence[sp.Expr], fast: Sequence[sp.Symbol], name: str = "system"
) -> tuple[tuple[sp.Expr, ...], bool]:
    """Solve g(x, z) = 0 for z, and say whether the solution was shown to be the only one.

    An affine g with a regular matrix that is free of undetermined zeros has one solution, by linear algebra.
    Otherwise SymPy's solver is asked, each real solution is checked by substitution, and uniqueness is not
    claimed.
    """
    if _is_affine_regular(rates, fast):
        matrix, right = sp.linear_eq_to_matrix(list(rates), list(fast))
        return tuple(sp.cancel(entry) for entry in matrix.LUsolve(right)), True
    try:
        found = sp.solve(list(rates), list(fast), dict=True)
    except NotImplementedError:
        found = []
    solutions = []
    for candidate in found:
        values = tuple(candidate.get(symbol, symbol) for symbol in fast)
        if any(set(fast) & value.free_symbols or value.is_real is False for value in values):
            continue
        if all(vanishes(rate.subs(dict(zip(fast, values, strict=True)), simultaneous=True)) for rate in rates):
            solutions.append(values)
    if not solutions:
        raise InputError(f"{name}: no quasi-steady state found; give it as an expression in the slow states")
    if len(solutions) > 1:
        raise InputError(f"{name}: the quasi-steady state is not unique: {solutions}")
    return solutions[0], False


def _is_affine_regular(rates: Sequence[sp.Expr], fast: Sequence[sp.Symbol]) -> bool:
    try:
        matrix, _ = sp.linear_eq_to_matrix(list(rates), list(fast))
    except NonlinearError:
        return False
    return bool(sp.factor(matrix.det()).is_nonzero)
