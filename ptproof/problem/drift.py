"""The two classes of drift: along the field's gradient, and bounded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.smooth import require_smooth
from ptproof.system import gradient


@dataclass(frozen=True)
class Drift:
    """A drift f(t, x) on the position.

    Attributes
    ----------
    kind
        ``none``, ``gradient`` (f = E∇F, case A of the paper's Assumption 3) or ``bounded`` (‖f‖ ≤ d(t), case B).
    rate
        f, n expressions in the time and the position. [length/time]
    matrix
        E (n × n) for ``gradient``.
    bound
        d, an expression in the time, for ``bounded``. Declared, not checked here.
    """

    kind: Literal["none", "gradient", "bounded"]
    rate: tuple[sp.Expr, ...]
    matrix: sp.ImmutableDenseMatrix | None = None
    bound: sp.Expr | None = None


def no_drift(dimension: int = 2) -> Drift:
    """f = 0."""
    return Drift("none", (sp.Integer(0),) * dimension)


def gradient_drift(matrix: Sequence[Sequence[sp.Expr]], field: sp.Expr, position: Sequence[sp.Symbol]) -> Drift:
    """f = E∇F for the matrix E (n × n) and the field F(x) over n coordinates, which must have a gradient everywhere.

    Raises
    ------
    InputError
        If E has another shape, or F is not shown to be continuously differentiable, as where it jumps.
    """
    E = sp.ImmutableDenseMatrix(matrix)
    if E.shape != (len(position), len(position)):
        raise InputError(f"drift: E is {E.rows} × {E.cols}, but there are {len(position)} coordinates")
    require_smooth(field, position, 1, "drift: E∇F needs the gradient of the field")
    return Drift("gradient", tuple(E * gradient(field, position)), matrix=E)


def bounded_drift(rate: Sequence[sp.Expr], bound: sp.Expr | None = None) -> Drift:
    """f with ‖f(t, x)‖ ≤ d(t) = ``bound``."""
    return Drift("bounded", tuple(map(sp.sympify, rate)), bound=None if bound is None else sp.sympify(bound))
