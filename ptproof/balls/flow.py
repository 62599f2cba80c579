"""Solutions of ordinary differential equations, enclosed over one step: a smooth one, or a short one across a kink."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import flint
from flint import arb, arb_mat, arb_series

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.jet import JETS, Jet, slopes_of, variables
from ptproof.balls.matrices import (
    Growth,
    Vector,
    grown,
    grown_over,
    identity,
    inverse,
    magnitudes,
    times,
)  # fmt: skip
from ptproof.balls.pieces import Piece, Proposal, Region, VectorField, hull
from ptproof.balls.polynomials import around, highest, largest, not_below, spectra
from ptproof.balls.series import SERIES, series_length
from ptproof.balls.tape import Tape, Undefined

_JACOBIAN = 15  # so many coefficients of a Jacobian are told apart


def flow(field: VectorField, region: Region, start: arb, length: arb, proposal: Proposal) -> tuple[Piece, Region]:
    """Enclose all solutions that start in ``region`` at ``start``, over a step of ``length``.

    **Theorem.** Let x' = f(t, x), and p, P polynomials in s, t = start + (length/2)(1 + s). Write a solution that
    starts in c + e₀ as x = p + P e₀ + S g. Then in s, with h = length/2 and J = ∂f/∂x(t, p),

        g' = S⁻¹(h f(t, p) − p') + S⁻¹(h J P − P') e₀ + h S⁻¹ J S g + h S⁻¹ q,   |qᵢ| <= ½ Σ |∂ⱼ∂ₖfᵢ| |eⱼ| |eₖ|,

    with e = x − p and the second derivatives on the box around p and x (Taylor's theorem). The first two terms are
    bounded by the Taylor polynomials of f and J along p with Lagrange's remainder, whose coefficient is enclosed over
    the whole step; the third by the largest diagonal entries, and the largest magnitudes off the diagonal, of
    h S⁻¹ J S along p; the fourth from a tube |g| <= ρ that is assumed. Hence D⁺|g| <= M|g| + δ as long as x stays in
    the tube, and :func:`grown` bounds |g|. If that bound is below ρ, then each solution from ``region`` exists over
    the whole step, is unique and lies in the tube.

    *Proof.* f has continuous derivatives on the tube, where they are enclosed, so that there is one solution, which can
    be continued until it leaves the tube. Until then the inequality holds, so |g| stays below ρ: it does not leave. ∎

    Returns
    -------
    The step with the tube's bounds, and a region that contains every solution at its end.

    Raises
    ------
    Undefined
        Where this is not shown: no enclosure, a guard that may be negative, or a tube that does not close.
    """
    step = _Step(field, region, start, length, proposal)
    growth, errors = step.closed()
    step.guarded(errors)
    ends = [sum(row, arb(0)) for row in step.rows]
    carried = sum(proposal.spread[1:], proposal.spread[0])
    after = region.moved(ends, carried, proposal.metric, (proposal.basis, growth.end))
    added = times(magnitudes(proposal.basis), growth.end)
    return Piece(start, length, proposal.path, tuple(errors), tuple(added)), after


class _Step:
    """The terms of the theorem for one step."""

    def __init__(self, field: VectorField, region: Region, start: arb, length: arb, proposal: Proposal) -> None:
        self.field, self.region, self.proposal = field, region, proposal
        self.half = length / 2
        self.middle = start + self.half
        self.rows = proposal.path.tolist()
        self.back = inverse(proposal.basis)
        self.terms = proposal.path.ncols() + 9
        self.expand()

    def expand(self) -> None:
        """The Taylor polynomials along the path, and the coefficients of their remainders."""
        terms, tape = self.terms, self.field.tape
        with series_length(terms):
            time = arb_series([self.middle, self.half], terms)
            outputs = tape.run([time, *(arb_series(row, terms) for row in self.rows)], SERIES)
            self.series = [_coefficients(item, terms) for item in outputs]
        with series_length(terms + 1):
            wide = around(self.proposal.path, terms + 1).tolist()
            time = arb_series([self.middle + self.half * interval(-1, 1), self.half], terms + 1)
            outputs = tape.run([time, *(arb_series(row, terms + 1) for row in wide)], SERIES)
            self.rest = [arb(0) if isinstance(item, arb) else item[terms].abs_upper() for item in outputs]
        if not all(item.is_finite() for item in self.rest):
            raise Undefined("not analytic along the step")

    def square(self, entries: Sequence[arb]) -> arb_mat:
        """The Jacobian's entries as a matrix."""
        n = self.field.dimension
        flat = [arb(0)] * (n * n)
        for (i, j), entry in zip(self.field.places, entries, strict=False):
            flat[i * n + j] = entry
        return arb_mat(n, n, flat)

    def defect(self) -> Vector:
        """Bounds of S⁻¹(h f(t, p) − p')."""
        n, terms = self.field.dimension, self.terms
        flat = []
        for rate, row in zip(self.series[:n], self.rows, strict=True):
            slope = [*(k * c for k, c in enumerate(row[1:], start=1)), *[arb(0)] * terms]
            flat += [self.half * a - b for a, b in zip(rate, slope, strict=False)]
        spectrum = spectra(self.back * arb_mat(n, terms, flat)).tolist()
        left = times(magnitudes(self.back), [(self.half * r).abs_upper() for r in self.rest[:n]])
        return [largest(row) + rest for row, rest in zip(spectrum, left, strict=True)]

    @cached_property
    def jacobians(self) -> list[arb_mat]:
        """The first coefficients of J along the path."""
        n, places = self.field.dimension, len(self.field.places)
        return [self.square([row[k] for row in self.series[n : n + places]]) for k in range(_JACOBIAN)]

    @cached_property
    def jacobian_rest(self) -> arb_mat:
        """What the others add to J at most."""
        n, places = self.field.dimension, len(self.field.places)
        rows = zip(self.series[n : n + places], self.rest[n : n + places], strict=True)
        return self.square([sum((c.abs_upper() for c in row[_JACOBIAN:]), rest).upper() for row, rest in rows])

    def bounded(self, parts: Sequence[arb_mat], *, signed: bool = False) -> arb_mat:
        """Bounds of the magnitudes of a polynomial's matrices; with ``signed`` of the values, on the diagonal."""
        n, count = self.field.dimension, len(parts)
        rows = zip(*(part.entries() for part in parts), strict=True)
        spectrum = spectra(arb_mat(n * n, count, list(itertools.chain.from_iterable(rows)))).tolist()
        bounds = (highest if signed and i % (n + 1) == 0 else largest for i in range(n * n))
        return arb_mat(n, n, [bound(row) for bound, row in zip(bounds, spectrum, strict=True)])

    def rates(self) -> arb_mat:
        """M: of h S⁻¹ J S along the path."""
        basis, back = self.proposal.basis, self.back
        bounds = self.bounded([back * J * basis for J in self.jacobians], signed=True)
        total = self.half * (bounds + magnitudes(back) * self.jacobian_rest * magnitudes(basis))
        return arb_mat([[entry.upper() for entry in row] for row in total.tolist()])

    @cached_property
    def spread(self) -> arb_mat:
        """Bounds of P B, in magnitudes."""
        return self.bounded([part * self.region.frame for part in self.proposal.spread])

    def spreading(self) -> arb_mat:
        """Bounds of S⁻¹(h J P − P') B, in matrices of magnitudes."""
        spread, frame = self.proposal.spread, self.region.frame
        zero, count = 0 * spread[0], len(spread)
        defects = [(-k - 1) * spread[k + 1] if k + 1 < count else zero for k in range(count + _JACOBIAN - 1)]
        scaled = [self.half * J for J in self.jacobians]
        for i, J in enumerate(scaled):
            for j, part in enumerate(spread):
                defects[i + j] += J * part
        bounds = self.bounded([self.back * part * frame for part in defects])
        left = magnitudes(self.half * self.jacobian_rest) * self.spread
        return bounds + magnitudes(self.back) * left

    def bending(self, errors: Sequence[arb]) -> tuple[Vector, list[Vector]]:
        """Bounds of |h q| for states within ``errors`` of the path, and of the guards' slopes there."""
        n, places = self.field.dimension, self.field.places
        time = self.middle + self.half * interval(-1, 1)
        outputs = self.field.tape.run(variables([time, *hull(self.proposal.path, errors)]), JETS)
        total = [arb(0)] * n
        bounds = [[slope.abs_upper() for slope in slopes_of(output, n + 1)[1:]] for output in outputs[n:]]
        for (i, j), row in zip(places, bounds, strict=False):
            total[i] += sum((slope * error for slope, error in zip(row, errors, strict=True)), arb(0)) * errors[j]
        return [(self.half * entry / 2).abs_upper() for entry in total], bounds[len(places) :]

    def closed(self) -> tuple[Growth, Vector]:
        """Bounds of g in a tube that closes, and those of x − p."""
        region, spread, basis = self.region, self.proposal.spread, self.proposal.basis
        n = self.field.dimension
        begin = sum(((-1) ** k * part for k, part in enumerate(spread[1:], start=1)), spread[0])
        point = [sum(((-1) ** k * c for k, c in enumerate(row)), arb(0)) for row in self.rows]
        left_out = magnitudes(self.back * (identity(n) - begin) * region.frame)
        apart = [(c - p).abs_upper() for c, p in zip(region.centre, point, strict=True)]
        first = _plus(times(left_out, region.radii), times(magnitudes(self.back), apart))
        rates, known = self.rates(), _plus(self.defect(), times(self.spreading(), region.radii))
        along = times(self.spread, region.radii)
        outward, inward = magnitudes(basis), magnitudes(self.back)
        over = grown_over(rates, known, first, 2)
        for factor in (1.25, 2, 8):
            tube = [(arb(factor) * entry + arb(2) ** (-2 * flint.ctx.prec)).upper() for entry in over]
            errors = _plus(along, times(outward, tube))
            self.slopes: list[Vector]
            bent, self.slopes = self.bending(errors)
            growth = grown(rates, _plus(known, times(inward, bent)), first, 2)
            if all(entry < limit for entry, limit in zip(growth.over, tube, strict=True)):
                return growth, errors
            over = growth.over
        raise Undefined("no tube closes around the step")

    def guarded(self, errors: Sequence[arb]) -> None:
        """Raises unless every guard is shown not to be negative in the tube."""
        first = len(self.series) - self.field.guards
        for index, slopes in enumerate(self.slopes):
            margin = sum((a * b for a, b in zip(slopes, errors, strict=True)), self.rest[first + index])
            if not not_below(self.series[first + index], margin.upper()):
                raise GuardCrossed(f"guard {index} may be negative")


class GuardCrossed(Undefined):
    """Another right-hand side may hold before the step's end."""


def _coefficients(item: Any, terms: int) -> list[arb]:
    if isinstance(item, arb):
        return [item, *[arb(0)] * (terms - 1)]
    found = item.coeffs()
    return [*found, *[arb(0)] * (terms - len(found))]


def _plus(left: Sequence[arb], right: Sequence[arb]) -> Vector:
    return [(a + b).upper() for a, b in zip(left, right, strict=True)]


def across(tape: Tape, region: Region, start: arb, length: arb) -> tuple[Piece, Region]:
    """Enclose all solutions that start in ``region`` at ``start``, over a short step of ``length``.

    **Theorem.** Let x' = f(t, x) with f continuous and piecewise smooth in x (sums, products, smooth functions, Max,
    Min and Abs of such), so that f is Lipschitz where the enclosure J of its slopes, over both sides of every kink, is
    finite. With p = c + v(t − start) and x = p + e₀ + g, D⁺|g| <= length·(|f(t, p) − v| + |J| (|e₀| + |g|)) in the
    step's own time, with signs on the diagonal of J where it meets |g|, by the mean value theorem of Lebourg. The rest
    is as for :func:`ptproof.balls.flow.flow`: where the bound of |g| is below the radii of the tube on which J was
    enclosed, each solution exists over the step, is unique and lies in the tube.

    ``tape`` takes the time and n states and gives n rates. Raises :class:`Undefined` where this is not shown.
    """
    n = len(region.centre)
    clock, centre = start + length * interval(0, 1), list(region.centre)
    values = tape.run([start, *centre], BALLS)
    velocity = [value.mid() for value in values]
    line = [c + v * length * interval(0, 1) for c, v in zip(centre, velocity, strict=True)]
    known = region.errors
    # Along the line the slope is taken first and its hull over both sides of a kink then: terms that cancel do so.
    along = [Jet(clock, (arb(1),)), *(Jet(p, (v,)) for p, v in zip(line, velocity, strict=True))]
    bends = [slopes_of(output, 1)[0].abs_upper() for output in tape.run(along, JETS)]
    off = [
        (length * ((f - v).abs_upper() + bend * length)).upper()
        for f, v, bend in zip(values, velocity, bends, strict=True)
    ]
    guess = [(2 * a + arb(2) ** (-flint.ctx.prec)).upper() for a in off]
    for _ in range(6):
        errors = [(a + b).upper() for a, b in zip(known, guess, strict=True)]
        rates = _rates(tape, [clock, *(p + arb(0, e) for p, e in zip(line, errors, strict=True))], length)
        pushed = times(magnitudes(rates), known)
        growth = grown(rates, [(a + b).upper() for a, b in zip(off, pushed, strict=True)], [arb(0)] * n, 1)
        if all(entry < limit for entry, limit in zip(growth.over, guess, strict=True)):
            half = length / 2
            rows = [row for c, v in zip(centre, velocity, strict=True) for row in (c + v * half, v * half)]
            ends = [c + v * length for c, v in zip(centre, velocity, strict=True)]
            after = region.moved(ends, identity(n), None, (identity(n), growth.end))
            return Piece(start, length, arb_mat(n, 2, rows), tuple(errors), tuple(growth.end)), after
        guess = [(3 * entry + limit).upper() for entry, limit in zip(growth.over, guess, strict=True)]
    raise Undefined("no tube closes around the step across a kink")


def _rates(tape: Tape, box: Sequence[arb], length: arb) -> arb_mat:
    rows = [[length * slope for slope in slopes_of(output, len(box))[1:]] for output in tape.run(variables(box), JETS)]
    if not all(entry.is_finite() for row in rows for entry in row):
        raise Undefined("slopes without bounds")
    return arb_mat([[e.upper() if i == j else e.abs_upper() for j, e in enumerate(row)] for i, row in enumerate(rows)])


def lowest(tape: Tape, region: Region, time: arb) -> list[arb]:
    """A lower bound of each output of ``tape`` on the region at ``time``, by the mean value form."""
    middle = tape.run([time.mid(), *region.centre], BALLS)
    outputs = tape.run(variables([time, *region.box]), JETS)
    bounds = []
    radii = [time.rad(), *region.errors]
    for value, output in zip(middle, outputs, strict=True):
        spread = sum((s.abs_upper() * r for s, r in zip(slopes_of(output, len(radii)), radii, strict=True)), arb(0))
        bounds.append((value - spread).lower())
    return bounds
