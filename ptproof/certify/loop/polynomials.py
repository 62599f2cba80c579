"""Polynomials in the vehicle's variables: powers of δ, turns of the heading, powers of the filter, and letters.

A polynomial is a mapping from ``(grade, turns, power, letters)`` to a coefficient and stands for the sum of
coefficient · δ^grade · exp(i·turns·s) · q^power · the product of the letters. A letter is a function of the slow
variables alone: a partial derivative of the field or of the drift, or the bounded rest of a Taylor polynomial.
Coefficients are complex floats where W is looked for, and complex balls where its derivative is proved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

from ptproof.balls import arithmetic


class Letter(NamedTuple):
    """A function of the slow variables: ``first`` and ``second`` count its derivatives in space, ``late`` in τ."""

    name: str
    first: int = 0
    second: int = 0
    late: int = 0


Key: TypeAlias = tuple[int, int, int, tuple[Letter, ...]]
Polynomial: TypeAlias = Mapping[Key, Any]
Derivative: TypeAlias = Callable[[Letter, int], "Letter | None"]

ZERO: Polynomial = {}


def term(coefficient: Any, *letters: Letter, grade: int = 0, turns: int = 0, power: int = 0) -> Polynomial:
    """One term."""
    return {(grade, turns, power, tuple(sorted(letters))): coefficient}


def collected(items: Iterable[tuple[Key, Any]]) -> Polynomial:
    """The sum of terms; what is exactly zero is left out."""
    # Of a ball, `== 0` says that it is exactly zero; `!= 0` would say that it certainly is not.
    return {key: value for key, value in arithmetic.collected(items).items() if not value == 0}  # noqa: SIM201


def total(*parts: Polynomial) -> Polynomial:
    """The sum of polynomials."""
    return collected(item for part in parts for item in part.items())


def scaled(factor: Any, part: Polynomial, *, grade: int = 0) -> Polynomial:
    """``factor`` · δ^``grade`` · the polynomial."""
    return {(key[0] + grade, *key[1:]): value * factor for key, value in part.items()}


def product(left: Polynomial, right: Polynomial) -> Polynomial:
    """The product of two polynomials."""
    return collected(
        ((a[0] + b[0], a[1] + b[1], a[2] + b[2], _joined(a[3], b[3])), x * y)
        for a, x in left.items()
        for b, y in right.items()
    )


@lru_cache(maxsize=10_000)
def _joined(left: tuple[Letter, ...], right: tuple[Letter, ...]) -> tuple[Letter, ...]:
    return tuple(sorted(left + right))


def by_heading(part: Polynomial) -> Polynomial:
    """The partial derivative with respect to the heading s."""
    return {key: value * complex(0, key[1]) for key, value in part.items() if key[1]}


def by_filter(part: Polynomial) -> Polynomial:
    """The partial derivative with respect to the filter's deviation q."""
    return {(g, n, p - 1, letters): value * p for (g, n, p, letters), value in part.items() if p}


def by_slow(part: Polynomial, axis: int, derivative: Derivative) -> Polynomial:
    """The partial derivative with respect to a coordinate (``axis`` 0, 1) or τ (2); None is a derivative that is 0."""
    return collected(
        ((g, n, p, tuple(sorted((*letters[:at], new, *letters[at + 1 :])))), value)
        for (g, n, p, letters), value in part.items()
        for at, letter in enumerate(letters)
        if (new := derivative(letter, axis)) is not None
    )


def selected(part: Polynomial, keep: Callable[[Key], bool]) -> Polynomial:
    """The terms whose key is kept."""
    return {key: value for key, value in part.items() if keep(key)}


def real(part: Polynomial) -> Polynomial:
    """The nearest real polynomial: the coefficients of opposite turns are conjugate to each other exactly."""
    return collected(
        item for (g, n, p, letters), value in part.items() for item in _pair(g, n, p, letters, complex(value))
    )


def _pair(g: int, n: int, p: int, letters: tuple[Letter, ...], value: complex) -> list[tuple[Key, complex]]:
    if n == 0:
        return [((g, 0, p, letters), complex(value.real))]
    return [((g, n, p, letters), value), ((g, -n, p, letters), value.conjugate())] if n > 0 else []
