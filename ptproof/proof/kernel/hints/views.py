"""Symbols of unknown sign as a bound and what is above it: in this view signs are seen by structure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.statement import Relation


@dataclass(frozen=True)
class View:
    """What was replaced: what symbols are in the view (``there``), and what the new symbols are outside (``back``).

    ``equal`` are the symbols that are replaced by what they are said to be.
    """

    there: dict[sp.Symbol, sp.Expr]
    back: dict[sp.Symbol, sp.Expr]
    equal: tuple[sp.Symbol, ...] = ()

    def of(self, expression: sp.Expr) -> sp.Expr:
        """The expression in this view; arguments of functions are brought into one form."""
        seen = expression.xreplace(self.there)
        calls = {call: call.func(*map(sp.expand, call.args)) for call in seen.atoms(AppliedUndef)}
        seen = seen.xreplace(calls)
        return seen.xreplace({part: sp.exp(sp.factor(sp.together(part.args[0]))) for part in seen.atoms(sp.exp)})

    def relation(self, relation: Relation) -> Relation:
        """Both sides in this view."""
        return Relation(self.of(relation.left), relation.sign, self.of(relation.right))


def view(known: Iterable[Relation]) -> View:
    """A view in which what is known of plain symbols is seen; signs that are declared stay so."""
    there: dict[sp.Symbol, sp.Expr] = {}
    back: dict[sp.Symbol, sp.Expr] = {}
    equal: list[sp.Symbol] = []
    for relation in known:
        item = relation.standard()
        if item.sign == "!=" or (found := _solved(item, there, back)) is None:
            continue
        symbol, value, above = found
        if above is not None:
            back[above] = item.right - item.left
        else:
            equal.append(symbol)
        there = {old: sp.expand(new.xreplace({symbol: value})) for old, new in there.items()}
        there[symbol] = value
    return View(there, back, tuple(equal))


def _solved(
    item: Relation, there: dict[sp.Symbol, sp.Expr], back: dict[sp.Symbol, sp.Expr]
) -> tuple[sp.Symbol, sp.Expr, sp.Symbol | None] | None:  # fmt: skip
    """A symbol, its value, and the new symbol in it."""
    if item.sign == "=":
        for symbol, value in ((item.left, item.right), (item.right, item.left)):
            if symbol.is_Symbol and not value.has(symbol) and symbol not in there and _keeps(symbol, value):
                return symbol, value.xreplace(there), None
        return None
    gap = item.right - item.left
    if not gap.free_symbols or not gap.is_polynomial() or sp.Poly(gap, *gap.free_symbols).total_degree() > 1:
        return None
    seen = sp.expand(gap.xreplace(there))
    moved = bool(seen.free_symbols & set(back))
    for symbol in sorted(seen.free_symbols, key=lambda s: (s.is_nonnegative is True, s.name)):
        factor = seen.coeff(symbol)
        if factor not in (1, -1) or symbol in back or (symbol.is_nonnegative and not moved):
            continue
        above = sp.Symbol(f"gap{len(back)}", **{"positive" if item.sign == "<" else "nonnegative": True})
        value = sp.expand(symbol + (above - seen) / factor)
        if _keeps(symbol, value):
            return symbol, value, above
    return None


def _keeps(symbol: sp.Symbol, value: sp.Expr) -> bool:
    """Whether what is declared of the symbol is seen in the value."""
    kinds = [word for word in ("positive", "negative", "nonnegative", "nonpositive", "integer")
             if getattr(symbol, f"is_{word}")]  # fmt: skip
    return all(getattr(value, f"is_{word}") for word in kinds)
