"""Exact values at which a hypothesis may fail: allowed by the declarations, inside the region, possible at once."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence, Set

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import admissible, declared
from ptproof.proof.statement import Relation
from ptproof.proof.substitution import holds_at
from ptproof.system import differentiated

_VALUES = (sp.S.Zero, sp.S.One, sp.Rational(-3, 2), sp.Integer(3), sp.Rational(1, 2), sp.Integer(-2))
_MOST = 64
_OPAQUE = (AppliedUndef, sp.Derivative, sp.Subs)


def masked_functions(expression: sp.Expr) -> tuple[sp.Expr, dict[sp.Symbol, sp.Expr]]:
    """Undefined functions and their derivatives as symbols, of the functions' declared kind, and the way back.

    At any one point a smooth function and its derivatives may have any values, of its declared sign.
    """
    expression = differentiated(expression)
    nodes = sp.preorder_traversal(expression)
    table: dict[sp.Basic, sp.Symbol] = {}
    for node in nodes:
        if isinstance(node, _OPAQUE):
            nodes.skip()
            kind = declared(node) if isinstance(node, AppliedUndef) else {"real": True}
            table.setdefault(node, sp.Dummy(str(node), **kind))
    return expression.xreplace(table), {symbol: node for node, symbol in table.items()}


def sample_points(
    symbols: Set[sp.Symbol], domain: Sequence[Relation] = (), meaning: Mapping[sp.Symbol, sp.Expr] | None = None
) -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Exact values for all the symbols at once; not too many.

    Parameters
    ----------
    symbols
        Each gets a value that its declaration allows.
    domain
        Relations between these symbols hold at each point that is given out.
    meaning
        What stands behind the symbols of :func:`masked_functions`, whose arguments then get values as well: what no
        function can do, such as having two values at one place, is left out.
    """
    meaning = {symbol: node for symbol, node in (meaning or {}).items() if symbol in symbols}
    symbols = set(symbols).union(*(node.free_symbols for node in meaning.values()))
    ordered = sorted(symbols, key=lambda symbol: (symbol.name, symbol.class_key()))
    within = [relation for relation in domain if relation.free_symbols <= symbols]
    pools = [[value for value in _pool(symbol, within) if admissible(symbol, value)] for symbol in ordered]
    for values in itertools.islice(itertools.product(*pools), 20 * _MOST):
        point = dict(zip(ordered, values, strict=True))
        if holds_at(within, point) and _is_possible(point, meaning):
            yield point


def _pool(symbol: sp.Symbol, domain: Sequence[Relation]) -> list[sp.Expr]:
    """Values to try: some small numbers that lie in the symbol's interval, and the middle and the ends of that."""
    bounds = [
        other
        for relation in domain
        for one, other in ((relation.left, relation.right), (relation.right, relation.left))
        if one == symbol and other.is_number
    ]
    if not bounds:
        return list(_VALUES)
    middle = [sp.Add(*bounds) / len(bounds)]
    own = [relation for relation in domain if relation.free_symbols == {symbol}]
    values = dict.fromkeys([*middle, *_VALUES, *bounds])
    return [value for value in values if holds_at(own, {symbol: value})]


def _is_possible(point: Mapping[sp.Symbol, sp.Expr], meaning: Mapping[sp.Symbol, sp.Expr]) -> bool:
    """Whether smooth functions have these values: one value at a place, and flat where a sign makes it so."""
    seen: dict[tuple[sp.Basic, ...], sp.Expr] = {}
    for symbol, value in point.items():
        node = meaning.get(symbol)
        if node is None:
            continue
        key = _jet(node, point, meaning)
        if key is None or seen.setdefault(key, value) != value:
            return False
    for (function, place, moved), value in seen.items():
        base = seen.get((function, place, sp.Tuple()))
        signed = set(declared(function(*place))) & {"nonnegative", "nonpositive"}
        if moved and signed and base == 0 and value != 0:
            return False
    return True


def _jet(
    node: sp.Expr, point: Mapping[sp.Symbol, sp.Expr], meaning: Mapping[sp.Symbol, sp.Expr]
) -> tuple[sp.Basic, ...] | None:
    """The function, the place in numbers, and the arguments it is differentiated by; None if that is not clear."""
    applied, moved = (node.expr, node.variables) if isinstance(node, sp.Derivative) else (node, ())
    if not isinstance(applied, AppliedUndef) or any(applied.args.count(symbol) != 1 for symbol in moved):
        return None
    inner = {node: point[symbol] for symbol, node in meaning.items() if symbol in point}
    place = tuple(argument.xreplace(inner).xreplace(dict(point)) for argument in applied.args)
    if any(not argument.is_Rational for argument in place):
        return None
    positions = sorted(applied.args.index(symbol) for symbol in moved)
    return applied.func, sp.Tuple(*place), sp.Tuple(*positions)
