"""Where an expression is defined and real: what has to hold, as relations that are shown like any others.

A quotient needs a denominator that is not 0, a power with another exponent a base that is not negative, a logarithm
a positive argument; an integral an integrand that is defined on its whole range, a derivative no kink at the place
where it is taken. A symbol has to be declared real. SymPy simplifies some of that away when an expression is made
(``x/x`` is 1): what is not written is not asked for.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ptproof.proof.declarations import declared, like
from ptproof.proof.kinks import KINKS, switching
from ptproof.proof.obligation import Obligation as Obligation
from ptproof.proof.statement import Relation, RelationSign, eq, ge, gt, le
from ptproof.system import differentiated

_TOTAL = (
    sp.exp, sp.sin, sp.cos, sp.atan, sp.sinh, sp.cosh, sp.tanh, sp.asinh, sp.erf, sp.Abs, sp.sign, sp.floor,
    sp.ceiling, sp.Max, sp.Min, sp.Heaviside, sp.Add, sp.Mul,
)  # fmt: skip
_NOT_ZERO = {sp.tan: sp.cos, sp.sec: sp.cos, sp.cot: sp.sin, sp.csc: sp.sin}
_COMPARED: dict[type, RelationSign] = {
    sp.Eq: "=", sp.Ne: "!=", sp.LessThan: "<=", sp.StrictLessThan: "<", sp.GreaterThan: ">=", sp.StrictGreaterThan: ">"
}  # fmt: skip
ZERO, ONE = sp.S.Zero, sp.S.One


@dataclass(frozen=True)
class _Place:
    """Where a node stands: under which conditions, and which symbols a derivative around it moves.

    ``whole`` says that it stands under an integral, which asks every branch to be defined on the whole range.
    """

    given: tuple[Relation, ...] = ()
    moving: frozenset[sp.Symbol] = frozenset()
    whole: bool = False
    shown: Collection[sp.Basic] = ()

    def needs(self, node: sp.Basic, relation: Relation) -> Obligation:
        return Obligation(node, relation, self.given, under_binder=self.whole or bool(self.moving))

    def moves(self, node: sp.Basic) -> bool:
        return bool(self.moving) and bool(self.moving & node.free_symbols)


def obligations(
    expression: sp.Basic, shown: Collection[sp.Basic] = (), moving: Collection[sp.Symbol] = ()
) -> Iterator[Obligation]:
    """What has to hold for ``expression`` to be defined and real, the inner parts first.

    Parameters
    ----------
    expression
        A scalar expression, or a column of them.
    shown
        Integrals and limits of which an engine has shown that they exist and are real.
    moving
        Symbols in which it has to be continuously differentiable as well: no kink, no jump, no root of 0.

    Examples
    --------
    >>> x, y = sp.symbols("x y", real=True)
    >>> [str(need) for need in obligations(sp.log(1 / x - y) + sp.sqrt(1 + x**2)) if not need.settled]
    ['x != 0', '-y + 1/x > 0']
    >>> [str(need) for need in obligations(sp.Piecewise((1 / x, x > 1), (0, True)))]
    ['x != 0 where x > 1']
    """
    entries = expression if isinstance(expression, sp.MatrixBase) else (expression,)
    seen: set[Obligation] = set()
    for entry in entries:
        for need in _of(entry, _Place(shown=shown, moving=frozenset(moving))):
            if need not in seen:
                seen.add(need)
                yield need


def domain_of(relation: Relation, shown: Collection[sp.Basic] = ()) -> tuple[Obligation, ...]:
    """What has to hold for both sides of a relation to be defined and real, and is not plain from declarations."""
    return _domain(relation, frozenset(shown))


@lru_cache(maxsize=8192)
def _domain(relation: Relation, shown: frozenset[sp.Basic]) -> tuple[Obligation, ...]:
    sides = [
        side for side in (relation.left, relation.right)
        # The value of a limit or an integral may be infinite.
        if not (isinstance(relation.left, sp.Limit | sp.Integral) and side in (sp.oo, -sp.oo))
    ]  # fmt: skip
    return tuple(need for side in sides for need in obligations(side, shown) if not need.settled)


def _of(node: sp.Basic, place: _Place) -> Iterator[Obligation]:
    if node in place.shown and isinstance(node, sp.Limit):
        return
    match node:
        case sp.Symbol():
            if not node.is_real:
                yield Obligation(node, None, place.given, f"{node} is not declared real")
        case AppliedUndef():
            if not node.is_real:
                yield Obligation(node, None, place.given, f"{node} is not declared real")
            yield from _parts(node.args, place)
        case sp.Derivative():
            yield from _derivative(node, place)
        case sp.Subs():
            yield from _parts(node.point, place)
            # What the bound variable is declared to be says nothing of the point: a plain real takes its place.
            fresh = {variable: sp.Dummy(variable.name, real=True) for variable in node.variables}
            there = (eq(fresh[letter], value) for letter, value in zip(node.variables, node.point, strict=True))
            yield from _of(node.expr.xreplace(fresh), replace(place, given=(*place.given, *there)))
        case sp.Integral():
            yield from _integral(node, place)
        case sp.Sum() | sp.Product():
            yield from _sum(node, place)
        case sp.Piecewise():
            yield from _piecewise(node, place)
        case _ if not node.args:
            if not (isinstance(node, sp.Expr) and node.is_real):
                yield Obligation(node, None, place.given, f"{node} is no real number")
        case _:
            yield from _parts(node.args, place)
            yield from _own(node, place)


def _parts(nodes: Collection[sp.Basic], place: _Place) -> Iterator[Obligation]:
    for node in nodes:
        yield from _of(node, place)


def _own(node: sp.Basic, place: _Place) -> Iterator[Obligation]:
    """What the node itself asks, its arguments being defined."""
    if place.moves(node) and isinstance(node, KINKS):
        if isinstance(node, sp.floor | sp.ceiling | sp.Mod):
            yield Obligation(node, None, place.given, f"the derivative of {node} is not known")
        yield from (place.needs(node, Relation(side, "!=", ZERO)) for side in switching(node))
    if isinstance(node, _TOTAL):
        return
    strict = place.moves(node)
    match node:
        case sp.Pow():
            yield from _power(node, strict, place)
        case sp.log():
            yield place.needs(node, gt(node.args[0], ZERO))
        case sp.tan() | sp.sec() | sp.cot() | sp.csc():
            yield place.needs(node, Relation(_NOT_ZERO[node.func](node.args[0]), "!=", ZERO))
        case sp.asin() | sp.acos():
            yield place.needs(node, Relation(node.args[0] ** 2, "<" if strict else "<=", ONE))
        case sp.acosh():
            yield place.needs(node, Relation(node.args[0], ">" if strict else ">=", ONE))
        case sp.atanh():
            yield place.needs(node, Relation(node.args[0] ** 2, "<", ONE))
        case sp.atan2():
            yield place.needs(node, gt(node.args[0] ** 2 + node.args[1] ** 2, ZERO))
        case sp.Ei():
            yield place.needs(node, Relation(node.args[0], "!=", ZERO))
        case sp.Mod():
            yield place.needs(node, Relation(node.args[1], "!=", ZERO))
        case sp.Limit():
            yield Obligation(node, None, place.given, f"it is not shown that {node} exists")
        case _:
            yield Obligation(node, None, place.given, f"it is not known where {node.func} is defined and real")


def _power(node: sp.Pow, strict: bool, place: _Place) -> Iterator[Obligation]:
    base, exponent = node.base, node.exp
    if exponent.is_integer:
        if not exponent.is_nonnegative:
            yield place.needs(node, Relation(base, "!=", ZERO))
    elif exponent.is_positive and not strict:
        yield place.needs(node, ge(base, ZERO))
    else:
        yield place.needs(node, gt(base, ZERO))


def _derivative(node: sp.Derivative, place: _Place) -> Iterator[Obligation]:
    if isinstance(node.expr, AppliedUndef) and all(isinstance(entry, sp.Symbol) for entry in node.expr.args):
        yield from _of(node.expr, place)
        return
    yield from _of(node.expr, replace(place, moving=place.moving | set(node.variables)))
    carried = differentiated(node)
    if not carried.has(sp.Derivative, sp.Subs):
        yield from _of(carried, place)


def covers(variable: sp.Symbol, low: sp.Expr, high: sp.Expr) -> bool:
    """Whether a variable of integration may have every value between the ends: what SymPy simplified is then right."""
    kind = {name for name in declared(variable) if name != "finite"}
    above = all(end is sp.oo or end.is_nonnegative for end in (low, high))
    one_sided = above and kind in ({"positive"}, {"nonnegative"})
    return all(declared(variable).values()) and (kind == {"real"} or one_sided)


def _integral(node: sp.Integral, place: _Place) -> Iterator[Obligation]:
    inside = replace(place, whole=True)
    function = node.function
    for limit in reversed(node.limits):
        if len(limit) != 3:
            yield Obligation(node, None, place.given, f"{node} has no ends")
            return
        variable, low, high = limit
        if not covers(variable, low, high):
            yield Obligation(node, None, place.given, f"{variable} is not declared to have all values in {node}")
            return
        finite = [end for end in (low, high) if end not in (sp.oo, -sp.oo)]
        if len(finite) < 2 and node not in place.shown:
            yield Obligation(node, None, place.given, f"it is not shown that {node} converges")
            return
        yield from _parts(finite, inside)
        fresh = like(variable)
        function = function.xreplace({variable: fresh})
        if len(finite) < 2:
            between = tuple(
                relation for relation, end in ((ge(fresh, low), low), (le(fresh, high), high)) if end in finite
            )
        elif (high - low).is_nonnegative:
            between = (ge(fresh, low), le(fresh, high))
        else:
            between = (le((fresh - low) * (fresh - high), ZERO),)
        inside = replace(inside, given=(*inside.given, *between))
    yield from _of(function, inside)


def _sum(node: sp.Basic, place: _Place) -> Iterator[Obligation]:
    inside, function = place, node.function
    for variable, low, high in reversed(node.limits):
        if sp.oo in (low, high) or -sp.oo in (low, high):
            yield Obligation(node, None, place.given, f"it is not shown that {node} converges")
            return
        yield from _parts((low, high), inside)
        fresh = sp.Dummy(variable.name, integer=True)
        function = function.xreplace({variable: fresh})
        inside = replace(inside, given=(*inside.given, ge(fresh, low), le(fresh, high)))
    yield from _of(function, inside)


def _piecewise(node: sp.Piecewise, place: _Place) -> Iterator[Obligation]:
    before: tuple[Relation, ...] = ()
    for value, condition in node.args:
        if condition == sp.true:
            yield from _of(value, place if place.whole else replace(place, given=(*place.given, *before)))
            return
        if not isinstance(condition, Relational):
            yield Obligation(node, None, place.given, f"the condition {condition} is not one comparison")
            return
        here = Relation(condition.lhs, _COMPARED[condition.func], condition.rhs)
        yield from _parts((here.left, here.right), replace(place, given=(*place.given, *before)))
        if place.moves(condition):
            yield place.needs(node, Relation(here.left - here.right, "!=", ZERO))
        yield from _of(value, place if place.whole else replace(place, given=(*place.given, *before, here)))
        before = (*before, here.negation())
    nothing_left = Relation(ONE, "<", ZERO)
    yield Obligation(node, nothing_left, (*place.given, *before), f"{node} has no value where no condition holds")
