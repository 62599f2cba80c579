"""What a composition of smooth functions needs in order to be smooth on a domain, place by place.

C^k on a set D of values of the variables means here: each point of D has a neighbourhood in Rⁿ on which some C^k
function agrees, on D, with the expression. On an open set that is the usual meaning, on a half-line or a box it asks
for derivatives up to the boundary, and for k = 0 it is continuity on D. Every rule below carries such functions from
the arguments of a node to the node; where a rule speaks of the expression itself beside D, because that is what its
theorem is about, no function that agrees only on D may have been used below it (``beyond``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.core.relational import Relational

from ptproof.proof.declarations import SAYS, SIGNS, declared
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.glued import glued_smoothly
from ptproof.proof.engines.reals import follows
from ptproof.proof.kinks import KINKS, switching
from ptproof.proof.obligation import is_declared
from ptproof.proof.statement import Relation

ZERO = sp.S.Zero
_SECONDS = 3.0
_ENTIRE = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh, sp.tanh, sp.atan, sp.asinh, sp.erf)
_READ = (
    *_ENTIRE, sp.Abs, sp.sign, sp.Heaviside, sp.Max, sp.Min, sp.log, sp.tan, sp.sec, sp.asin, sp.acos, sp.atan2
)  # fmt: skip
_COMPARISONS = (sp.Eq, sp.Ne, sp.LessThan, sp.StrictLessThan, sp.GreaterThan, sp.StrictGreaterThan)


@dataclass(frozen=True)
class Need:
    """``relation`` must hold on the domain, where ``given`` does, for ``node`` to be smooth; None: nothing would help.

    With ``everywhere`` it must hold for all real values of the variables, because the rule that asks for it is about
    a full neighbourhood of each point of the domain. ``settled`` says that it has been shown already.
    """

    node: sp.Basic
    relation: Relation | None
    given: tuple[Relation, ...] = ()
    everywhere: bool = False
    settled: bool = False

    def __str__(self) -> str:
        if self.relation is None:
            return str(self.node)
        where = f" where {' and '.join(map(str, self.given))}" if self.given else ""
        return f"{self.node} needs {self.relation}{where}{' on a full neighbourhood' if self.everywhere else ''}"


@dataclass(frozen=True)
class Known:
    """An undefined function that is ``order`` times continuously differentiable on the kind of its ``letters``."""

    function: UndefinedFunction
    letters: tuple[sp.Expr, ...] | None
    order: Any

    @classmethod
    def of(cls, function: Any, order: Any) -> Known:
        """From a function as applied, whose letters say where it is smooth, or from the bare function."""
        if isinstance(function, AppliedUndef):
            return cls(function.func, function.args, order)
        return cls(function, None, order)

    def covers(self, node: AppliedUndef, order: int) -> bool:
        same = self.function == node.func and (self.letters is None or len(self.letters) == len(node.args))
        return same and bool(self.order >= order)

    def asks(self, node: AppliedUndef, everywhere: bool) -> Iterator[Need]:
        """What the arguments must be to be of the kind of the letters."""
        for letter, argument in zip(self.letters or (), node.args, strict=self.letters is not None):
            if not isinstance(letter, sp.Symbol):
                if letter != argument:
                    yield Need(node, None)
                continue
            words = declared(letter)
            if argument != letter and any(word not in ("real", *SIGNS) for word in words):
                yield Need(node, None)
            for word in SIGNS:
                if words.get(word):
                    yield Need(node, Relation(argument, SAYS[word], ZERO), (), everywhere)


@dataclass
class Examiner:
    """Walks through an expression and collects what has to hold for it to be smooth in the ``variables``."""

    variables: frozenset[sp.Symbol]
    known: tuple[Known, ...]
    domain: tuple[Relation, ...]
    glued: list[sp.Expr] = field(default_factory=list)
    _shown: dict[Need, bool] = field(default_factory=dict)

    def holds(self, need: Need) -> bool:
        """Whether what is needed is shown."""
        if need not in self._shown:
            self._shown[need] = need.settled or (need.relation is not None and self._holds(need, need.relation))
        return self._shown[need]

    def _holds(self, need: Need, relation: Relation) -> bool:
        domain: Sequence[Relation] = (*self.domain, *need.given)
        if need.everywhere:
            # No declared sign of a variable may help either.
            free = {symbol: sp.Dummy(symbol.name, real=True) for symbol in self.variables}
            relation = relation.map(lambda side: side.xreplace(free))
            domain = [part for part in domain if not part.free_symbols & self.variables]
        return is_declared(relation) or follows(relation, list(domain), seconds=_SECONDS).shown

    def is_smooth(self, expression: sp.Expr, order: int, beyond: bool = True) -> bool:
        """Whether everything that ``expression`` needs is shown."""
        return all(map(self.holds, self.needs(expression, order, beyond=beyond)))

    def needs(self, node: sp.Basic, order: int, *, glue: bool = True, beyond: bool = True) -> Iterator[Need]:
        """What has to hold for ``node`` to be C^order; without ``beyond``, for its own formula around the domain."""
        if not node.free_symbols & self.variables:
            yield from self.defined(node)
            return
        if node.is_Symbol:
            return
        if glue and not node.is_Add and node.has(*KINKS) and self.is_glued(node, order, beyond):
            self.glued.append(node)
            return
        match node:
            case sp.Pow():
                yield from self.power(node, order, glue, beyond)
            case sp.Derivative():
                yield from self.derivative(node, order)
            case sp.Subs():
                yield from self.put_in(node, order, glue, beyond)
            case sp.Piecewise():
                yield from self.piecewise(node, order, glue, beyond)
            case AppliedUndef():
                yield from self.unknown(node, order, glue, beyond)
            case _ if node.is_Add or node.is_Mul or isinstance(node, _READ):
                for argument in node.args:
                    yield from self.needs(argument, order, glue=glue, beyond=beyond)
                if order > 0 or not isinstance(node, sp.Abs | sp.Max | sp.Min):
                    yield from _own_needs(node)
            case _:
                yield Need(node, None)

    def defined(self, node: sp.Basic) -> Iterator[Need]:
        """What has to hold for the node to be defined and real."""
        for duty in obligations(node):
            if not duty.settled:
                yield Need(duty.node, duty.relation, duty.given)

    def is_glued(self, node: sp.Expr, order: int, beyond: bool) -> bool:
        if not glued_smoothly(node, self.variables, order, lambda entry: self.is_smooth(entry, order, beyond)):
            return False
        # The pieces may be smooth where the node itself is not defined, as in Abs(x)/x.
        return all(map(self.holds, self.defined(node)))

    def power(self, node: sp.Pow, order: int, glue: bool, beyond: bool) -> Iterator[Need]:
        """A power: of a positive base; with 0 allowed, by the exponent and by what the base is around its zeros."""
        base, exponent = node.base, node.exp
        constant = not exponent.free_symbols & self.variables
        high = constant and bool((exponent - order).is_positive)
        positive = Need(node, Relation(ZERO, "<", base))
        yield from self.needs(exponent, order, glue=glue, beyond=beyond)
        if base is sp.E:
            return
        if isinstance(base, sp.Abs) and high:  # |h|^p is C^k for p > k
            yield from self.needs(base.args[0], order, glue=glue, beyond=beyond)
            return
        yield from self.needs(base, order, glue=glue, beyond=beyond)
        if constant and exponent.is_integer:
            if not exponent.is_positive:
                yield Need(node, Relation(base, "!=", ZERO))
        elif self.holds(positive):
            yield positive
        elif high:  # max(g, 0)^p is C^k for p > k, and is g^p where g ≥ 0
            yield Need(node, Relation(ZERO, "<=", base), (), not beyond)
        elif order in (1, 2) and constant and exponent.is_Rational and 2 * exponent > order:
            # Where g is C² and g ≥ 0 on a full neighbourhood of a zero, |∇g|² ≤ C g there (Glaeser): g^q is then C¹
            # for q > 1/2 and C² for q > 1. With g ≥ 0 on one side only it is false, as for g = x and q = 3/4.
            yield from self.needs(base, 2, glue=glue, beyond=False)
            yield Need(node, Relation(ZERO, "<=", base), (), True)
        else:
            yield positive

    def derivative(self, node: sp.Derivative, order: int) -> Iterator[Need]:
        """A derivative costs as many orders; it is one of the formula itself, not of what agrees with it on D."""
        count = sum(number for _, number in node.variable_count)
        plain = all(isinstance(symbol, sp.Symbol) and symbol.is_real for symbol in node.variables)
        if not plain or not sp.sympify(count).is_Integer:
            yield Need(node, None)
            return
        wider = replace(self, variables=self.variables | set(node.variables), _shown={})
        for need in wider.needs(node.expr, order + int(count), beyond=False):
            yield self._carried(wider, need)

    def put_in(self, node: sp.Subs, order: int, glue: bool, beyond: bool) -> Iterator[Need]:
        """Values put in: the expression, jointly in what is replaced and in the variables, after the values."""
        fresh = {symbol: sp.Dummy(symbol.name, real=True) for symbol in node.variables}
        for point in node.point:
            yield from self.needs(point, order, glue=glue, beyond=beyond)
        there = tuple(Relation(fresh[symbol], "=", point) for symbol, point in zip(*node.args[1:], strict=True))
        wider = replace(self, variables=self.variables | set(fresh.values()), domain=(*self.domain, *there), _shown={})
        for need in wider.needs(node.expr.xreplace(fresh), order, glue=glue, beyond=beyond):
            yield self._carried(wider, need)

    @staticmethod
    def _carried(wider: Examiner, need: Need) -> Need:
        """A need of another examiner, with other variables and another domain, where it is shown or not."""
        return replace(need, settled=True) if wider.holds(need) else Need(need.node, None)

    def piecewise(self, node: sp.Piecewise, order: int, glue: bool, beyond: bool) -> Iterator[Need]:
        """Pieces that are all smooth, and conditions that don't change on any connected part of the domain."""
        if node.args[-1][1] != sp.true:
            yield Need(node, None)  # there may be no value
        for value, condition in node.args:
            yield from self.needs(value, order, glue=glue, beyond=beyond)
            if not _is_comparison(condition):
                yield Need(node, None)
                continue
            for relation in condition.atoms(Relational):
                difference = relation.lhs - relation.rhs
                yield from self.needs(difference, 0, glue=glue, beyond=beyond)
                if difference.free_symbols & self.variables:
                    yield Need(node, Relation(difference, "!=", ZERO))

    def unknown(self, node: AppliedUndef, order: int, glue: bool, beyond: bool) -> Iterator[Need]:
        """An undefined function of what is smooth, with arguments of the kind for which it is known to be smooth."""
        covering = [known for known in self.known if known.covers(node, order)]
        if not covering or not node.is_real:
            yield Need(node, None)
            return
        ways = [tuple(known.asks(node, not beyond)) for known in covering]
        yield from next((way for way in ways if all(map(self.holds, way))), ways[0])
        for argument in node.args:
            yield from self.needs(argument, order, glue=glue, beyond=beyond)


def _is_comparison(condition: sp.Basic) -> bool:
    """Whether it is made of comparisons of two expressions alone."""
    if condition in (sp.true, sp.false):
        return True
    if isinstance(condition, sp.And | sp.Or | sp.Not):
        return all(map(_is_comparison, condition.args))
    return isinstance(condition, _COMPARISONS) and all(isinstance(side, sp.Expr) for side in condition.args)


def _own_needs(node: sp.Basic) -> Iterator[Need]:
    """What ``node`` itself needs, its arguments being smooth."""
    match node:
        case sp.Abs() | sp.sign() | sp.Heaviside() | sp.Max() | sp.Min():
            for side in switching(node):
                yield Need(node, Relation(side, "!=", ZERO))
        case sp.log():
            yield Need(node, Relation(ZERO, "<", node.args[0]))
        case sp.tan() | sp.sec():
            yield Need(node, Relation(sp.cos(node.args[0]), "!=", ZERO))
        case sp.asin() | sp.acos():
            yield Need(node, Relation(node.args[0] ** 2, "<", sp.S.One))
        case sp.atan2():
            yield Need(node, Relation(ZERO, "<", node.args[1]))
