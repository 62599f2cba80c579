"""The average of a dither system to any order in 1/√ω, with the change of variables, what is left, and the check."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.average import derive
from ptproof.averaging.brackets import Vector, tidy
from ptproof.averaging.coefficients import signals
from ptproof.averaging.expansion import Expansion, normal_form
from ptproof.averaging.oscillation import DELTA
from ptproof.averaging.problem import DitherProblem, check_order
from ptproof.averaging.refusal import check_form, parts
from ptproof.averaging.residual import put_back
from ptproof.averaging.scaled import linear, of_problem
from ptproof.proof.algebra import is_zero
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import DitherSystem, System

_TIDIED = 16


@dataclass(frozen=True)
class Orders:
    """X = x + ω^(−1/2) W_1 + … + ω^(−(N+1)/2) W_(N+1), with dX/dτ = A_1(X) + … + ω^(−(N−1)/2) A_N(X) + r.

    Guaranteed where ``evidence`` is proved: along every solution of the system the identity holds, with the remainder
    r = ω^(−N/2) · ``remainder``, whose factor is bounded on every compact set of slow states and y, uniformly in τ and
    large ω, where the fields and the drift are C^(N+1) (``smooth`` says whether) and bounded in τ with their
    derivatives. So on a finite interval on which the average's solution exists, X stays within O(ω^(−N/2)) of it, and
    with N = 1 this is Lie bracket averaging. With ``problem.mu_omega`` = m the fast states are z = l(x) + y/√ω, as slow
    to settle as the dithers: A_1 depends on m and tends to the Lie bracket average as m → 0.

    Attributes
    ----------
    problem, expansion
        What was asked, and the expansion in δ = 1/√ω and σ = ωτ, one power further than ``order``.
    evidence
        Whether all of it, put back into the system, cancels: exact algebra of its own.
    smooth
        Whether fields, drift and quasi-steady state have the derivatives that this takes.
    """

    problem: DitherProblem
    expansion: Expansion
    evidence: Evidence
    smooth: Evidence

    @property
    def order(self) -> int:
        """N."""
        return self.expansion.order - 1

    @functools.cached_property
    def averages(self) -> tuple[Vector, ...]:
        """A_1, …, A_N, n expressions each, in readable form."""
        return tuple(tuple(map(_readable, self._of_states(row))) for row in self.expansion.means[1:])

    @functools.cached_property
    def correctors(self) -> tuple[Vector, ...]:
        """W_1, …, W_(N+1), n expressions each, in time, phase, states and the scaled fast states."""
        return tuple(map(self._of_states, self.expansion.correctors))

    @property
    def fast(self) -> dict[sp.Symbol, sp.Expr]:
        """{y: what it is}: the scaled fast states that the correctors contain."""
        return self.expansion.oscillation.meaning

    @property
    def system(self) -> System:
        """The average to order N; from N = 2 on ω is one of its parameters."""
        system, rows = self.problem.system, zip(*self.averages, strict=True)
        root = sp.sqrt(system.omega)
        rhs = tuple(sp.Add(*(entry / root**power for power, entry in enumerate(row))) for row in rows)
        return System(system.time, system.state, rhs, name=f"average of {system.name} to order {self.order}")

    @functools.cached_property
    def leading(self) -> Vector:
        """The limit of ``remainder`` as ω → ∞."""
        return self._of_states(self.expansion.rest[self.expansion.order + 1])

    @functools.cached_property
    def remainder(self) -> Vector:
        """ω^(N/2) r, n finite expressions in τ, θ, x, y and ω: dX/dτ along the system less the average at X."""
        return self._of_states(remainder(self.expansion, self.problem.system.omega))

    def _of_states(self, row: Vector) -> Vector:
        """Without the entry of the slow time, which is its own average."""
        return row[: len(self.problem.system.state)]

    def to_json(self) -> dict[str, Any]:
        """``orders`` and ``remainder``, as the command ``ptproof average --order`` prints them."""
        verdict = str(self.evidence.verdict)
        return {
            "orders": [
                {"order": n, "average": [*map(str, row)], "correctors": [*map(str, own)], "verdict": verdict}
                for n, (row, own) in enumerate(zip(self.averages, self.correctors, strict=False), start=1)
            ],
            "remainder": {
                "power": f"-{self.order}/2",
                "corrector": [*map(str, self.correctors[-1])],
                "leading": [*map(str, self.leading)],
                "fast": {str(y): str(value) for y, value in self.fast.items()},
                "verdict": verdict,
                "detail": self.evidence.detail,
                "smooth": str(self.smooth.verdict),
            },
        }


def average_to_order(problem: DitherProblem | DitherSystem, order: int = 1) -> Orders:
    """The average of a dither system to order N = ``order`` in 1/√ω, by exact algebra, put back and checked.

    Parameters
    ----------
    problem
        With or without fast states; where ``mu_omega`` is given they keep their dynamics, else they are at their
        quasi-steady state. Unknown functions stay as they are.

    Raises
    ------
    InputError
        If the order is not a whole number from 1 to 12.
    AveragingRefused, AveragingUndecided
        If the system is not of the form, a dither has no exact mean 0 and period, the fast states are not linear and
        shown to be stable, or with fast states of their own dynamics a dither is no sum of sines and cosines.
    ArithmeticError
        If the first order is not the Lie bracket average that is derived the other way (that would be a bug).

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> found = average_to_order(seeker, 2)
    >>> found.averages, found.correctors[0], str(found.evidence.verdict)
    (((Derivative(F(x), x)/2,), (0,)), (F(x)*cos(theta) - sin(theta),), 'proved')
    """
    if isinstance(problem, DitherSystem):
        problem = DitherProblem(problem)
    check_order(order, "order")
    check_form(problem.system)
    signals(problem.system)
    oscillation = of_problem(problem, order + 2)
    expansion = normal_form(oscillation, order + 1)
    found = Orders(problem, expansion, put_back(expansion), _smooth(problem, oscillation.meaning, order))
    if not oscillation.fast:
        lie = derive(problem.reduced(tuple(_steady(problem)))).system
        for ours, brackets in zip(found.averages[0], lie.rhs, strict=True):
            if not is_zero(ours - brackets):
                raise ArithmeticError(f"the first order {ours} is not shown to be the Lie bracket average {brackets}")
    return found


def _steady(problem: DitherProblem) -> Sequence[sp.Expr]:
    return linear(problem.fast)[1] if problem.fast else ()


def _smooth(problem: DitherProblem, fast: dict[sp.Symbol, sp.Expr], order: int) -> Evidence:
    """Whether the fields and the drift are C^(N+1), and where fast states move, the quasi-steady state is C^(N+2)."""
    variables = (problem.system.time, *problem.system.state, *(problem.fast.state if problem.fast else ()))
    asked = [(place, entry, order + 1) for place, entries in parts(problem.system) for entry in entries]
    asked += [(f"l_{i}", entry, order + 2) for i, entry in enumerate(_steady(problem) if fast else (), start=1)]
    asked += [
        (f"dither {i}", entry, order + 1)
        for i, entry in enumerate(problem.system.dithers, start=1)
        if problem.system.time in entry.free_symbols
    ]
    for place, entry, needed in asked:
        own = (problem.system.time,) if place.startswith("dither") else variables
        assumed: dict[Any, Any] = dict.fromkeys(problem.smooth_functions, sp.oo)
        if problem.functions is None:
            assumed = {node.func: sp.oo for node in (*assumed, *entry.atoms(AppliedUndef))}
        evidence = smoothness(entry, own, needed, assumed, problem.domain)
        if evidence.verdict is not Verdict.PROVED:
            return Evidence(evidence.engine, evidence.verdict, f"{place}: {evidence.detail}", witness=evidence.witness)
    return Evidence("smoothness", Verdict.PROVED, f"fields and drift are C^{order + 1}")


def _readable(entry: sp.Expr) -> sp.Expr:
    return tidy(entry) if len(sp.Add.make_args(entry)) <= _TIDIED else entry


def remainder(expansion: Expansion, omega: sp.Symbol) -> Vector:
    """ω^((n+1)/2) times dX/dσ along the system less Σ δ^j G_j(X), for each slow state, where n is the highest power.

    Nothing is expanded: X stands in the unknown functions of the means as it is. SymPy is quick about everything but
    large expressions inside of ``Subs`` and repeated derivatives of the same term, so each of both is made once.
    """
    own, delta = expansion.oscillation, 1 / sp.sqrt(omega)
    moved = {
        symbol: symbol + sp.Add(*(delta**n * row[i] for n, row in enumerate(expansion.correctors, start=1)))
        for i, symbol in enumerate(own.slow)
    }
    rates = [rate.subs(DELTA, delta) for rate in own.right_hand_side]
    slopes, there = _Slopes(), _Moved(moved)
    result = []
    for place, symbol in enumerate(own.slow):
        along = sp.Add(*(slopes(moved[symbol], s) * rate for s, rate in zip(own.states, rates, strict=True)))
        means = sp.Add(*there([delta**j * row[place] for j, row in enumerate(expansion.means, start=1)]))
        result.append((along - means) / delta ** (expansion.order + 1))
    return tuple(result)


class _Slopes:
    """Derivatives of sums of products, each calculated once."""

    def __init__(self) -> None:
        self._known: dict[tuple[sp.Expr, sp.Symbol], sp.Expr] = {}

    def __call__(self, entry: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
        key = entry, symbol
        if key not in self._known:
            self._known[key] = self._slope(entry, symbol) if symbol in entry.free_symbols else sp.S.Zero
        return self._known[key]

    def _slope(self, entry: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
        if entry.is_Add:
            return sp.Add(*(self(term, symbol) for term in entry.args))
        if entry.is_Mul:
            factors = entry.args
            slopes = ((i, self(factor, symbol)) for i, factor in enumerate(factors))
            return sp.Add(*(sp.Mul(*factors[:i], slope, *factors[i + 1 :]) for i, slope in slopes if slope != 0))
        return sp.diff(entry, symbol)


class _Moved:
    """Expressions with every symbol replaced at once, also inside of derivatives of unknown functions."""

    def __init__(self, values: dict[sp.Symbol, sp.Expr]) -> None:
        # A short mark that is no symbol stands for the value, so that SymPy makes a Subs of a derivative at it.
        moving = [symbol for symbol, value in values.items() if value != symbol]
        marks = {symbol: sp.Function(f"X{i}", real=True)(sp.Dummy(real=True)) for i, symbol in enumerate(moving)}
        self._marks: dict[sp.Symbol, AppliedUndef] = marks
        self._values = {mark: values[symbol] for symbol, mark in marks.items()}
        self._subs: dict[sp.Subs, sp.Expr] = {}

    def __call__(self, entries: list[sp.Expr]) -> list[sp.Expr]:
        marked = [entry.subs(self._marks, simultaneous=True) for entry in entries]
        for node in set().union(*(entry.atoms(sp.Subs) for entry in marked)) - self._subs.keys():
            self._subs[node] = node.xreplace(self._values)
        return [entry.xreplace({**self._values, **self._subs}) for entry in marked]
