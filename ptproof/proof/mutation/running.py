"""Mutating claims: in worker processes that may hang or die, or in this process."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

from ptproof.errors import InputError
from ptproof.proof.answering import READ, read
from ptproof.proof.claim import Claim
from ptproof.proof.load import Derivation
from ptproof.proof.mutation.judging import STEPS, Patience, judge, unanswered
from ptproof.proof.mutation.making import PER_CLAIM, mutants, neighbours
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.mutation.outcomes import Mutation, Outcome
from ptproof.proof.verdict import Verdict
from ptproof.reading.limits import Answered, Workers, check_seconds

SHARES = 4  # of the mutants of a claim, so that no process is left with much at the end
_PATIENCE = 12  # steps that a share may take to their limit before each mutant is tried on its own
Progress: TypeAlias = Callable[[Claim, Outcome], None]


@dataclass(frozen=True)
class Setting:
    """How many mutants a claim gets, which choice of them, and the limit of each step with one."""

    count: int
    seed: int
    timeout: float


def mutate(
    claims: Iterable[Claim] | Derivation, *, workers: int | None = None, timeout: float = 8.0, select: str = "",
    count: int = PER_CLAIM, seed: int = 0, progress: Progress | None = None,
) -> Mutation:  # fmt: skip
    """Corrupt every claim that is expected to be proved, and say what comes of each corrupted version.

    Parameters
    ----------
    claims
        Claims, whose mutants are judged in this process; or a derivation, whose are judged in worker processes.
    workers
        How many processes for a derivation, by default as many as there are processors.
    timeout
        The limit of each step with one mutant: its attack, its proof, its comparison with the original. [s]
    select
        Only claims of the derivation that contain this text in their id, title, section or labels.
    count
        How many mutants a claim shall have.
    seed
        Another number makes another choice of mutants.
    progress
        Called with the claim and the outcome of each mutant.

    Raises
    ------
    InputError
        If no claim is expected to be proved, or a parameter is not what it should be.

    Examples
    --------
    >>> import sympy as sp
    >>> from ptproof.proof import claim, eq, exact
    >>> x = sp.Symbol("x", real=True)
    >>> square = claim("square", "A square", eq((x + 1) ** 2, x**2 + 2 * x + 1))(exact)
    >>> found = mutate([square], count=12)
    >>> found.sound, found.counts("square")["refuted"] > found.counts("square")["undecided"]
    (True, True)
    """
    check_seconds(timeout, "timeout")
    if count < 1 or (workers is not None and workers < 1):
        raise InputError(f"count and workers take numbers of at least 1, got {count} and {workers}")
    start = time.perf_counter()
    setting = Setting(count, seed, timeout)
    chosen = corruptible(claims.claims if isinstance(claims, Derivation) else claims, select)
    if isinstance(claims, Derivation):
        answers = _in_workers(chosen, claims, workers or os.cpu_count() or 1, setting)
    else:
        answers = _here(chosen, setting)
    found: dict[str, list[tuple[int, Outcome]]] = {item.id: [] for item in chosen}
    for claim, place, outcome in answers:
        found[claim.id].append((place, outcome))
        if progress is not None:
            progress(claim, outcome)
    ordered = {
        id: tuple(outcome for _, outcome in sorted(items, key=lambda item: item[0])) for id, items in found.items()
    }
    return Mutation(chosen, ordered, time.perf_counter() - start)


def corruptible(claims: Iterable[Claim], select: str = "") -> tuple[Claim, ...]:
    """The claims that are expected to be proved and contain the text.

    Raises
    ------
    InputError
        If there is none.
    """

    chosen = tuple(item for item in claims if item.expected is Verdict.PROVED and item.contains(select))
    if not chosen:
        where = f" contains {select!r} and" if select else ""
        raise InputError(f"no claim{where} is expected to be proved, so that there is nothing to corrupt")
    return chosen


def _made(claim: Claim, others: Sequence[Claim], setting: Setting) -> list[Mutant]:
    return mutants(claim, others, count=setting.count, seed=setting.seed)


def _here(claims: Sequence[Claim], setting: Setting) -> Iterator[tuple[Claim, int, Outcome]]:
    for claim, others in neighbours(claims):
        for place, mutant in enumerate(_made(claim, others, setting)):
            yield claim, place, judge(mutant, Patience(setting.timeout))


def _in_workers(
    claims: Sequence[Claim], derivation: Derivation, workers: int, setting: Setting
) -> Iterator[tuple[Claim, int, Outcome]]:
    """A share of the mutants of a claim at a time in each process; where it dies or hangs, each of them on its own."""
    near = {claim.id: others for claim, others in neighbours(claims)}
    by_id = {claim.id: claim for claim in claims}
    files = tuple(sorted({derivation.homes[claim.id] for claim in claims if claim.id in derivation.homes}))
    # What assumes most takes longest, and shall not be what is waited for at the end.
    order = sorted(claims, key=lambda claim: -len(claim.assumptions))
    named = {claim.id: tuple(other.id for other in near[claim.id]) for claim in claims}
    tasks = {
        (claim.id, share): (claim.id, named[claim.id], setting, share, SHARES)
        for claim in order for share in range(SHARES)
    }  # fmt: skip
    with Workers(min(workers, len(tasks)), start=read, arguments=(files,)) as processes:
        lost = []
        for (id, share), outcome in processes.each(_PATIENCE * setting.timeout, judge_share, tasks):
            if isinstance(outcome, Answered):
                for place, item in outcome.answer:
                    yield by_id[id], place, item
            else:
                lost.append((id, share))
        for id, share in lost:
            made = _made(by_id[id], near[id], setting)
            places = range(share, len(made), SHARES)
            single = {place: (id, named[id], setting, place, len(made)) for place in places}
            for place, answer in processes.each(STEPS * setting.timeout, judge_share, single):
                if isinstance(answer, Answered):
                    yield by_id[id], place, answer.answer[0][1]
                else:
                    yield by_id[id], place, unanswered(made[place], answer.reason)


def judge_share(
    id: str, others: tuple[str, ...], setting: Setting, first: int, every: int
) -> list[tuple[int, Outcome]]:
    """In a worker: what comes of some mutants of a claim that was read, from the first one every so many."""
    made = _remembered(id, others, setting)
    return [(place, judge(made[place], Patience(setting.timeout))) for place in range(first, len(made), every)]


@lru_cache(maxsize=2)
def _remembered(id: str, others: tuple[str, ...], setting: Setting) -> list[Mutant]:
    return _made(READ[id], [READ[other] for other in others], setting)
