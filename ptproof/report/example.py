"""A witness as an example: its values put into the formula that they defeat, which stays as it is built."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.statement import All, Relation, Statement, relations_of
from ptproof.report.formula import SIGNS, Names, latex, width
from ptproof.report.printer import numbers
from ptproof.system import replaced

_ROOM, _SHORT = 60.0, 12.0
_DIGITS = (6, 9, 14, 20)
Ball: TypeAlias = tuple[sp.Expr, float]  # a number, and how far the true one may be from it
_OPAQUE = (AppliedUndef, sp.Derivative, sp.Subs)


@dataclass(frozen=True)
class Point:
    """Exact values of symbols, and of functions as an expression in their arguments, by name."""

    symbols: Mapping[sp.Symbol, sp.Expr]
    functions: Mapping[str, tuple[tuple[sp.Symbol, ...], sp.Expr]]

    def __call__(self, side: Any) -> Any:
        """The side there."""

        def ours(node: Any) -> bool:
            return isinstance(node, AppliedUndef) and node.func.__name__ in self.functions

        def put(node: Any) -> Any:
            arguments, body = self.functions[node.func.__name__]
            return body.xreplace(dict(zip(arguments, node.args, strict=True)))

        return replaced(side.replace(ours, put).doit(integrals=False), self.symbols)


@dataclass(frozen=True)
class Example:
    """What the witness makes of one relation, as LaTeX.

    Attributes
    ----------
    letters
        The names of the symbols and functions whose values stand in it.
    put
        The relation with these values in it; empty where that is too long for a line, or is what they come to.
    compared
        What both sides come to.
    """

    letters: frozenset[str]
    put: str
    compared: str


def example_of(statement: Statement, point: Point, left: Ball, right: Ball, names: Names) -> Example | None:
    """The relation whose sides at the point lie in ``left`` and ``right``, if there is one of numbers."""
    if not isinstance(statement, Relation | All):
        return None
    for part in (one for relation in relations_of(statement) for one in relation.components()):
        if part.left.has(sp.Integral, sp.Limit) or part.right.has(sp.Integral, sp.Limit):
            continue  # nothing that is checked in a line
        try:
            sides = [point(side) for side in (part.left, part.right)]
        except (TypeError, ValueError, NotImplementedError):
            continue
        if _same(sides[0], *left) and _same(sides[1], *right):
            return _shown(part, point, sides, names)
    return None


def _same(mine: Any, said: sp.Expr, radius: float) -> bool:
    """Whether a side is the number that the witness says, as far as that says it."""
    if mine.free_symbols or not mine.is_number or mine.has(sp.nan, sp.zoo, sp.oo, *_OPAQUE):
        return False
    difference = sp.N(mine - said, 20)
    return bool(difference.is_real) and abs(difference) <= max(radius, 1e-9)


def _shown(part: Relation, point: Point, values: list[Any], names: Names) -> Example | None:
    sign = SIGNS[part.sign]
    sides = [_structure(side, point, names) for side in (part.left, part.right)]
    short = _apart(values)
    put, compared = f" {sign} ".join(sides), f" {sign} ".join(short)
    if width(put) > _ROOM:
        sides = short  # then both sides are said, and not how they come about
    # A side that is a number already is said once: 3 > 2·4 = 8.
    if sides[0] == short[0] and sides[1] != short[1]:
        put, compared = "", f"{put} = {short[1]}"
    elif sides == short:
        put = ""
    used = {symbol.name for side in (part.left, part.right) for symbol in side.free_symbols}
    used |= {node.func.__name__ for side in (part.left, part.right) for node in side.atoms(AppliedUndef)}
    return Example(frozenset(used), put, compared)


def _structure(side: sp.Expr, point: Point, names: Names) -> str:
    """The side with a number in the place of each letter, and of what is a function or a derivative there."""
    masks = {node: sp.Dummy() for node in _outermost(side)}
    glyphs = {mask: numbers(point(node)) for node, mask in masks.items()}
    glyphs |= {symbol: numbers(value) for symbol, value in point.symbols.items()}
    if side in masks or side.is_Symbol:
        return latex(point(side), {})
    return latex(side.xreplace(masks), {**names, **glyphs}, dots=True)


def _outermost(side: sp.Expr) -> Iterator[sp.Expr]:
    if isinstance(side, _OPAQUE):
        yield side
        return
    for inside in side.args:
        yield from _outermost(inside)


def _apart(values: list[Any]) -> list[str]:
    """Both numbers, in as many digits as tell them apart."""
    told = (n for n in _DIGITS if str(sp.N(values[0], n)) != str(sp.N(values[1], n)))
    digits = next(told, _DIGITS[-1])
    return [_value(value, digits) for value in values]


def _value(value: sp.Expr, digits: int) -> str:
    """A number: exact where that is short, and in digits where it is no fraction."""
    exact = latex(value, {})
    if value.is_Rational and width(exact) < _SHORT:
        return exact
    about = latex(sp.Float(sp.N(value, digits), digits), {}).rstrip("0")
    return rf"{exact} \approx {about}" if width(exact) < _SHORT else about
