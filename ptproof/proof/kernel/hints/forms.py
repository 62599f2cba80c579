"""Differences that are forms of degree two in two variables, with what makes them positive known."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal


def by_form(goal: Goal) -> Iterator[str]:
    """The difference as a x^2 + 2 b x y + c y^2 with a > 0 and a c > b^2, where these are facts or plain."""
    relation = goal.relation.standard()
    if relation.sign not in ("<", "<="):
        return
    for form in forms(sp.expand(relation.right - relation.left)):
        yield f"form_of {' '.join(map(goal.text, form))}"


def forms(gap: sp.Expr) -> Iterator[tuple[sp.Expr, ...]]:
    """a, b, c, x and y, where the gap is a x^2 + 2 b x y + c y^2 and the signs of x and y are open."""
    free = sorted((s for s in gap.free_symbols if s.is_nonnegative is None), key=lambda s: s.name)
    for x, y in itertools.combinations(free, 2):
        if not gap.is_polynomial(x, y):
            continue
        form = sp.Poly(gap, x, y)
        if {sum(powers) for powers in form.monoms()} == {2} and len(form.monoms()) == 3:
            a, b, c = form.coeff_monomial(x**2), form.coeff_monomial(x * y) / 2, form.coeff_monomial(y**2)
            if not (a.free_symbols | b.free_symbols | c.free_symbols) & {x, y}:
                yield a, sp.expand(b), c, x, y
