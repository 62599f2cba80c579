"""Products of what is not negative that add up to a polynomial: found by linear programming, and only a hint."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.proof.statement import Relation

_MOST = 4000


@dataclass(frozen=True)
class Fact:
    """A numerator that is not negative (positive, where strict), and the denominator that was above it."""

    top: sp.Expr
    relation_bottom: sp.Expr
    strict: bool


@dataclass(frozen=True)
class Sum:
    facts: tuple[Fact, ...]
    products: tuple[tuple[sp.Expr, ...], ...]


def products(rational: sp.Expr, strict: bool, known: Sequence[Relation]) -> Sum | None:
    """Products whose sum, with factors that are not negative, is the numerator of ``rational``; None if none is found."""
    top, bottom = sp.fraction(rational)
    facts = [fact for relation in known for fact in _facts(relation)]
    generators = sorted(
        {s for e in (top, *(f.top for f in facts)) for s in e.free_symbols}, key=lambda s: (s.name, str(s))
    )
    if not generators or len(generators) > 24:
        return None
    signed = [s for s in generators if s.is_nonnegative]
    try:
        target = sp.Poly(top, *generators)
        tops = [sp.Poly(fact.top, *generators) for fact in facts]
    except sp.PolynomialError:
        return None
    if not target.domain.is_QQ and not target.domain.is_ZZ:
        return None
    one = sp.Poly(1, *generators)
    bases: list[tuple[tuple[sp.Expr, ...], sp.Poly, bool]] = [((), one, True)]
    bases += [((fact.top,), poly, fact.strict) for fact, poly in zip(facts, tops, strict=True)]
    for (a, p), (b, q) in itertools.combinations_with_replacement(list(zip(facts, tops, strict=True)), 2):
        bases.append(((a.top, b.top), p * q, a.strict and b.strict))
    for a, b in itertools.combinations([s for s in generators], 2):
        bases.append((((a - b) ** 2,), sp.Poly((a - b) ** 2, *generators), False))
    for a in generators:
        if a not in signed:
            bases.append(((a**2,), sp.Poly(a**2, *generators), False))
    degrees = [max((m[i] for m in target.monoms()), default=0) for i in range(len(generators))]
    total = target.total_degree()
    candidates: list[tuple[tuple[sp.Expr, ...], sp.Poly, bool]] = []
    for factors, poly, positive in bases:
        room = total - poly.total_degree()
        free = [max(0, degrees[i] - min(m[i] for m in poly.monoms())) if s in signed else 0 for i, s in enumerate(generators)]
        for powers in _monomials(free, room):
            monomial = sp.Poly({powers: 1}, *generators)
            expressions = tuple(s for s, n in zip(generators, powers, strict=True) for _ in range(n))
            candidates.append(((*expressions, *factors), monomial * poly, positive and all(s.is_positive for s in expressions)))
            if len(candidates) > _MOST:
                return None
    chosen = _combination(target, candidates, strict)
    if chosen is None:
        return None
    used = [candidates[i][0] for i in chosen]
    needed = tuple(f for f in facts if any(f.top in factors for factors in used))
    return Sum(needed, tuple(factors for factors in used if factors))


def _facts(relation: Relation) -> list[Fact]:
    gap = sp.together(relation.right - relation.left)
    top, bottom = sp.fraction(gap)
    top = sp.expand(top)
    if not top.free_symbols or top.is_nonnegative and top.is_Symbol:
        return []
    if relation.sign == "=":
        return [Fact(top, bottom, False), Fact(-top, bottom, False)]
    return [Fact(top, bottom, relation.sign == "<")]


def _monomials(most: Sequence[int], room: int):
    if room < 0:
        return
    stack = [((), room)]
    for i, limit in enumerate(most):
        stack = [((*powers, n), left - n) for powers, left in stack for n in range(min(limit, left) + 1)]
        if len(stack) > _MOST:
            return
    for powers, _ in stack:
        yield powers


def _combination(target: sp.Poly, candidates, strict: bool):
    import numpy as np
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix

    rows: dict[tuple[int, ...], int] = {}
    entries: list[tuple[int, int, float]] = []
    for column, (_, poly, _) in enumerate(candidates):
        for monomial, value in poly.terms():
            entries.append((rows.setdefault(monomial, len(rows)), column, float(value)))
    right = {m: float(v) for m, v in target.terms()}
    if any(m not in rows for m in right):
        return None
    vector = np.zeros(len(rows))
    for m, v in right.items():
        vector[rows[m]] = v
    matrix = coo_matrix(([e[2] for e in entries], ([e[0] for e in entries], [e[1] for e in entries])), shape=(len(rows), len(candidates)))
    cost = np.array([1.0 + len(c[0]) for c in candidates])
    done = linprog(cost, A_eq=matrix.tocsr(), b_eq=vector, bounds=(0, None), method="highs", options={"time_limit": 5})
    if done.status != 0:
        return None
    return [i for i, value in enumerate(done.x) if value > 1e-9]
