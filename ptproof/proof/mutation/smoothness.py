"""Changes of a statement of smoothness: its order, its variables, what is assumed of functions, and kinks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Edit, Letters, edits
from ptproof.proof.mutation.mutant import Candidate
from ptproof.proof.statement import Smooth


def changed_smoothness(claim: Claim, statement: Smooth, letters: Letters) -> Iterator[Candidate]:
    """The order raised, a variable exchanged or added, a kink or a pole added to each expression, and each edited."""

    def changed(**changes: Any) -> Claim:
        return replace(claim, statement=replace(statement, **changes))

    def with_row(row: int, expression: sp.Expr) -> Claim:
        rows = (*statement.expressions[:row], expression, *statement.expressions[row + 1 :])
        return changed(expressions=rows)

    for more in (1, 2):
        order = statement.order + more
        yield Candidate("order", ("order",), partial("order {}".format, order), partial(changed, order=order))
    outside = [letter for letter in letters if isinstance(letter, sp.Symbol) and letter not in statement.variables]
    for symbol in outside:
        variables = (*statement.variables, symbol)
        yield Candidate(
            "variables", ("variables",), partial("in {} too".format, symbol), partial(changed, variables=variables)
        )
    for position, (applied, order) in enumerate(statement.assumed):
        rest = (*statement.assumed[:position], *statement.assumed[position + 1 :])
        yield Candidate(
            "assumption dropped",
            ("assumed", position),
            partial("{} not assumed smooth".format, applied),
            partial(changed, assumed=rest),
        )
        less = (*statement.assumed[:position], (applied, order - 1), *statement.assumed[position + 1 :])
        yield Candidate(
            "assumption weakened",
            ("assumed", position),
            partial("{} of order {}".format, applied, order - 1),
            partial(changed, assumed=less),
        )
    for row, expression in enumerate(statement.expressions):
        for symbol in statement.variables:
            for kink, term in _kinks(symbol, statement.order):
                yield Candidate(
                    "kink",
                    (row,),
                    partial("row {}: plus {}".format, row + 1, kink),
                    partial(with_row, row, expression + term),
                )
        # Most changes of a smooth expression leave a smooth one: one of each kind is enough of those.
        for edit in {edit.kind: edit for edit in edits(expression, letters)}.values():
            words = partial(edit.said, f"row {row + 1}: ")
            yield Candidate(edit.kind, (row,), words, partial(_edited, with_row, row, expression, edit))


def _edited(with_row: Callable[[int, sp.Expr], Claim], row: int, expression: sp.Expr, edit: Edit) -> Claim:
    return with_row(row, edit.apply(expression))


def _kinks(symbol: sp.Symbol, order: int) -> Iterator[tuple[str, sp.Expr]]:
    """What has fewer continuous derivatives than ``order``, as far as the values of the symbol go."""
    kink = symbol ** (order - 1) * sp.Abs(symbol) if symbol.is_nonnegative is None else None
    if kink is not None:
        yield str(kink), kink
    yield f"|{symbol} - 1|", sp.Abs(symbol - 1)
    yield f"max({symbol}, 2)", sp.Max(symbol, 2)
    yield (
        f"|{symbol} - 1/2|**{order - 1}·|{symbol} - 1/2|",
        (symbol - sp.Rational(1, 2)) ** (order - 1) * sp.Abs(symbol - sp.Rational(1, 2)),
    )
    yield f"√|{symbol} - 1|", sp.sqrt(sp.Abs(symbol - 1))
    yield f"1/({symbol} - 1)", 1 / (symbol - 1)
