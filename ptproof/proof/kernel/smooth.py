"""Smoothness for Coq: Fréchet's derivatives, near the point that the variables name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import declared
from ptproof.proof.kernel.declared import bare, for_all
from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.obligations import Part, obligations
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Smooth

_POINT = "p"
_SMOOTH, _NEAR = "smooth_at", "locally"
# Kinds of arguments that make an open set: on them a function is smooth in the ordinary sense.
_OPEN = {"positive", "negative", "nonzero"}


def symbols(statement: Smooth) -> set[sp.Symbol]:
    """The symbols of what is assumed: they stand for any arguments."""
    return {symbol for call, _ in statement.assumed for symbol in call.free_symbols}


def conclusions(statement: Smooth, names: Names) -> list[Part]:
    """Each expression is defined near the point of its variables, and so often continuously differentiable there.

    That is more than smoothness on a domain with a boundary: the expression itself goes on beyond it.

    Raises
    ------
    NoTranslation
        As :func:`ptproof.proof.kernel.terms.term`, and for variables of which two are called alike.
    """
    parts = list(dict.fromkeys(part for item in statement.expressions for part in obligations(item, names)))
    variables = [names[variable] for variable in statement.variables]
    near = [Part(f"{_NEAR} {_tuple(variables)} {_function(part.text, variables, names)}") for part in parts]
    said = [_smooth(term(item, names), variables, statement.order, names) for item in statement.expressions]
    return [*parts, *near, *map(Part, said)]


def premises(statement: Smooth, functions: Iterable[sp.Basic], names: Names) -> list[Part]:
    """What the statement assumes of the undefined functions in it, for all arguments of their kind."""
    found = []
    wanted = set(functions)
    for call, order in statement.assumed:
        if call.func not in wanted:
            continue
        if not bare(call) or any(_kinds(symbol) - _OPEN for symbol in call.args):
            raise NoTranslation(f"no translation for the smoothness of {call}")
        found.append(Part(_assumed(call, order, names)))
    return found


def of_derivatives(derivatives: Iterable[sp.Derivative], names: Names) -> list[Part]:
    """That functions below these derivatives are smooth, if of several arguments or only of others than plain symbols.

    A claim that says nothing of smoothness is about smooth functions of real arguments; a function that can be
    differentiated by each argument alone is not one, and has no derivative along a curve.
    """
    calls = [(call, len(item.variables)) for item in derivatives for call in item.expr.atoms(AppliedUndef)]
    known = {call.func for call, _ in calls if bare(call) and len(call.args) == 1}
    orders: dict[tuple[Any, int], int] = {}
    for call, order in calls:
        if call.func not in known:
            key = call.func, len(call.args)
            orders[key] = max(orders.get(key, 0), order)
    found = []
    for (function, count), order in sorted(orders.items(), key=lambda item: names[item[0][0]]):
        variables = [fresh(f"q{number}", names) for number in range(1, count + 1)]
        text = f"({names[function]} {' '.join(variables)})"
        found.append(Part(f"(forall {' '.join(variables)} : R, {_smooth(text, variables, order, names)})"))
    return found


def script(part: Part, known: Sequence[str]) -> str:
    """The tactic for one conclusion about smoothness; empty for any other. ``known`` are lines that show facts."""
    if part.relation is not None or not part.text.startswith((_SMOOTH, _NEAR)):
        return ""
    tactic = "smoothly" if part.text.startswith(_SMOOTH) else "near_smoothly"
    return "; ".join([*known, f"try (solve [ {tactic} ])", "leaf_or_say"])


def _kinds(symbol: sp.Symbol) -> set[str]:
    """What the symbol is declared to be, beside real."""
    return {word for word, truth in declared(symbol).items() if truth} - {"real", "finite"}


def _assumed(call: AppliedUndef, order: int, names: Names) -> str:
    return for_all(call.args, _smooth(term(call, names), [names[symbol] for symbol in call.args], order, names), names)


def _smooth(text: str, variables: Sequence[str], order: int, names: Names) -> str:
    return f"{_SMOOTH} {order} {_function(text, variables, names)} {_tuple(variables)}"


def _tuple(variables: Sequence[str]) -> str:
    return f"({', '.join(variables)})"


def _function(text: str, variables: Sequence[str], names: Names) -> str:
    """The text as a function of a point whose coordinates the variables are."""
    if len(set(variables)) != len(variables):
        raise NoTranslation("no translation for smoothness in these variables")
    point = fresh(_POINT, names)
    kind = " * ".join("R" for _ in variables)
    coordinates = [point]
    for _ in variables[1:]:
        coordinates = [f"(fst {coordinates[0]})", f"(snd {coordinates[0]})", *coordinates[1:]]
    return f"(fun {point} : {kind} => (fun {' '.join(variables)} : R => {text}) {' '.join(coordinates)})"
