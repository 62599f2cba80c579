"""Values put in for letters, and concrete functions for undefined ones, with derivatives carried out."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.tree import BINDERS


def concretely(expression: sp.Expr, functions: Mapping[Any, Concrete]) -> sp.Expr:
    """The expression with these functions put in, and derivatives carried out."""
    inside = {node.func for node in expression.atoms(AppliedUndef)}.union(*(one.inside for one in functions.values()))
    return _put_in(expression, tuple((function, one) for function, one in functions.items() if function in inside))


@lru_cache(maxsize=2048)
def _put_in(expression: sp.Expr, functions: tuple[tuple[Any, Concrete], ...]) -> sp.Expr:
    found = _Putting(dict(functions)).into(expression)
    return found.doit(integrals=False, limits=False) if found.has(sp.Subs, sp.Sum, sp.Product) else found


class _Putting:
    """What becomes of expressions; a function whose own body it is in is left there as it stands."""

    def __init__(self, functions: Mapping[Any, Concrete]) -> None:
        self.functions = functions
        self.known: dict[Any, Any] = {}
        self.bodies: dict[Any, sp.Expr] = {}

    def into(self, expression: Any) -> Any:
        if not expression.args:
            return expression
        found = self.known.get(expression)
        if found is None:
            found = self.known[expression] = self._into(expression)
        return found

    def _into(self, expression: Any) -> Any:
        if isinstance(expression, sp.Derivative):
            return self._derivative(expression)
        if isinstance(expression, sp.Subs):
            inner, letters, values = expression.args
            return put(self.into(inner), dict(zip(letters, map(self.into, values), strict=True)))
        args = tuple(map(self.into, expression.args))
        if isinstance(expression, AppliedUndef) and expression.func in self.functions:
            places = self.functions[expression.func].arguments
            return put(self._body(expression.func), dict(zip(places, args, strict=True)))
        return expression if args == expression.args else expression.func(*args)

    def _body(self, function: Any) -> sp.Expr:
        if function not in self.bodies:
            others = {other: one for other, one in self.functions.items() if other != function}
            self.bodies[function] = _Putting(others).into(self.functions[function].body)
        return self.bodies[function]

    def _derivative(self, expression: sp.Derivative) -> sp.Expr:
        """Taken first, and only then what a function is worth is put in for one by which it is taken."""
        inner, counts, values = expression.expr, [], {}
        for variable, count in expression.variable_count:
            value = self.into(variable)
            if value != variable:
                letter = sp.Dummy("moving", real=True)
                inner, variable, values[letter] = inner.xreplace({variable: letter}), letter, value
            counts.append((variable, count))
        return put(_derived(self.into(inner), tuple(counts)), values)


@lru_cache(maxsize=2048)
def _derived(expression: sp.Expr, counts: tuple[tuple[Any, Any], ...]) -> sp.Expr:
    return sp.diff(expression, *counts)


def put(expression: sp.Expr, values: Mapping[Any, Any]) -> sp.Expr:
    """The expression with values in place of letters and applied functions, all at once."""
    return _put(expression, tuple(values.items())) if values else expression


@lru_cache(maxsize=4096)
def _put(expression: sp.Expr, values: tuple[tuple[Any, Any], ...]) -> sp.Expr:
    if expression.has(*BINDERS):
        return expression.subs(dict(values), simultaneous=True)
    return expression.xreplace(dict(values))
