"""Integrals by the fundamental theorem: an antiderivative that is checked, taken between the ends.

The antiderivative comes from SymPy's indefinite integration and is not trusted: its derivative must be the
integrand by exact algebra, and it must be continuous between the ends (no denominator that may vanish).
Definite integration by SymPy is never asked: over a full period it has been wrong without notice.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.evaluation import carried_out
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import relations_of
from ptproof.proof.verdict import Evidence, Verdict


@engine
def integrals(goal: Goal) -> Evidence:
    """Show equalities whose left side contains definite integrals."""
    converging = set()
    for part in relations_of(goal.statement):
        if part.sign != "=":
            return Evidence("fundamental theorem", Verdict.UNDECIDED, f"not an equality: {part}")
        found = carried_out(part.left)
        if found is None:
            return Evidence("fundamental theorem", Verdict.UNDECIDED, f"no checked antiderivative for {part}")
        if not vanishes(found - part.right):
            detail = f"the integral is {found}"
            return Evidence("fundamental theorem", Verdict.UNDECIDED, detail, found={part.left: found})
        converging |= part.left.atoms(sp.Integral)
    detail = "an antiderivative whose derivative is the integrand by exact algebra, between the ends"
    return Evidence("fundamental theorem", Verdict.PROVED, detail, found=dict.fromkeys(converging))
