"""Changes of one scalar expression, by kind: each replaces a part of it, and says so in words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

_BOUND = (sp.Integral, sp.Sum, sp.Product, sp.Limit, sp.Subs, sp.Derivative)
_HALF = sp.Rational(1, 2)
_SHOWN = 60


@dataclass(frozen=True)
class Edit:
    """One change: what stands in an expression, and what is put there instead."""

    kind: str
    old: sp.Expr
    new: sp.Expr
    how: str = ""
    part: sp.Expr | None = None
    exchange: bool = False

    @property
    def words(self) -> str:
        """What is changed: ``how`` with the ``part`` in the place of its braces, or what was and what is."""
        if not self.how:
            return f"{short(self.old)} → {short(self.new)}"
        return self.how.format(short(self.part))

    def said(self, before: str) -> str:
        """The words, with others before them."""
        return before + self.words

    def apply(self, expression: sp.Expr) -> sp.Expr:
        """The changed expression; an exchange puts each of the two where the other stands.

        Raises
        ------
        ValueError, TypeError
            If SymPy cannot build it, such as an integral whose bound variable became a number.
        """
        change = {self.old: self.new} | ({self.new: self.old} if self.exchange else {})
        changed = expression.xreplace(change)
        bound = {node.args[1] for node in changed.atoms(sp.Limit)}.union(
            *(node.variables for node in changed.atoms(sp.Subs, sp.Derivative))
        )
        if not all(variable.is_Symbol for variable in bound):
            raise ValueError("a bound variable became an expression")  # which SymPy lets pass
        return changed


Letters: TypeAlias = Sequence[sp.Expr]
Kind: TypeAlias = Callable[[sp.Expr, Letters], Iterator[Edit]]


def short(value: Any) -> str:
    """The value as text, cut where it is long."""
    text = sp.sstr(value, order="none")  # ordering terms may take numerical integrals
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"


def with_item(items: Sequence[Any], position: int, *instead: Any) -> tuple[Any, ...]:
    """The items with others in the place of one of them, or without it."""
    return (*items[:position], *instead, *items[position + 1 :])


def edits(expression: sp.Expr, letters: Letters) -> Iterator[Edit]:
    """Every change of the expression, kind by kind; ``letters`` are the symbols and functions that may come in."""
    for kind in KINDS:
        yield from kind(expression, letters)


def parts_of(expression: sp.Expr) -> list[sp.Expr]:
    """The subexpressions, each once, from outside in; what a binder says about its variables is left out."""
    found: dict[sp.Expr, None] = {}
    waiting = [expression]
    while waiting:
        node = waiting.pop()
        if node in found or not isinstance(node, sp.Expr):
            continue
        found[node] = None
        waiting.extend(reversed(node.args[:1] if isinstance(node, _BOUND) else node.args))
    return list(found)


def coefficients(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """A term halved or doubled, the whole doubled, and a number one further."""
    if expression != 0:
        yield Edit("coefficient", expression, 2 * expression)
    for node, term in _terms(expression):
        yield Edit("coefficient", node, node - term / 2, "the term {} halved", term)
        yield Edit("coefficient", node, node + term, "the term {} doubled", term)
    for node in parts_of(expression):
        if isinstance(node, sp.Mul) and (number := node.args[0]).is_Rational and number not in (-1, _HALF):
            yield Edit("coefficient", node, node * (number.p + 1) / number.p)


def signs(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """The sign of a term, of the whole, or of the argument of a function that has one argument."""
    for node, term in _terms(expression):
        yield Edit("sign", node, node - 2 * term, "the sign of {}", term)
    if expression != 0:
        yield Edit("sign", expression, -expression)
    for node in parts_of(expression):
        if isinstance(node, sp.sin | sp.exp | sp.atan | sp.tan):
            yield Edit("sign", node, node.func(-node.args[0]))


def dropped_terms(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """A term or a factor left out."""
    for node, term in _terms(expression):
        yield Edit("term", node, node - term, "without the term {}", term)
    for node in parts_of(expression):
        if isinstance(node, sp.Mul):
            for factor in node.args:
                if not factor.is_Number:
                    yield Edit("term", node, node / factor, "without the factor {}", factor)


def exponents(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """An exponent one higher or of the other sign, a letter squared, a square root that becomes a cube root."""
    for node in parts_of(expression):
        if isinstance(node, sp.Pow):
            yield Edit("exponent", node, node.base ** (node.exp + 1))
            if node.exp not in (1, -1):
                yield Edit("exponent", node, node.base ** (node.exp - 1))
            yield Edit("exponent", node, node.base ** (-node.exp))
            if node.exp == _HALF:
                yield Edit("exponent", node, node.base ** sp.Rational(1, 3))
        elif isinstance(node, sp.Symbol | AppliedUndef):
            yield Edit("exponent", node, node**2)


def indices(expression: sp.Expr, letters: Letters) -> Iterator[Edit]:
    """A letter replaced by one of a similar name and the same declaration: a₁ by a₂, E₁₂ by E₂₁, f₁ by f₂."""
    present = [node for node in parts_of(expression) if isinstance(node, sp.Symbol | AppliedUndef)]
    for node in present:
        for other in letters:
            if isinstance(node, sp.Symbol) and isinstance(other, sp.Symbol):
                if other != node and similar(node.name, other.name) and same_kind(node, other):
                    yield Edit("index", node, other)
            elif isinstance(node, AppliedUndef) and isinstance(other, AppliedUndef):
                fits = len(node.args) == len(other.args) and node.func != other.func
                if fits and similar(node.func.__name__, other.func.__name__):
                    yield Edit("index", node, other.func(*node.args))
    for node in parts_of(expression):
        if isinstance(node, sp.Derivative):
            for other in parts_of(node.expr):
                if isinstance(other, sp.Symbol) and other not in node.variables:
                    yield Edit("index", node, sp.Derivative(node.expr, *[other] * len(node.variables)))


def exchanges(expression: sp.Expr, letters: Letters) -> Iterator[Edit]:
    """Two letters exchanged; those of one declaration first."""
    present = [node for node in parts_of(expression) if isinstance(node, sp.Symbol)]
    others = [letter for letter in letters if isinstance(letter, sp.Symbol)]
    pairs = {frozenset((a, b)): (a, b) for a in present for b in others if a != b}
    for a, b in sorted(pairs.values(), key=lambda pair: not same_kind(*pair)):
        yield Edit("exchange", a, b, f"{a} and {b} exchanged", exchange=True)


def functions(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """Another function: cosine for sine, minimum for maximum, a value for its absolute value."""
    for node in parts_of(expression):
        if (other := _OTHERS.get(type(node))) is not None:
            yield Edit("function", node, other(*node.args))
        elif isinstance(node, sp.Pow) and node.exp == _HALF:
            yield Edit("function", node, node.base)


_OTHERS: dict[type, Callable[..., sp.Expr]] = {
    sp.sin: sp.cos,
    sp.cos: sp.sin,
    sp.Max: sp.Min,
    sp.Min: sp.Max,
    sp.Abs: lambda value: value,
    sp.exp: lambda value: 1 + value,
    sp.log: lambda value: value - 1,
    sp.atan: lambda value: value,
    sp.tan: lambda value: value,
}


def orders(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """A derivative once more or once less, and a whole number one further."""
    for node in parts_of(expression):
        if isinstance(node, sp.Derivative):
            yield Edit("order", node, sp.Derivative(node.expr, *node.variables, node.variables[-1]))
            fewer = node.variables[:-1]
            yield Edit("order", node, sp.Derivative(node.expr, *fewer) if fewer else node.expr)
        elif isinstance(node, sp.Symbol) and node.is_integer:
            yield Edit("order", node, node + 1)
    if expression.is_Rational and expression != 0:
        yield Edit("order", expression, (expression.p + 1) / sp.Integer(expression.q))


def ends(expression: sp.Expr, _: Letters) -> Iterator[Edit]:
    """The side or the point of a limit, the ends of an integral, the point at which something is taken."""
    for node in parts_of(expression):
        if isinstance(node, sp.Limit):
            inner, variable, point, side = node.args
            if point.is_finite is not False:
                yield Edit("limit", node, sp.Limit(inner, variable, point, "-" if str(side) == "+" else "+"))
                yield Edit("limit", node, sp.Limit(inner, variable, point + 1, str(side)))
                yield Edit("limit", node, sp.Limit(inner, variable, sp.oo))
            else:
                yield Edit("limit", node, sp.Limit(inner, variable, -point))
                yield Edit("limit", node, sp.Limit(inner, variable, sp.Integer(0), "+"))
        elif isinstance(node, sp.Integral):
            for i, (variable, *span) in enumerate(node.limits):
                if len(span) == 2:
                    yield from _other_spans(node, i, variable, *span)
        elif isinstance(node, sp.Subs):
            for i, point in enumerate(node.point):
                yield Edit("point", node, sp.Subs(node.expr, node.variables, with_item(node.point, i, point + 1)))


def _other_spans(node: sp.Integral, place: int, variable: sp.Symbol, low: sp.Expr, high: sp.Expr) -> Iterator[Edit]:
    spans = [(low, high / 2) if high.is_finite is not False else (low, low + 1), (low + 1, high), (high, low)]
    for span in spans:
        yield Edit("integral", node, sp.Integral(node.function, *with_item(node.limits, place, (variable, *span))))


def additions(expression: sp.Expr, letters: Letters) -> Iterator[Edit]:
    """One added, and a small multiple of each letter."""
    yield Edit("plus", expression, expression + 1)
    yield Edit("plus", expression, expression - sp.Rational(1, 100))
    for letter in letters:
        if isinstance(letter, sp.Symbol):
            yield Edit("plus", expression, expression + letter / 100)
            yield Edit("plus", expression, expression - letter / 100)


KINDS: tuple[Kind, ...] = (
    coefficients, signs, exponents, indices, exchanges, functions, orders, ends, additions, dropped_terms
)  # fmt: skip


def similar(name: str, other: str) -> bool:
    """Whether two names are easily taken for each other: one stem, or one character apart.

    >>> similar("a1", "a2"), similar("E12", "E21"), similar("t0", "tau"), similar("V", "V0"), similar("a1", "k")
    (True, True, False, True, False)
    """
    stems = [re.sub(r"[\d_'].*$", "", word) for word in (name, other)]
    near = len(name) == len(other) > 1 and sum(a != b for a, b in zip(name, other, strict=True)) == 1
    return name != other and (near or (stems[0] == stems[1] != ""))


def same_kind(symbol: sp.Symbol, other: sp.Symbol) -> bool:
    """Whether two symbols are declared alike."""
    return bool(symbol.assumptions0 == other.assumptions0)


def _terms(expression: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """Each term of each sum in the expression, with its sum."""
    for node in parts_of(expression):
        if isinstance(node, sp.Add):
            for term in node.args:
                yield node, term
