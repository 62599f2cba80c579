"""Smoothness by structure: compositions of smooth functions, with the places examined where that is not enough."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, engine
from ptproof.proof.declarations import is_continuum
from ptproof.proof.engines.singular import find_singularity
from ptproof.proof.engines.structure import Examiner, Known, Need
from ptproof.proof.statement import Relation, Smooth
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "smoothness"


@engine
def smooth(goal: Goal) -> Evidence:
    """Show that all expressions of the goal are as smooth as it says, on the domain that its assumptions leave."""
    statement = goal.statement
    if not isinstance(statement, Smooth):
        return Evidence(ENGINE, Verdict.UNDECIDED, f"not a statement about smoothness: {statement}")
    quantified = [item for item in goal.assumptions if not isinstance(item, Relation)]
    details = []
    for expression in statement.expressions:
        found = smoothness(expression, statement.variables, statement.order, dict(statement.assumed), goal.relations)
        if found.verdict is Verdict.REFUTED and quantified:
            detail = f"{found.detail}, if that is compatible with {' and '.join(map(str, quantified))}"
            return replace(found, verdict=Verdict.UNDECIDED, detail=detail, witness=None)
        if found.verdict is not Verdict.PROVED:
            return found
        details.append(found.detail)
    return Evidence(ENGINE, Verdict.PROVED, "; ".join(dict.fromkeys(details)))


def smoothness(
    expression: sp.Expr,
    variables: Sequence[sp.Symbol],
    order: int,
    assumed: Mapping[Any, Any] | None = None,
    domain: Sequence[Relation] = (),
) -> Evidence:
    """Whether ``expression`` is real and ``order`` times continuously differentiable in ``variables``, jointly.

    On a domain that is not open it means: each point of the domain has a neighbourhood with a C^order function that
    agrees, on the domain, with the expression (:mod:`ptproof.proof.engines.structure`).

    Parameters
    ----------
    expression
        One real expression; symbols that are no variables are parameters within their own assumptions.
    variables
        Real symbols, each ranging over what it is declared to be, or over what ``domain`` leaves of it.
    order
        0, 1, 2, …; anything else raises an InputError.
    assumed
        Undefined function, as applied to symbols or by itself → how often it is continuously differentiable in all
        its arguments (an integer or ``sympy.oo``), for arguments of the kind that its symbols are declared to be. A
        function that is missing, or that differs in its number of arguments or in what it is declared to be, leads
        to "undecided".
    domain
        Relations that restrict the variables, such as a box or ``tau >= 0``.

    Returns
    -------
    Evidence
        proved: every node is a composition of smooth functions, and each denominator, root, logarithm, absolute
        value, … was shown to stay away from where it is not smooth, or to be smooth enough there. refuted: with
        an exact point at which a derivative jumps, or near which the expression is unbounded or not real.
        undecided: with the places that are left.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> print(smoothness(sp.sqrt(1 + x**2), [x], 2).verdict, smoothness(x * sp.Abs(x), [x], 2).verdict)
    proved refuted
    """
    expression, order = sp.sympify(expression), _order(order)
    if unsuitable := [symbol for symbol in variables if not is_continuum(symbol)]:
        names = ", ".join(map(str, unsuitable))
        return Evidence(ENGINE, Verdict.UNDECIDED, f"not declared as real variables: {names}")
    known = tuple(Known.of(function, value) for function, value in (assumed or {}).items())
    examiner = Examiner(frozenset(variables), known, tuple(domain))
    shown: list[Need] = []
    left: list[Need] = []
    for need in dict.fromkeys(examiner.needs(expression, order)):
        (shown if examiner.holds(need) else left).append(need)
    if not left:
        return Evidence(ENGINE, Verdict.PROVED, _told(order, examiner.glued, [str(n.relation) for n in shown]))
    found = find_singularity(expression, variables, order, [need.node for need in left], domain)
    if found is not None:
        reason, witness = found
        return Evidence(ENGINE, Verdict.REFUTED, f"not C^{order}: {reason}", witness=witness)
    return Evidence(ENGINE, Verdict.UNDECIDED, f"C^{order} not shown, it rests on {'; '.join(map(str, left))}")


def _order(order: Any) -> int:
    number = sp.sympify(order)
    if not (number.is_Integer and number >= 0):
        raise InputError(f"the order of differentiability must be one of 0, 1, 2, ..., not {order}")
    return int(number)


def _told(order: int, glued: Iterable[sp.Expr], shown: Iterable[str]) -> str:
    detail = f"C^{order}: a composition of smooth functions"
    if names := ", ".join(dict.fromkeys(map(str, glued))):
        detail += f", {names} glued to order {order}"
    if relations := ", ".join(dict.fromkeys(shown)):
        detail += f", with {relations} on the whole domain"
    return detail
