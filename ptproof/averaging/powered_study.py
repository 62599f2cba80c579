"""Everything about the average of one system with powers of the frequency: result, hypotheses, the author's claim."""

from __future__ import annotations

from ptproof.averaging.answer import Average
from ptproof.averaging.attack import attack_powered
from ptproof.averaging.expected import compare
from ptproof.averaging.powered_ledger import CONDITIONS, examine_powered
from ptproof.averaging.powers import PoweredProblem
from ptproof.proof.verdict import Evidence, Verdict


def study_powered(problem: PoweredProblem) -> Average:
    """The limit, if all that it rests on is not refuted, with the ledger of hypotheses.

    A refuted condition on powers (``2.1`` to ``2.3``) stands in the ledger and among the notes; where the limit is
    shown all the same, the average is that limit.
    """
    ledger, found = examine_powered(problem)
    broken = [letter for letter in ledger.with_verdict(Verdict.REFUTED) if letter not in CONDITIONS]
    if found is None or broken:
        reason = "there is no average to compare with"
        expected = None if problem.expected is None else Evidence("average", Verdict.UNDECIDED, reason)
        return Average(problem, None, {} if found is None else found.v, {}, ledger, expected)
    attack_powered(found, points=2)
    domain = problem.plain.domain
    free = set().union(*(entry.free_symbols for entry in (*found.system.rhs, *(problem.expected or ()))))
    if any(power.free_symbols & free for power in problem.system.powers):
        domain = (*domain, *problem.system.exponents.relations)
    expected = None if problem.expected is None else compare(found.system.rhs, problem.expected, domain)
    return Average(problem, found.system, found.v, found.brackets, ledger, expected, powered=found)
