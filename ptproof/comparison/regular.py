"""Continuity from the start on: without it a solution on one side of a pole or a jump says nothing about the other."""

from __future__ import annotations

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.engines.evaluation import continuous


def check_continuous(expression: sp.Expr, time: sp.Symbol, start: sp.Expr, what: str) -> None:
    """Raise unless its structure shows that ``expression`` is continuous for all times from ``start`` on."""
    elapsed = sp.Dummy("elapsed", nonnegative=True)
    inside = expression.subs(time, start + elapsed)
    # The exponential integral is continuous where its argument is positive.
    inside = inside.replace(
        lambda node: isinstance(node, sp.Ei) and bool(sp.factor(node.args[0]).is_positive), lambda node: node.args[0]
    )
    if not continuous(inside, elapsed):
        raise InputError(f"comparison: {what} {expression} is not shown to be continuous from {time} = {start} on")
