"""Hints for norms in the plane: equal calls made the same, and Cauchy's inequality for each two norms."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation


def norms(
    relation: Relation, known: Iterable[Relation], names: Names
) -> tuple[Relation, list[Relation], list[str]] | None:
    """The relation and what is known with norms instead of their letters, and the lines by which Coq follows.

    Nothing where no two norms are multiplied.
    """
    given = list(known)
    meant = {item.left: item.right for item in given if item.sign == "=" and item.left.is_Symbol and _norm(item.right)}
    lines = [f"subst {names[symbol]}" for symbol in meant]

    def put_in(item: Relation) -> Relation:
        return item.map(lambda side: side.xreplace(meant))

    moved = [put_in(item) for item in (relation, *given) if item.left not in meant]
    calls = (item.left.atoms(AppliedUndef) | item.right.atoms(AppliedUndef) for item in moved)
    same = dict(_same(call for found in calls for call in sorted(found, key=sp.default_sort_key)))
    lines += [f"same_call {term(old, names)} {term(new, names)}" for old, new in same.items()]
    moved = [item.map(lambda side: side.xreplace(same)) for item in moved]
    goal, *others = moved
    pairs = [pair for side in (goal.left, goal.right) for product in side.atoms(sp.Mul)
             for pair in combinations([factor for factor in product.args if _norm(factor)], 2)]  # fmt: skip
    if not pairs:
        return None
    lines.append("without_squared_roots")
    for pair in dict.fromkeys(pairs):
        vectors = [part.base for norm in pair for part in norm.args[0].args]
        texts = " ".join(term(part, names) for part in vectors)
        lines += [f"pose proof (cauchy_schwarz {texts})", f"pose proof (cauchy_schwarz_below {texts})"]
    return goal, others, lines


def _norm(expression: sp.Basic) -> bool:
    """Whether the expression is the root of a sum of two squares."""
    if not (isinstance(expression, sp.Pow) and expression.exp == sp.Rational(1, 2) and expression.base.is_Add):
        return False
    parts = expression.base.args
    return len(parts) == 2 and all(isinstance(part, sp.Pow) and part.exp == 2 for part in parts)


def _same(calls: Iterable[AppliedUndef]) -> Iterator[tuple[AppliedUndef, AppliedUndef]]:
    """Each call that has the arguments of an earlier one in other words, with that one."""
    first: list[AppliedUndef] = []
    for call in dict.fromkeys(calls):
        for other in first:
            pairs = zip(call.args, other.args, strict=False)
            if call.func == other.func and all(sp.simplify(one - two) == 0 for one, two in pairs):
                yield call, other
                break
        else:
            first.append(call)
