"""A goal by contradiction: what z3 needs of all that is known, and products that cannot hold with the goal's negation.

z3 and a linear program say what to look at; Coq multiplies out what they point to.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.definedness import domain_of
from ptproof.proof.engines.reals import Problem
from ptproof.proof.kernel.hints.bases import by_zero, lettered, signs_of_bases
from ptproof.proof.kernel.hints.cases import split
from ptproof.proof.kernel.hints.exponents import by_one_power
from ptproof.proof.kernel.hints.forms import forms
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.ground import Ground
from ptproof.proof.kernel.hints.masks import hidden, masked, put_in
from ptproof.proof.kernel.hints.needed import can_be_told, needed
from ptproof.proof.kernel.hints.ordered import ordered
from ptproof.proof.kernel.hints.positivstellensatz import SECONDS, Product, Sign, contradiction
from ptproof.proof.kernel.hints.slack import slackened
from ptproof.proof.kernel.hints.told import text_of
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Relation, RelationSign

_MOST_CASES = 2
# Of the right side less the left one.
_OF_GAPS: dict[str, RelationSign] = {"<=": ">=", "<": ">", "=": "="}


def by_refutation(goal: Goal) -> Iterator[str]:
    """Tactics for the goal from what it needs alone, if that is found."""
    match goal.relation:
        case Relation(value, "!=", sp.S.Zero):
            signs = (
                (Relation(sp.S.Zero, "<", value), "Rgt_not_eq; red"),
                (Relation(value, "<", sp.S.Zero), "Rlt_not_eq"),
            )
            found = (
                f"apply {way}; {line}"
                for item, way in signs
                for line in _refuted_from_few(replace(goal, relation=item))
            )
            yield from itertools.islice(found, 1)
        case Relation(left, "<=" | ">=", right) if left == right:
            yield "first [ apply Rle_refl | apply Rge_refl ]"
        case Relation(_, "<=" | "<" | ">=" | ">", _):
            yield from _refuted_from_few(goal)


def _refuted_from_few(goal: Goal, deeper: bool = True) -> Iterator[str]:
    """Tactics for the goal, ``deeper`` also for that what stands below a line is positive."""
    known = _with_domains(goal)
    if (core := _core(goal, known)) is None:
        return
    facts, lines = [*core, *signs_of_bases((goal.relation, *core), known)], list[str]()
    for bottom in dict.fromkeys(_bottoms((goal.relation, *core))):
        positive = Relation(sp.S.Zero, "<", bottom)
        reasons = needed(positive, known) or ()
        if deeper and not all(map(_is_linear, reasons)):
            below = _refuted_from_few(replace(goal, relation=positive, known=reasons), deeper=False)
            lines += [f"assert ({text_of(positive, goal.names)}) by (solve [ {line} ])" for line in below]
        facts += reasons
    facts = list(dict.fromkeys(facts))
    said = "".join(f"({text_of(item, goal.names)}) -> " for item in facts)
    more, focused = put_in(Goal(goal.relation, tuple(facts), goal.names))
    for before, there, seconds in _ways(focused, deeper):
        if inner := _by_cases(there, _MOST_CASES, seconds):
            yield "; ".join([f"only_from ({said}True)", *lines, *more, *before, inner])
            return


def _ways(goal: Goal, deeper: bool) -> Iterator[tuple[list[str], Goal, float]]:
    """The goal in letters, in one way after the other, with the lines for these and how long to try."""
    if deeper and (found := ordered(goal, partial(_refuted_from_few, deeper=False))) is not None:
        yield *_in_letters(*found), SECONDS
    lines, plain = _in_letters([], goal)
    more, loose = slackened(plain)
    yield lines, plain, SECONDS / 3 if more else SECONDS
    if more:
        yield [*lines, *more], loose, SECONDS


def _in_letters(lines: list[str], goal: Goal) -> tuple[list[str], Goal]:
    for step in (masked, _without_functions, masked, by_one_power, lettered):
        more, goal = step(goal)
        lines = [*lines, *more]
    return lines, goal


def follows(goal: Goal) -> bool | None:
    """Whether z3 finds that the goal follows from what is known; None if it cannot be told."""
    if not can_be_told(goal.relation):
        return None
    return _core(goal, _with_domains(goal)) is not None


def _core(goal: Goal, known: Sequence[Relation]) -> tuple[Relation, ...] | None:
    """What is needed of all that is known; sums and derivatives are looked into only if they have to be."""
    seen = hidden(Goal(goal.relation, tuple(known), goal.names))
    if (core := needed(seen.relation, seen.known)) is not None:
        return tuple(item for item, masked in zip(known, seen.known, strict=True) if masked in core)
    return needed(goal.relation, known)


def _with_domains(goal: Goal) -> list[Relation]:
    """What is known, and what holds where this and the goal are defined."""
    needs = (need for item in goal.relations() for need in domain_of(item) if not need.settled and not need.given)
    return list(dict.fromkeys([*goal.known, *(need.relation for need in needs if need.relation is not None)]))


def _is_linear(item: Relation) -> bool:
    """Whether the relation is between sums of multiples of letters: Coq puts such together by itself."""
    gap = sp.expand(item.left - item.right)
    letters = gap.free_symbols
    return not letters or bool(gap.is_polynomial() and sp.Poly(gap, *letters).total_degree() <= 1)


def _bottoms(relations: Iterable[Relation]) -> Iterator[sp.Expr]:
    """What stands below a line and has no plain sign."""
    for item in relations:
        for power in sp.Tuple(item.left, item.right).atoms(sp.Pow):
            if power.exp.is_negative and power.base.is_Add and not power.base.is_positive:
                yield power.base


def _without_functions(goal: Goal) -> tuple[list[str], Goal]:
    """Values of unknown functions, and of their derivatives, as numbers."""
    if not any(item.has(AppliedUndef, sp.Derivative) for item in goal.relations()):
        return [], goal
    ground = Ground.over(goal.names)
    relation = goal.relation.map(ground)
    spoken = [item for item in goal.known if item.has(AppliedUndef)]
    facts = [item.map(ground) for item in goal.known]
    again = [item.map(ground) for item in spoken]
    inner = Goal(relation, tuple(dict.fromkeys(facts)), ground.names)
    return [
        *ground.lines(),
        *(f"try (assert ({text_of(item, inner.names)}) by found_as)" for item in again),
        f"try (shown_as {inner.text(relation.left)} {inner.text(relation.right)})",
    ], inner


def _by_cases(goal: Goal, left: int, seconds: float) -> str:
    """Bases of powers that may be 0, minima, maxima and absolute values one after the other; nothing if one fails."""
    if left and (sides := by_zero(goal)) is not None:
        line, zero, positive = sides
        both = [_by_cases(each, left - 1, seconds) for each in (zero, positive)]
        return f"{line}; [> zero_powers; {both[0]} | positive_powers; {both[1]} ]" if all(both) else ""
    if left and (found := split(goal)) is not None:
        line, goals = found
        each = [_by_cases(case, left - 1, seconds) for case in goals]
        return f"{line}; [> {' | '.join(f'facts; {tactic}' for tactic in each)} ]" if all(each) else ""
    with contextlib.suppress(NoTranslation, NotAlgebraic, sp.PolynomialError):
        return _refuted(goal, seconds)
    return ""


@dataclass
class _Written:
    """A relation between polynomials: ``top`` sign 0, once the positive ``bottom`` is multiplied away."""

    top: sp.Expr
    bottom: sp.Expr
    sign: RelationSign

    def known(self) -> Sign:
        """What is known of the polynomial, if the relation holds."""
        return Sign(self.top, _OF_GAPS[self.sign])


def _refuted(goal: Goal, seconds: float) -> str:
    problem = Problem(goal.relation, [item for item in goal.known if item.sign != "!="], ())
    letters = _Letters(goal, problem)
    wanted = _written(letters.seen(problem.conclusion))
    if wanted is None:
        return "solve [ sign | lra ]"
    told = [fact.conclusion for fact in problem.told if not fact.hypotheses and fact.conclusion.sign != "!="]
    told += [Relation(polynomial, "=", sp.S.Zero) for _, polynomial in problem.generators.relations]
    said = (item for item in map(_written, map(letters.seen, told)) if item is not None)
    known = {item.known(): item for item in said if item.sign != "<=" or not item.top.is_nonnegative}
    closing = _closing(wanted.top, wanted.sign, known, letters, seconds) or _by_form(wanted, known, letters, seconds)
    if not closing:
        return ""
    return "; ".join([*letters.lines(), f"top_of {letters.text(wanted.top)} {letters.text(wanted.bottom)}", closing])


def _closing(
    top: sp.Expr, sign: RelationSign, known: Mapping[Sign, _Written], letters: _Letters, seconds: float
) -> str:  # fmt: skip
    """The lines by which a polynomial has its sign; nothing if none are found."""
    symbols = top.free_symbols.union(*(item.polynomial.free_symbols for item in known))
    whole = [Sign(symbol - 1, ">=") for symbol in symbols if symbol.is_integer and symbol.is_positive]
    denied = Sign(sp.expand(-top), ">" if sign == "<=" else ">=")
    if (found := contradiction([*known, *whole], denied, seconds)) is None:
        return ""
    lines = [f"deny {letters.text(denied.polynomial)}"]
    for factor in dict.fromkeys(factor for product in found for factor in product.factors):
        if (item := known.get(factor)) is not None:
            name = "equation_from" if factor.sign == "=" else "fact_from"
            lines.append(f"{name} {letters.text(item.bottom)} {letters.text(item.top)}")
    there = {(), *((sign,) for sign in (denied, *known))}
    lines += [letters.product(item) for item in found if item.symbols or item.factors not in there]
    return "; ".join([*lines, "lra"])


def _by_form(wanted: _Written, known: Mapping[Sign, _Written], letters: _Letters, seconds: float) -> str:
    """The lines by which a form of degree two in two letters is not negative: both its ends, and its determinant."""
    for form in forms(wanted.top) if wanted.sign == "<=" else ():
        a, b, c, *_ = form
        parts = [_closing(sp.expand(part), "<=", known, letters, seconds) for part in (a, c, a * c - b**2)]
        if all(parts):
            return f"form_from {' '.join(map(letters.text, form))}; [> {' | '.join(parts)} ]"
    return ""


def _written(relation: Relation) -> _Written | None:
    item = relation.standard()
    top, bottom = sp.fraction(sp.together(item.right - item.left))
    top = sp.expand(top)
    if not top.free_symbols or (top.is_Symbol and top.is_nonnegative):
        return None
    return _Written(top, bottom, item.sign)


def _upright(node: sp.Basic) -> sp.Basic:
    """The power that Coq has below the line, where it stands there."""
    below = isinstance(node, sp.Pow) and node.base.is_positive and node.exp.could_extract_minus_sign()
    return node.base**-node.exp if below else node


class _Letters:
    """The generators of a problem for Coq: powers written by them, what is known of them, and then a letter each."""

    def __init__(self, goal: Goal, problem: Problem) -> None:
        self._goal = goal
        self._generators = problem.generators
        self._names = dict(goal.names)
        self._full = dict(goal.names)
        self._letters: dict[sp.Symbol, sp.Symbol] = {}
        meanings = self._generators.meaning
        for letter, meaning in sorted(meanings.items(), key=lambda item: (-sp.count_ops(item[1]), item[0].name)):
            name = fresh(f"g{len(self._letters)}", self._names)
            root = isinstance(meaning, sp.Pow) and not meaning.exp.is_Integer
            own = "positive" if meaning.is_positive else "nonnegative" if root or meaning.is_nonnegative else "real"
            symbol = sp.Symbol(name, **{"real": True, own: True})
            self._letters[letter] = symbol
            self._names[symbol] = self._names[name] = name
            self._full[letter] = term(meaning, goal.names)
        # A letter of the goal as the power of its root.
        self._roots = {power - polynomial: power.xreplace(self._letters) for letter, polynomial
                       in self._generators.relations for power in [letter ** sp.degree(polynomial, letter)]
                       if (power - polynomial).is_Symbol and power - polynomial not in self._letters}  # fmt: skip

    def seen(self, relation: Relation) -> Relation:
        """The relation with the letters for generators that Coq will have."""
        return relation.map(lambda side: side.xreplace(self._letters).xreplace(self._roots))

    def text(self, expression: sp.Expr) -> str:
        """A polynomial for Coq."""
        return term(expression, self._names)

    def product(self, product: Product) -> str:
        """The line for a product."""
        powers = (symbol ** product.symbols.count(symbol) for symbol in dict.fromkeys(product.symbols))
        text = " * ".join(map(self.text, (*powers, *(item.polynomial for item in product.factors))))
        return f"no_product ({text})" if product.sign == "=" else f"product ({text})"

    def lines(self) -> Iterator[str]:
        """Powers by generators, what is known of these, and the letters: the outer ones first, as they hold others."""
        sides = [side for item in self._goal.relations() for side in (item.left, item.right)]
        nodes = {_upright(node) for side in sides for node in side.atoms(sp.Pow, sp.exp)
                 if isinstance(node, sp.exp) or not node.exp.is_Integer}  # fmt: skip
        for node in sorted(nodes, key=lambda node: (-sp.count_ops(node), sp.default_sort_key(node))):
            (prepared,) = self._generators.read([node])
            old, new = term(node, self._goal.names), term(self._generators.rational(prepared), self._full)
            if old != new:
                yield f"try (power_as {old} {new})"
        split = [(base, product) for base, product in self._generators.split_bases()
                 if base.is_Symbol and product not in self._letters]  # fmt: skip
        for base, product in split:
            yield f"try (assert ({self._full[base]} = {term(product, self._full)}) by by_powers)"
        for letter, polynomial in self._generators.relations:
            power = letter ** sp.degree(polynomial, letter)
            value = term(sp.expand(power - polynomial), self._full)
            yield f"try (assert ({term(power, self._full)} = {value}) by power_known)"
        for letter, symbol in self._letters.items():
            yield f"try (atom {symbol.name} {self._full[letter]})"
        for base in (*(base for base, _ in split), *self._roots):
            yield f"try (subst {self._full[base]})"
