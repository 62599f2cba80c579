"""Products of what is not negative that add up to a polynomial: found by linear programming, and only a hint."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.proof.statement import Relation

_MOST = 4000
_SECONDS = 2.0
Polynomial = dict[tuple[int, ...], float]


@dataclass(frozen=True)
class Fact:
    """A numerator that is not negative (positive, where strict), and the positive denominator that was below it."""

    top: sp.Expr
    bottom: sp.Expr
    strict: bool


@dataclass(frozen=True)
class Sum:
    """``factor`` times the polynomial is a sum of ``products`` with weights that are not negative, of these facts."""

    factor: sp.Expr
    facts: tuple[Fact, ...]
    products: tuple[tuple[sp.Expr, ...], ...]


@dataclass(frozen=True)
class _Candidate:
    factors: tuple[sp.Expr, ...]
    polynomial: Polynomial


def products(top: sp.Expr, known: Sequence[Relation], *, squares: bool = False) -> Sum | None:
    """Products whose sum is ``top``, or a positive symbol times it; None if few products do not do.

    With ``squares`` the facts are multiplied by even powers of variables without a sign, too, but not by each other.
    """
    facts = list(dict.fromkeys(fact for relation in known for fact in _facts(relation)))
    symbols = top.free_symbols
    for _ in range(2):
        symbols = symbols.union(*(fact.top.free_symbols for fact in facts if fact.top.free_symbols & symbols))
    generators = sorted(symbols, key=lambda s: s.name)
    facts = [fact for fact in facts if fact.top.free_symbols <= symbols]
    if not generators or len(generators) > 16:
        return None
    target = _polynomial(top, generators)
    tops = [_polynomial(fact.top, generators) for fact in facts]
    bases = [base for base in _bases(facts, tops, generators) if not squares or len(base[0]) < 2]
    ones = [(sp.Integer(1), 0), (sp.Integer(1), 1)]
    for factor, extra in [*ones, *((s, 0) for s in generators if s.is_positive and s not in top.free_symbols)]:
        scaled = _times(target, _polynomial(factor, generators))
        candidates = _candidates(scaled, bases, generators, extra, squares)
        chosen = _combination(scaled, candidates)
        if chosen:
            needed = tuple(fact for fact in facts if any(fact.top in item.factors for item in chosen))
            return Sum(factor, needed, tuple(item.factors for item in chosen if item.factors))
    return None


def _facts(relation: Relation) -> list[Fact]:
    top, bottom = sp.fraction(sp.together(relation.right - relation.left))
    top = sp.expand(top)
    if not top.free_symbols or (top.is_nonnegative and top.is_Symbol):
        return []
    if relation.sign == "=":
        return [Fact(top, bottom, False), Fact(sp.expand(-top), bottom, False)]
    return [Fact(top, bottom, relation.sign == "<")]


def _polynomial(expression: sp.Expr, generators: Sequence[sp.Symbol]) -> Polynomial:
    return {monomial: float(value) for monomial, value in sp.Poly(expression, *generators).terms()}


def _times(a: Polynomial, b: Polynomial) -> Polynomial:
    product: Polynomial = {}
    for m, v in a.items():
        for n, w in b.items():
            key = tuple(map(sum, zip(m, n, strict=True)))
            product[key] = product.get(key, 0.0) + v * w
    return product


def _bases(
    facts: Sequence[Fact], tops: Sequence[Polynomial], generators: Sequence[sp.Symbol]
) -> Iterator[tuple[tuple[sp.Expr, ...], Polynomial]]:
    yield (), {(0,) * len(generators): 1.0}
    pairs = list(zip(facts, tops, strict=True))
    for fact, poly in pairs:
        yield (fact.top,), poly
    for (a, p), (b, q) in itertools.combinations_with_replacement(pairs, 2):
        yield (a.top, b.top), _times(p, q)
    for first, second in itertools.combinations(generators, 2):
        yield ((first - second) ** 2,), _polynomial((first - second) ** 2, generators)
    for symbol in generators:
        if not symbol.is_nonnegative:
            yield (symbol**2,), _polynomial(symbol**2, generators)


def _candidates(
    target: Polynomial,
    bases: Sequence[tuple[tuple[sp.Expr, ...], Polynomial]],
    generators: Sequence[sp.Symbol],
    extra: int,
    squares: bool,
) -> list[_Candidate]:
    """The bases times monomials of what is not negative, of no higher degree than the target, and a little more."""
    single = [target, *(poly for factors, poly in bases if len(factors) == 1)]
    degrees = [max((m[i] for poly in single for m in poly), default=0) + extra for i in range(len(generators))]
    total = max(map(sum, target), default=0) + extra
    found: list[_Candidate] = []
    for factors, poly in bases:
        free = [
            degrees[i] - max(m[i] for m in poly) if squares or s.is_nonnegative else 0 for i, s in enumerate(generators)
        ]
        for powers in _monomials(free, total - max(map(sum, poly))):
            if any(n % 2 for s, n in zip(generators, powers, strict=True) if not s.is_nonnegative):
                continue
            symbols = tuple(s for s, n in zip(generators, powers, strict=True) for _ in range(n))
            shifted = {tuple(map(sum, zip(m, powers, strict=True))): v for m, v in poly.items()}
            found.append(_Candidate((*symbols, *factors), shifted))
            if len(found) > _MOST:
                return found
    return found


def _monomials(most: Sequence[int], room: int) -> Iterator[tuple[int, ...]]:
    if room < 0:
        return
    stack: list[tuple[tuple[int, ...], int]] = [((), room)]
    for limit in most:
        stack = [((*powers, n), left - n) for powers, left in stack for n in range(min(max(limit, 0), left) + 1)]
        if len(stack) > _MOST:
            return
    for powers, _ in stack:
        yield powers


def _combination(target: Polynomial, candidates: Sequence[_Candidate]) -> list[_Candidate]:
    import numpy as np
    from scipy.optimize import linprog
    from scipy.sparse import csr_matrix

    rows: dict[tuple[int, ...], int] = {}
    entries = [(rows.setdefault(m, len(rows)), column, value) for column, item in enumerate(candidates)
               for m, value in item.polynomial.items()]  # fmt: skip
    if any(m not in rows for m in target):
        return []
    vector = np.zeros(len(rows))
    for monomial, value in target.items():
        vector[rows[monomial]] = value
    matrix: Any = csr_matrix(
        ([e[2] for e in entries], ([e[0] for e in entries], [e[1] for e in entries])), (len(rows), len(candidates))
    )
    cost = [1.0 + len(item.factors) for item in candidates]
    done = linprog(cost, A_eq=matrix, b_eq=vector, bounds=(0, None), method="highs", options={"time_limit": _SECONDS})
    return [item for item, weight in zip(candidates, done.x, strict=True) if weight > 1e-9] if done.status == 0 else []
