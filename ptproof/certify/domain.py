"""Where a field is looked at: a ball around the source, an annulus, or the whole space."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sp

from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.problem.field import Field
    from ptproof.proof.statement import Relation


@dataclass(frozen=True)
class Domain:
    """All points with ``inner`` ≤ ‖x − x*‖ ≤ ``outer``, x* itself left out.

    ``inner`` is exact and at least 0; ``outer`` is exact and larger, or None for no limit.

    Raises
    ------
    InputError
        If a radius is not an exact real number, negative, or not larger than the inner one.

    Examples
    --------
    >>> print(Domain(), Domain(outer=sp.sqrt(2)), sep="; ")
    the whole space; the ball ‖x − x*‖ ≤ sqrt(2)
    """

    inner: sp.Expr = sp.S.Zero
    outer: sp.Expr | None = None

    def __post_init__(self) -> None:
        from ptproof.balls.ball import separated

        for name in ("inner", "outer"):
            value = getattr(self, name)
            if value is None:
                continue
            if isinstance(value, bool | float | str):
                raise InputError(f"the radius must be exact, not {value!r}: give an integer or a fraction")
            value = sp.sympify(value)
            if not isinstance(value, sp.Expr) or value.free_symbols or not value.is_real or value.has(sp.Float):
                raise InputError(f"the radius must be an exact real number, not {value}")
            object.__setattr__(self, name, value)
        if not self.inner.is_zero and separated(self.inner, 0) != 1:
            raise InputError(f"the inner radius must not be negative, but is {self.inner}")
        if self.outer is not None and separated(self.outer, self.inner) != 1:
            raise InputError(f"the radius must be larger than {self.inner}, but is {self.outer}")

    @staticmethod
    def of(radius: Any = None, annulus: tuple[Any, Any] | None = None) -> Domain:
        """The domain from the two options that a person gives."""
        if annulus is None:
            return Domain(sp.Integer(0), radius)
        if radius is not None:
            raise InputError("give either a radius or an annulus, not both")
        inner, outer = annulus
        if outer is None:
            raise InputError("an annulus needs an outer radius")
        return Domain(inner, outer)

    def contains(self, offset: Sequence[sp.Expr]) -> bool:
        """Whether x* + offset certainly belongs to it; exact coordinates."""
        from ptproof.balls.ball import separated

        square = sum((entry**2 for entry in offset), sp.Integer(0))
        if square == 0:
            return False
        low = self.inner == 0 or separated(square, self.inner**2) == 1 or square == self.inner**2
        return low and (self.outer is None or square == self.outer**2 or separated(square, self.outer**2) == -1)

    def relations(self, field: Field) -> tuple[Relation, ...]:
        """What holds for the squared distance from the source of ``field`` on the domain."""
        from ptproof.proof.statement import ge, le

        square = sp.Add(*((x - s) ** 2 for x, s in zip(field.variables, field.source, strict=True)))
        above = () if self.has_source else (ge(square, self.inner**2),)
        return above if self.outer is None else (*above, le(square, self.outer**2))

    @property
    def has_source(self) -> bool:
        """Whether points arbitrarily near the source belong to it."""
        return bool(self.inner == 0)

    def __str__(self) -> str:
        return self._text(str)

    @property
    def readable(self) -> str:
        """As ``str``, with decimals beside radii that are no integers."""
        return self._text(_with_decimals)

    def _text(self, shown: Callable[[sp.Expr], str]) -> str:
        if self.outer is None:
            return "the whole space" if self.has_source else f"‖x − x*‖ ≥ {shown(self.inner)}"
        if self.has_source:
            return f"the ball ‖x − x*‖ ≤ {shown(self.outer)}"
        return f"the annulus {shown(self.inner)} ≤ ‖x − x*‖ ≤ {shown(self.outer)}"


def _with_decimals(value: sp.Expr) -> str:
    if value.is_Integer:
        return str(value)
    near = f"{float(value):.6g}"
    return f"{value} ({'' if value == sp.Rational(near) else 'about '}{near})"
