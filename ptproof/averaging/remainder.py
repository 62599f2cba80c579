"""What a closed expansion leaves of the derivative of X, as one finite expression in the letters of the system."""

from __future__ import annotations

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.brackets import Vector
from ptproof.averaging.expansion import Expansion
from ptproof.averaging.oscillation import DELTA


def remainder(expansion: Expansion, omega: sp.Symbol) -> Vector:
    """ω^((n+1)/2) times dX/dσ along the system less Σ δ^j G_j(X), for each slow state, where n is the highest power.

    Nothing is expanded: X stands in the unknown functions of the means as it is. SymPy is quick about everything but
    large expressions inside of ``Subs`` and repeated derivatives of the same term, so each of both is made once.
    """
    own, delta = expansion.oscillation, 1 / sp.sqrt(omega)
    moved = {
        symbol: symbol + sp.Add(*(delta**n * row[i] for n, row in enumerate(expansion.correctors, start=1)))
        for i, symbol in enumerate(own.slow)
    }
    rates = [rate.subs(DELTA, delta) for rate in own.right_hand_side]
    slopes, there = _Slopes(), _Moved(moved)
    result = []
    for place, symbol in enumerate(own.slow):
        along = sp.Add(*(slopes(moved[symbol], s) * rate for s, rate in zip(own.states, rates, strict=True)))
        means = sp.Add(*there([delta**j * row[place] for j, row in enumerate(expansion.means, start=1)]))
        result.append((along - means) / delta ** (expansion.order + 1))
    return tuple(result)


class _Slopes:
    """Derivatives of sums of products, each calculated once."""

    def __init__(self) -> None:
        self._known: dict[tuple[sp.Expr, sp.Symbol], sp.Expr] = {}

    def __call__(self, entry: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
        key = entry, symbol
        if key not in self._known:
            self._known[key] = self._slope(entry, symbol) if symbol in entry.free_symbols else sp.S.Zero
        return self._known[key]

    def _slope(self, entry: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
        if entry.is_Add:
            return sp.Add(*(self(term, symbol) for term in entry.args))
        if entry.is_Mul:
            factors = entry.args
            slopes = ((i, self(factor, symbol)) for i, factor in enumerate(factors))
            return sp.Add(*(sp.Mul(*factors[:i], slope, *factors[i + 1 :]) for i, slope in slopes if slope != 0))
        return sp.diff(entry, symbol)


class _Moved:
    """Expressions with every symbol replaced at once, also inside of derivatives of unknown functions."""

    def __init__(self, values: dict[sp.Symbol, sp.Expr]) -> None:
        # A short mark that is no symbol stands for the value, so that SymPy makes a Subs of a derivative at it.
        moving = [symbol for symbol, value in values.items() if value != symbol]
        marks = {symbol: sp.Function(f"X{i}", real=True)(sp.Dummy(real=True)) for i, symbol in enumerate(moving)}
        self._marks: dict[sp.Symbol, AppliedUndef] = marks
        self._values = {mark: values[symbol] for symbol, mark in marks.items()}
        self._subs: dict[sp.Subs, sp.Expr] = {}

    def __call__(self, entries: list[sp.Expr]) -> list[sp.Expr]:
        marked = [entry.subs(self._marks, simultaneous=True) for entry in entries]
        for node in set().union(*(entry.atoms(sp.Subs) for entry in marked)) - self._subs.keys():
            self._subs[node] = node.xreplace(self._values)
        return [entry.xreplace({**self._values, **self._subs}) for entry in marked]
