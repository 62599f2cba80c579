"""Signs and zeros, decided: by enclosures that exclude zero, by exact algebra, by what symbols are declared to be."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.balls.ball import ball_from, interval, precision, separated
from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.declarations import Letter, declared
from ptproof.proof.statement import MEANING, Relation

_BITS = (64, 128, 256, 1024)
_BOUND = (sp.Derivative, sp.Integral, sp.Limit, sp.Sum, sp.Product, sp.Subs)
_ORDINARY = {"real", "positive", "nonnegative", "negative", "nonpositive", "nonzero", "rational", "integer", "finite"}


def vanishes(expression: Any) -> bool:
    """Whether it is shown that ``expression`` is 0 wherever it is defined; False says only that it is not shown.

    Where it is certainly another number at some exact values, nothing more is asked. Otherwise the normal form of exact
    algebra is (:func:`ptproof.proof.algebra.is_zero`); products of roots of numbers are then also multiplied out. A
    floating-point number, a limit or a sum shows nothing, and neither does
    a quotient whose denominator vanishes identically.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> vanishes(sp.cos(x) ** 2 + sp.sin(x) ** 2 - 1), vanishes((1 + sp.sqrt(2)) * sp.sqrt(3) - sp.sqrt(3) - sp.sqrt(6))
    (True, True)
    >>> vanishes(x), vanishes(sp.Float(0))
    (False, False)
    """
    expression = sp.sympify(expression)
    if _differs(expression):
        return False
    try:
        if is_zero(expression):
            return True
        numerator, denominator = sp.fraction(sp.together(expression))
        return bool(sp.expand(numerator) == 0) and not is_zero(denominator)
    except NotAlgebraic:
        return False


def _differs(expression: sp.Expr) -> bool:
    """Whether an enclosure excludes 0 at exact values that the letters of the expression may have."""
    if not isinstance(expression, sp.Expr) or expression.has(*_BOUND):
        return False
    applied = sorted(expression.atoms(AppliedUndef), key=str)
    if len({node.func for node in applied}) < len(applied):
        return False  # two arguments may be the same in other words, and then so are the two values
    masks = {node: sp.Dummy("value", real=True) for node in applied}
    masked = expression.xreplace(masks)
    meaning = {mask: node for node, mask in masks.items()}
    letters = sorted(masked.free_symbols, key=lambda letter: str(meaning.get(letter, letter)))
    values = {letter: _example(meaning.get(letter, letter), place) for place, letter in enumerate(letters)}
    return bool(values) and None not in values.values() and separated(masked, 0, values, (64,)) is not None


def _example(letter: Letter, place: int) -> sp.Rational | None:
    """A number that the letter may stand for, another one in each place; None where its declaration says more."""
    kind = declared(letter)
    if not all(kind.values()) or not kind.keys() <= _ORDINARY:
        return None
    number = sp.Integer(place + 2) if "integer" in kind else sp.Rational(sp.prime(place + 5), 7)
    return -number if kind.keys() & {"negative", "nonpositive"} else number


def sign_of(expression: Any) -> int | None:
    """The sign (−1, 0 or 1) of an exact number, or of an expression whose symbols' declarations fix it; else None.

    An answer is certain: a number differs from 0 because an enclosure of it does (a root of a polynomial,
    ``CRootOf``, is isolated between rational numbers), and is 0 because exact algebra says so. None says only that
    nothing decided, as for two numbers that agree to hundreds of digits and are not seen to be equal, or for what has
    no real value.

    Examples
    --------
    >>> sign_of(sp.pi - sp.Rational(22, 7)), sign_of(sp.sqrt(8) - 2 * sp.sqrt(2)), sign_of(sp.I)
    (-1, 0, None)
    >>> k, x = sp.Symbol("k", positive=True), sp.Symbol("x", real=True)
    >>> sign_of(k * x**2 + k), sign_of(k * x**2)
    (1, None)
    >>> sign_of(sp.CRootOf(x**5 - x - 1, 0) - 1)
    1
    """
    expression = sp.sympify(expression)
    if expression.is_Rational:
        return int(sp.sign(expression))
    if expression.free_symbols or expression.has(AppliedUndef):
        found = 1 if expression.is_positive else -1 if expression.is_negative else None
    else:
        found = _sign_by_enclosure(expression)
    return 0 if found is None and vanishes(expression) else found


def holds(relation: Relation) -> bool:
    """Whether a relation between two exact numbers is certain."""
    difference = relation.left - relation.right
    sign = None if difference.free_symbols else sign_of(difference)
    return sign is not None and bool(MEANING[relation.sign](sign, 0))


def _sign_by_enclosure(number: sp.Expr) -> int | None:
    """The sign of a number that an enclosure separates from 0."""
    roots = sorted(number.atoms(sp.CRootOf), key=sp.default_sort_key)
    if not roots:
        return separated(number, 0, bits_ladder=_BITS)
    if not all(root.is_real for root in roots):
        return None
    names = [sp.Dummy(f"root{i}", real=True) for i in range(len(roots))]
    masked = number.xreplace(dict(zip(roots, names, strict=True)))
    for bits in _BITS:
        radius = sp.Rational(1, 2**bits)
        with precision(2 * bits):
            middles = [root.eval_rational(dx=radius) for root in roots]
            ends = [[ball_from(middle + side * radius) for side in (-1, 1)] for middle in middles]
            values = {name: interval(*pair) for name, pair in zip(names, ends, strict=True)}
        found = separated(masked, 0, values, bits_ladder=(bits,))
        if found is not None:
            return found
    return None
