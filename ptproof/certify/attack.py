"""Attacking the certified constants of a field: its quotients at exact places of the domain, by another evaluator.

Places lie on axes, diagonals and random rays, near the source, far away, at the ends of the domain, and from there
uphill and downhill. One quotient beyond a certified end is an error of ptproof.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import sympy as sp

from ptproof.certify.certificate import NAMES, FieldCertificate, Range
from ptproof.problem.field import Field
from ptproof.proof.attack import Place, WrongPromise
from ptproof.proof.attack.numbers import Number, exact, undisturbed
from ptproof.proof.attack.worth import NO_VALUE, NOT_KNOWN, as_float
from ptproof.proof.verdict import Verdict

_INNERMOST, _OUTERMOST = Fraction(1, 10**6), Fraction(10**6)


def unshaken(certificate: FieldCertificate, *, seed: int = 0, rays: int = 3) -> FieldCertificate:
    """The certificate, if no place is found that contradicts it.

    Raises
    ------
    WrongPromise
        With an exact place at which a quotient lies beyond a certified end, or the field has no value.
    """
    attack_certificate(certificate, seed=seed, rays=rays)
    return certificate


def attack_certificate(certificate: FieldCertificate, *, seed: int = 0, rays: int = 8) -> int:
    """At how many places the certificate was attacked in vain; raises as :func:`unshaken`."""
    count = 0
    for promised in (certificate, certificate.smaller):
        if promised is not None and any(getattr(promised, name) != Range() for name in NAMES):
            with undisturbed():
                count += _Attack(promised, random.Random(f"ptproof:{seed}")).run(rays)
    return count


@dataclass(frozen=True)
class _Quotient:
    """One of the two quotients, with the certified ends that no value may pass."""

    name: str
    least: float | None
    largest: float | None


class _Attack:
    def __init__(self, certificate: FieldCertificate, generator: random.Random) -> None:
        self.certificate = certificate
        self.field: Field = certificate.field
        self.random = generator
        start = Place({})
        self.source: list[Number] = [start.value(coordinate) for coordinate in self.field.source]
        domain = certificate.domain
        self.inner, self.outer = (
            None if end is None else Fraction(as_float(start.value(end))) for end in (domain.inner, domain.outer)
        )
        value, slope = "(F(x*) − F(x)) / ‖x − x*‖^2κ", "‖∇F(x)‖ / ‖x − x*‖^(2κ−1)"
        self.quotients = (
            _Quotient(value, certificate.a2.lower, certificate.a1.upper),
            _Quotient(slope, certificate.b1.lower, certificate.b2.upper),
        )

    def run(self, rays: int) -> int:
        found: list[tuple[tuple[float, float], tuple[Fraction, ...], Fraction]] = []
        for direction in self._directions(rays):
            for radius in self._radii():
                values = self._known(direction, radius)
                if values is not None:
                    found.append((values, direction, radius))
        count = len(found)
        for index, sign in product((0, 1), (1, -1)):
            if found:
                count += self._climb(index, sign, *max(found, key=lambda item: sign * item[0][index]), steps=2 * rays)
        return count

    def _known(self, direction: Sequence[Fraction], radius: Fraction) -> tuple[float, float] | None:
        try:
            return self._at(self._place(direction, radius))
        except NOT_KNOWN:
            return None

    def _directions(self, rays: int) -> Iterator[tuple[Fraction, ...]]:
        """Rational directions of about unit length."""
        n = self.field.dimension
        for i in range(n):
            for sign in (1, -1):
                yield tuple(Fraction(sign if j == i else 0) for j in range(n))
        for signs in list(product((1, -1), repeat=n))[: 2 * rays]:
            yield _scaled([Fraction(sign) for sign in signs])
        for _ in range(rays):
            yield _scaled([Fraction(self.random.randint(-99, 99), 10) for _ in range(n)])

    def _radii(self) -> Iterator[Fraction]:
        low = self.inner if self.inner else (_INNERMOST if self.outer is None else self.outer * _INNERMOST)
        high = _OUTERMOST if self.outer is None else self.outer
        nearly = Fraction(999999, 1000000)
        yield from (low / nearly, high * nearly)
        if self.outer is None:
            yield from map(Fraction, ("1/100", "1/2", "1", "3/2", "9/4", "4", "100"))
        else:
            yield from (
                low + (high - low) * share
                for share in (Fraction(1, 50), Fraction(1, 5), Fraction(1, 2), Fraction(3, 4))
            )
        drawn = Fraction(self.random.uniform(0.02, 0.98)).limit_denominator(1000)
        yield low + ((high if self.outer is not None else Fraction(20)) - low) * drawn

    def _place(self, direction: Sequence[Fraction], radius: Fraction) -> Place:
        numbers = Place({}).calculus.numbers
        values = {
            variable: numbers.add([middle, exact(part * radius)])
            for variable, middle, part in zip(self.field.variables, self.source, direction, strict=True)
        }
        return Place(values)

    def _at(self, place: Place) -> tuple[float, float] | None:
        """Both quotients there; None outside the domain. Raises WrongPromise where they pass a certified end."""
        numbers = place.calculus.numbers
        offsets = [variable - middle for variable, middle in zip(self.field.variables, self.field.source, strict=True)]
        square = place.value(sp.Add(*(sp.Pow(offset, 2) for offset in offsets)))
        if not self._inside(place, square):
            return None
        try:
            drop = numbers.sub(place.value(self.field.peak), place.value(self.field.expression))
            parts = [place.value(sp.Derivative(self.field.expression, v, evaluate=False)) for v in self.field.variables]
        except NO_VALUE as error:
            if self.certificate.verdict is not Verdict.PROVED:
                return None  # an end that is known so far says nothing of places without a value
            raise self._wrong("the field has a value there", place, str(error)) from None
        slope = numbers.power(numbers.add([numbers.mul(part, part) for part in parts]), exact(Fraction(1, 2)))
        kappa = int(self.field.kappa)
        values = (
            numbers.mul(drop, numbers.power(square, exact(-kappa))),
            numbers.mul(slope, numbers.power(square, exact(Fraction(1 - 2 * kappa, 2)))),
        )
        for quotient, value in zip(self.quotients, values, strict=True):
            if quotient.largest is not None and place.exceeds(value, quotient.largest):
                raise self._wrong(f"{quotient.name} ≤ {quotient.largest:.17g}", place, f"it is {as_float(value):.17g}")
            least = None if quotient.least is None else -Fraction(quotient.least)
            if least is not None and place.exceeds(numbers.neg(value), least):
                raise self._wrong(f"{quotient.name} ≥ {quotient.least:.17g}", place, f"it is {as_float(value):.17g}")
        return as_float(values[0]), as_float(values[1])

    def _inside(self, place: Place, square: Number) -> bool:
        numbers = place.calculus.numbers
        domain = self.certificate.domain
        ends = [(domain.inner, 1)] + ([] if domain.outer is None else [(domain.outer, -1)])
        return all(
            numbers.sign(numbers.mul(exact(side), numbers.sub(square, place.value(sp.Pow(end, 2))))) >= 0
            for end, side in ends
        )

    def _wrong(self, promise: str, place: Place, reason: str) -> WrongPromise:
        where = ", ".join(f"{v} = {as_float(place.value(v)):.17g}" for v in self.field.variables)
        verdict = "certified" if self.certificate.verdict is Verdict.PROVED else "shown"
        return WrongPromise(f"for {self.field.expression} it was {verdict} that {promise}", f"at {where} {reason}")

    def _climb(
        self, index: int, sign: int, values: tuple[float, float], direction: tuple[Fraction, ...], radius: Fraction,
        steps: int,
    ) -> int:  # fmt: skip
        """Steps from a place towards a larger or smaller quotient, each of which is looked at."""
        best, size, count = sign * values[index], Fraction(1, 4), 0
        for _ in range(steps):
            turned = _scaled([part + size * Fraction(self.random.randint(-9, 9), 9) for part in direction])
            at = radius * (1 + size * Fraction(self.random.randint(-9, 9), 10))
            reached = self._known(turned, at.limit_denominator(10**9))
            if reached is None:
                continue
            count += 1
            if sign * reached[index] > best:
                best, direction, radius = sign * reached[index], turned, at
            else:
                size *= Fraction(4, 5)
        return count


def _scaled(parts: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """The direction, about as long as 1."""
    length: Any = sum(float(part) ** 2 for part in parts) ** 0.5 or 1.0
    shorter = Fraction(length).limit_denominator(1000) or Fraction(1)
    return tuple((part / shorter).limit_denominator(1000) for part in parts)
