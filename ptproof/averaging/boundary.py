"""Stability of the boundary layer dỹ/dτ̃ = g(x, ỹ + l(x)), uniformly in the frozen x."""

from __future__ import annotations

import itertools
import time
from collections.abc import Sequence

import sympy as sp

from ptproof.averaging.problem import FastStates
from ptproof.averaging.samples import masked_functions, sample_points
from ptproof.proof.engines.reals import follows
from ptproof.proof.kinks import KINKS
from ptproof.proof.signs import sign_of, vanishes
from ptproof.proof.statement import Relation
from ptproof.proof.substitution import Substitution
from ptproof.proof.verdict import Evidence, Verdict, Witness

ENGINE = "boundary layer"
_SECONDS = 1.0
_BUDGET = 6.0
_RATES = (sp.S.One, sp.Rational(1, 2), sp.Rational(1, 10), sp.Rational(1, 100))


def boundary_layer_stability(
    fast: FastStates, steady: Sequence[sp.Expr], domain: Sequence[Relation] = (), states: Sequence[sp.Symbol] = ()
) -> Evidence:
    """Whether a Lyapunov function as in eq:blm_req_1 and eq:blm_req_2 exists, for all slow ``states`` in the domain.

    proved: g is affine in z with a constant matrix that satisfies the Routh-Hurwitz conditions (V is then a
    quadratic form), or ỹᵀ g(x, ỹ + l(x)) ≤ −c |ỹ|^(2p) was shown for some c > 0 and p (V = |ỹ|²/2).
    refuted: with exact values in the domain at which the linearisation has an eigenvalue with positive real part, or
    is affine and not asymptotically stable. undecided otherwise.
    """
    matrix = sp.Matrix(list(fast.rate)).jacobian(list(fast.state))
    moving = {symbol for entry in matrix for symbol in entry.free_symbols if not symbol.is_positive or symbol in states}
    constant = not moving and not any(entry.has(sp.Function) for entry in matrix) and _is_affine(matrix, fast)

    if constant and hurwitz(matrix):
        return Evidence(ENGINE, Verdict.PROVED, "linear with a constant matrix; the Routh-Hurwitz conditions hold")
    if (detail := _lyapunov(fast, steady, domain, states)) is not None:
        return Evidence(ENGINE, Verdict.PROVED, detail)
    if (found := _unstable(matrix, fast, steady, domain, affine=constant)) is not None:
        detail, witness = found
        return Evidence(ENGINE, Verdict.REFUTED, detail, witness=witness)
    detail = "no Lyapunov function was found, and no point at which it is unstable"
    return Evidence(ENGINE, Verdict.UNDECIDED, detail)


def _is_affine(matrix: sp.Matrix, fast: FastStates) -> bool:
    """Whether the rates are their Jacobian times z and a rest; of a jump the derivative alone does not say that."""
    linear = matrix * sp.Matrix(list(fast.state))
    rests = [sp.expand(rate - part) for rate, part in zip(fast.rate, linear, strict=True)]
    return not any(rest.free_symbols & set(fast.state) for rest in rests)


def routh_column(matrix: sp.Matrix) -> list[sp.Expr]:
    """The leading principal minors of the Hurwitz matrix of the characteristic polynomial, a_n = 1."""
    coefficients = [sp.cancel(entry) for entry in matrix.charpoly(sp.Dummy("s")).all_coeffs()]
    size = len(coefficients) - 1

    def entry(row: int, column: int) -> sp.Expr:
        index = 2 * (column + 1) - (row + 1)
        return coefficients[index] if 0 <= index <= size else sp.S.Zero

    hurwitz = sp.Matrix(size, size, entry)
    return [sp.factor(hurwitz[:k, :k].det()) for k in range(1, size + 1)]


def hurwitz(matrix: sp.Matrix) -> bool:
    """Whether all eigenvalues are shown to have negative real parts, for all values of the parameters."""
    return all(
        bool(minor.is_positive) or follows(Relation(sp.S.Zero, "<", minor), (), seconds=_SECONDS).shown
        for minor in routh_column(matrix)
    )


def _lyapunov(
    fast: FastStates, steady: Sequence[sp.Expr], domain: Sequence[Relation], states: Sequence[sp.Symbol]
) -> str | None:
    deviation = [sp.Dummy(f"y_{symbol.name}", real=True) for symbol in fast.state]
    moved = {z: y + value for z, y, value in zip(fast.state, deviation, steady, strict=True)}
    rates = [rate.subs(moved, simultaneous=True) for rate in fast.rate]
    product, back = masked_functions(sp.expand(sum(y * rate for y, rate in zip(deviation, rates, strict=True))))
    squared = sum(y**2 for y in deviation)
    constants = product.free_symbols - back.keys() - set(states)
    scales = [sp.S.One, *sorted((symbol for symbol in constants if symbol.is_positive), key=str)]
    end = time.perf_counter() + _BUDGET
    for power in (1, 2, 3):
        for scale, rate in itertools.product(scales, _RATES):
            if time.perf_counter() > end:
                return None
            bound = Relation(product, "<=", -rate * scale * squared**power)
            if follows(bound, domain, seconds=_SECONDS).shown:
                return f"V = |y|^2/2 decreases at least by {rate * scale}*|y|^{2 * power}, uniformly in the slow states"
    return None


def _unstable(
    matrix: sp.Matrix, fast: FastStates, steady: Sequence[sp.Expr], domain: Sequence[Relation], *, affine: bool
) -> tuple[str, Witness] | None:
    if any(node.free_symbols & set(fast.state) for rate in fast.rate for node in rate.atoms(*KINKS)):
        return None  # it may have no linearisation
    there = dict(zip(fast.state, steady, strict=True))
    entries = [entry.subs(there, simultaneous=True) for entry in (*matrix, *fast.rate)]
    within = [Substitution(there).relation(relation) for relation in domain if relation.free_symbols & set(fast.state)]
    sides = [side for relation in within for side in (relation.left, relation.right)]
    everything, back = masked_functions(sp.Tuple(*entries, *sides))
    local = sp.Matrix(matrix.rows, matrix.cols, everything[: len(matrix)]).applyfunc(sp.expand)
    rests, sides = everything[len(matrix) : len(entries)], iter(everything[len(entries) :])
    here = [*domain, *(Relation(next(sides), relation.sign, next(sides)) for relation in within)]
    for point in sample_points(everything.free_symbols, here, back):
        if not all(vanishes(rest.subs(point)) for rest in rests):
            continue
        numbers = local.subs(point)
        signs = {sign_of(minor) for minor in routh_column(numbers)}
        # A vanishing real part leaves a nonlinear boundary layer open.
        if None in signs or signs == {1} or (not affine and 0 in signs):
            continue
        names = {str(back.get(symbol, symbol)): str(value) for symbol, value in point.items()}
        eigenvalues = ", ".join(str(value) for value in numbers.eigenvals()) if numbers.rows <= 2 else str(numbers)
        detail = f"the boundary layer is not asymptotically stable: its linear part has the eigenvalues {eigenvalues}"
        return detail, Witness(names, eigenvalues, "negative real parts")
    return None
