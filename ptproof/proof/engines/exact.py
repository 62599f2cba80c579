"""Equalities by exact algebra: the difference of the two sides has the normal form 0."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Goal, engine
from ptproof.proof.statement import relations_of
from ptproof.proof.verdict import Evidence, Verdict

_BINDERS = (sp.Derivative, sp.Integral, sp.Limit, sp.Subs, sp.Sum, sp.Product)


@engine
def exact(goal: Goal) -> Evidence:
    """Show every equality of the goal; an assumption ``symbol = expression`` is substituted first."""
    given = definitions_in(goal)
    for part in relations_of(goal.statement):
        if part.sign != "=":
            return Evidence("exact algebra", Verdict.UNDECIDED, f"not an equality: {part}")
        try:
            shown = is_zero(resolve(part.left - part.right, given))
            reason = "the difference does not have the normal form 0"
        except NotAlgebraic as error:
            shown, reason = False, str(error)
        if not shown:
            return Evidence("exact algebra", Verdict.UNDECIDED, f"{part}: {reason}")
    detail = "the difference of the two sides has the normal form 0"
    return Evidence("exact algebra", Verdict.PROVED, detail)


def definitions_in(goal: Goal) -> dict[sp.Expr, sp.Expr]:
    """The assumptions of the form symbol = expression, or applied function = expression, as replacements."""
    found: dict[sp.Expr, sp.Expr] = {}
    for relation in goal.relations:
        if relation.sign == "=" and (relation.left.is_Symbol or relation.left.is_Function):
            found.setdefault(relation.left, relation.right)
    return found


def resolve(expression: sp.Expr, given: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    """Replace until nothing changes; a circle of definitions is left as it is after as many rounds as there are.

    An assumption says that two values agree, not two functions: inside a derivative, an integral or a limit only
    symbols are replaced, and only by what does not depend on the bound variables.
    """
    for _ in range(len(given) + 1):
        replaced = _replaced(expression, given)
        if replaced == expression:
            break
        expression = replaced
    return expression


def _replaced(expression: sp.Expr, given: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    masks: dict[sp.Expr, sp.Expr] = {}
    traversal = sp.preorder_traversal(expression)
    for node in traversal:
        if isinstance(node, _BINDERS):
            masks[node] = sp.Dummy("bound", real=True)
            traversal.skip()
    outside = expression.xreplace(masks).xreplace(dict(given))
    return outside.xreplace({mask: _replaced_inside(node, given) for node, mask in masks.items()})


def _replaced_inside(node: sp.Expr, given: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    bound = {symbol for binder in node.atoms(*_BINDERS) for symbol in _bound(binder)}
    constant = {
        symbol: value for symbol, value in given.items()
        if symbol.is_Symbol and not bound & {symbol, *value.free_symbols}
    }  # fmt: skip
    return node.xreplace(constant)


def _bound(binder: sp.Basic) -> set[sp.Symbol]:
    if isinstance(binder, sp.Derivative):
        return set(binder.variables)
    if isinstance(binder, sp.Limit):
        return {binder.args[1]}
    return set(binder.bound_symbols)
