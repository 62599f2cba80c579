"""Rigorous enclosures of nested integrals ∫₀ᴾ f_j(θ) ∫₀^θ f_i(s) ds dθ of real functions, for all pairs at once.

The interval is cut into panels. On each a function is its Taylor polynomial around the middle plus Lagrange's
remainder, enclosed over the whole panel, so that all that is integrated are polynomials. Where a function is not
smooth, a sliver of tiny width is left over and enters with its largest size.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import flint
import sympy as sp
from flint import arb, arb_mat, arb_series

from ptproof.balls.ball import Undefined, enclose, interval
from ptproof.balls.series import SERIES, series_length
from ptproof.balls.tape import Tape, compile_tape

_ORDER = 24
_TARGET = arb("1e-11")  # the remainder on a panel, in relation to the function's size
_SLIVER = arb("1e-13")
_MOST_PANELS = 20_000
_WAVES = {(sp.asin, sp.sin), (sp.acos, sp.cos), (sp.atan, sp.tan)}


@dataclass(frozen=True)
class Functions:
    """The functions ``expressions`` of ``variable``, whose other symbols have the balls ``values``.

    ``sizes`` are bounds of their absolute values on the interval [0, ``end``].
    """

    expressions: Sequence[sp.Expr]
    variable: sp.Symbol
    end: arb
    values: Mapping[sp.Symbol, arb]

    @functools.cached_property
    def sizes(self) -> list[arb]:
        return self._largest(interval(0, self.end))

    @functools.cached_property
    def _tape(self) -> Tape:
        return compile_tape(list(map(_unfolded, self.expressions)), (self.variable, *self.values))

    def nested_integrals(self, breaks: Iterable[sp.Expr] = ()) -> arb_mat:
        """The matrix whose entry (j, i) contains the nested integral of f_j and f_i, at the present precision.

        ``breaks`` are points where panels should end; wrong or missing ones cost time, not rigour. Raises
        ``ArithmeticError`` where too many panels would be needed.
        """
        count, (weights, nested) = len(self.expressions), _moments()
        total, error, before = arb_mat(count, count), arb_mat(count, count), arb_mat(count, 1)
        for half, rows, rests in self._panels(breaks):
            polynomials = arb_mat(rows)
            sizes = arb_mat(count, 1, [sum((abs(entry) for entry in row), arb(0)).upper() for row in rows])
            rest = arb_mat(count, 1, rests)
            spread = arb_mat(count, 1, [arb(0, 1) * (2 * r) for r in rests])
            integrals = half * (polynomials * weights + spread)
            total += half * half * (polynomials * nested * polynomials.transpose()) + integrals * before.transpose()
            # f_j f_i and p_j p_i differ by at most r_j (|p_i| + r_i) + |p_j| r_i on a triangle of area 2.
            error += 2 * half * half * (rest * (sizes + rest).transpose() + sizes * rest.transpose())
            before += integrals
        return total + arb_mat(count, count, [arb(0, 1) * entry for entry in error.entries()])

    def _panels(self, breaks: Iterable[sp.Expr]) -> Iterator[tuple[arb, list[list[arb]], list[arb]]]:
        """For consecutive panels: half the width, coefficients of each function's polynomial, and the remainders."""
        points = sorted((enclose(point, bits=flint.ctx.prec) for point in breaks), key=lambda point: float(point.mid()))
        cuts = [arb(0)]
        for cut in (end.mid() for point in points for end in (point - _SLIVER, point + _SLIVER)):
            if cut > cuts[-1] and cut < self.end:
                cuts.append(cut)
        todo, done = list(pairwise([*cuts, self.end]))[::-1], 0
        while todo:
            left, right = todo.pop()
            half, whole = (right - left) / 2, interval(left, right)
            found = self._polynomials((left + right) / 2, half, whole)
            if found is None and half < _SLIVER:
                found = [[arb(0)] * _ORDER] * len(self.expressions), self._largest(whole)
            if found is not None:
                yield half, *found
            else:
                centre = whole.mid()
                todo += [(centre, right), (left, centre)]
            done += 1
            if done > _MOST_PANELS:
                raise ArithmeticError("the nested integrals need too many panels")

    def _polynomials(self, middle: arb, half: arb, whole: arb) -> tuple[list[list[arb]], list[arb]] | None:
        """The coefficients in s, θ = middle + half·s, and the remainders; None where these are not small."""
        try:
            rests = [abs(row[_ORDER]).upper() for row in self._coefficients(whole, half, _ORDER + 1)]
            if not all(rest <= _TARGET * size for rest, size in zip(rests, self.sizes, strict=True)):
                return None
            return self._coefficients(middle, half, _ORDER), rests
        except Undefined:
            return None

    def _coefficients(self, start: arb, step: arb, count: int) -> list[list[arb]]:
        with series_length(count):
            outputs: list[Any] = self._tape.run([arb_series([start, step], count), *self.values.values()], SERIES)
            padded = (output if isinstance(output, arb_series) else arb_series([output], count) for output in outputs)
            return [[series[k] for k in range(count)] for series in padded]

    def _largest(self, ball: arb) -> list[arb]:
        """Upper bounds of the absolute values on ``ball``, over all branches that may apply."""
        result = []
        for expression in self.expressions:
            # Inverse functions of waves, whose arguments' balls reach beyond their domain.
            waves = {wave: sp.Dummy("wave", real=True) for wave in expression.atoms(sp.asin, sp.acos, sp.atan)}
            values = {**self.values, **dict.fromkeys(waves.values(), arb(0, 4)), self.variable: ball}
            result.append(enclose(expression.xreplace(waves), values, bits=flint.ctx.prec).abs_upper())
        return result


def _unfolded(expression: sp.Expr) -> sp.Expr:
    """``expression`` with inverse functions of waves as the straight pieces that they are, on each integer level."""
    pieces = {}
    for wave in expression.atoms(sp.asin, sp.acos, sp.atan):
        if (wave.func, wave.args[0].func) in _WAVES:
            angle, half = wave.args[0].args[0], sp.Rational(wave.func is not sp.acos, 2)
            level = sp.floor(angle / sp.pi + half)
            rest, odd = angle - level * sp.pi, sp.Mod(level, 2)
            turned = (1 - 2 * odd) * rest + 2 * odd * (sp.Rational(1, 2) - half) * sp.pi
            pieces[wave] = rest if wave.func is sp.atan else turned
    return expression.xreplace(pieces)


@functools.cache
def _moments() -> tuple[arb_mat, arb_mat]:
    """∫ sᵏ and ∫ sᵏ ∫₋₁ˢ rˡ dr ds over [−1, 1], for polynomials by their coefficients."""
    n = range(_ORDER)

    def moment(k: int) -> arb:
        return arb(2) / (k + 1) if k % 2 == 0 else arb(0)

    nested = [[(moment(k + m + 1) + (-1) ** m * moment(k)) / (m + 1) for m in n] for k in n]
    return arb_mat([[moment(k)] for k in n]), arb_mat(nested)
