"""A difference as a sum: multiples of what is known, and a rest of plain sign. SymPy finds it, Coq multiplies out."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.hints.goals import Goal, as_factors, is_shown, upright
from ptproof.proof.kernel.hints.squares import sum_of_squares
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation

_MOST_OPERATIONS = 200
_MOST_FACTS = 10
_MOST_TRIES = 80
_MOST_SECONDS = 4.0


@dataclass(frozen=True)
class _Fact:
    """``top`` is not negative (positive, where strict). The line says how Coq has it from a hypothesis."""

    top: sp.Expr
    strict: bool
    line: str


@dataclass(frozen=True)
class _Sum:
    """``factor`` times the polynomial is the sum of ``weights`` times facts and a rest."""

    factor: sp.Expr
    weights: tuple[tuple[sp.Expr, _Fact], ...]
    rest: sp.Expr


def by_multiples(goal: Goal) -> Iterator[str]:
    """The goal's difference from multiples of at most two facts, after every variable with a bound is moved there."""
    relation = goal.relation.standard()
    if relation.sign not in ("<", "<="):
        return
    atoms = Atoms.over(goal.names)
    atoms.choose(side for item in goal.relations() for side in (item.left, item.right))
    wanted = relation.map(atoms)
    facts = [item.standard().map(atoms) for item in goal.known]
    for depth, moving in ((1, True), (1, False), (2, True)):
        names = dict(atoms.names)
        moved, lines = loosen(facts, names) if moving else ({}, [])
        gap = as_factors((wanted.right - wanted.left).xreplace(moved))
        start = [*atoms.lines, *lines]
        if line := _contradiction([_moved(fact, moved) for fact in facts], names):
            yield "; ".join([*start, line])
            return
        if is_shown(gap, relation.sign == "<"):
            yield "; ".join([*start, f"difference_as {term(gap, names)}"])
            return
        top, bottom = sp.fraction(gap)
        if sp.count_ops(top) > _MOST_OPERATIONS:
            continue
        useful = list(_facts([_moved(fact, moved) for fact in facts], names))
        found = _search(sp.expand(top), useful[:_MOST_FACTS], depth, relation.sign == "<", _tries())
        if found is not None:
            yield "; ".join([*start, *_lines(found, top, bottom, names)])
            return
        if depth == 1 and sum(1 for part in sp.Mul.make_args(top) if part.free_symbols) > 1:
            yield "; ".join([*start, f"factors_as {term(upright(gap), names)}"])


def _moved(fact: Relation, moved: dict[sp.Symbol, sp.Expr]) -> Relation:
    return fact.map(lambda side: side.xreplace(moved))


def _lines(found: _Sum, top: sp.Expr, bottom: sp.Expr, names: dict[sp.Basic, str]) -> Iterator[str]:
    yield f"top_of {term(top, names)} {term(bottom, names)}"
    if found.factor != 1:
        yield f"multiply_by {term(found.factor, names)}"
    for _, fact in found.weights:
        yield fact.line
    parts = [f"{term(weight, names)} * {term(fact.top, names)}" for weight, fact in found.weights]
    yield f"positive_as ({' + '.join([*parts, *([term(found.rest, names)] if found.rest != 0 else [])])})"


def _facts(relations: Sequence[Relation], names: dict[sp.Basic, str]) -> Iterator[_Fact]:
    for relation in relations:
        top, bottom = sp.fraction(as_factors(relation.right - relation.left))
        top, bottom = sp.expand(top), as_factors(bottom)
        if not top.free_symbols or relation.sign == "!=" or sp.count_ops(top) > _MOST_OPERATIONS:
            continue
        if is_shown(bottom, strictly=True):
            for sign in (1, -1) if relation.sign == "=" else (1,):
                own = sp.expand(sign * top)
                if not (own.is_Symbol and is_shown(own)):
                    line = f"fact_from {term(bottom, names)} {term(own, names)}"
                    yield _Fact(own, relation.sign == "<", line)
        elif relation.sign != "=":
            whole = as_factors(top * bottom)
            line = f"fact_by_square {term(bottom, names)} {term(top, names)} {term(whole, names)}"
            yield _Fact(whole, relation.sign == "<", line)


def _contradiction(relations: Sequence[Relation], names: dict[sp.Basic, str]) -> str:
    """The line for a fact that cannot hold."""
    for relation in relations:
        top, bottom = sp.fraction(as_factors(relation.right - relation.left))
        strict = relation.sign == "<"
        if relation.sign in ("<", "<=") and is_shown(bottom, strictly=True) and is_shown(-top, strictly=not strict):
            return f"contradicts {' '.join(term(part, names) for part in (bottom, top, sp.factor(-top)))}"
    return ""


def _search(top: sp.Expr, facts: Sequence[_Fact], depth: int, strictly: bool, tries: Iterator[bool]) -> _Sum | None:
    for fact in facts:
        for factor, weight in _weights(top, fact.top):
            if not next(tries):
                return None
            rest = as_factors(sp.expand(factor * top - weight * fact.top))
            positive = fact.strict and is_shown(weight, strictly=True)
            if is_shown(rest, strictly and not positive):
                return _Sum(factor, ((weight, fact),), rest)
            if (not strictly or positive) and (squares := sum_of_squares(rest)) is not None:
                return _Sum(factor, ((weight, fact),), squares)
            if depth > 1 and sp.count_ops(rest) < _MOST_OPERATIONS // 2:
                others = [other for other in facts if other is not fact]
                inner = _search(sp.expand(rest), others, depth - 1, strictly and not positive, tries)
                if inner is not None:
                    own = (sp.factor(inner.factor * weight), fact)
                    return _Sum(sp.factor(inner.factor * factor), (own, *inner.weights), inner.rest)
    return None


def _tries() -> Iterator[bool]:
    """Whether there may be another try."""
    start = time.thread_time()
    for count in itertools.count():
        yield count < _MOST_TRIES and time.thread_time() < start + _MOST_SECONDS


def _weights(top: sp.Expr, fact: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """A factor and a weight, both positive, such that factor top - weight fact has a term fewer in some symbol."""
    seen: set[tuple[sp.Expr, sp.Expr]] = set()
    for ratio in _ratios(top, sp.expand(fact)):
        weight, factor = sp.fraction(ratio)
        if not is_shown(factor, strictly=True) and is_shown(-factor, strictly=True):
            weight, factor = -weight, -factor
        if not is_shown(weight) or not is_shown(factor, strictly=True) or (factor, weight) in seen or weight == 0:
            continue
        seen.add((factor, weight))
        yield factor, weight


def _ratios(top: sp.Expr, fact: sp.Expr) -> Iterator[sp.Expr]:
    yield as_factors(top) / as_factors(fact)
    for symbol in sorted(fact.free_symbols, key=str):
        above = sp.Poly(top, symbol).as_dict()
        below = sp.Poly(fact, symbol).as_dict()
        if len(above) * len(below) > 12:
            continue
        for ((i,), a), ((j,), b) in itertools.product(sorted(above.items()), sorted(below.items())):
            if i >= j:
                yield as_factors(a) / as_factors(b) * symbol ** (i - j)


def loosen(facts: Sequence[Relation], names: dict[sp.Basic, str]) -> tuple[dict[sp.Symbol, sp.Expr], list[str]]:
    """Variables replaced by what they equal, or by a bound and what is above it; and the lines for Coq.

    The variable may have a factor of positive sign in the fact. ``names`` gets the names of what is above.
    """
    moved: dict[sp.Symbol, sp.Expr] = {}
    lines: list[str] = []
    for relation in facts:
        if relation.sign == "!=":
            continue
        gap = sp.expand((relation.right - relation.left).xreplace(moved))
        if is_shown(gap) and relation.sign != "=":
            continue
        if nothing := _vanishing(gap, relation.sign):
            lines.append(f"vanishes {names[nothing]}")
            moved = {old: new.xreplace({nothing: 0}) for old, new in moved.items()} | {nothing: sp.Integer(0)}
            continue
        found = _solvable(gap, relation.sign)
        if found is None:
            continue
        symbol, factor = found
        bound = as_factors(symbol - gap / factor)
        text = term(bound, names)
        if relation.sign == "=":
            value = bound
            lines.append(f"replace_by {names[symbol]} {text}")
        else:
            strict = relation.sign == "<"
            name = fresh(f"above{len(lines)}", names)
            above = sp.Symbol(name, **{"positive" if strict else "nonnegative": True})
            names[above] = name
            value = bound + above
            word = ("above" if strict else "at_least") + ("" if factor == 1 else "_by")
            scale = "" if factor == 1 else f"{term(factor, names)} "
            lines.append(f"{word} {scale}{names[symbol]} {text} {name}")
        moved = {old: new.xreplace({symbol: value}) for old, new in moved.items()} | {symbol: value}
    return moved, lines


def _vanishing(gap: sp.Expr, sign: str) -> sp.Symbol | None:
    """The symbol that is 0 because it is not negative and the gap, a negative multiple of it, is not either."""
    top, bottom = sp.fraction(as_factors(gap))
    factors = [part for part in sp.Mul.make_args(-top) if not is_shown(part, strictly=True)]
    if sign == "<=" and is_shown(bottom, strictly=True) and len(factors) == 1 and factors[0].is_Symbol:
        return factors[0] if is_shown(factors[0]) else None
    return None


def _solvable(gap: sp.Expr, sign: str) -> tuple[sp.Symbol, sp.Expr] | None:
    """A symbol that the gap holds in one term with a positive factor; for an equation with a factor 1 or -1."""
    found: list[tuple[sp.Symbol, sp.Expr]] = []
    for symbol in gap.free_symbols:
        factor = gap.coeff(symbol)
        if factor == 0 or (gap - sp.expand(factor * symbol)).has(symbol) or factor.has(symbol):
            continue
        fits = factor in (1, -1) if sign == "=" else is_shown(factor, strictly=True)
        # A sign that is known already must not be lost.
        if fits and (not is_shown(symbol) or is_shown(as_factors(symbol - gap / factor))):
            found.append((symbol, factor))

    def order(item: tuple[sp.Symbol, sp.Expr]) -> tuple[bool, bool, bool, str]:
        symbol, factor = item
        return factor not in (1, -1), symbol.name.startswith("above"), symbol.is_nonnegative is True, symbol.name

    return min(found, key=order, default=None)
