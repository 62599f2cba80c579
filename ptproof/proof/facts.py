"""Facts that a proof may use: implications that nobody but this package can make.

There are three kinds: the statement of a claim that is used (:attr:`ptproof.proof.claim.Goal.facts` and
``specialise``), a quantified assumption at a point (``instances``), and a lemma of :mod:`ptproof.proof.lemmas`. Each
remembers the claims and the assumptions that it rests on, and an engine takes it only for a goal that has both.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import wraps
from typing import Any, ParamSpec, Protocol

from ptproof.errors import InputError
from ptproof.proof import steps
from ptproof.proof.definedness import domain_of
from ptproof.proof.statement import Assumption, Implication, Relation

P = ParamSpec("P")
_SEAL = object()
_LIBRARY = "ptproof.proof."


class Goal(Protocol):
    """What facts are used for: a goal with its assumptions and the claims that it may use."""

    @property
    def id(self) -> str: ...
    @property
    def assumptions(self) -> tuple[Assumption, ...]: ...
    @property
    def uses(self) -> tuple[Any, ...]: ...


@dataclass(frozen=True)
class Fact:
    """An implication, with the contents of the claims and the assumptions that it rests on.

    Raises
    ------
    InputError
        If it is made by anybody else than this module.
    """

    says: Implication
    claims: frozenset[str] = frozenset()
    assumptions: frozenset[Assumption] = frozenset()
    seal: Any = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.seal is not _SEAL:
            raise InputError(
                f"a fact comes from a claim that is used, an assumption or a lemma of ptproof.proof, not from "
                f"elsewhere: {self.says}"
            )

    def __str__(self) -> str:
        return str(self.says)


def lemma(statement: Callable[P, Implication]) -> Callable[P, Fact]:
    """Mark a function of this package as a lemma: what it returns holds for all real values.

    Raises
    ------
    InputError
        For a function that stands elsewhere: what a derivation needs beyond the lemmas is a claim.
    """
    if not statement.__module__.startswith(_LIBRARY):
        raise InputError(f"{statement.__module__}.{statement.__qualname__}: lemmas stand in {_LIBRARY}lemmas only")

    @wraps(statement)
    def made(*arguments: P.args, **options: P.kwargs) -> Fact:
        says = statement(*arguments, **options)
        steps.note(steps.Lemma(says))
        return Fact(says, seal=_SEAL)

    return made


def _made_here(says: Implication) -> None:
    """Refuse a caller that is not of this package."""
    frame = inspect.currentframe()
    caller = frame.f_back.f_back if frame is not None and frame.f_back is not None else None
    if caller is None or not str(caller.f_globals.get("__name__")).startswith(_LIBRARY):
        Fact(says)


def resting_on(goal: Goal, says: Implication, claims: Iterable[str] = (), *others: Fact) -> Fact:
    """A fact that was derived from assumptions of a goal, the claims with these contents, and other facts."""
    _made_here(says)
    rests = frozenset(claims).union(*(other.claims for other in others))
    assumed = frozenset(goal.assumptions).union(*(other.assumptions for other in others))
    return Fact(says, rests, assumed, seal=_SEAL)


def from_claim(content: str, says: Implication) -> Fact:
    """A fact that the claim of this content states at its own symbols."""
    _made_here(says)
    return Fact(says, frozenset([content]), seal=_SEAL)


def usable(goal: Goal, facts: Iterable[Any]) -> tuple[Implication, ...]:
    """What the facts say, each shown to rest on nothing that the goal does not have.

    Raises
    ------
    InputError
        For a value that is no fact, and for a fact that rests on a claim or an assumption that the goal lacks.
    """
    said = []
    contents = {used.content for used in goal.uses}
    for fact in facts:
        if not isinstance(fact, Fact) or fact.seal is not _SEAL:
            raise InputError(f"{goal.id}: a proof uses facts, made by lemmas, specialise or instances; got {fact!s}")
        if not fact.claims <= contents:
            raise InputError(f"{goal.id}: a fact rests on a claim that is not among those used: {fact}")
        if not fact.assumptions <= frozenset(goal.assumptions):
            raise InputError(f"{goal.id}: a fact rests on an assumption that the claim does not make: {fact}")
        said.append(fact.says)
    return tuple(said)


def guarded(says: Implication) -> Implication | None:
    """The implication where all that it speaks of is defined; None where nothing says where that is."""
    needs = [need for part in (*says.hypotheses, says.conclusion) for need in domain_of(part)]
    if any(need.relation is None or need.given for need in needs):
        return None
    relations: tuple[Relation, ...] = tuple(need.relation for need in needs if need.relation is not None)
    return Implication((*says.hypotheses, *relations), says.conclusion, says.source)


def is_said(relation: Relation, facts: Iterable[Implication]) -> bool:
    """Whether one of the facts says this without a hypothesis, or a strict inequality of which it is part."""
    part = relation.standard()
    enough = {"!=": ("!=", "<"), "<=": ("<=", "<", "=")}.get(part.sign, (part.sign,))
    sides = {(part.left, part.right)} | ({(part.right, part.left)} if part.sign in ("!=", "=") else set())
    said = (fact.conclusion.standard() for fact in facts if not fact.hypotheses)
    return any(one.sign in enough and (one.left, one.right) in sides for one in said)
