"""Functions of one time that are given by an expression with poles or roots, where it is used away from these.

An undefined function stands for a smooth function of all real arguments. 1/√(1 + 4s) is none of all; but where it is
used for s ≥ 0 only there is one that agrees with it there: a function that is smooth in a neighbourhood of a closed set
can be continued from that set, and where it is positive there the continuation can be positive. So what is asked here
is that all arguments at which the function is taken lie in a closed set, and that the expression is smooth at each of
its points.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.claim import Goal
from ptproof.proof.declarations import declared, everywhere
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.reals import are_met, follows
from ptproof.proof.statement import Exists, ForAll, Prose, Relation, Runs, Smooth, eq, expressions_of, gt, lt
from ptproof.proof.substitution import BINDERS, NotOfKind, Substitution

_CATCHING = tuple(binder for binder in BINDERS if binder not in (sp.Derivative, sp.Lambda))
_SIGNED = {"positive": (gt,), "nonnegative": (gt,), "negative": (lt,), "nonpositive": (lt,), "nonzero": (gt, lt)}
_SECONDS = 2.0


def values_where_used(goal: Goal, values: Mapping[Any, Any]) -> Substitution:
    """Exact values put in, each function defined and smooth where the goal takes it, if not everywhere.

    Raises
    ------
    NotOfKind
        If a value is not known to be what its letter stands for.
    InputError
        If a function is not written as applied to distinct symbols.
    """
    try:
        return Substitution(values)
    except NotOfKind:
        partial = {letter: sp.sympify(value) for letter, value in values.items() if _is_partial(letter, value)}
        if not partial:
            raise
    numbers = {letter: value for letter, value in values.items() if isinstance(letter, sp.Symbol)}
    there = Substitution(values, elsewhere=frozenset(partial))
    for letter, value in partial.items():
        if reason := _unfit(goal, letter, value, numbers):
            raise NotOfKind(f"{value} is not known to be what {letter} stands for: {reason}")
    return there


def _is_partial(letter: Any, value: Any) -> bool:
    """Whether the value is one for a function of one argument, and not known to be defined for all of these."""
    if not isinstance(letter, AppliedUndef) or len(letter.args) != 1 or not isinstance(letter.args[0], sp.Symbol):
        return False
    return any(not need.settled for need in obligations(everywhere(letter, sp.sympify(value))))


def _unfit(goal: Goal, letter: AppliedUndef, value: sp.Expr, numbers: Mapping[Any, Any]) -> str:
    """Why the value does not serve for the function in this goal; empty if it does."""
    if not value.free_symbols <= set(letter.args) or value.has(*BINDERS, AppliedUndef):
        return "it has other letters than its argument, or is not written out"
    if isinstance(goal.statement, Prose | Smooth | Exists | Runs):
        return "nobody can tell where the statement takes it"
    place = sp.Dummy("place", real=True)
    there = value.xreplace({letter.args[0]: place})
    signs = []
    for used in _uses(goal, letter.func, numbers, place):
        if isinstance(used, str):
            return used
        needs = [need for need in obligations(there, moving={place}) if not need.settled]
        if not (answer := are_met(needs, used, seconds=_SECONDS)).shown:
            return answer.how
        signs.append({sign for sign in (gt, lt) if follows(sign(there, 0), used, seconds=_SECONDS).shown})
    return _of_another_kind(letter, signs)


def _of_another_kind(letter: AppliedUndef, signs: list[set[Any]]) -> str:
    """Why a function with these signs at the places where it is taken has no continuation of the declared kind."""
    asked = {word: truth for word, truth in declared(letter).items() if word != "real"}
    for word, truth in asked.items():
        if truth is not True or word not in _SIGNED:
            return f"it may not be {word} everywhere"
        # Where it is 0 a continuation may have to change its sign; and it may not be positive here and negative there.
        if not any(all(sign in found for found in signs) for sign in _SIGNED[word]):
            return f"it is not shown to be {word} and other than 0 where it is taken"
    return ""


def _uses(goal: Goal, function: Any, numbers: Mapping[Any, Any], place: sp.Symbol) -> Iterator[list[Relation] | str]:
    """For each argument at which the function is taken what is known of ``place`` there; a text where nothing is."""
    put_in = Substitution(numbers)
    for item in (goal.statement, *goal.assumptions):
        assert not isinstance(item, Prose | Smooth | Exists | Runs)
        variables = item.variables if isinstance(item, ForAll) else ()
        domain = [*_closed(put_in.quantified(item))] if isinstance(item, ForAll) else []
        letters = {variable: sp.Dummy(variable.name, real=True) for variable in variables}
        for expression in expressions_of([item]):
            if _is_caught(expression, function):
                yield f"it is taken where a variable is bound: {expression}"
            for node in sorted(expression.atoms(AppliedUndef), key=str):
                if node.func != function:
                    continue
                if node.args[0].has(AppliedUndef, *BINDERS):
                    yield f"it is taken at {node.args[0]}"
                    continue
                inside = {letter: number for letter, number in numbers.items() if letter not in variables}
                argument = Substitution(inside).into(node.args[0])
                if not _affine(argument, variables):
                    yield f"the values of {argument} may not be closed"
                    continue
                known = [
                    Relation(part.left.xreplace(letters), part.sign, part.right.xreplace(letters)) for part in domain
                ]
                yield [*known, eq(place, argument.xreplace(letters))]


def _closed(item: ForAll) -> Iterator[Relation]:
    """Relations that hold on the closure of the domain of an assumption: of those that are linear, with equality."""
    for part in item.domain:
        if _affine(part.left, item.variables) and _affine(part.right, item.variables) and part.sign != "!=":
            yield Relation(part.left, {"<": "<=", ">": ">="}.get(part.sign, part.sign), part.right)  # type: ignore[arg-type]


def _affine(expression: sp.Expr, variables: tuple[sp.Symbol, ...]) -> bool:
    """Whether it is linear in the variables, with numbers, and has no other letters."""
    polynomial = expression.as_poly(*variables) if variables and expression.has(*variables) else None
    if polynomial is not None:
        return polynomial.total_degree() <= 1 and all(number.is_real for number in polynomial.coeffs())
    return not expression.free_symbols and bool(expression.is_real)


def _is_caught(expression: sp.Expr, function: Any) -> bool:
    """Whether the function is taken at what a limit, an integral or the like gives its value."""
    if expression.has(sp.Lambda):
        return True
    for node in expression.atoms(*_CATCHING):
        bound = {node.args[1]} if isinstance(node, sp.Limit) else set(node.bound_symbols)
        if any(inner.func == function and inner.free_symbols & bound for inner in node.args[0].atoms(AppliedUndef)):
            return True
    return False
