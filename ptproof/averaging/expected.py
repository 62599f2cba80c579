"""What an author expects of averages, beside what is derived: decided, and said with both sides."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.orders import Orders
from ptproof.averaging.problem import DitherProblem
from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.settling import settle
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Evidence, Verdict


@dataclass(frozen=True)
class Expectation:
    """One order of the average as its author claims it, and what became of that.

    Attributes
    ----------
    order
        1 for the average itself, N ≥ 2 for A_N, the factor of ω^(−(N−1)/2), for correctors of mean 0.
    claimed, derived
        n expressions each; ``derived`` is None where there is no such average.
    """

    order: int
    claimed: Vector
    derived: Vector | None
    evidence: Evidence

    def sentence(self, state: Sequence[Any], longest: int | None = None) -> str:
        """The verdict in words; where it is not proved, with both sides of each entry that is not the same text.

        Sides of more than ``longest`` characters are cut.
        """
        told = f"the expected average{f' of order {self.order}' if self.order > 1 else ''}: {self.evidence.verdict}"
        if self.evidence.verdict is Verdict.PROVED:
            return told
        pairs = zip(state, self.derived or (), self.claimed, strict=False)
        parts = [
            f"d{symbol}/dtau is derived as {_cut(ours, longest)} and expected as {_cut(theirs, longest)}"
            for symbol, ours, theirs in pairs
            if ours != theirs
        ]
        if (witness := self.evidence.witness) is not None:
            values = ", ".join(f"{name} = {value}" for name, value in witness.values.items())
            parts.append(f"{f'at {values}: ' if values else ''}derived {witness.left}, expected {witness.right}")
        elif self.evidence.detail:
            parts.append(self.evidence.detail)
        if self.order > 1 and self.derived is not None:
            parts.append(
                "this is for correctors of mean 0 over the phase; with others the orders from 2 on look otherwise"
            )
        return f"{told}; {'; '.join(parts)}"

    def to_json(self) -> dict[str, Any]:
        """``order``, ``verdict``, ``derived``, ``expected``, ``witness`` and ``detail``."""
        witness = self.evidence.witness
        return {
            "order": self.order,
            "verdict": str(self.evidence.verdict),
            "derived": None if self.derived is None else [*map(str, self.derived)],
            "expected": [*map(str, self.claimed)],
            "witness": witness and witness.to_json(),
            "detail": self.evidence.detail,
        }


def _cut(side: sp.Expr, longest: int | None) -> str:
    text = str(side)
    return text if longest is None or len(text) <= longest else f"{text[:longest]}…"


def summary(expectations: Sequence[Expectation]) -> dict[str, Any]:
    """The verdict on all of them, which is that of the worst, with its witness; each by itself if any is of order > 1.

    >>> summary([Expectation(1, (sp.S.Zero,), (sp.S.Zero,), Evidence("exact", Verdict.PROVED, ""))])
    {'verdict': 'proved', 'witness': None}
    """
    badness = {Verdict.PROVED: 0, Verdict.REFUTED: 2}
    worst = max(expectations, key=lambda found: badness.get(found.evidence.verdict, 1))
    witness = worst.evidence.witness
    found = {"verdict": str(worst.evidence.verdict), "witness": witness and witness.to_json()}
    if all(expectation.order == 1 for expectation in expectations):
        return found
    return found | {"orders": [expectation.to_json() for expectation in expectations]}


def open_ones(claimed: Mapping[int, Vector], reason: str) -> tuple[Expectation, ...]:
    """Expectations with which nothing can be compared."""
    undecided = Evidence("average", Verdict.UNDECIDED, reason)
    return tuple(Expectation(order, entries, None, undecided) for order, entries in sorted(claimed.items()))


def of_orders(found: Orders | None, problem: DitherProblem, reason: str) -> tuple[Expectation, ...]:
    """What becomes of the orders from 2 on that the author claims; undecided where the expansion is not proved.

    ``reason`` says why there is no expansion where none is ``found``.
    """
    if found is None:
        return open_ones(problem.expected_orders, reason)
    if found.evidence.verdict is not Verdict.PROVED:
        return open_ones(problem.expected_orders, f"the expansion is not checked: {found.evidence.detail}")
    claimed = sorted(problem.expected_orders.items())
    pairs = ((order, entries, found.averages[order - 1]) for order, entries in claimed)
    return tuple(
        Expectation(order, entries, derived, compare(derived, entries, problem.domain))
        for order, entries, derived in pairs
    )


def compare(derived: Vector, expected: Vector, domain: Sequence[Relation] = ()) -> Evidence:
    """Whether the right-hand side that is derived equals ``expected`` on the domain, with a witness where it does not.

    proved: the difference has the normal form 0. refuted: exact values (polynomials for undefined functions) at
    which the two sides are apart. What is asked is that they agree wherever both are defined. The two sides are
    compared as given; neither is computed from the other.
    """
    both = Relation(sp.Matrix(derived), "=", sp.Matrix(list(expected)))
    goal = Goal("expected average", both, tuple(domain), where_defined=True)
    return settle(goal, exact)
