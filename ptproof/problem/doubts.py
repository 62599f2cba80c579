"""Whether the stated source can be the field's maximum: what is certain at the source, and what a run has seen."""

from __future__ import annotations

import itertools
from collections.abc import Iterable

import sympy as sp

from ptproof.problem.problem import Problem
from ptproof.problem.smooth import roughness
from ptproof.proof.signs import sign_of

_ALL_MINORS = 5
_SLACK = 1e-9


def source_doubt(problem: Problem) -> str | None:
    """A sentence if the field certainly has no maximum at the stated source, else None, which proves nothing.

    Certain is a component of the gradient that is not zero, or a direction in which the field rises to second order:
    −∇²F(x*) has a negative principal minor. A field that is not
    shown to be smooth is passed over, and so is what has no exact value there.

    Examples
    --------
    >>> from ptproof.problem import example
    >>> source_doubt(example("vanishing")) is None
    True
    """
    field = problem.field
    if roughness(field.expression, field.variables, 2) is not None:
        return None  # a derivative that SymPy makes of a jump or a kink says nothing
    at = dict(zip(field.variables, field.source, strict=True))
    where = f"field.source: ({', '.join(map(str, field.source))}) is no maximum of the field"
    slope = [entry.subs(at, simultaneous=True) for entry in field.gradient]
    if any(_sign(entry) in (-1, 1) for entry in slope):
        return f"{where}, whose gradient there is ({', '.join(map(str, slope))}); name a point where it vanishes"
    downward = -field.hessian_at_source
    n = field.dimension
    for size in range(1, (n if n <= _ALL_MINORS else 2) + 1):
        for rows in itertools.combinations(range(n), size):
            if _sign(downward.extract(list(rows), list(rows)).det()) == -1:
                names = ", ".join(str(field.variables[i]) for i in rows)
                return f"{where}, which rises from there in a direction of ({names}); name its highest point"
    return None


def _sign(value: sp.Expr) -> int | None:
    exact = value.is_number and not value.has(sp.nan, sp.zoo, sp.oo, sp.Derivative, sp.Subs)
    return sign_of(value) if exact else None


def run_doubt(problem: Problem, measured: Iterable[float]) -> str | None:
    """A sentence if one of the ``measured`` values of the field is above its value at the stated source."""
    peak, largest = float(problem.peak), max((float(value) for value in measured), default=float("-inf"))
    if not largest > peak + _SLACK * (1 + abs(peak)):
        return None
    return (
        f"the field was {largest:.6g} on the way, above the {peak:.6g} at the stated source, which therefore is not "
        f"its maximum"
    )
