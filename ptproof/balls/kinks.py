"""A short step across a kink: both right-hand sides at once, by the hull of their values and slopes."""

from __future__ import annotations

from collections.abc import Sequence

import flint
from flint import arb, arb_mat

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.jet import JETS, Jet, slopes_of, variables
from ptproof.balls.matrices import grown, identity, magnitudes, times
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
