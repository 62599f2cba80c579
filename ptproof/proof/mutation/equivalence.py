"""Whether a mutant says the same as its original, or less, and how that is shown."""

from __future__ import annotations

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Claim, Goal
from ptproof.proof.definedness import domain_of
from ptproof.proof.engines.exact import definitions_in, resolve
from ptproof.proof.engines.reals import are_met, follows
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.statement import All, Assumption, ForAll, Relation, free_symbols, plain, relations_of

SECONDS = 0.3


def equivalent(mutant: Mutant) -> str:
    """How it is shown that the mutant says the same as the original; empty where it is not shown.

    A changed relation says the same where the differences of the sides agree by exact algebra, the symbols that are
    assumed to be expressions put in; or where z3 shows each from the other under the assumptions, unless it shows
    the changed one from the assumptions alone: then it is true whatever the original says. A changed assumption says
    the same where each follows from the other, and a dropped one where it follows from the rest.
    """
    old, new = mutant.original, mutant.claim
    if (old.uses, old.where_defined) != (new.uses, new.where_defined) or not _relational(old) or not _relational(new):
        return ""
    if old.statement == new.statement:
        return _same_assumptions(old, new)
    if old.assumptions != new.assumptions or not _same_symbols(old, new):
        return ""
    ways = set()
    for before, after in _changed(old, new):
        if not _same_domain(before, after, plain(new.assumptions)):
            return ""
        if _agree(before, after, new.goal()):
            ways.add("exact algebra")
        elif _both_ways(before, after, plain(new.assumptions)):
            ways.add("z3 in both directions")
        else:
            return ""
    return " and ".join(sorted(ways))


def implied(mutant: Mutant) -> str:
    """How it is shown that the mutant is true where the original is; empty where it is not shown."""
    old, new = mutant.original, mutant.claim
    if (old.statement, old.assumptions) == (new.statement, new.assumptions):
        return "it states what the original states"
    if not _relational(old) or not _relational(new):
        return ""
    if old.statement == new.statement:
        if all(_follows_from(item, new.assumptions) for item in old.assumptions if item not in new.assumptions):
            return "it assumes at least what the original assumes (z3)"
        return ""
    if old.assumptions != new.assumptions or not _same_symbols(old, new):
        return ""
    known = (*plain(new.assumptions), *relations_of(old.statement))
    parts = [after for _, after in _changed(old, new)]
    if all(follows(part, plain(new.assumptions), seconds=SECONDS).shown for part in parts):
        return "what is changed follows from the assumptions (z3)"
    if all(follows(part, known, seconds=SECONDS).shown for part in parts):
        return "it follows from the original (z3)"
    return ""


def _relational(claim: Claim) -> bool:
    return isinstance(claim.statement, Relation | All)


def _same_symbols(old: Claim, new: Claim) -> bool:
    """Whether the new claim speaks of no other symbols: one of another declaration has other values."""
    return free_symbols([new.statement]) <= free_symbols([old.statement, *old.assumptions])


def _changed(old: Claim, new: Claim) -> list[tuple[Relation, Relation]]:
    pairs = zip(relations_of(old.statement), relations_of(new.statement), strict=True)
    return [(before, after) for before, after in pairs if before != after]


def _same_domain(before: Relation, after: Relation, known: tuple[Relation, ...]) -> bool:
    """Whether what has to be defined is the same for both, or shown to be defined."""
    needs = [set(domain_of(relation)) for relation in (before, after)]
    return are_met(list(needs[0] ^ needs[1]), known, seconds=SECONDS).shown


def _agree(before: Relation, after: Relation, goal: Goal) -> bool:
    """Whether the two differ by a change of form only."""
    if before.sign != after.sign:
        return False
    given = definitions_in(goal)
    first, second = (resolve(item.left - item.right, given) for item in (before, after))
    signs = (1, -1) if after.sign in ("=", "!=") else (1,)
    try:
        return any(is_zero(first - sign * second) for sign in signs)
    except NotAlgebraic:
        return False


def _both_ways(before: Relation, after: Relation, known: tuple[Relation, ...]) -> bool:
    if not follows(after, (*known, before), seconds=SECONDS).shown:
        return False
    if not follows(before, (*known, after), seconds=SECONDS).shown:
        return False
    return not follows(after, known, seconds=SECONDS).shown


def _same_assumptions(old: Claim, new: Claim) -> str:
    """Whether each list of assumptions follows from the other."""
    for stronger, weaker in ((new, old), (old, new)):
        missing = [item for item in weaker.assumptions if item not in stronger.assumptions]
        if not all(_follows_from(item, stronger.assumptions) for item in missing):
            return ""
    return "the assumptions follow from each other (z3)"


def _follows_from(item: Assumption, given: tuple[Assumption, ...]) -> bool:
    if isinstance(item, ForAll):
        return False
    return all(follows(part, plain(given), seconds=SECONDS).shown for part in item.components())
