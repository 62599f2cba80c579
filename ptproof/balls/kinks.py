"""A short step across a kink: both right-hand sides at once, by the hull of their values and slopes."""

from __future__ import annotations

from collections.abc import Sequence

import flint
from flint import arb, arb_mat

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.jet import JETS, Jet, variables
from ptproof.balls.matrices import Vector, grown, identity, magnitudes, times
from ptproof.balls.pieces import Piece
from ptproof.balls.region import Region
from ptproof.balls.tape import Tape, Undefined


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
    bends = [output.slopes[0] if isinstance(output, Jet) else None for output in tape.run(along, JETS)]
    off = [
        (length * ((f - v).abs_upper() + (arb(0) if bend is None else bend.abs_upper() * length))).upper()
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
    n = len(box) - 1
    entries: Vector = []
    for i, output in enumerate(tape.run(variables(box), JETS)):
        slopes = output.slopes[1:] if isinstance(output, Jet) else (None,) * n
        for j, slope in enumerate(slopes):
            if slope is None:
                entries.append(arb(0))
            else:
                entries.append((length * slope).upper() if i == j else (length * slope).abs_upper())
    if not all(entry.is_finite() for entry in entries):
        raise Undefined("slopes without bounds")
    return arb_mat(n, n, entries)


def certainly_positive(tape: Tape, region: Region, time: arb) -> list[bool]:
    """For each output of ``tape`` (time and states) whether it is shown to be positive on the region at ``time``."""
    return [low > 0 for low in lowest(tape, region, time)]


def lowest(tape: Tape, region: Region, time: arb) -> list[arb]:
    """A lower bound of each output of ``tape`` on the region at ``time``, by the mean value form."""
    middle = tape.run([time.mid(), *region.centre], BALLS)
    outputs = tape.run(variables([time, *region.box]), JETS)
    bounds = []
    for value, output in zip(middle, outputs, strict=True):
        spread = arb(0)
        if isinstance(output, Jet):
            for slope, radius in zip(output.slopes, [time.rad(), *region.errors], strict=True):
                spread += arb(0) if slope is None else slope.abs_upper() * radius
        bounds.append((value - spread).lower())
    return bounds
