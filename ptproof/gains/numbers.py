"""Exact numbers with a value: their sign, and how they are handed over."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.balls.ball import enclose, precision, separated
from ptproof.errors import InputError
from ptproof.proof.signs import sign_of
from ptproof.reading.guards import short as short

_BITS = (64, 256, 1024)


class NotApplicable(InputError):
    """A formula does not apply to these data, or a number that it needs is missing; the text says why."""


class Unlimited(NotApplicable):
    """There is no such threshold because the bound holds for every value: it counts as infinite."""


def sign(expression: sp.Expr) -> int:
    """The exact sign (−1, 0, 1) of a number; see :func:`ptproof.proof.signs.sign_of`.

    Raises
    ------
    NotApplicable
        If it is not decided: two numbers that agree to hundreds of digits and are not seen to be equal.

    Examples
    --------
    >>> sign(sp.pi - sp.Rational(22, 7)), sign(sp.sqrt(8) - 2 * sp.sqrt(2)), sign(sp.LambertW(1) - sp.Rational(1, 2))
    (-1, 0, 1)
    """
    expression = sp.sympify(expression)
    found = _sign_with_lambert(expression) if expression.has(sp.LambertW) else sign_of(expression)
    if found is None:
        raise NotApplicable(f"cannot decide the sign of {short(expression)}; change the data a little")
    return found


def _sign_with_lambert(expression: sp.Expr) -> int | None:
    """The sign where enclosures show it, each value W(c), c ≥ 0, as a ball of its own."""
    names = {node: sp.Dummy("W", real=True) for node in expression.atoms(sp.LambertW)}
    for bits in _BITS:
        with precision(bits):
            values = {name: enclose(node.args[0], bits=bits).lambertw() for node, name in names.items()}
        found = separated(expression.xreplace(names), 0, values, bits_ladder=(bits,))
        if found is not None:
            return found
    return None


def times_exponential(factor: sp.Expr, exponent: sp.Expr) -> sp.Expr:
    """``factor * exp(exponent)``, with logarithms in the exponent left there.

    SymPy would turn them into powers, of hundreds of digits where the coefficients are not simple.
    """
    if exponent.has(sp.log):
        return sp.Mul(factor, sp.exp(exponent, evaluate=False), evaluate=False)
    return factor * sp.exp(exponent)


@dataclass(frozen=True)
class Quantity:
    """An exact number or formula, with its unit-free meaning left to the key under which it stands.

    Attributes
    ----------
    exact
        The expression; a formula in ``tau`` where the quantity is a function of the stretched time.
    """

    exact: sp.Expr

    @property
    def value(self) -> float | None:
        """The nearest float, or None for a formula and for what no float can hold."""
        if self.exact.free_symbols:
            return None
        try:
            number = float(sp.N(self.exact, 20))
        except (OverflowError, TypeError):
            return None
        return number if math.isfinite(number) else None

    @property
    def text(self) -> str:
        """Six digits of the number, also where no float holds it; empty for a formula."""
        if self.exact.free_symbols:
            return ""
        value = self.value
        if value is not None:
            return f"{value:.6g}"
        try:
            return str(sp.N(self.exact, 6))
        except (OverflowError, MemoryError):
            return "too large"

    def to_json(self) -> dict[str, Any]:
        """``{"exact": text, "value": float or null}``."""
        return {"exact": str(self.exact), "value": self.value}
