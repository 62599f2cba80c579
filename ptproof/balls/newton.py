"""Zeros of a gradient: found in floating-point numbers, then proved by the interval Newton method of Krawczyk."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb, arb_mat

from ptproof.balls.ball import BALLS
from ptproof.balls.matrices import column, identity
from ptproof.balls.tape import Undefined


def newton(gradient: Any, hessian: Any, begin: Sequence[float]) -> list[arb] | None:
    """Where Newton's method in floating-point numbers ends, None where it does not; it proves nothing."""
    import numpy as np

    n = len(begin)
    point = np.array(begin, dtype=float)
    try:
        for _ in range(60):
            balls = [arb(float(entry)) for entry in point]
            value = np.array([float(entry.mid()) for entry in gradient.run(balls, BALLS)])
            slope = np.array([float(entry.mid()) for entry in hessian.run(balls, BALLS)]).reshape(n, n)
            if not (np.all(np.isfinite(value)) and np.all(np.isfinite(slope))):
                return None
            step = np.linalg.lstsq(slope, value, rcond=1e-12)[0]
            point = point - step
            if not np.all(np.isfinite(point)) or np.abs(point).max() > 1e9:
                return None
            if np.abs(step).max() <= 1e-13 * max(1.0, float(np.abs(point).max())):
                return [arb(float(entry)) for entry in point]
    except (Undefined, np.linalg.LinAlgError, ValueError, OverflowError):
        return None
    return None


def krawczyk(found: Sequence[arb], gradient: Any, hessian: Any) -> list[arb] | None:
    """A box that certainly contains exactly one zero of the gradient, around ``found``."""
    n = len(found)
    for radius in ("1e-9", "1e-7", "1e-11", "1e-5"):
        box = [arb(centre, arb(radius)) for centre in found]
        try:
            slope = arb_mat(n, n, hessian.run(box, BALLS))
            middle = arb_mat(n, n, [entry.mid() for entry in hessian.run(list(found), BALLS)])
            inverse = arb_mat(n, n, [entry.mid() for entry in middle.inv().entries()])
            value = arb_mat(n, 1, gradient.run(list(found), BALLS))
        except (Undefined, ZeroDivisionError):
            continue
        offset = column([ball - centre for ball, centre in zip(box, found, strict=True)])
        image = column(found) - inverse * value + (identity(n) - inverse * slope) * offset
        if all(ball.contains_interior(new) for ball, new in zip(box, image.entries(), strict=True)):
            return list(image.entries())
    return None
