"""Cauchy's inequality without roots: products of vectors whose squared lengths are bounded."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, as_factors
from ptproof.proof.statement import Relation

Vector = tuple[sp.Expr, sp.Expr]


def with_products(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with bounds of the products of such vectors, and the lines for them."""
    lines, goal = _squared(goal)
    bounds: list[Relation] = []
    for vector, other, factor, line in [*_by_multiples(goal), *_by_lengths(goal)]:
        length = factor * (other[0] ** 2 + other[1] ** 2) if line == "dots" else factor
        for x, y in (other, other[::-1]):
            product = vector[0] * x + vector[1] * y
            bounds += [Relation(product, "<=", length), Relation(-product, "<=", length)]
            words = " ".join(map(goal.text, (*vector, x, y)))
            lines.append(f"try ({line} {words}{f' {goal.text(factor)}' if line == 'dots' else ''})")
    return lines, goal.with_known(*bounds)


def _squared(goal: Goal) -> tuple[list[str], Goal]:
    """Bounds of roots as bounds of their squares."""
    lines: list[str] = []
    facts: list[Relation] = []
    for item in (fact.standard() for fact in goal.known):
        if item.sign in ("<=", "<") and _is_root(item.left) and item.right.is_nonnegative:
            squares = sp.expand_power_base(item.left**2), sp.expand_power_base(item.right**2)
            facts.append(Relation(squares[0], "<=", squares[1]))
            lines.append(f"try (squares_of {' '.join(map(goal.text, (item.left, item.right, *squares)))})")
    return lines, goal.with_known(*facts)


def _is_root(expression: sp.Expr) -> bool:
    return isinstance(expression, sp.Pow) and expression.exp == sp.Rational(1, 2)


def _by_multiples(goal: Goal) -> Iterator[tuple[Vector, Vector, sp.Expr, str]]:
    """From p^2 + q^2 <= c^2 (x^2 + y^2), with c >= 0."""
    for item in (fact.standard() for fact in goal.known):
        vector = _vector(item.left)
        if vector is None or item.sign == "!=":
            continue
        factors = sp.Mul.make_args(item.right)
        for part in factors:
            root = _root(item.right / part)
            if (other := _vector(part)) is not None and root is not None:
                yield vector, other, root, "dots"


def _by_lengths(goal: Goal) -> Iterator[tuple[Vector, Vector, sp.Expr, str]]:
    """From p^2 + q^2 <= c^2 and x^2 + y^2 <= d^2, with c, d >= 0."""
    found: list[tuple[Vector, sp.Expr]] = []
    for item in (fact.standard() for fact in goal.known):
        for left, right in ((item.left, item.right), *([(item.right, item.left)] if item.sign == "=" else [])):
            vector, root = _vector(left), _root(right)
            if vector is not None and root is not None and item.sign != "!=":
                found.append((vector, root))
    for (vector, first), (other, second) in combinations(found, 2):
        yield vector, other, first * second, f"dots_by_lengths {goal.text(first)} {goal.text(second)}"


def _vector(expression: sp.Expr) -> Vector | None:
    """The two whose squares add up to the expression."""
    parts = sp.Add.make_args(expression)
    if len(parts) != 2 or not all(isinstance(part, sp.Pow) and part.exp == 2 for part in parts):
        return None
    return parts[0].base, parts[1].base


def _root(expression: sp.Expr) -> sp.Expr | None:
    """What is not negative and has the expression as its square."""
    root = sp.sqrt(as_factors(expression))
    return root if root.is_nonnegative and not any(not p.exp.is_Integer for p in root.atoms(sp.Pow)) else None
