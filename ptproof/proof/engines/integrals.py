"""Integrals by the fundamental theorem: an antiderivative that is checked, taken between the ends.

The antiderivative comes from SymPy's indefinite integration and is not trusted: its derivative must be the
integrand by exact algebra, and it must be continuous between the ends (no denominator that may vanish).
Definite integration by SymPy is never asked: over a full period it has been wrong without notice.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.evaluation import carried_out
from ptproof.proof.engines.witnesses import candidates
from ptproof.proof.signs import holds, vanishes
from ptproof.proof.statement import Relation, relations_of
from ptproof.proof.substitution import Substitution
from ptproof.proof.verdict import Evidence, Verdict

_TRIED = 12  # points at which an integral whose value is another is looked at


@engine
def integrals(goal: Goal) -> Evidence:
    """Show equalities whose left side contains definite integrals; where a value is another, a point is suspected."""
    converging = set()
    for part in relations_of(goal.statement):
        found = carried_out(part.left)
        if found is None:
            return Evidence("fundamental theorem", Verdict.UNDECIDED, f"no checked antiderivative for {part}")
        if part.sign != "=" or not vanishes(found - part.right):
            detail = f"the integral is {found}" if part.sign == "=" else f"not an equality: {part}"
            suspect = _failing(goal, Relation(found, part.sign, part.right))
            return Evidence("fundamental theorem", Verdict.UNDECIDED, detail, found={part.left: found}, suspect=suspect)
        converging |= part.left.atoms(sp.Integral)
    detail = "an antiderivative whose derivative is the integrand by exact algebra, between the ends"
    return Evidence("fundamental theorem", Verdict.PROVED, detail, found=dict.fromkeys(converging))


def _failing(goal: Goal, part: Relation) -> Mapping[Any, Any] | None:
    """Exact values at which the part fails with the integrals' values put in; whoever checks them has the integrals."""
    for values in itertools.islice(candidates(goal), _TRIED):
        with contextlib.suppress(InputError):
            if holds(Substitution(values).relation(part).negation()):
                return values
    return None
