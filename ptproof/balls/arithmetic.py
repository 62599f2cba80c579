"""What a kind of number has to offer so that a tape can run on it, and what follows from its sum and product."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from typing import Any, Protocol, TypeVar

import flint

Key = TypeVar("Key", bound=Hashable)


class Undefined(ArithmeticError):
    """An expression has no finite real enclosure there: a singularity in reach, or a function not supported."""


def collected(items: Iterable[tuple[Key, Any]]) -> dict[Key, Any]:
    """The sums of the numbers that stand at the same key."""
    sums: dict[Key, Any] = {}
    for key, value in items:
        sums[key] = sums[key] + value if key in sums else value
    return sums


class Ring:
    """Differences and the operations from the right, for numbers with ``+`` and ``*`` (also by balls) and ``-``."""

    __slots__ = ()

    def square(self: Any) -> Any:
        """The product with itself."""
        return self * self

    def __radd__(self: Any, other: Any) -> Any:
        return self + other

    def __rmul__(self: Any, other: Any) -> Any:
        return self * other

    def __sub__(self: Any, other: Any) -> Any:
        return self + (-other)

    def __rsub__(self: Any, other: Any) -> Any:
        return (-self) + other


class Arithmetic(Protocol):
    """What the instructions need of one kind of number, besides ``+`` and ``*``."""

    def constant(self, value: flint.arb) -> Any:
        """The number that is certainly in ``value``."""

    def call(self, name: str, value: Any) -> Any:
        """The function of that name in the table of tapes; raises :class:`Undefined` where it is not finite."""

    def integer_power(self, base: Any, exponent: int) -> Any:
        """``base**exponent``; raises :class:`Undefined` where a negative exponent meets zero."""

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        """``base**(numerator/denominator)`` of a base >= 0; ``nonnegative`` says that it is so by its form."""

    def power(self, base: Any, exponent: Any) -> Any:
        """``base**exponent`` of a positive base."""

    def absolute(self, value: Any) -> Any:
        """The absolute value."""

    def sign(self, value: Any) -> Any:
        """The sign, -1, 0 or 1."""

    def maximum(self, left: Any, right: Any) -> Any:
        """The larger one."""

    def minimum(self, left: Any, right: Any) -> Any:
        """The smaller one."""

    def floor(self, value: Any) -> Any:
        """The largest integer that is not above."""

    def angle(self, y: Any, x: Any) -> Any:
        """The angle of the point (x, y), in (-π, π]."""

    def either(self, values: Sequence[Any]) -> Any:
        """One of ``values``, which are branches of a Piecewise; may raise :class:`Undefined`."""

    def order(self, value: Any) -> int | None:
        """The sign of ``value`` where it is certain (0 only for exactly zero), else None."""
