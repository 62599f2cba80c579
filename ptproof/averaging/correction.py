"""The terms of order 1/√ω: how far the solution is from its average, and how far the average drifts."""

from __future__ import annotations

import itertools
import operator
from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.average import derive
from ptproof.averaging.brackets import SparseField, Vector, sparse_bracket, tidy
from ptproof.averaging.coefficients import signals, tidy_constant, triple_means
from ptproof.averaging.refusal import parts
from ptproof.averaging.signal import Signal
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import DitherSystem, System


@dataclass(frozen=True)
class Correction:
    """x = x̄ + (1/√ω) Σ b_i(τ, x̄) U_i(τ, ωτ) + O(1/ω), with x̄ the solution of a corrected average.

    With U_i the antiderivative of u_i of zero mean, and averages ⟨·⟩ over one period,

        dx̄/dτ = b₀ + Σ_{i<j} [b_i, b_j] v_ji + (1/√ω) g,
        g = −(1/3) Σ_{i<j} Σ_k (⟨u_j U_i U_k⟩ − ⟨u_i U_j U_k⟩) [[b_i, b_j], b_k].

    Guaranteed on every finite interval of τ on which the average exists, uniformly for initial states in a compact
    set, if the fields are C³, the drift is C², both in time and states, and the slow amplitudes of the dithers
    are C²: |x(τ) − expressions(τ, x̄(τ))| ≤ C/ω, where x̄ starts in ``initial_state``. Without g, or without the
    shift of the initial state, the error is O(1/√ω) in general, as for the plain average.

    Attributes
    ----------
    system, average
        The dither system and its Lie bracket system.
    shift
        Σ b_i U_i in terms of time, phase and states, n expressions.
    drift
        g, n expressions in time and states; zero for many dithers (cos θ and sin θ, square waves), not for all. Where
        it is, the plain average already serves as x̄.
    """

    system: DitherSystem
    average: System
    shift: Vector
    drift: Vector

    @property
    def corrected_average(self) -> System:
        """The average with its drift of order 1/√ω; ω is one of its parameters."""
        root = sp.sqrt(self.system.omega)
        rhs = tuple(a + g / root for a, g in zip(self.average.rhs, self.drift, strict=True))
        return System(self.system.time, self.system.state, rhs, name=f"corrected {self.average.name}")

    @property
    def expressions(self) -> Vector:
        """x to first order, in terms of x̄ (written in the letters of the states), τ and ω."""
        fast = {self.system.phase: self.system.omega * self.system.time}
        root = sp.sqrt(self.system.omega)
        return tuple(
            symbol + entry.subs(fast) / root for symbol, entry in zip(self.system.state, self.shift, strict=True)
        )

    @property
    def initial_state(self) -> Vector:
        """x̄ at the initial time in terms of x there: x̄ = x − (1/√ω) Σ b_i(τ, x) U_i(τ, ωτ)."""
        return tuple(2 * symbol - entry for symbol, entry in zip(self.system.state, self.expressions, strict=True))

    def hypotheses(self, domain: Sequence[Relation] = ()) -> Evidence:
        """Whether the fields are C³, drift and slow amplitudes C², on ``domain``; functions are taken as smooth.

        This is one order more than the average itself needs; where it is not proved, neither is the order 1/ω.
        """
        system = self.system
        variables = (system.time, *system.state)
        asked = [(place, entries, 2 if place == "drift" else 3, variables) for place, entries in parts(system)]
        for i, dither in enumerate(system.dithers, start=1):
            if system.time in dither.free_symbols:
                asked.append((f"dither {i}", (dither,), 2, (system.time,)))
        for place, entries, order, moving in asked:
            for entry in entries:
                assumed = {applied.func: sp.oo for applied in entry.atoms(AppliedUndef)}
                evidence = smoothness(entry, moving, order, assumed, domain)
                if evidence.verdict is not Verdict.PROVED:
                    return replace(evidence, detail=f"{place}: {evidence.detail}")
        return Evidence("smoothness", Verdict.PROVED, "the fields are C^3, the drift and the slow amplitudes are C^2")

    def _repr_latex_(self) -> str:
        rows = [
            rf"{sp.latex(symbol)} &= {sp.latex(entry)} + O(1/{sp.latex(self.system.omega)})"
            for symbol, entry in zip(self.system.state, self.expressions, strict=True)
        ]
        return r"$\displaystyle \begin{aligned}" + r" \\ ".join(rows) + r"\end{aligned}$"


def first_correction(system: DitherSystem) -> Correction:
    """The near-identity term and the drift of the average, both of order 1/√ω, by exact algebra.

    Raises as :func:`ptproof.averaging.average.average` does; what is guaranteed stands in :class:`Correction`.

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> first_correction(seeker).shift
    (-F(x)*cos(theta) + sin(theta),)
    """
    derived = derive(system)
    found = signals(system)
    primitives = [tidy_constant(signal.primitive.expression(system.phase)) for signal in found]
    rows = ([field[row] for field in system.fields] for row in range(len(system.state)))
    shift = tuple(sp.Add(*map(operator.mul, row, primitives)) for row in rows)
    return Correction(system, derived.system, shift, _drift(system, found))


def _drift(system: DitherSystem, found: tuple[Signal, ...]) -> Vector:
    fields = [SparseField(entries, system.state) for entries in system.fields]
    mean = triple_means(found)
    rows: list[list[sp.Expr]] = [[] for _ in system.state]
    for i, j in itertools.combinations(range(len(fields)), 2):
        weights = {k: tidy_constant(sp.expand(mean(j, i, k) - mean(i, j, k))) for k in range(len(fields))}
        weights = {k: weight for k, weight in weights.items() if weight != 0}
        if not weights:
            continue
        inner = sparse_bracket(fields[i], fields[j])
        for k, weight in weights.items():
            for row, entry in sparse_bracket(inner, fields[k]).entries.items():
                rows[row].append(-weight * entry / 3)
    return tuple(tidy(sp.Add(*terms)) if terms else sp.S.Zero for terms in rows)
