"""Sums of s^n cos(r s) and s^n sin(r s) with exact coefficients: the class in which dithers are integrated.

The class is closed under products and antiderivatives, and both are finite algebra, so no integrator is
trusted (SymPy's returns wrong values for some integrals over a full period).
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided
from ptproof.proof.signs import sign_of

_HIGHEST_POWER = 64
Key = tuple[int, sp.Expr]
Pair = tuple[sp.Expr, sp.Expr]


@dataclass(frozen=True)
class QuasiPolynomial:
    """Σ s^n (a cos(r s) + b sin(r s)), stored as {(n, r): (a, b)} with exact r ≥ 0 and a, b free of s."""

    terms: dict[Key, Pair] = field(default_factory=dict)

    @classmethod
    def constant(cls, value: Any) -> QuasiPolynomial:
        return cls.collect([((0, sp.S.Zero), (sp.sympify(value), sp.S.Zero))])

    @classmethod
    def collect(cls, items: Iterable[tuple[Key, Pair]]) -> QuasiPolynomial:
        """The sum of ``items``; like terms are merged and zero terms dropped."""
        sums: dict[Key, tuple[list[sp.Expr], list[sp.Expr]]] = {}
        for key, (a, b) in items:
            cosines, sines = sums.setdefault(key, ([], []))
            cosines.append(a)
            sines.append(b)
        terms = {}
        for key, (cosines, sines) in sums.items():
            a, b = (_short(sp.Add(*entries)) for entries in (cosines, sines))
            b = sp.S.Zero if key[1] == 0 else b
            if a != 0 or b != 0:
                terms[key] = (a, b)
        return cls(terms)

    def __add__(self, other: QuasiPolynomial) -> QuasiPolynomial:
        return self.collect([*self.terms.items(), *other.terms.items()])

    def scale(self, factor: sp.Expr) -> QuasiPolynomial:
        return self.collect((key, (factor * a, factor * b)) for key, (a, b) in self.terms.items())

    def __mul__(self, other: QuasiPolynomial) -> QuasiPolynomial:
        items: list[tuple[Key, Pair]] = []
        for (n, r), (a, b) in self.terms.items():
            for (m, q), (c, d) in other.terms.items():
                # 2 cos·cos = cos(r−q) + cos(r+q) and its companions.
                items.append(_signed(n + m, r - q, (a * c + b * d) / 2, (b * c - a * d) / 2))
                items.append(((n + m, r + q), ((a * c - b * d) / 2, (a * d + b * c) / 2)))
        return self.collect(items)

    def antiderivative(self) -> QuasiPolynomial:
        """An antiderivative, by parts: ∫ s^n cos = s^n sin/r − (n/r) ∫ s^(n−1) sin, and its companion."""
        items: list[tuple[Key, Pair]] = []
        for (n, r), (a, b) in self.terms.items():
            if r == 0:
                items.append(((n + 1, r), (a / (n + 1), sp.S.Zero)))
                continue
            while n >= 0:
                items.append(((n, r), (-b / r, a / r)))
                a, b, n = n * b / r, -n * a / r, n - 1
        return self.collect(items)

    def at(self, point: sp.Expr) -> sp.Expr:
        """The exact value at s = ``point``."""
        return _short(self.expression(point))

    def expression(self, variable: sp.Expr) -> sp.Expr:
        """The sum as a SymPy expression in ``variable``."""
        return sp.Add(
            *(
                variable**n * (a * sp.cos(r * variable) + b * sp.sin(r * variable))
                for (n, r), (a, b) in self.terms.items()
            )
        )

    @property
    def is_trigonometric_polynomial(self) -> bool:
        return all(n == 0 for n, _ in self.terms)


def read(expression: sp.Expr, variable: sp.Symbol, where: str) -> QuasiPolynomial:
    """The normal form of ``expression`` in ``variable``; everything else in it is a coefficient.

    Raises :class:`AveragingUndecided`, naming ``where``, for anything outside the class, and
    :class:`AveragingRefused` for a frequency that is not a number.
    """
    if variable not in expression.free_symbols:
        return QuasiPolynomial.constant(expression)
    if expression == variable:
        return QuasiPolynomial({(1, sp.S.Zero): (sp.S.One, sp.S.Zero)})
    if isinstance(expression, sp.Add):
        return QuasiPolynomial.collect(
            item for entry in expression.args for item in read(entry, variable, where).terms.items()
        )
    if isinstance(expression, sp.Mul):
        constant, rest = expression.as_independent(variable, as_Add=False)
        factors = (read(factor, variable, where) for factor in sp.Mul.make_args(rest))
        return math.prod(factors, start=QuasiPolynomial.constant(constant))
    if isinstance(expression, sp.Pow) and expression.exp.is_Integer and 0 < expression.exp <= _HIGHEST_POWER:
        base = read(expression.base, variable, where)
        return math.prod([base] * int(expression.exp), start=QuasiPolynomial.constant(1))
    if isinstance(expression, sp.sin | sp.cos):
        return _sinusoid(expression, variable, where)
    raise AveragingUndecided(
        f"{where}: no exact integral is known here for {expression}; dithers are sums of products of sines and "
        "cosines, or Piecewise, Abs, sign, Max, Min, Mod and floor of such and of polynomials in the phase"
    )


def linear_part(expression: sp.Expr, variable: sp.Symbol) -> tuple[sp.Expr, sp.Expr] | None:
    """(a, c) if ``expression`` is a·variable + c with a and c free of the variable, else None."""
    slope = sp.expand(sp.diff(expression, variable))
    if variable in slope.free_symbols:
        return None
    return slope, sp.expand(expression - slope * variable)


def _sinusoid(expression: sp.Expr, variable: sp.Symbol, where: str) -> QuasiPolynomial:
    linear = linear_part(expression.args[0], variable)
    if linear is None:
        raise AveragingUndecided(f"{where}: the argument of {expression} is not linear in the phase")
    rate, offset = linear
    if not rate.is_number:
        raise AveragingRefused(
            "D", where, f"the frequency of {expression} depends on a symbol, so that no period holds for all its values"
        )
    cosine, sine = sp.cos(offset), sp.sin(offset)
    if isinstance(expression, sp.cos):
        return QuasiPolynomial.collect([_signed(0, rate, cosine, -sine)])
    return QuasiPolynomial.collect([_signed(0, rate, sine, cosine)])


def _signed(n: int, rate: sp.Expr, a: sp.Expr, b: sp.Expr) -> tuple[Key, Pair]:
    """a cos(rate s) + b sin(rate s) with the sign of the rate taken out of the sine."""
    sign = exact_sign(rate)
    return ((n, sp.S.Zero) if sign == 0 else (n, rate if sign > 0 else -rate)), (a, b if sign >= 0 else -b)


def exact_sign(number: sp.Expr) -> int:
    """−1, 0 or 1 for an exact real number; raises :class:`AveragingUndecided` where it can't be told."""
    sign = sign_of(number)
    if sign is None:
        raise AveragingUndecided(f"the sign of {number} can't be told")
    return sign


def ordered(points: Iterable[sp.Expr]) -> list[sp.Expr]:
    """Exact real numbers from the smallest on, each once."""

    def compared(first: sp.Expr, second: sp.Expr) -> int:
        return exact_sign(first - second)

    found: list[sp.Expr] = []
    for point in sorted(points, key=functools.cmp_to_key(compared)):
        if not found or exact_sign(point - found[-1]) > 0:
            found.append(point)
    return found


def _short(value: sp.Expr) -> sp.Expr:
    return value if value.is_Rational else sp.expand_mul(value)
