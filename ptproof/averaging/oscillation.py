"""Systems with one fast phase, slow states and stable linear fast states, as series in δ = 1/√ω."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.refusal import AveragingRefused
from ptproof.errors import InputError
from ptproof.system import check_names

DELTA = sp.Symbol("delta", positive=True)


@dataclass(frozen=True)
class Oscillation:
    """dx/dσ = Σ δ^j f_j, dφ/dσ = 1 + Σ δ^j p_j (j ≥ 1), dy/dσ = A y + Σ δ^j h_j (j ≥ 0): what is averaged to any order.

    Attributes
    ----------
    phase, period
        φ and the period in φ of everything.
    slow
        n states x; the slow time τ is one of them, with the rate δ², where something depends on it.
    rates
        f_1, f_2, …: n expressions each, periodic in φ, polynomial in y.
    fast
        q states y, or none.
    matrix
        A (q × q), free of states and phase, with eigenvalues of negative real part (whoever makes it sees to that).
    forcing
        h_0, h_1, …: q expressions each; h_0 is free of y.
    turning
        p_1, p_2, …; none where the phase is a function of time alone.
    meaning
        {y: what it is in the letters of the system that this was made from}.
    whole
        The rates of x, φ and y exactly, in terms of ``DELTA``, where the series above are cut off; else empty.
    """

    phase: sp.Symbol
    period: sp.Expr
    slow: tuple[sp.Symbol, ...]
    rates: tuple[Vector, ...]
    fast: tuple[sp.Symbol, ...] = ()
    matrix: sp.ImmutableDenseMatrix = field(default_factory=lambda: sp.ImmutableDenseMatrix(0, 0, []))
    forcing: tuple[Vector, ...] = ()
    turning: tuple[sp.Expr, ...] = ()
    meaning: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    whole: Vector = ()
    name: str = "oscillation"

    def __post_init__(self) -> None:
        states = (self.phase, *self.slow, *self.fast)
        if len(set(states)) != len(states):
            raise InputError(f"{self.name}: phase, slow and fast states must be distinct symbols")
        for what, vectors, count in (("rates", self.rates, len(self.slow)), ("forcing", self.forcing, len(self.fast))):
            if any(len(vector) != count for vector in vectors):
                raise InputError(f"{self.name}: {what} with another number of entries than the {count} states")
        if self.matrix.shape != (len(self.fast), len(self.fast)):
            raise InputError(f"{self.name}: a matrix of shape {self.matrix.shape} for {len(self.fast)} fast states")
        if self.matrix.free_symbols & set(states):
            raise InputError(f"{self.name}: the matrix of the fast states depends on a state or the phase")
        if self.forcing and any(entry.free_symbols & set(self.fast) for entry in self.forcing[0]):
            raise InputError(
                f"{self.name}: the forcing at order 0 contains a fast state, which belongs into the matrix"
            )
        entries = [entry for vectors in (self.rates, self.forcing) for vector in vectors for entry in vector]
        others = set().union(*(entry.free_symbols for entry in (*entries, *self.turning))) - set(states)
        check_names((*states, *sorted(others, key=lambda symbol: symbol.name)), self.name)

    @property
    def states(self) -> tuple[sp.Symbol, ...]:
        """Slow states, phase, fast states."""
        return *self.slow, self.phase, *self.fast

    @property
    def right_hand_side(self) -> Vector:
        """The rates of ``states``, exactly, in terms of ``DELTA``."""
        if self.whole:
            return self.whole

        def series(terms: Sequence[sp.Expr], first: int) -> sp.Expr:
            return sp.Add(*(entry * DELTA**power for power, entry in enumerate(terms, start=first)))

        slow = (series(terms, 1) for terms in zip(*self.rates, strict=True))
        forced = zip(*self.forcing, strict=True) if self.forcing else [()] * len(self.fast)
        linear = self.matrix * sp.Matrix(self.fast) if self.fast else ()
        fast = (own + series(terms, 0) for own, terms in zip(linear, forced, strict=True))
        return *slow, 1 + series(self.turning, 1), *fast


def in_delta(oscillation: Oscillation, order: int) -> Oscillation:
    """The same with its series in δ, up to ``order``, taken from ``whole``, which goes where they are the whole.

    Raises
    ------
    AveragingRefused
        If a slow state moves at order 1, the phase not at the rate 1, or a fast state not as its matrix says.
    """
    n, q = len(oscillation.slow), len(oscillation.fast)
    coefficients = [_taylor(entry, order, oscillation.name) for entry in oscillation.whole]
    slow, (turn, *_), fast = coefficients[:n], coefficients[n : n + 1], coefficients[n + 1 :]
    for symbol, terms in zip(oscillation.slow, slow, strict=True):
        if terms[0] != 0:
            raise AveragingRefused("form", f"d{symbol}/dsigma", f"it has the term {terms[0]} of order omega^0")
    if turn[0] != 1:
        raise AveragingRefused("form", f"d{oscillation.phase}/dsigma", f"its leading term is {turn[0]}, not 1")
    linear = oscillation.matrix * sp.Matrix(oscillation.fast) if q else []
    forcing = [[sp.expand(terms[0] - own), *terms[1:]] for terms, own in zip(fast, linear, strict=True)]
    found = replace(
        oscillation,
        rates=tuple(tuple(terms[power] for terms in slow) for power in range(1, order + 1)),
        turning=tuple(turn[1:]) if any(turn[1:]) else (),
        forcing=tuple(tuple(terms[power] for terms in forcing) for power in range(order + 1)) if q else (),
        whole=(),
    )
    left = (a - b for a, b in zip(oscillation.whole, found.right_hand_side, strict=True))
    return found if all(sp.expand(entry) == 0 for entry in left) else replace(found, whole=oscillation.whole)


def _taylor(entry: sp.Expr, order: int, where: str) -> list[sp.Expr]:
    """The coefficients of δ^0 … δ^order at δ = 0."""
    found: list[sp.Expr] = [sp.S.Zero] * (order + 1)
    for term in sp.Add.make_args(spread(entry)):
        factor, rest = term.as_independent(DELTA, as_Add=False)
        power, inside = _power_of_delta(rest)
        if power < 0:
            raise AveragingRefused("form", where, f"{term} grows with the frequency by more than this expansion allows")
        for k in range(order - power + 1):
            value = inside.subs(DELTA, 0).doit()
            found[power + k] += factor * value / sp.factorial(k)
            inside = sp.diff(inside, DELTA)
            if inside == 0:
                break
    return found


def spread(entry: sp.Expr) -> sp.Expr:
    """Expanded, but as it is inside of functions that are free of δ."""
    kinds = (sp.Function, sp.Derivative, sp.Subs)
    nodes = [node for node in entry.atoms(*kinds) if DELTA not in node.free_symbols]
    masks = {node: sp.Dummy() for node in nodes}
    return sp.expand(entry.xreplace(masks)).xreplace({mask: node for node, mask in masks.items()})


def _power_of_delta(rest: sp.Expr) -> tuple[int, sp.Expr]:
    power, inside = 0, []
    for factor in sp.Mul.make_args(rest):
        base, exponent = factor.as_base_exp()
        if base == DELTA and exponent.is_Integer:
            power += int(exponent)
        else:
            inside.append(factor)
    return power, sp.Mul(*inside)
