"""The proof of a claim that says C^k: every expression is examined by structure."""

from __future__ import annotations

import time

from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Smooth
from ptproof.proof.verdict import Evidence, Verdict


@engine
def smooth(goal: Goal) -> Evidence:
    """Show that all expressions of the goal are as smooth as it says, on the domain that its assumptions leave."""
    start = time.perf_counter()
    statement = goal.statement
    if not isinstance(statement, Smooth):
        return Evidence("smoothness", Verdict.UNDECIDED, f"not a statement about smoothness: {statement}")
    details = []
    for expression in statement.expressions:
        found = smoothness(expression, statement.variables, statement.order, dict(statement.assumed), goal.relations)
        if found.verdict is not Verdict.PROVED:
            return found
        details.append(found.detail)
    detail = "; ".join(dict.fromkeys(details))
    return Evidence("smoothness", Verdict.PROVED, detail, time.perf_counter() - start)
