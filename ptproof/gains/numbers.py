"""Exact numbers with a value: their sign, and how they are handed over."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.balls.ball import separated
from ptproof.errors import InputError
from ptproof.proof.algebra import NotAlgebraic, is_zero


class NotApplicable(InputError):
    """A formula does not apply to these data, or a number that it needs is missing; the text says why."""


def sign(expression: sp.Expr) -> int:
    """The exact sign (−1, 0, 1) of a number, by disjoint enclosures or by exact algebra.

    Raises
    ------
    NotApplicable
        If neither decides: two numbers that agree to hundreds of digits and are not seen to be equal.

    Examples
    --------
    >>> sign(sp.pi - sp.Rational(22, 7)), sign(sp.sqrt(8) - 2 * sp.sqrt(2))
    (-1, 0)
    """
    expression = sp.sympify(expression)
    if expression.is_Rational:
        return int(sp.sign(expression))
    if expression.has(sp.CRootOf):  # isolated exactly by SymPy, to the digits asked for
        near = expression.evalf(50)
        if abs(near) > sp.Float("1e-40"):
            return 1 if near > 0 else -1
    else:
        found = separated(expression, 0)
        if found is not None:
            return found
    try:
        if sp.expand(expression) == 0 or is_zero(expression):
            return 0
    except NotAlgebraic:
        pass
    raise NotApplicable(f"cannot decide the sign of {short(expression)}; change the data a little")


def short(expression: Any) -> str:
    """The text of an expression, cut to 60 characters."""
    text = str(expression)
    return text if len(text) <= 60 else text[:57] + "..."


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
