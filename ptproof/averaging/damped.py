"""Functions of the phase between switches: powers, sines and cosines, and exponentials that decay as linear filters do.

A filter that is driven by a dither with jumps answers, between two jumps, by what the dither is plus a free motion.
So the basis has the free motions too, and then it is closed under products, antiderivatives and periodic responses.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterable, Mapping, Sequence

import sympy as sp

from ptproof.averaging.quasipolynomial import QuasiPolynomial, exact_sign, ordered
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.ring import Coefficient, Ring
from ptproof.averaging.signal import Signal, read_signal
from ptproof.averaging.waves import Harmonics, Key, Phases, Terms
from ptproof.proof.kinks import innermost
from ptproof.proof.signs import sign_of

Turns = tuple[int, ...]


class Pieces(Phases):
    """φ^n e^(a(φ − φ_p)) cos(rφ), key (p, n, r, 0, k), and with sin (p, n, r, 1, k), on the piece p, 0 elsewhere.

    φ_p is the end of the piece, so that nothing in it is larger than at its end, and a = Σ k_c μ_c ≥ 0 for the decay
    rates μ_c of the filters. ``turns[i]`` says how often each of these stands in the rate of the i-th fast state.

    Parameters
    ----------
    ring, phase, period
        As for :class:`~ptproof.averaging.waves.Phases`.
    points
        Where the pieces end, from 0 to the period.
    decays
        The rate at which each fast state decays in the phase, positive; those whose ratio is rational share a unit.
    """

    def __init__(
        self, ring: Ring, phase: sp.Symbol, period: sp.Expr, points: Sequence[sp.Expr], decays: Sequence[sp.Expr] = ()
    ) -> None:
        super().__init__(ring, phase, period)
        self.points = tuple(points)
        self._units, self.turns = _shared(decays)
        self.response = functools.cache(self._response)

    @functools.cached_property
    def _spans(self) -> list[tuple[sp.Expr, int]]:
        """The length of each piece as a unit and how often it stands in it."""
        units, counts = _shared([end - start for start, end in itertools.pairwise(self.points)])
        return [(units[place], count) for places in counts for place, count in enumerate(places) if count]

    @property
    def _still(self) -> Turns:
        return (0,) * len(self._units)

    @property
    def one(self) -> Terms:
        return tuple(((p, 0, sp.S.Zero, 0, self._still), self.ring.one) for p in range(len(self.points) - 1))

    def read(self, expression: sp.Expr, where: str) -> Terms:
        signal = read_signal(expression, self.phase, self.period, where)
        result: list[tuple[Key, Coefficient]] = []
        place = 0
        for p, end in enumerate(self.points[1:]):
            result.extend(self._keyed(p, signal.pieces[place], self._still))
            place += place + 1 < len(signal.pieces) and exact_sign(signal.points[place + 1] - end) <= 0
        return tuple(result)

    def _keyed(self, p: int, piece: QuasiPolynomial, turns: Turns) -> Terms:
        return tuple(
            ((p, n, rate, kind, turns), self.ring.read(value))
            for (n, rate), values in piece.terms.items()
            for kind, value in enumerate(values)
            if value != 0
        )

    def expression(self, terms: Mapping[Key, sp.Expr]) -> sp.Expr:
        if all(key[4] == self._still for key in terms):
            pieces = [
                QuasiPolynomial.collect(
                    ((n, rate), (sp.S.Zero, value) if kind else (value, sp.S.Zero))
                    for (q, n, rate, kind, _), value in terms.items()
                    if q == p
                )
                for p in range(len(self.points) - 1)
            ]
            same = all(piece == pieces[0] for piece in pieces)
            points, pieces = ((self.points[0], self.points[-1]), pieces[:1]) if same else (self.points, pieces)
            return Signal(self.period, points, tuple(pieces)).expression(self.phase)
        inside = self.phase - self.period * sp.floor(self.phase / self.period)
        branches = []
        for p, end in enumerate(self.points[1:]):
            parts = (
                value * inside**n * (sp.sin, sp.cos)[1 - kind](r * inside) * sp.exp(self._rate(k) * (inside - end))
                for (q, n, r, kind, k), value in terms.items()
                if q == p
            )
            branches.append((sp.Add(*parts), inside < end))
        return sp.Piecewise(*branches[:-1], (branches[-1][0], True))

    def _rate(self, turns: Turns) -> sp.Expr:
        return sp.Add(*(count * unit for count, unit in zip(turns, self._units, strict=True)))

    def _decay(self, place: int, turns: Turns) -> Coefficient:
        """e^(−a · length) of one piece; the same powers of few generators for all pieces."""
        unit, count = self._spans[place]
        result = self.ring.one
        for power, rate in zip(turns, self._units, strict=True):
            if power:
                result *= self.ring.read(sp.exp(-sp.cancel(rate * unit))) ** (power * count)
        return result

    def _multiply(self, first: Key, second: Key) -> Terms:
        if first[0] != second[0]:
            return ()
        one, other = (
            QuasiPolynomial({(n, rate): (sp.S.Zero, sp.S.One) if kind else (sp.S.One, sp.S.Zero)})
            for _, n, rate, kind, _ in (first, second)
        )
        turns = tuple(a + b for a, b in zip(first[4], second[4], strict=True))
        return self._keyed(first[0], one * other, turns)

    def _at_ends(self, terms: Iterable[tuple[Key, Coefficient]]) -> tuple[Coefficient, Coefficient]:
        """The values at the start and at the end of the piece of functions on one and the same piece."""
        start, end = self.ring.zero, self.ring.zero
        for (p, n, r, kind, k), value in terms:
            function = (sp.cos, sp.sin)[kind]
            left, right = (point**n * function(sp.expand(r * point)) for point in self.points[p : p + 2])
            start += self.ring.reduced(value * self.ring.read(sp.expand(left)) * self._decay(p, k))
            end += value * self.ring.read(sp.expand(right))
        return self.ring.reduced(start), self.ring.reduced(end)

    def _antiderivative(self, key: Key, lower: Turns | None = None) -> Terms:
        """Of the function, on its piece; with ``lower`` the solution w of w′ − a_lower w = the function instead."""
        p, n, r, kind, turns = key
        apart = turns if lower is None else tuple(a - b for a, b in zip(turns, lower, strict=True))
        rate = self._not_zero(apart) if r == 0 and any(apart) else self._rate(apart)
        if r == 0 and not any(apart):
            return (((p, n + 1, r, kind, turns), self.ring.number(sp.Rational(1, n + 1))),)
        below, result = rate**2 + r**2, []
        cosine, sine = (sp.S.One, sp.S.Zero) if kind == 0 else (sp.S.Zero, sp.S.One)
        for power in range(n, -1, -1):
            a, b = (
                sp.factor(sp.cancel(above / below)) for above in (rate * cosine - r * sine, rate * sine + r * cosine)
            )
            values = (a, sp.S.Zero if r == 0 else b)
            result += [((p, power, r, i, turns), self.ring.read(v)) for i, v in enumerate(values) if v != 0]
            cosine, sine = (-power * value for value in values)
        return tuple(result)

    def _not_zero(self, turns: Turns) -> sp.Expr:
        """The rate, if it is shown not to vanish: where it does, the response has another form."""
        rate = self._rate(turns)
        if min(turns) >= 0 or max(turns) <= 0 or sign_of(rate) in (-1, 1):
            return rate
        raise AveragingUndecided(
            f"whether {sp.factor(rate)} vanishes, a resonance of the fast states among themselves, depends on symbols"
        )

    def _mean(self, key: Key) -> Coefficient:
        start, end = self._at_ends(self._antiderivative(key))
        return self.ring.reduced((end - start) * self.ring.read(1 / self.period))

    def _primitive(self, key: Key) -> Terms:
        own, place, still = self._antiderivative(key), key[0], self._still
        start, end = self._at_ends(own)
        mean = self.ring.reduced((end - start) * self.ring.read(1 / self.period))
        sums: dict[Key, Coefficient] = dict(own)
        for p in range(len(self.points) - 1):
            level = self.ring.zero if p < place else -start if p == place else end - start
            for power, value in ((0, level), (1, -mean)):
                entry = (p, power, sp.S.Zero, 0, still)
                sums[entry] = sums.get(entry, self.ring.zero) + value
        shift = self.ring.reduced(sum((value * self.mean(entry) for entry, value in sums.items()), self.ring.zero))
        for entry, one in self.one:
            sums[entry] = sums[entry] - shift * one
        return self._without_zeros(sums)

    def _response(self, key: Key, lower: Turns) -> Terms:
        """The periodic and continuous w with w′ − a w = −function, where a is the rate of ``lower``, not 0."""
        ring, last = self.ring, len(self.points) - 1
        own = tuple((entry, -value) for entry, value in self._antiderivative(key, lower))
        start, end = self._at_ends(own)
        place = key[0]
        jumps = [ring.zero] * last  # [p]: what the free motion has to make up for at the end of the piece p
        jumps[place] -= end
        jumps[(place - 1) % last] += start
        decays = [self._decay(p, lower) for p in range(last)]
        along, total = ring.one, ring.zero
        for p in range(last):
            total += along * jumps[p]
            along *= decays[(p + 1) % last]
        free = [ring.zero] * last
        free[0] = ring.reduced(total * ring.inverse(ring.one - math.prod(decays, start=ring.one)))
        for p in range(last - 1, 0, -1):
            free[p] = ring.reduced(jumps[p] + decays[(p + 1) % last] * free[(p + 1) % last])
        sums = dict(own)
        for p, value in enumerate(free):
            entry = (p, 0, sp.S.Zero, 0, lower)
            sums[entry] = sums.get(entry, ring.zero) + value
        return self._without_zeros(sums)

    def _without_zeros(self, sums: Mapping[Key, Coefficient]) -> Terms:
        reduced = ((key, self.ring.reduced(value)) for key, value in sums.items())
        return tuple((key, value) for key, value in reduced if value != 0)


def phases_for(ring: Ring, phase: sp.Symbol, period: sp.Expr, expressions: Iterable[sp.Expr]) -> Phases:
    """The basis that holds these functions of the phase: :class:`Harmonics`, or :class:`Pieces` where there are jumps.

    Raises
    ------
    AveragingRefused, AveragingUndecided
        If the period is not one of them all, or no exact integral is known.
    """
    points: set[sp.Expr] = set()
    for i, expression in enumerate(expressions, start=1):
        if innermost(expression, {phase}) is not None:
            points.update(read_signal(expression, phase, period, f"dither {i}").points)
    if not points:
        return Harmonics(ring, phase, period)
    if len(apart := ordered(points)) < 2:
        raise AveragingUndecided("the pieces of the dithers are not told apart")
    return Pieces(ring, phase, period, apart)


def _shared(values: Sequence[sp.Expr]) -> tuple[list[sp.Expr], list[Turns]]:
    """Few units, and how often each stands in each of the values: those whose ratio is rational share one."""
    classes: list[list[tuple[int, sp.Rational]]] = []
    for i, value in enumerate(values):
        for members in classes:
            ratio = sp.radsimp(sp.cancel(sp.simplify(value / values[members[0][0]])))
            if ratio.is_Rational:
                members.append((i, ratio))
                break
        else:
            classes.append([(i, sp.S.One)])
    units: list[sp.Expr] = []
    counts = [[0] * len(classes) for _ in values]
    for place, members in enumerate(classes):
        part = sp.Rational(1, sp.ilcm(1, *(ratio.q for _, ratio in members)))
        units.append(values[members[0][0]] * part)
        for i, ratio in members:
            counts[i][place] = int(ratio / part)
    return units, [tuple(row) for row in counts]
