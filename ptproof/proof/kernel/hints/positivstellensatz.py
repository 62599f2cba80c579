"""Products of polynomials with known signs whose sum is 0 although it is positive: found by linear programming.

What is found is a hint: floating-point numbers say which products matter, and nothing more.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.proof.statement import RelationSign

_MOST_COLUMNS = 6000
_MOST_ROWS = 6000
_ROUNDS = 3
SECONDS = 8.0
_SECONDS_A_PROGRAM = 3.0
_WEIGHTS = (1, -1, 2, -2, sp.Rational(1, 2), -sp.Rational(1, 2))
Powers = tuple[int, ...]
Polynomial = dict[Powers, float]


@dataclass(frozen=True)
class Sign:
    """What is known of a polynomial: that it is > 0, >= 0 or = 0."""

    polynomial: sp.Expr
    sign: RelationSign


@dataclass(frozen=True)
class Product:
    """Symbols, some of them more than once, times polynomials with known signs."""

    symbols: tuple[sp.Symbol, ...]
    factors: tuple[Sign, ...]

    @property
    def sign(self) -> RelationSign:
        """The sign that the product has."""
        signs = [factor.sign for factor in self.factors]
        if "=" in signs:
            return "="
        # Symbols without a sign stand there an even number of times.
        strict = all(sign == ">" for sign in signs) and all(symbol.is_nonzero for symbol in self.symbols)
        return ">" if strict else ">="


@dataclass(frozen=True)
class _Base:
    factors: tuple[Sign, ...]
    polynomial: Polynomial


def contradiction(known: Sequence[Sign], denied: Sign, seconds: float = SECONDS) -> tuple[Product, ...] | None:
    """Products by which what is ``known``, and what is ``denied``, cannot hold together, if they are found in time.

    A symbol with a declared sign may stand in a product. A sum of the products with positive weights (of any sign
    where they are 0) vanishes, and one of them is positive.
    """
    every = [denied, *known]
    symbols = sorted(set().union(*(item.polynomial.free_symbols for item in every)), key=lambda s: s.name)
    if not symbols:
        return None
    bases = list(_bases(every, symbols))
    until = time.thread_time() + seconds
    given = set(every)
    alone = [base for base in bases if len(base.factors) < 2]
    pairs = [base for base in bases if len(base.factors) < 3 and given.issuperset(base.factors)]
    for start, some in itertools.product(_starts(bases[1].polynomial, bases, symbols), (alone, pairs, bases)):
        if (found := _from(start, some, symbols, until)) is not None:
            return found
    return None


def _from(
    start: set[Powers], bases: Sequence[_Base], symbols: Sequence[sp.Symbol], until: float
) -> tuple[Product, ...] | None:  # fmt: skip
    """Products in which the monomials of the start cancel, and then those that come in with them."""
    rows, seen = set(start), dict[tuple[int, Powers], None]()
    for _ in range(_ROUNDS):
        before = len(seen)
        for key in _matching(rows, bases, symbols):
            seen.setdefault(key)
            if len(seen) > _MOST_COLUMNS or time.thread_time() > until:
                return None
        if len(seen) == before:
            return None
        columns = [_shifted(bases[number].polynomial, powers) for number, powers in seen]
        rows = {powers for column in columns for powers in column}
        if len(rows) > _MOST_ROWS:
            return None
        products = [_product(bases[number], powers, symbols) for number, powers in seen]
        if (chosen := _vanishing(columns, products)) is not None:
            return chosen
    return None


def _starts(goal: Polynomial, bases: Sequence[_Base], symbols: Sequence[sp.Symbol]) -> Iterator[set[Powers]]:
    """The monomials that have to cancel: those of what is denied; times what makes them ones of what is known."""
    own = set(goal)
    yield own
    multipliers = {
        powers
        for base in bases if len(base.factors) == 1
        for row in base.polynomial
        for powers in (tuple(r - o for r, o in zip(row, other, strict=True)) for other in own)
        if _is_nonnegative(powers, symbols)
    }  # fmt: skip
    yield {_plus(row, powers) for row in own for powers in multipliers} | own
    yield {_plus(one, other) for one in own for other in own}
    # What has no sign has to cancel: the least common multiple of two monomials in which it stands.
    open_ = [number for number, symbol in enumerate(symbols) if not symbol.is_nonnegative]
    multipliers = {
        powers
        for base in bases if len(base.factors) == 1
        for row in base.polynomial
        for other in own if any(row[number] and row[number] == other[number] for number in open_)
        for powers in (tuple(max(r, o) - o for r, o in zip(row, other, strict=True)),)
        if _is_nonnegative(powers, symbols)
    }  # fmt: skip
    yield {_plus(row, powers) for row in own for powers in multipliers} | own


def _is_nonnegative(powers: Powers, symbols: Sequence[sp.Symbol]) -> bool:
    """Whether the powers are whole, and their product is not negative by the declared signs."""
    return min(powers, default=0) >= 0 and all(
        power % 2 == 0 or symbol.is_nonnegative for symbol, power in zip(symbols, powers, strict=True)
    )


def _bases(every: Sequence[Sign], symbols: Sequence[sp.Symbol]) -> Iterator[_Base]:
    """Alone, in pairs, and in threes where they are few; 1 is the first, then what is denied."""
    single = [_Base((item,), _polynomial(item.polynomial, symbols)) for item in every]
    yield _Base((), {(0,) * len(symbols): 1.0})
    yield from single
    unequal = [base for base in single if base.factors[0].sign != "="]
    for count in (2, 3) if len(unequal) <= 7 else (2,):
        for chosen in itertools.combinations_with_replacement(unequal, count):
            product: Polynomial = {(0,) * len(symbols): 1.0}
            for base in chosen:
                product = _times(product, base.polynomial)
            if len(product) <= 60:
                yield _Base(tuple(base.factors[0] for base in chosen), product)
    rows = set().union(*(base.polynomial for base in single))
    for one, other in dict.fromkeys(pair for base in single for row in base.polynomial for pair in _halves(row, rows)):
        first, second = (sp.Mul(*(s**n for s, n in zip(symbols, powers, strict=True))) for powers in (one, other))
        for weight in _WEIGHTS:
            gap = first - weight * second
            yield _Base((Sign(gap**2, ">="),), _polynomial(sp.expand(gap**2), symbols))


def _halves(row: Powers, rows: set[Powers]) -> Iterator[tuple[Powers, Powers]]:
    """Two monomials whose product is this one; the square of the first is among the others."""
    for square in rows:
        if all(power % 2 == 0 for power in square):
            half = tuple(power // 2 for power in square)
            other = tuple(r - h for r, h in zip(row, half, strict=True))
            if min(other) >= 0 and half != other:
                yield half, other


def _matching(rows: set[Powers], bases: Sequence[_Base], symbols: Sequence[sp.Symbol]) -> Iterator[tuple[int, Powers]]:
    """Multiples of a base in which one of the ``rows`` occurs, by powers that are known not to be negative."""
    for number, base in enumerate(bases):
        free = base.factors and base.factors[0].sign == "="
        for own in base.polynomial:
            for row in rows:
                powers = tuple(r - o for r, o in zip(row, own, strict=True))
                if _is_nonnegative(powers, symbols) or (free and min(powers) >= 0):
                    yield number, powers


def _product(base: _Base, powers: Powers, symbols: Sequence[sp.Symbol]) -> Product:
    return Product(
        tuple(symbol for symbol, power in zip(symbols, powers, strict=True) for _ in range(power)), base.factors
    )


def _vanishing(columns: Sequence[Polynomial], found: Sequence[Product]) -> tuple[Product, ...] | None:
    """Those of the products whose weighted sum vanishes, some of them positive; the least of them by their factors."""
    import numpy as np
    from scipy.optimize import linprog
    from scipy.sparse import csr_matrix, hstack

    rows: dict[Powers, int] = {}
    entries = [(rows.setdefault(powers, len(rows)), number, value)
               for number, column in enumerate(columns) for powers, value in column.items()]  # fmt: skip
    total = len(rows)
    entries += [(total, number, 1.0) for number, product in enumerate(found) if product.sign == ">"]
    if entries[-1][0] != total:
        return None
    matrix: Any = csr_matrix(
        ([e[2] for e in entries], ([e[0] for e in entries], [e[1] for e in entries])), (total + 1, len(columns))
    )
    vector = np.zeros(total + 1)
    vector[total] = 1.0
    # A product that is 0 may be taken away: its two signs are columns of their own.
    turned = [number for number, product in enumerate(found) if product.sign == "="]
    whole = hstack([matrix, -matrix[:, turned]]).tocsr() if turned else matrix
    cost = [1.0 + 4 * len(item.factors) ** 2 + 0.1 * len(item.symbols) for item in found]
    cost += [cost[number] for number in turned]
    options = {"time_limit": _SECONDS_A_PROGRAM}
    done = linprog(cost, A_eq=whole, b_eq=vector, bounds=(0, None), method="highs", options=options)
    if done.status != 0:
        return None
    weights = np.abs(done.x[: len(found)])
    weights[turned] += np.abs(done.x[len(found) :])
    return tuple(item for item, weight in zip(found, weights, strict=True) if weight > 1e-9 * weights.max())


def _polynomial(expression: sp.Expr, symbols: Sequence[sp.Symbol]) -> Polynomial:
    return {powers: float(value) for powers, value in sp.Poly(expression, *symbols).terms()}


def _plus(one: Powers, other: Powers) -> Powers:
    return tuple(a + b for a, b in zip(one, other, strict=True))


def _shifted(polynomial: Polynomial, powers: Powers) -> Polynomial:
    return {_plus(own, powers): value for own, value in polynomial.items()}


def _times(one: Polynomial, other: Polynomial) -> Polynomial:
    product: Polynomial = {}
    for m, v in one.items():
        for n, w in other.items():
            key = _plus(m, n)
            product[key] = product.get(key, 0.0) + v * w
    return {key: value for key, value in product.items() if value}
