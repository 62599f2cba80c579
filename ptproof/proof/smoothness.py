"""Smoothness by structure: compositions of smooth functions, with the places examined where that is not enough."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ptproof.proof.glued import glued_smoothly
from ptproof.proof.reals import follows
from ptproof.proof.singular import find_singularity
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "smoothness"
_ENTIRE = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh, sp.tanh, sp.atan, sp.asinh, sp.erf)
_SECONDS = 3.0


@dataclass(frozen=True)
class _Need:
    """``relation`` must hold on the whole domain for ``node`` to be smooth; None where nothing would help."""

    node: sp.Basic
    relation: Relation | None


def smoothness(
    expression: sp.Expr,
    variables: Sequence[sp.Symbol],
    order: int,
    assumed: Mapping[Any, Any] | None = None,
    domain: Sequence[Relation] = (),
) -> Evidence:
    """Whether ``expression`` is ``order`` times continuously differentiable in ``variables``, jointly.

    Parameters
    ----------
    expression
        One real expression; symbols that are no variables are parameters within their own assumptions.
    variables
        Real symbols, each ranging over all of R, or over what ``domain`` leaves of it.
    order
        0, 1, 2, …
    assumed
        Undefined function (applied or not) → how often it is continuously differentiable in all its arguments
        (an integer or ``sympy.oo``). A function that is missing leads to "undecided".
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
    >>> print(smoothness(sp.Abs(x) ** 3, [x], 2).verdict)
    proved
    """
    start = time.perf_counter()
    orders = {_key(function): value for function, value in (assumed or {}).items()}
    needs = list(dict.fromkeys(_needs(sp.sympify(expression), frozenset(variables), order, orders)))
    shown, left = [], []
    for need in needs:
        if need.relation is not None and _holds(need.relation, domain):
            shown.append(str(need.relation))
        else:
            left.append(need)
    if not left:
        detail = f"C^{order}: a composition of smooth functions"
        if shown:
            detail += f", with {', '.join(shown)} on the whole domain"
        return Evidence(ENGINE, Verdict.PROVED, detail, time.perf_counter() - start)
    places = frozenset(variables)
    terms = sp.Add.make_args(sp.sympify(expression))
    if all(
        _is_smooth(term, places, order, orders, domain) or _is_glued(term, places, order, orders, domain)
        for term in terms
    ):
        detail = f"C^{order}: smooth pieces whose difference vanishes to order {order} where they meet"
        return Evidence(ENGINE, Verdict.PROVED, detail, time.perf_counter() - start)
    found = find_singularity(expression, variables, order, [need.node for need in left], domain)
    seconds = time.perf_counter() - start
    if found is not None:
        reason, witness = found
        return Evidence(ENGINE, Verdict.REFUTED, f"not C^{order}: {reason}", seconds, witness)
    remaining = "; ".join(
        f"{need.node}" + (f" needs {need.relation}" if need.relation is not None else "") for need in left
    )
    return Evidence(ENGINE, Verdict.UNDECIDED, f"C^{order} not shown, it rests on {remaining}", seconds)


def _is_smooth(
    expression: sp.Expr,
    variables: frozenset[sp.Symbol],
    order: int,
    orders: Mapping[str, Any],
    domain: Sequence[Relation],
) -> bool:
    return all(
        need.relation is not None and _holds(need.relation, domain)
        for need in _needs(expression, variables, order, orders)
    )


def _is_glued(
    term: sp.Expr,
    variables: frozenset[sp.Symbol],
    order: int,
    orders: Mapping[str, Any],
    domain: Sequence[Relation],
) -> bool:
    return glued_smoothly(term, variables, order, lambda entry: _is_smooth(entry, variables, order, orders, domain))


def _key(function: Any) -> str:
    """Functions are matched by name: SymPy makes a new class for the same name with other assumptions."""
    if isinstance(function, AppliedUndef):
        return str(function.func)
    return str(function)


def _needs(node: sp.Basic, variables: frozenset[sp.Symbol], order: int, orders: Mapping[str, Any]) -> Iterator[_Need]:
    if not node.free_symbols & variables or node.is_Symbol:
        return
    match node:
        case sp.Pow():
            yield from _power(node, variables, order, orders)
            return
        case sp.Derivative():
            inner, count = node.expr, sum(number for _, number in node.variable_count)
            if isinstance(inner, AppliedUndef) and orders.get(str(inner.func), -1) >= order + count:
                return
            yield _Need(node, None)
            return
        case sp.Subs():
            yield from _needs(node.expr, frozenset(node.variables), order, orders)
            for point in node.point:
                yield from _needs(point, variables, order, orders)
            return
        case sp.Piecewise():
            yield from _piecewise(node, variables, order, orders)
            return
        case AppliedUndef() if orders.get(str(node.func), -1) < order:
            yield _Need(node, None)
    for argument in node.args:
        yield from _needs(argument, variables, order, orders)
    if order > 0 or not isinstance(node, sp.Abs | sp.Max | sp.Min):
        yield from _own_needs(node)


def _own_needs(node: sp.Basic) -> Iterator[_Need]:
    """What ``node`` itself needs, its arguments being smooth."""
    if node.is_Add or node.is_Mul or isinstance(node, (*_ENTIRE, AppliedUndef)):
        return
    zero = sp.S.Zero
    match node:
        case sp.Abs() | sp.sign() | sp.Heaviside():
            yield _Need(node, Relation(node.args[0], "!=", zero))
        case sp.Max() | sp.Min():
            for i, first in enumerate(node.args):
                for second in node.args[i + 1 :]:
                    yield _Need(node, Relation(first - second, "!=", zero))
        case sp.log():
            yield _Need(node, Relation(zero, "<", node.args[0]))
        case sp.tan() | sp.sec():
            yield _Need(node, Relation(sp.cos(node.args[0]), "!=", zero))
        case sp.asin() | sp.acos():
            yield _Need(node, Relation(node.args[0] ** 2, "<", sp.S.One))
        case sp.atan2():
            yield _Need(node, Relation(zero, "<", node.args[1]))
        case _:
            yield _Need(node, None)


def _power(node: sp.Pow, variables: frozenset[sp.Symbol], order: int, orders: Mapping[str, Any]) -> Iterator[_Need]:
    base, exponent = node.base, node.exp
    zero = sp.S.Zero
    yield from _needs(exponent, variables, order, orders)
    if exponent.is_integer and exponent.is_nonnegative:
        if isinstance(base, sp.Abs) and exponent > order:  # |h|^p is C^k for p > k
            yield from _needs(base.args[0], variables, order, orders)
        else:
            yield from _needs(base, variables, order, orders)
        return
    if isinstance(base, sp.Abs) and exponent.is_Rational and exponent > order:
        yield from _needs(base.args[0], variables, order, orders)
        return
    if base is sp.E:
        return
    yield from _needs(base, variables, order, orders)
    if exponent.is_integer:
        yield _Need(node, Relation(base, "!=", zero))
    elif order <= 2 and exponent.is_Rational and 2 * exponent > order:
        # g ≥ 0 with |∇g|² ≤ C g near its zeros: g^q is C^1 for q > 1/2 and C^2 for q > 1.
        yield from _needs(base, variables, max(order, 2), orders)
        yield _Need(node, Relation(zero, "<=", base))
    else:
        yield _Need(node, Relation(zero, "<", base))


def _piecewise(
    node: sp.Piecewise, variables: frozenset[sp.Symbol], order: int, orders: Mapping[str, Any]
) -> Iterator[_Need]:
    for value, condition in node.args:
        yield from _needs(value, variables, order, orders)
        for relation in condition.atoms(Relational):
            difference = relation.lhs - relation.rhs
            if difference.free_symbols & variables:
                yield from _needs(difference, variables, 0, orders)
                yield _Need(node, Relation(difference, "!=", sp.S.Zero))


def _holds(relation: Relation, domain: Sequence[Relation]) -> bool:
    difference = relation.left - relation.right
    by_assumptions = {
        "!=": difference.is_nonzero,
        "<": difference.is_negative,
        "<=": difference.is_nonpositive,
    }[relation.sign]
    return bool(by_assumptions) or follows(relation, list(domain), seconds=_SECONDS)[0]
