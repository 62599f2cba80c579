"""Lie brackets of sparse vector fields, and averages in readable form."""

from __future__ import annotations

import functools
import operator
from collections import Counter
from collections.abc import Mapping, Sequence

import sympy as sp

Vector = tuple[sp.Expr, ...]
_FACTORED = 200


class SparseField:
    """A vector field that remembers which entries are not zero and what these depend on."""

    def __init__(self, entries: Sequence[sp.Expr], state: Sequence[sp.Symbol]) -> None:
        self.entries = {row: entry for row, entry in enumerate(entries) if entry != 0}
        self.state = tuple(state)
        self._columns = {symbol: column for column, symbol in enumerate(state)}
        self._derivative = functools.cache(lambda row, column: sp.diff(self.entries[row], self.state[column]))

    @functools.cached_property
    def depends(self) -> dict[int, frozenset[int]]:
        """Row → the columns of the states that its entry contains."""
        return {
            row: frozenset(self._columns[symbol] for symbol in entry.free_symbols if symbol in self._columns)
            for row, entry in self.entries.items()
        }

    @property
    def vector(self) -> Vector:
        """All entries, n expressions."""
        return tuple(self.entries.get(row, sp.S.Zero) for row in range(len(self.state)))

    def along(self, direction: SparseField) -> SparseField:
        """The derivative of this field along ``direction``: (∂self/∂x) direction."""
        result: list[sp.Expr] = [sp.S.Zero] * len(self.state)
        for row, columns in self.depends.items():
            moving = (column for column in columns if column in direction.entries)
            result[row] = sp.Add(*(self._derivative(row, column) * direction.entries[column] for column in moving))
        return SparseField(result, self.state)


def sparse_bracket(f: SparseField, g: SparseField, factored: int = _FACTORED) -> SparseField:
    """[f, g] = (∂g/∂x) f − (∂f/∂x) g, as :func:`ptproof.system.lie_bracket`, touching nonzero entries only.

    ``factored`` as in :func:`tidy`.
    """
    entries = map(operator.sub, g.along(f).vector, f.along(g).vector)
    return SparseField([tidy(entry, factored) if entry != 0 else entry for entry in entries], f.state)


def tidy(expression: sp.Expr, factored: int = _FACTORED) -> sp.Expr:
    """The same expression with sin² + cos² = 1 used up, for every argument, in the shortest form found.

    Sines and cosines, functions, derivatives and other transcendentals become generators, the rest is
    polynomial algebra: exact, and fast also where ``simplify`` gives no answer. Sums of more than ``factored`` terms
    are not factored, which takes long where there are many generators.
    """
    masked, sines, cosines, back = _mask(expression)
    expanded = sp.expand(masked)
    forms = [_reduce(expanded, sines, cosines)]
    if sines:
        forms.append(_reduce(expanded, cosines, sines))
    for form in dict.fromkeys(forms):
        if form.is_Add:
            forms.append(sp.factor_terms(form))
            if _is_plain(form):
                forms.append(sp.gcd_terms(form))
            elif len(form.args) <= factored:
                forms.append(sp.factor(form))
    if len(forms[0].free_symbols) >= len(masked.free_symbols):
        forms.append(masked)
    shortest = min(forms, key=lambda form: (sp.count_ops(form), len(str(form))))
    while shortest.free_symbols & back.keys():
        shortest = shortest.xreplace(back)
    return shortest


def _is_plain(form: sp.Add) -> bool:
    """Whether it is seen that nothing can be taken out of a sum of monomials but a number and a monomial.

    That is so where a letter stands in one term only, and there to the first power: of two factors one has the letter,
    and the other divides what the letter is multiplied with, which is a monomial.
    """
    counts: Counter[sp.Expr] = Counter()
    single: set[sp.Expr] = set()
    for term in form.args:
        for letter, power in term.as_powers_dict().items():
            if not (letter.is_Number or (letter.is_Symbol and power.is_Integer and power > 0)):
                return False
            counts[letter] += 1
            if power == 1 and letter.is_Symbol:
                single.add(letter)
    return any(counts[letter] == 1 for letter in single)


def _mask(
    expression: sp.Expr,
) -> tuple[sp.Expr, dict[sp.Expr, sp.Symbol], dict[sp.Expr, sp.Symbol], dict[sp.Symbol, sp.Expr]]:
    """Sines and cosines, and the functions outside of them, become symbols; with the way back."""
    sines: dict[sp.Expr, sp.Symbol] = {}
    cosines: dict[sp.Expr, sp.Symbol] = {}
    hidden: dict[sp.Basic, sp.Symbol] = {}

    def hide(node: sp.Basic) -> sp.Basic:
        if isinstance(node, sp.sin | sp.cos):
            table = sines if isinstance(node, sp.sin) else cosines
            return table.setdefault(node.args[0], sp.Dummy(node.func.__name__))
        # A denominator stays as it is written.
        power = node.is_Pow and node.base.is_Add and not (node.exp.is_Integer and node.exp > 0)
        if power or isinstance(node, sp.Subs | sp.Derivative | sp.Function):
            return hidden.setdefault(node, sp.Dummy("f"))
        return node.func(*map(hide, node.args)) if node.args else node

    masked = hide(expression)
    for argument in (*sines, *cosines):
        sines.setdefault(argument, sp.Dummy("sin"))
        cosines.setdefault(argument, sp.Dummy("cos"))
    back = {symbol: node for node, symbol in hidden.items()}
    back |= {symbol: sp.sin(argument) for argument, symbol in sines.items()}
    back |= {symbol: sp.cos(argument) for argument, symbol in cosines.items()}
    return masked, sines, cosines, back


def _reduce(expanded: sp.Expr, removed: Mapping[sp.Expr, sp.Symbol], kept: Mapping[sp.Expr, sp.Symbol]) -> sp.Expr:
    """Modulo removed² + kept² = 1 for every argument, so that the removed symbol occurs at most once."""
    for argument, symbol in removed.items():
        other = kept[argument]
        terms = []
        changed = False
        for term in sp.Add.make_args(expanded):
            power = term.as_powers_dict().get(symbol, sp.S.Zero)
            if power.is_Integer and power >= 2:
                half = int(power) // 2
                term = sp.expand(term / symbol ** (2 * half) * (1 - other**2) ** half)
                changed = True
            terms.append(term)
        if changed:
            expanded = sp.expand(sp.Add(*terms))
    return expanded
