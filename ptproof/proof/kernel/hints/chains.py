"""Hints for inequalities: the difference of both sides as a sum of known differences, each times what is not negative.

What is left over is matched summand by summand: of two products of powers the one is below the other since its
logarithm is, by what is known. The search is in SymPy; every line that comes out is checked by Coq.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.monomials import (
    Exponents,
    difference,
    monomial_of,
    powers,
    product_of,
    summands,
    total,
)
from ptproof.proof.statement import Relation

_SECONDS = 4.0
_DEPTH = 9
Summands = Mapping[sp.Expr, sp.Rational]


@dataclass(frozen=True)
class Used:
    """What is known, times a factor that is not negative."""

    relation: Relation
    factor: sp.Expr


@dataclass(frozen=True)
class Below:
    """``lower <= upper``, by the logarithms of ``known``; ``common`` stands before the difference."""

    lower: sp.Expr
    upper: sp.Expr
    known: tuple[Used, ...]
    common: sp.Expr


@dataclass(frozen=True)
class Chain:
    """The difference as a sum of what is not negative: known differences, matched ones, and summands that are left."""

    used: tuple[Used, ...]
    matched: tuple[Below, ...]
    left: tuple[sp.Expr, ...]


@dataclass
class Search:
    """A search for a chain among what is known, as ``lower <= upper``, which ends at the time ``until``.

    ``narrow``: only the open summand is followed that the fewest of what is known take away.
    """

    known: Sequence[Relation]
    until: float = 0.0
    narrow: bool = True
    logarithms: dict[sp.Expr, tuple[Used, ...] | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.gaps = [summands(relation.right - relation.left) for relation in self.known]
        self.ratios = [(relation, ratio) for relation in self.known if (ratio := _ratio(relation))]
        self.plain = {relation for relation, _ in self.ratios}

    def chain(self, gap: sp.Expr) -> Chain | None:
        """How ``gap`` is a sum of what is not negative."""
        for self.narrow in (True, False):
            self.until = time.thread_time() + _SECONDS
            for depth in range(1, _DEPTH + 1):
                found = self._chain(summands(gap), (), depth)
                if found is not None:
                    return found
        return None

    def _chain(self, gap: Summands, used: tuple[tuple[int, sp.Expr], ...], depth: int) -> Chain | None:
        if time.thread_time() > self.until:
            return None
        open_, matched, left = self._matched(gap)
        if open_ and used and _vanishes(gap):
            open_, matched, left = {}, [], []
        if not open_:
            return Chain(tuple(Used(self.known[i], factor) for i, factor in used), tuple(matched), tuple(left))
        if len(used) == depth:
            return None
        for index, factor in self._steps(open_, {i for i, _ in used}):
            rest = dict(gap)
            for part, value in self.gaps[index].items():
                number, monomial = monomial_of(factor * part).as_coeff_Mul(rational=True)
                rest[monomial] = rest.get(monomial, sp.Integer(0)) - number * value
            found = self._chain({m: c for m, c in rest.items() if c != 0}, (*used, (index, factor)), depth)
            if found is not None:
                return found
        return None

    def _steps(self, open_: Summands, taken: set[int]) -> Iterator[tuple[int, sp.Expr]]:
        """What is known and takes away an open summand; those of unknown sign first."""
        ways = [(monomial, list(self._ways(monomial, value, taken))) for monomial, value in open_.items()]
        ways.sort(key=lambda item: (item[0].is_nonnegative is True, not item[1], len(item[1]), str(item[0])))
        for monomial, steps in ways:
            yield from steps
            if steps and (self.narrow or not monomial.is_nonnegative):
                return

    def _ways(self, monomial: sp.Expr, value: sp.Rational, taken: set[int]) -> Iterator[tuple[int, sp.Expr]]:
        for index, gap in enumerate(self.gaps):
            if index in taken or (self.narrow and self.known[index] in self.plain):
                continue
            for part, weight in gap.items():
                if weight * value > 0 and (factor := _quotient(monomial, part)) is not None:
                    yield index, factor * value / weight

    def _matched(self, gap: Summands) -> tuple[Summands, list[Below], list[sp.Expr]]:
        """The summands that are neither positive nor below another one; the matches; and what is left."""
        above = {m: c for m, c in gap.items() if c > 0 and m.is_nonnegative}
        open_ = {m: c for m, c in gap.items() if m not in above}
        found: list[Below] = []
        for lower, value in list(open_.items()):
            if not lower.is_nonnegative:
                continue
            for upper in list(above):
                weight = min(-value, above[upper])
                item = self._below(lower, upper, weight)
                if item is None:
                    continue
                found.append(item)
                above[upper] -= weight
                value += weight
                if above[upper] == 0:
                    del above[upper]
                if value == 0:
                    del open_[lower]
                    break
                open_[lower] = value
        return open_, found, [c * m for m, c in above.items()]

    def _below(self, lower: sp.Expr, upper: sp.Expr, weight: sp.Rational) -> Below | None:
        low, up = (dict(powers(item)[1]) for item in (lower, upper))
        common = {base: exponent for base, exponent in low.items() if up.get(base) == exponent}
        low, up = ({b: e for b, e in item.items() if b not in common} for item in (low, up))
        if not all(base.is_positive for base in (*low, *up)):
            return None
        target = difference(up, low)
        key = product_of(target)
        if key not in self.logarithms:
            self.logarithms[key] = by_logarithms(target, self.ratios)
        known = self.logarithms[key]
        if known is None:
            return None
        return Below(product_of(low), product_of(up), known, weight * product_of(common))


def by_logarithms(
    target: Exponents, ratios: Sequence[tuple[Relation, Exponents]]
) -> tuple[Used, ...] | None:  # fmt: skip
    """Factors with which the logarithms of the ratios add up to that of the target; None if a few ratios do not do."""
    rest, always = _exponentials(target)
    if always is None:
        return None
    if not rest:
        return always
    usable = [*_ones(rest, ratios), *ratios]
    for size in range(1, 4):
        for chosen in itertools.combinations(usable, size):
            bases = dict.fromkeys(base for _, ratio in chosen for base in ratio)
            if not set(rest) <= set(bases):
                continue
            if (factors := _factors(rest, [ratio for _, ratio in chosen], list(bases))) is not None:
                found = tuple(Used(item[0], c) for item, c in zip(chosen, factors, strict=True) if c != 0)
                return (*found, *always)
    return None


def _exponentials(target: Exponents) -> tuple[Exponents, tuple[Used, ...] | None]:
    """What is left of the target without its exponentials, and that their product is at least 1; None if it is not."""
    rest = {base: exponent for base, exponent in target.items() if not isinstance(base, sp.exp)}
    inside = sp.Add(*(exponent * base.args[0] for base, exponent in target.items() if base not in rest))
    inside = sp.factor(sp.together(sp.expand(inside)))
    if inside == 0:
        return rest, ()
    return rest, (Used(Relation(sp.Integer(1), "<=", sp.exp(inside)), sp.Integer(1)),) if not_negative(inside) else None


def _ones(target: Exponents, ratios: Sequence[tuple[Relation, Exponents]]) -> list[tuple[Relation, Exponents]]:
    """Quotients that are at least 1 as they are built: of sums, of 1 and more, of whole numbers."""
    one = sp.Integer(1)
    whole = [base for _, ratio in ratios for base in ratio if base.is_Integer]
    found: list[tuple[Relation, Exponents]] = []
    found += [
        (Relation(one, "<=", base), {base: one}) for base in dict.fromkeys([*target, *whole]) if at_least_one(base)
    ]
    sums = [base for base in target if base.is_Add]
    found += [(Relation(low, "<=", high), {high: one, low: -one}) for low, high in itertools.permutations(sums, 2)
              if sp.expand(high - low).is_nonnegative]  # fmt: skip
    return found


def _factors(target: Exponents, ratios: Sequence[Exponents], bases: Sequence[sp.Basic]) -> list[sp.Expr] | None:
    unknown = sp.symbols(f"c:{len(ratios)}", cls=sp.Dummy)
    zero = sp.Integer(0)
    equations = [sum(c * r.get(b, zero) for c, r in zip(unknown, ratios, strict=True)) - target.get(b, zero)
                 for b in bases]  # fmt: skip
    solution = sp.solve(equations, unknown, dict=True)
    if not solution or any(c not in solution[0] for c in unknown):
        return None
    factors = [sp.factor(solution[0][c]) for c in unknown]
    return factors if all(not_negative(c) for c in factors) else None


def not_negative(expression: sp.Expr) -> bool:
    """Whether the expression is not negative as it is built, with positive integers at least 1."""
    whole = {s: 1 + sp.Dummy(s.name, integer=True, nonnegative=True) for s in expression.free_symbols
             if s.is_integer and s.is_positive}  # fmt: skip
    return bool(sp.factor(sp.expand(expression.xreplace(whole))).is_nonnegative)


def at_least_one(base: sp.Basic) -> bool:
    """Whether the base is 1 and something that is not negative."""
    return bool((base.is_Integer and base >= 1) or (base.is_Add and (base - 1).is_nonnegative))


def _ratio(relation: Relation) -> Exponents:
    """The exponents of upper / lower, where both are products of powers of what is positive."""
    if relation.left.is_Add or relation.right.is_Add or not (relation.left.is_positive and relation.right.is_positive):
        return {}
    sides = []
    for side in (relation.left, relation.right):
        factor, exponents = powers(side)
        sides.append(exponents | {sp.Integer(p): sp.Integer(e) for p, e in sp.factorrat(factor).items()})
    low, up = sides
    return difference(up, low) if all(base.is_positive for base in (*low, *up)) else {}


def _quotient(monomial: sp.Expr, part: sp.Expr) -> sp.Expr | None:
    """The quotient, if it is a product that is defined and not negative as it is built."""
    exponents = difference(powers(monomial)[1], powers(part)[1])
    for base, exponent in exponents.items():
        even = exponent.is_Integer and exponent.is_even and exponent > 0
        if not (base.is_positive or even or (base.is_nonnegative and exponent.is_positive)):
            return None
    return product_of(exponents)


def _vanishes(gap: Summands) -> bool:
    """Whether the sum is 0 as a rational function; seldom, so that a value is looked at first."""
    if not any(b.is_Add and e.is_negative for m in gap for b, e in powers(m)[1].items()):
        return False
    whole = total(gap)
    unknown = sorted({*whole.atoms(AppliedUndef), *whole.free_symbols}, key=sp.default_sort_key, reverse=True)
    values = {item: sp.Float(0.7 + 0.13 * i) for i, item in enumerate(sorted(unknown, key=lambda u: u.is_Symbol))}
    value = whole.xreplace(values).evalf()
    return bool(value.is_number and abs(value) < 1e-9) and sp.together(whole).expand() == 0


def directed(relations: Iterable[Relation]) -> Iterator[Relation]:
    """The relations as ``lower <= upper``; an equation is two of them."""
    for relation in relations:
        if relation.sign == "!=":
            continue
        item = relation.standard()
        yield Relation(item.left, "<=", item.right)
        if item.sign == "=":
            yield Relation(item.right, "<=", item.left)
