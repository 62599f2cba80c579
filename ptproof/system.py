"""Systems of ordinary differential equations as symbolic values.

A :class:`System` is what is proved about, integrated and printed; a proof step is a function from system to
system. A :class:`DitherSystem` is one written as drift plus dithered vector fields.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.errors import InputError

_NEVER_BY_SYMPY = (sp.Integral, sp.Limit, sp.Sum, sp.Product)
_BINDING = (*_NEVER_BY_SYMPY, sp.Derivative, sp.Subs, sp.Lambda)


def gradient(expression: sp.Expr, state: Sequence[sp.Symbol]) -> sp.ImmutableDenseMatrix:
    """The column of partial derivatives of ``expression`` with respect to ``state`` (n × 1)."""
    return sp.ImmutableDenseMatrix([sp.diff(expression, variable) for variable in state])


def jacobian(vector: Sequence[sp.Expr], state: Sequence[sp.Symbol]) -> sp.ImmutableDenseMatrix:
    """The matrix of partial derivatives, entry (i, j) = ∂vector[i]/∂state[j]."""
    return sp.ImmutableDenseMatrix(len(vector), len(state), lambda i, j: sp.diff(vector[i], state[j]))


def lie_bracket(f: Sequence[sp.Expr], g: Sequence[sp.Expr], state: Sequence[sp.Symbol]) -> tuple[sp.Expr, ...]:
    """The Lie bracket [f, g] = (∂g/∂x) f − (∂f/∂x) g, with the sign that Lie bracket averaging uses."""
    left = jacobian(g, state) * sp.Matrix(list(f))
    right = jacobian(f, state) * sp.Matrix(list(g))
    return tuple(left - right)


@dataclass(frozen=True)
class System:
    """dx/dtime = rhs(time, x), with x = ``state``.

    Parameters
    ----------
    time
        The independent variable, a real symbol.
    state
        n distinct real symbols.
    rhs
        n expressions in ``time``, ``state``, ``parameters`` and undefined functions of these.
    parameters
        The remaining symbols. Left out, they are collected from ``rhs``, by name.
    name
        For people.

    Raises
    ------
    InputError
        If the lengths differ, a state stands twice, time is a state, ``parameters`` misses a symbol, or two symbols
        have one name.

    Examples
    --------
    >>> t, x = sp.symbols("t x", real=True)
    >>> k = sp.Symbol("k", positive=True)
    >>> decay = System(t, (x,), (-k * x,))
    >>> decay.parameters, decay.with_values({k: 2}).rhs
    ((k,), (-2*x,))
    """

    time: sp.Symbol
    state: tuple[sp.Symbol, ...]
    rhs: tuple[sp.Expr, ...]
    parameters: tuple[sp.Symbol, ...] | None = None
    name: str = "system"

    def __post_init__(self) -> None:
        state = tuple(self.state)
        rhs = tuple(sp.sympify(entry) for entry in self.rhs)
        if len(state) != len(rhs):
            raise InputError(f"{self.name}: {len(state)} states but {len(rhs)} right-hand sides")
        if len(set(state)) != len(state) or self.time in state:
            raise InputError(f"{self.name}: the states and the time must be distinct symbols")
        free = set().union(*(entry.free_symbols for entry in rhs)) - {self.time, *state}
        if self.parameters is None:
            parameters = tuple(sorted(free, key=lambda symbol: symbol.name))
        else:
            parameters = tuple(self.parameters)
            if missing := free - set(parameters):
                names = ", ".join(sorted(symbol.name for symbol in missing))
                raise InputError(f"{self.name}: the right-hand side has symbols that are not declared: {names}")
        object.__setattr__(self, "state", state)
        object.__setattr__(self, "rhs", rhs)
        object.__setattr__(self, "parameters", parameters)
        check_names(self.symbols, self.name)

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """Time, states, parameters, and what else stands in the right-hand side."""
        assert self.parameters is not None
        return self.time, *self.state, *self.parameters

    @property
    def dimension(self) -> int:
        """The number n of states."""
        return len(self.state)

    @property
    def vector(self) -> sp.ImmutableDenseMatrix:
        """The right-hand side as a column (n × 1)."""
        return sp.ImmutableDenseMatrix(self.rhs)

    @property
    def undefined_functions(self) -> tuple[sp.Function, ...]:
        """The applied undefined functions that the right-hand side contains, sorted by their text."""
        found = set().union(*(entry.atoms(sp.core.function.AppliedUndef) for entry in self.rhs))
        return tuple(sorted(found, key=str))

    def derivative_along(self, expression: sp.Expr) -> sp.Expr:
        """d/dtime of ``expression(time, x)`` along the solutions: ∂/∂time + (∂/∂x) rhs."""
        total = sp.diff(expression, self.time)
        for variable, rate in zip(self.state, self.rhs, strict=True):
            total += sp.diff(expression, variable) * rate
        return total

    def linearization(self, at: Mapping[sp.Symbol, Any]) -> sp.ImmutableDenseMatrix:
        """The matrix ∂rhs/∂x (n × n) evaluated at the point ``at``."""
        return jacobian(self.rhs, self.state).subs(at).doit()

    def with_values(self, values: Mapping[Any, Any]) -> System:
        """The same system with parameters, or undefined functions, replaced.

        A key is a parameter or an applied undefined function such as ``F(x1, x2)``, whose value is an
        expression in its arguments; derivatives of it are carried out.
        """
        return replace(self, rhs=substitute(self.rhs, values), parameters=None)

    def rename(self, states: Mapping[sp.Symbol, sp.Symbol], name: str | None = None) -> System:
        """The same system in other letters for its states.

        Raises
        ------
        InputError
            If a new letter stands for something else already, or is not of the kind of the old one.
        """
        for old, new in states.items():
            if new in {*self.symbols} - states.keys():
                raise InputError(f"{self.name}: {old} can't be called {new}, which is in use")
            if old.assumptions0 != new.assumptions0:
                raise InputError(f"{self.name}: {old} and {new} are not declared to be of one kind")
        state = tuple(states.get(symbol, symbol) for symbol in self.state)
        rhs = tuple(replaced(entry, states) for entry in self.rhs)
        return replace(self, state=state, rhs=rhs, parameters=None, name=self.name if name is None else name)

    def latex(self) -> str:
        """The system as a LaTeX ``aligned`` block, without delimiters."""
        rows = [
            rf"\frac{{\mathrm{{d}} {sp.latex(variable)}}}{{\mathrm{{d}} {sp.latex(self.time)}}} &= {sp.latex(entry)}"
            for variable, entry in zip(self.state, self.rhs, strict=True)
        ]
        return r"\begin{aligned}" + r" \\ ".join(rows) + r"\end{aligned}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"


def check_names(symbols: Sequence[sp.Symbol], where: str) -> None:
    """Refuse two symbols of one name, which SymPy keeps apart by their assumptions and nobody else can."""
    names: dict[str, sp.Symbol] = {}
    for symbol in symbols:
        if not isinstance(symbol, sp.Dummy) and names.setdefault(symbol.name, symbol) != symbol:
            raise InputError(f"{where}: two symbols are called {symbol.name}; declare it once")


def substitute(expressions: Sequence[sp.Expr], values: Mapping[Any, Any]) -> tuple[sp.Expr, ...]:
    """Replace symbols and applied undefined functions, then carry out the derivatives.

    ``F(x1, x2) -> expression in x1, x2`` replaces F at every argument, also inside derivatives.
    """
    symbols = {key: sp.sympify(value) for key, value in values.items() if isinstance(key, sp.Symbol)}
    functions = {key: value for key, value in values.items() if not isinstance(key, sp.Symbol)}
    result = []
    for entry in expressions:
        for applied, value in functions.items():
            entry = entry.replace(applied.func, sp.Lambda(applied.args, value))
        result.append(replaced(differentiated(entry), symbols))
    return tuple(result)


def replaced(expression: sp.Expr, values: Mapping[sp.Symbol, sp.Expr]) -> sp.Expr:
    """The expression with all symbols replaced at once."""
    # Where nothing is bound a plain exchange does it, and SymPy's substitution takes many times as long.
    bound = expression.has(*_BINDING)
    return expression.subs(values, simultaneous=True) if bound else expression.xreplace(values)


@lru_cache(maxsize=8192, typed=True)
def differentiated(expression: sp.Expr) -> sp.Expr:
    """Carry out derivatives and substitutions and nothing else: SymPy's limits, sums and integrals are not trusted."""
    masks: dict[sp.Expr, sp.Expr] = {}
    done: dict[sp.Expr, sp.Expr] = {}
    traversal = sp.preorder_traversal(expression)
    for node in traversal:
        if isinstance(node, _NEVER_BY_SYMPY):
            inside = node.func(differentiated(node.args[0]), *node.args[1:])
        elif isinstance(node, sp.Derivative | sp.Subs):
            traversal.skip()  # what is inside depends on the variable of the derivative
            if not node.has(sp.Limit, sp.Sum, sp.Product):
                continue
            inside = node
        else:
            continue
        masks.setdefault(node, sp.Dummy("mask", real=True))
        done[masks[node]] = inside
        traversal.skip()
    return expression.xreplace(masks).doit(integrals=False).xreplace(done)


@dataclass(frozen=True)
class DitherSystem:
    """dx/dtime = drift + √ω Σ fields[i] · dithers[i], with the dithers functions of (time, phase), phase = ω·time.

    Parameters
    ----------
    time, phase, omega
        The slow time τ, the symbol θ that stands for ωτ in ``dithers``, and the frequency ω.
    state
        n real symbols.
    drift
        b₀: n expressions in ``time`` and ``state``.
    fields
        b₁ … b_N: N tuples of n expressions in ``time`` and ``state``; the factor √ω is not part of them.
    dithers
        u₁ … u_N: N expressions in ``phase``, and in ``time`` where an amplitude varies slowly.
    period
        The common period of the dithers in ``phase``.

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, k = sp.symbols("omega k", positive=True)
    >>> F = sp.Function("F", real=True)(x)
    >>> DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), (sp.cos(theta), sp.sin(theta))).fields
    ((1,), (k*F(x),))
    """

    time: sp.Symbol
    phase: sp.Symbol
    omega: sp.Symbol
    state: tuple[sp.Symbol, ...]
    drift: tuple[sp.Expr, ...]
    fields: tuple[tuple[sp.Expr, ...], ...]
    dithers: tuple[sp.Expr, ...]
    period: sp.Expr = 2 * sp.pi
    name: str = "dither system"

    def __post_init__(self) -> None:
        n = len(self.state)
        object.__setattr__(self, "state", tuple(self.state))
        object.__setattr__(self, "drift", tuple(map(sp.sympify, self.drift)))
        object.__setattr__(self, "fields", tuple(tuple(map(sp.sympify, field)) for field in self.fields))
        object.__setattr__(self, "dithers", tuple(map(sp.sympify, self.dithers)))
        object.__setattr__(self, "period", sp.sympify(self.period))
        if len(set(self.state)) != n or {self.time, self.phase, self.omega} & set(self.state):
            raise InputError(f"{self.name}: time, phase, frequency and states must be distinct symbols")
        if len(self.drift) != n:
            raise InputError(f"{self.name}: {n} states but a drift of {len(self.drift)} entries")
        for i, field in enumerate(self.fields, start=1):
            where = f"{self.name}: field {i}"
            if len(field) != n:
                raise InputError(f"{where} has {len(field)} entries for {n} states")
            if any(self.phase in entry.free_symbols for entry in field):
                raise InputError(f"{where} depends on the phase {self.phase}; that belongs into its signal")
        if len(self.fields) != len(self.dithers):
            raise InputError(f"{self.name}: {len(self.fields)} fields but {len(self.dithers)} dithers")
        for i, dither in enumerate(self.dithers, start=1):
            if dither.free_symbols & set(self.state):
                raise InputError(f"{self.name}: dither {i} depends on the state; that belongs into its field")
        if self.period.is_positive is False:
            raise InputError(f"{self.name}: the period {self.period} is not positive")
        entries = (*self.drift, *(entry for field in self.fields for entry in field), *self.dithers, self.period)
        others = sorted(set().union(*(entry.free_symbols for entry in entries)), key=lambda symbol: symbol.name)
        check_names((self.time, self.phase, self.omega, *self.state, *others), self.name)

    def to_system(self, name: str | None = None) -> System:
        """The equation itself, with the phase replaced by ω·time; what is Piecewise in it is extended periodically."""
        total = sp.Matrix(self.drift)
        now, inside = self.omega * self.time, sp.Dummy("phase", real=True)
        # Not Mod: SymPy prints a multiple of it as Python code without the parentheses that it needs.
        within = now - self.period * sp.floor(now / self.period)
        for field, dither in zip(self.fields, self.dithers, strict=True):
            pieces = [node for node in dither.atoms(sp.Piecewise) if self.phase in node.free_symbols]
            signal = dither.xreplace({node: node.subs(self.phase, inside) for node in pieces})
            signal = signal.subs(self.phase, now).subs(inside, within)
            total += sp.sqrt(self.omega) * signal * sp.Matrix(field)
        return System(self.time, self.state, tuple(total), name=self.name if name is None else name)

    def _repr_latex_(self) -> str:
        return self.to_system()._repr_latex_()
