"""A goal of which little is known by contradiction: products that cannot hold with its negation, in letters for Coq."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import sympy as sp

from ptproof.proof.engines.reals import Problem
from ptproof.proof.kernel.hints.forms import forms
from ptproof.proof.kernel.hints.goals import Goal, as_factors
from ptproof.proof.kernel.hints.positivstellensatz import Product, Sign, contradiction
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation, RelationSign

# Of the right side less the left one.
_OF_GAPS: dict[str, RelationSign] = {"<=": ">=", "<": ">", "=": "="}


@dataclass
class _Written:
    """A relation between polynomials: ``top`` sign 0, once the positive ``bottom`` is multiplied away."""

    top: sp.Expr
    bottom: sp.Expr
    sign: RelationSign

    def known(self) -> Sign:
        """What is known of the polynomial, if the relation holds."""
        return Sign(self.top, _OF_GAPS[self.sign])


def refuted(goal: Goal, seconds: float) -> str:
    """The lines that close a goal between polynomials in letters; nothing if no products are found.

    Raises
    ------
    NoTranslation, NotAlgebraic, PolynomialError
        Where the goal is none.
    """
    problem = Problem(goal.relation, [item for item in goal.known if item.sign != "!="], ())
    letters = _Letters(goal, problem)
    wanted = _written(letters.seen(problem.conclusion))
    if wanted is None:
        return "solve [ sign | lra | apply Req_le; rational | apply Req_ge; rational ]"
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
        self._letters: dict[sp.Symbol, sp.Expr] = {}  # a sum stands for itself
        meanings = self._generators.meaning
        for letter, meaning in sorted(meanings.items(), key=lambda item: (-sp.count_ops(item[1]), item[0].name)):
            self._full[letter] = term(meaning, goal.names)
            if meaning.is_Add and meaning.is_polynomial():
                self._letters[letter] = meaning
                continue
            name = fresh(f"g{len(self._letters)}", self._names)
            root = isinstance(meaning, sp.Pow) and not meaning.exp.is_Integer
            own = "positive" if meaning.is_positive else "nonnegative" if root or meaning.is_nonnegative else "real"
            symbol = sp.Symbol(name, **{"real": True, own: True})
            self._letters[letter] = symbol
            self._names[symbol] = self._names[name] = name
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
            base = node.base if isinstance(node, sp.Pow) else sp.S.One
            if base.is_Add and not base.is_polynomial() and (whole := as_factors(base)) != base:
                yield f"try (same_sum {term(base, self._goal.names)} {term(whole, self._goal.names)})"
                node = sp.Pow(whole, node.exp, evaluate=False)
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
            if value != self._full.get(letter):
                yield f"try (assert ({term(power, self._full)} = {value}) by power_known)"
        for letter, symbol in self._letters.items():
            if symbol.is_Symbol:
                yield f"try (atom {symbol.name} {self._full[letter]})"
        for base in (*(base for base, _ in split), *self._roots):
            yield f"try (subst {self._full[base]})"
