"""Changes of a statement of smoothness: its order, its variables, what is assumed of functions, and kinks."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Edit, Letters, edits, with_item
from ptproof.proof.mutation.mutant import Candidate, Place, restated
from ptproof.proof.statement import Smooth


def changed_smoothness(claim: Claim, statement: Smooth, letters: Letters) -> Iterator[Candidate[Claim]]:
    """The order raised, a variable exchanged or added, a kink or a pole added to each expression, and each edited."""

    def candidate(kind: str, row: Place, words: str, **changes: Any) -> Candidate[Claim]:
        return Candidate(kind, row, lambda: words, lambda: restated(claim, **changes))

    for order in (statement.order + 1, statement.order + 2):
        yield candidate("order", ("order",), f"order {order}", order=order)
    for symbol in letters:
        if isinstance(symbol, sp.Symbol) and symbol not in statement.variables:
            yield candidate("variables", ("variables",), f"in {symbol} too", variables=(*statement.variables, symbol))
    for position, (applied, order) in enumerate(statement.assumed):
        row, rest = ("assumed", position), with_item(statement.assumed, position)
        yield candidate("assumption dropped", row, f"{applied} not assumed smooth", assumed=rest)
        less = with_item(statement.assumed, position, (applied, order - 1))
        yield candidate("assumption weakened", row, f"{applied} of order {order - 1}", assumed=less)
    for place, expression in enumerate(statement.expressions):
        for symbol in statement.variables:
            for kink, term in _kinks(symbol, statement.order):
                rows = with_item(statement.expressions, place, expression + term)
                yield candidate("kink", (place,), f"row {place + 1}: plus {kink}", expressions=rows)
        # Most changes of a smooth expression leave a smooth one: one of each kind is enough of those.
        for edit in {edit.kind: edit for edit in edits(expression, letters)}.values():
            make = partial(_edited, claim, statement.expressions, place, edit)
            yield Candidate(edit.kind, (place,), partial(edit.said, f"row {place + 1}: "), make)


def _edited(claim: Claim, rows: tuple[sp.Expr, ...], place: int, edit: Edit) -> Claim:
    return restated(claim, expressions=with_item(rows, place, edit.apply(rows[place])))


def _kinks(symbol: sp.Symbol, order: int) -> Iterator[tuple[str, sp.Expr]]:
    """What has fewer continuous derivatives than ``order``, as far as the values of the symbol go."""
    half = symbol - sp.Rational(1, 2)
    if symbol.is_nonnegative is None:
        kink = symbol ** (order - 1) * sp.Abs(symbol)
        yield str(kink), kink
    yield f"|{symbol} - 1|", sp.Abs(symbol - 1)
    yield f"max({symbol}, 2)", sp.Max(symbol, 2)
    yield f"|{symbol} - 1/2|**{order - 1}·|{symbol} - 1/2|", half ** (order - 1) * sp.Abs(half)
    yield f"√|{symbol} - 1|", sp.sqrt(sp.Abs(symbol - 1))
    yield f"1/({symbol} - 1)", 1 / (symbol - 1)
