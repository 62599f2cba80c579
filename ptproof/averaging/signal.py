"""One dither over one period: exact smooth pieces, mean, antiderivative."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import sympy as sp

from ptproof.averaging.quasipolynomial import QuasiPolynomial, exact_sign, read
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, NotAPeriod
from ptproof.averaging.switching import pieces
from ptproof.proof.kinks import innermost
from ptproof.proof.signs import vanishes


@dataclass(frozen=True)
class Signal:
    """A dither on [0, period]: ``pieces[p]`` holds between ``points[p]`` and ``points[p + 1]``."""

    period: sp.Expr
    points: tuple[sp.Expr, ...]
    pieces: tuple[QuasiPolynomial, ...]

    @property
    def is_trigonometric(self) -> bool:
        """Whether the signal is one trigonometric polynomial for all phases, as |sin(θ/2)| on [0, 2π] is not."""
        if len(self.pieces) != 1 or not self.pieces[0].is_trigonometric_polynomial:
            return False
        turns = (rate * self.period / (2 * sp.pi) for _, rate in self.pieces[0].terms)
        return all(turn.is_Integer or sp.radsimp(sp.simplify(turn)).is_Integer for turn in turns)

    @property
    def coefficients(self) -> set[sp.Expr]:
        """What the powers, sines and cosines of the phase are multiplied by."""
        return {value for piece in self.pieces for pair in piece.terms.values() for value in pair}

    @functools.cached_property
    def antiderivatives(self) -> tuple[QuasiPolynomial, ...]:
        """The pieces of the continuous antiderivative that vanishes at 0."""
        value: sp.Expr = sp.S.Zero
        result = []
        for start, end, piece in zip(self.points, self.points[1:], self.pieces, strict=False):
            primitive = piece.antiderivative()
            primitive = primitive + QuasiPolynomial.constant(value - primitive.at(start))
            result.append(primitive)
            value = primitive.at(end)
        return tuple(result)

    @functools.cached_property
    def primitive(self) -> Signal:
        """The antiderivative of zero mean, of a signal of zero mean."""
        rough = Signal(self.period, self.points, self.antiderivatives)
        if self.is_trigonometric:  # each harmonic by itself has zero mean
            return Signal(self.period, self.points, (self.pieces[0].antiderivative(),))
        shift = QuasiPolynomial.constant(-rough.mean)
        return Signal(self.period, self.points, tuple(piece + shift for piece in rough.pieces))

    def __mul__(self, other: Signal) -> Signal:
        points, pieces = [sp.S.Zero], []
        for _, end, p, q in common_pieces(self, other):
            points.append(end)
            pieces.append(self.pieces[p] * other.pieces[q])
        return Signal(self.period, tuple(points), tuple(pieces))

    def expression(self, phase: sp.Symbol) -> sp.Expr:
        """The signal for all phases, extended periodically."""
        if self.is_trigonometric:
            return self.pieces[0].expression(phase)
        # Not Mod: SymPy prints a multiple of it as Python code without the parentheses that it needs.
        inside = phase - self.period * sp.floor(phase / self.period)
        branches = [
            (piece.expression(inside), inside < end) for end, piece in zip(self.points[1:], self.pieces, strict=True)
        ]
        return sp.Piecewise(*branches[:-1], (branches[-1][0], True))

    @functools.cached_property
    def mean(self) -> sp.Expr:
        """The exact mean over one period."""
        if self.is_trigonometric:
            return self.pieces[0].terms.get((0, sp.S.Zero), (sp.S.Zero, sp.S.Zero))[0]
        return sp.simplify(self.antiderivatives[-1].at(self.points[-1]) / self.period)


def read_signal(dither: sp.Expr, phase: sp.Symbol, period: sp.Expr, where: str) -> Signal:
    """The pieces of ``dither`` on [0, ``period``]; one that contains Piecewise is extended periodically.

    Raises
    ------
    AveragingRefused
        If what stands outside Piecewise does not have the declared period.
    AveragingUndecided
        If the dither is outside the class that is integrated exactly.
    """
    if innermost(dither, {phase}) is None:
        terms = read(dither, phase, where)
        _check_period(terms, dither, phase, period, where)
        return Signal(period, (sp.S.Zero, period), (terms,))
    _check_period_of_switches(dither, phase, period, where)
    return _pieces_of(dither, phase, period, where)


def common_pieces(first: Signal, second: Signal) -> list[tuple[sp.Expr, sp.Expr, int, int]]:
    """(from, to, piece of the first, piece of the second) on the common refinement of their points."""
    result, p, q, start = [], 0, 0, sp.S.Zero
    while p < len(first.pieces) and q < len(second.pieces):
        left, right = first.points[p + 1], second.points[q + 1]
        order = exact_sign(left - right)
        end = left if order <= 0 else right
        result.append((start, end, p, q))
        start, p, q = end, p + (order <= 0), q + (order >= 0)
    return result


def _check_period(terms: QuasiPolynomial, dither: sp.Expr, phase: sp.Symbol, period: sp.Expr, where: str) -> None:
    if not terms.is_trigonometric_polynomial:
        raise AveragingRefused(
            "D", where, f"{dither} grows with {phase}, it is not periodic; write Mod({phase}, {period}) for {phase}"
        )
    for _, rate in terms.terms:
        turns = sp.radsimp(sp.simplify(rate * period / (2 * sp.pi)))
        if not turns.is_integer:
            raise NotAPeriod(
                where,
                f"{period} is not a period of {dither}: its part of frequency {rate} makes {turns} turns in it, "
                "not a whole number",
            )


def rates_of(dither: sp.Expr, phase: sp.Symbol) -> set[sp.Expr]:
    """The frequencies of a dither that is a trigonometric polynomial; none for others."""
    if innermost(dither, {phase}) is not None:
        return set()
    try:
        return {rate for _, rate in read(dither, phase, "dither").terms} - {sp.S.Zero}
    except (AveragingRefused, AveragingUndecided):
        return set()


def period_of(rates: set[sp.Expr]) -> sp.Expr | None:
    """The smallest common period of sinusoids with these frequencies, or None where there is none."""
    ordered = sorted(rates, key=str)
    ratios = [sp.radsimp(sp.simplify(rate / ordered[0])) for rate in ordered]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    return sp.simplify(2 * sp.pi / (ordered[0] * sp.gcd_list(ratios)))


def _check_period_of_switches(dither: sp.Expr, phase: sp.Symbol, period: sp.Expr, where: str) -> None:
    """A Piecewise is what it says on one period; everything else must have the period by itself."""
    masked = dither.replace(lambda node: isinstance(node, sp.Piecewise), lambda node: sp.Dummy())
    if phase not in masked.free_symbols:
        return
    if innermost(masked, {phase}) is None:
        _check_period(read(masked, phase, where), dither, phase, period, where)
        return
    # The same pieces, one period later, must be the same functions.
    constants = {symbol: sp.Symbol(f"c{i}") for i, symbol in enumerate(masked.atoms(sp.Dummy))}
    masked = masked.xreplace(constants)
    first, later = (_pieces_of(entry, phase, period, where) for entry in (masked, masked.subs(phase, phase + period)))
    for _, _, p, q in common_pieces(first, later):
        difference = first.pieces[p] + later.pieces[q].scale(sp.S.NegativeOne)
        for value in (value for pair in difference.terms.values() for value in pair):
            if vanishes(value):
                continue
            if not value.is_number or exact_sign(value) == 0:
                raise AveragingUndecided(f"{where}: whether {period} is a period of {dither} is not known")
            raise NotAPeriod(where, f"{period} is not a period of {dither}")


def _pieces_of(dither: sp.Expr, phase: sp.Symbol, period: sp.Expr, where: str) -> Signal:
    points: list[sp.Expr] = [sp.S.Zero]
    parts: list[QuasiPolynomial] = []
    for _, end, expression in pieces(dither, phase, sp.S.Zero, period, where):
        points.append(end)
        parts.append(read(expression, phase, where))
    return Signal(period, tuple(points), tuple(parts))
