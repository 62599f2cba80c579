"""Where a paper begins with another system whose letters are those of an earlier one."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.drafting.facts import Fact, depends
from ptproof.drafting.paper import Paper
from ptproof.reading.latex.statements import Pair


def begins_anew(fact: Fact, pair: Pair, line: int, paper: Paper) -> bool:
    """Whether in an equation for a rate that ``fact`` defines a letter that moves occurs for the first time.

    ``line`` is where it stands. What was said before tells nothing of such a letter, so that this is no result of it.
    """
    if pair.sign != "=" or fact.chain or not (pair.left.is_Symbol and pair.left.name in paper.moved):
        return False
    names = {symbol.name for symbol in pair.right.free_symbols} & paper.states - {*paper.table["times"]}
    return any(paper.declared[name].line >= line for name in names) and not depends(pair.right, pair.left, {})


def outdated(rate: sp.Expr, facts: Mapping[sp.Expr, Fact], paper: Paper) -> tuple[sp.Expr, ...]:
    """What was said of the letter of this rate, of its rates, and of functions of time in which it is."""
    moved = paper.moved[rate.name][0]
    rates = {name for name, (of, _) in paper.moved.items() if str(of) == str(moved)}
    times = {*paper.table["times"]}
    return tuple(
        head for head, fact in facts.items()
        if str(head) == str(moved) or str(head) in rates
        or (isinstance(head, AppliedUndef) and {str(argument) for argument in head.args} <= times
            and depends(fact.pair.right, sp.Symbol(str(moved), real=True), facts))
    )  # fmt: skip
