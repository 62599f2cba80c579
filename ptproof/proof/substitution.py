"""Values put in the place of symbols and undefined functions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.proof.statement import Relation
from ptproof.system import differentiated

_BINDERS = (sp.Derivative, sp.Integral, sp.Limit, sp.Subs, sp.Sum, sp.Product, sp.Lambda)


def substitute_in(relation: Relation, values: Mapping[Any, Any]) -> Relation:
    """Replace symbols and undefined functions in both sides, without carrying out limits or integrals."""
    symbols = {key: sp.sympify(value) for key, value in values.items() if isinstance(key, sp.Symbol)}
    functions = {key: value for key, value in values.items() if not isinstance(key, sp.Symbol)}

    def change(expression: sp.Expr) -> sp.Expr:
        for applied, value in functions.items():
            expression = expression.replace(applied.func, sp.Lambda(applied.args, value))
        if functions:
            expression = differentiated(expression)
        if expression.has(*_BINDERS):
            return expression.subs(symbols, simultaneous=True)
        # All at once, from the leaves up: a Min or Max is then compared once, between its final arguments.
        return expression.xreplace(symbols)

    return relation.map(change)
