"""A point of the attacker in words that others can use: exact SymPy values and expressions for functions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.proof.attack.preparation import Prepared
from ptproof.proof.attack.putting import concretely, put
from ptproof.proof.attack.sampling import Point


def exact_values(ready: Prepared, point: Point) -> dict[Any, Any]:
    """Each symbol with its exact value, and each undefined function, applied to letters, with an expression in them."""
    known: dict[Any, sp.Expr] = {
        atom.expression: sp.Rational(int(value.p), int(value.q)) for atom, value in point.values.items()
    }
    for atom, body in point.defined:
        known[atom.expression] = _with(body.expression, known, point)
    values = {atom: known[atom] for atom in ready.atoms if atom.is_Symbol and atom in known}
    for function, concrete in point.by_function.items():
        letters = tuple(sp.Symbol(f"s{i + 1}", real=True) for i in range(len(concrete.arguments)))
        body = concrete.body.xreplace(dict(zip(concrete.arguments, letters, strict=True)))
        values[function(*letters)] = _with(body, known, point)
    values.update(_pinned(ready, known, point))
    return values


def _with(expression: sp.Expr, known: Mapping[Any, sp.Expr], point: Point) -> sp.Expr:
    return put(concretely(expression, point.by_function), dict(known))


def _pinned(ready: Prepared, known: Mapping[Any, sp.Expr], point: Point) -> dict[Any, sp.Expr]:
    """One polynomial through all values that a function was given, of its kind."""
    pins: dict[Any, dict[tuple[sp.Expr, ...], sp.Expr]] = {}
    for atom in ready.atoms:
        if not atom.is_Symbol and atom in known:
            place = tuple(_with(argument, known, point) for argument in atom.args)
            pins.setdefault(atom.func, {})[place] = known[atom]
    found = {}
    for function, values in pins.items():
        letters = tuple(sp.Symbol(f"s{i + 1}", real=True) for i in range(len(next(iter(values)))))
        found[function(*letters)] = _through(function(*letters), letters, values)
    return found


def _through(applied: Any, letters: tuple[sp.Symbol, ...], values: Mapping[tuple[sp.Expr, ...], sp.Expr]) -> sp.Expr:
    """Lagrange's polynomial; its square, or minus that, where the function has a sign."""
    signed = applied.is_nonnegative or applied.is_nonpositive
    total: sp.Expr = sp.S.Zero
    others: sp.Expr = sp.S.One
    for place, value in values.items():
        weight: sp.Expr = sp.sqrt(abs(value)) if signed else value
        for other in values:
            if other == place:
                continue
            apart = [(letter, a, b) for letter, a, b in zip(letters, place, other, strict=True) if a != b]
            letter, a, b = apart[0]
            weight *= (letter - b) / (a - b)
        total += weight
        others *= sum((letter - a) ** 2 for letter, a in zip(letters, place, strict=True))
    if not signed:
        return total
    square = total**2 + (others if applied.is_nonzero or applied.is_positive or applied.is_negative else 0)
    return square if applied.is_nonnegative else -square
