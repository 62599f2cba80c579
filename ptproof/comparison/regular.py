"""Regularity from the start on: a solution on one side of a pole or a jump says nothing about the other side."""

from __future__ import annotations

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.reals import are_met


def check_regular(expression: sp.Expr, time: sp.Symbol, start: sp.Expr, what: str) -> None:
    """Raise unless ``expression`` is shown to be continuously differentiable for all times from ``start`` on.

    Exact algebra alone does not see a jump or a kink: for SymPy the derivative of a jump is 0.
    """
    elapsed = sp.Dummy("elapsed", nonnegative=True)
    there = sp.sympify(expression).subs(time, start + elapsed)
    found = are_met(list(obligations(there, moving=[elapsed])), (), seconds=2.0)
    if not found.shown:
        raise InputError(
            f"comparison: {what} {expression} is not shown to be without jump, kink or pole from {time} = {start} on: "
            f"{found.how}"
        )
