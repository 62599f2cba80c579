"""Smoothness by structure: compositions of smooth functions, with the places examined where that is not enough."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.glued import glued_smoothly
from ptproof.proof.engines.reals import follows
from ptproof.proof.engines.singular import find_singularity
from ptproof.proof.kinks import KINKS, switching
from ptproof.proof.statement import Relation, Smooth
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "smoothness"
_ENTIRE = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh, sp.tanh, sp.atan, sp.asinh, sp.erf)
_SECONDS = 3.0


@dataclass(frozen=True)
class _Need:
    """``relation`` must hold on the whole domain for ``node`` to be smooth; None where nothing would help."""

    node: sp.Basic
    relation: Relation | None

    def __str__(self) -> str:
        return str(self.node) if self.relation is None else f"{self.node} needs {self.relation}"


@engine
def smooth(goal: Goal) -> Evidence:
    """Show that all expressions of the goal are as smooth as it says, on the domain that its assumptions leave."""
    statement = goal.statement
    if not isinstance(statement, Smooth):
        return Evidence(ENGINE, Verdict.UNDECIDED, f"not a statement about smoothness: {statement}")
    details = []
    for expression in statement.expressions:
        found = smoothness(expression, statement.variables, statement.order, dict(statement.assumed), goal.relations)
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
    orders = {_key(function): value for function, value in (assumed or {}).items()}
    examiner = _Examiner(frozenset(variables), orders, tuple(domain))
    shown, left = [], []
    for need in dict.fromkeys(examiner.needs(sp.sympify(expression), order)):
        if need.relation is not None and _holds(need.relation, domain):
            shown.append(str(need.relation))
        else:
            left.append(need)
    if not left:
        detail = f"C^{order}: a composition of smooth functions"
        if examiner.glued:
            detail += f", {', '.join(map(str, examiner.glued))} glued to order {order}"
        if shown:
            detail += f", with {', '.join(shown)} on the whole domain"
        return Evidence(ENGINE, Verdict.PROVED, detail)
    found = find_singularity(expression, variables, order, [need.node for need in left], domain)
    if found is not None:
        reason, witness = found
        return Evidence(ENGINE, Verdict.REFUTED, f"not C^{order}: {reason}", witness=witness)
    return Evidence(ENGINE, Verdict.UNDECIDED, f"C^{order} not shown, it rests on {'; '.join(map(str, left))}")


def _key(function: Any) -> str:
    """Functions are matched by name: SymPy makes a new class for the same name with other assumptions."""
    if isinstance(function, AppliedUndef):
        return str(function.func)
    return str(function)


class _Examiner:
    """Walks through an expression and collects what has to hold for it to be smooth."""

    def __init__(
        self, variables: frozenset[sp.Symbol], orders: Mapping[str, Any], domain: tuple[Relation, ...]
    ) -> None:
        self.variables, self.orders, self.domain = variables, orders, domain
        self.glued: list[sp.Expr] = []

    def needs(self, node: sp.Basic, order: int, *, glue: bool = True) -> Iterator[_Need]:
        if not node.free_symbols & self.variables or node.is_Symbol:
            return
        if glue and not node.is_Add and node.has(*KINKS) and self.is_glued(node, order):
            self.glued.append(node)
            return
        match node:
            case sp.Pow():
                yield from self.power(node, order, glue)
                return
            case sp.Derivative():
                inner, count = node.expr, sum(number for _, number in node.variable_count)
                if not (isinstance(inner, AppliedUndef) and self.order_of(inner) >= order + count):
                    yield _Need(node, None)
                    return
                node = inner
            case sp.Subs():
                inside = _Examiner(frozenset(node.variables), self.orders, ())
                yield from inside.needs(node.expr, order)
                for point in node.point:
                    yield from self.needs(point, order, glue=glue)
                return
            case sp.Piecewise():
                yield from self.piecewise(node, order, glue)
                return
            case AppliedUndef() if self.order_of(node) < order:
                yield _Need(node, None)
        for argument in node.args:
            yield from self.needs(argument, order, glue=glue)
        if order > 0 or not isinstance(node, sp.Abs | sp.Max | sp.Min):
            yield from _own_needs(node)

    def order_of(self, applied: AppliedUndef) -> Any:
        return self.orders.get(str(applied.func), -1)

    def is_smooth(self, expression: sp.Expr, order: int) -> bool:
        return all(
            need.relation is not None and _holds(need.relation, self.domain) for need in self.needs(expression, order)
        )

    def is_glued(self, node: sp.Expr, order: int) -> bool:
        if not glued_smoothly(node, self.variables, order, lambda entry: self.is_smooth(entry, order)):
            return False
        # The pieces may be smooth where the node itself is not defined, as in Abs(x)/x.
        own = [need for need in self.needs(node, 0, glue=False) if not isinstance(need.node, KINKS)]
        return all(need.relation is not None and _holds(need.relation, self.domain) for need in own)

    def power(self, node: sp.Pow, order: int, glue: bool) -> Iterator[_Need]:
        base, exponent = node.base, node.exp
        zero = sp.S.Zero
        yield from self.needs(exponent, order, glue=glue)
        if isinstance(base, sp.Abs) and exponent.is_Rational and exponent > order:  # |h|^p is C^k for p > k
            yield from self.needs(base.args[0], order, glue=glue)
            return
        if base is sp.E:
            return
        yield from self.needs(base, order, glue=glue)
        if exponent.is_integer and exponent.is_nonnegative:
            return
        if exponent.is_integer:
            yield _Need(node, Relation(base, "!=", zero))
        elif order <= 2 and exponent.is_Rational and 2 * exponent > order:
            # g ≥ 0 with |∇g|² ≤ C g near its zeros: g^q is C^1 for q > 1/2 and C^2 for q > 1.
            yield from self.needs(base, 2 if order else 0, glue=glue)
            yield _Need(node, Relation(zero, "<=", base))
        else:
            yield _Need(node, Relation(zero, "<", base))

    def piecewise(self, node: sp.Piecewise, order: int, glue: bool) -> Iterator[_Need]:
        for value, condition in node.args:
            yield from self.needs(value, order, glue=glue)
            for relation in condition.atoms(Relational):
                difference = relation.lhs - relation.rhs
                if difference.free_symbols & self.variables:
                    yield from self.needs(difference, 0, glue=glue)
                    yield _Need(node, Relation(difference, "!=", sp.S.Zero))


def _own_needs(node: sp.Basic) -> Iterator[_Need]:
    """What ``node`` itself needs, its arguments being smooth."""
    if node.is_Add or node.is_Mul or isinstance(node, (*_ENTIRE, AppliedUndef)):
        return
    zero = sp.S.Zero
    match node:
        case sp.Abs() | sp.sign() | sp.Heaviside() | sp.Max() | sp.Min():
            for side in switching(node):
                yield _Need(node, Relation(side, "!=", zero))
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


def _holds(relation: Relation, domain: Sequence[Relation]) -> bool:
    difference = relation.left - relation.right
    by_assumptions = {
        "!=": difference.is_nonzero,
        "<": difference.is_negative,
        "<=": difference.is_nonpositive,
    }[relation.sign]
    return bool(by_assumptions) or follows(relation, list(domain), seconds=_SECONDS).shown
