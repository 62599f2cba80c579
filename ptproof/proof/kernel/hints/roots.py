"""Square roots out of a goal: a number as the square of its root, and a sum with a root by the squares of its parts."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, as_factors
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation


def squared_symbols(goal: Goal) -> tuple[list[str], Goal]:
    """Every symbol below a root becomes a square, or a number times a square where the number's root stands by it."""
    roots = [root for root in goal.atoms(sp.Pow) if abs(root.exp) == sp.Rational(1, 2)]
    numbers = sorted({root.base for root in roots if root.base.is_Integer})
    lines: list[str] = [f"keeps_root {number}" for number in numbers]
    symbols = dict.fromkeys(root.base for root in roots if root.base.is_Symbol and root.base.is_nonnegative)
    for symbol in symbols:
        name = fresh("r_" + goal.names[symbol], goal.names)
        known = any(item.standard() == Relation(sp.Integer(0), "<", symbol) for item in goal.known)
        kind = "positive" if symbol.is_positive or known else "nonnegative"
        root = sp.Symbol(name, **{kind: True})
        number = next((n for n in numbers if _together(goal, symbol, n)), None)
        old = goal.names[symbol]
        lines.append(f"as_square {old} {name}" if number is None else f"as_multiple {number} {old} {name}")
        square = root**2 if number is None else number * root**2
        names = {**goal.names, root: name}
        goal = goal.replaced(symbol, square, names)
    return (lines if symbols else []), goal


def _together(goal: Goal, symbol: sp.Symbol, number: sp.Integer) -> bool:
    pair = {sp.sqrt(symbol), sp.sqrt(number)}
    return any(pair <= set(part.args) for part in goal.atoms(sp.Mul))


def dominated(goal: Goal) -> Iterator[tuple[str, Goal]]:
    """P + Q >= 0 by P >= 0 and Q^2 <= P^2, where the difference falls into two parts by the roots in them."""
    relation = goal.relation.standard()
    if relation.sign not in ("<", "<="):
        return
    gap = relation.right - relation.left
    roots = sorted({part for part in gap.atoms(sp.Pow) if part.exp == sp.Rational(1, 2)}, key=sp.default_sort_key)
    if not roots:
        return
    stands = {root: sp.Dummy() for root in roots}
    groups: dict[sp.Expr, sp.Expr] = {}
    plain = sp.expand(gap.xreplace(stands))
    if not plain.is_polynomial(*stands.values()):
        return
    for powers, value in sp.Poly(plain, *stands.values()).terms():
        key = sp.prod(root ** (power % 2) for root, power in zip(roots, powers, strict=True))
        even = sp.prod(root.base ** (power // 2) for root, power in zip(roots, powers, strict=True))
        groups[key] = groups.get(key, sp.Integer(0)) + value * even
    if len(groups) != 2:
        return
    parts = [(key * sp.factor(value), sp.factor(value) ** 2 * key**2) for key, value in groups.items()]
    for (first, above), (second, below) in (parts, reversed(parts)):
        if first.is_nonpositive or first.could_extract_minus_sign():
            continue
        line = f"dominated_by {' '.join(map(goal.text, (first, second, above, below)))}"
        yield line, Goal(Relation(below, relation.sign, above), goal.known, goal.names)


def roots_of_facts(goal: Goal) -> tuple[list[str], Goal]:
    """From p^2 <= q^2 with q >= 0 follows -q <= p <= q."""
    lines: list[str] = []
    for relation in goal.known:
        small, large = (_root(side) for side in (relation.standard().left, relation.standard().right))
        if relation.sign in ("=", "!=") or small is None or large is None or not large.is_nonnegative:
            continue
        lines.append(f"try (roots_of {goal.text(small)} {goal.text(large)})")
        goal = goal.with_known(
            Relation(small, relation.standard().sign, large), Relation(-large, relation.standard().sign, small)
        )
    return lines, goal


def _root(side: sp.Expr) -> sp.Expr | None:
    if not side.free_symbols:
        return None
    found = sp.sqrt(as_factors(side))
    found = found.replace(sp.Abs, lambda inner: inner)
    return found if not found.atoms(sp.Pow) or all(power.exp.is_Integer for power in found.atoms(sp.Pow)) else None
