"""Claims: a statement as data, its assumptions, the claims that it uses, and a proof that is a function.

A proof receives a :class:`Goal`, which holds the claim's own statement, and returns evidence about exactly
that. It is never told the verdict that the author expects.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, wraps
from types import FrameType
from typing import Any, Concatenate, ParamSpec, TypeAlias, cast

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.content import digest
from ptproof.proof.erratum import Erratum, erratum
from ptproof.proof.facts import Fact, from_claim, guarded
from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Implication,
    Prose,
    Relation,
    Runs,
    Smooth,
    Statement,
    plain,
    relations_of,
)
from ptproof.proof.verdict import Evidence, Verdict


@dataclass(frozen=True)
class Goal:
    """What a proof has to show: the statement, under the assumptions, with the facts of the claims used."""

    id: str
    statement: Statement
    assumptions: tuple[Assumption, ...] = ()
    uses: tuple[Claim, ...] = ()
    where_defined: bool = False
    example: tuple[tuple[Any, Any], ...] = ()

    @property
    def facts(self) -> tuple[Fact, ...]:
        """The statements of the claims used, at the same symbols, each under that claim's own assumptions."""
        return tuple(fact for used in self.uses for fact in facts_of(used))

    @property
    def relations(self) -> tuple[Relation, ...]:
        """The assumptions that are plain relations."""
        return plain(self.assumptions)


P = ParamSpec("P")
Proof: TypeAlias = Callable[[Goal], Evidence]


@dataclass(frozen=True)
class Claim:
    """One statement of a derivation.

    Attributes
    ----------
    id
        Permanent and unique.
    title
        A few words.
    statement
        What is claimed.
    prove
        The proof: a function from :class:`Goal` to :class:`~ptproof.proof.verdict.Evidence`.
    assumptions
        What is assumed beyond the assumptions of the symbols.
    uses
        The claims that the proof relies on.
    labels
        The paper's labels that this claim covers.
    expected
        What the author expects; recorded, never shown to the proof.
    prose
        The explanation in the report: the docstring of the proof.
    section
        The part of the derivation, for grouping.
    corrects
        The printed claim of which this one is the correction.
    place
        Where in the paper a statement without a label stands.
    where_defined
        Whether it speaks only of the values at which both sides are defined and real; otherwise that they are, for
        all values that the declarations and assumptions allow, is part of what is claimed.
    erratum
        Of a printed claim that is refuted: how grave that is, in words.
    example
        Exact values of all symbols and undefined functions at which the assumptions hold, where nobody finds such
        values by trying. They are checked, and so is the statement there; nothing else rests on them.
    """

    id: str
    title: str
    statement: Statement
    prove: Proof
    assumptions: tuple[Assumption, ...] = ()
    uses: tuple[Claim, ...] = ()
    labels: tuple[str, ...] = ()
    expected: Verdict = Verdict.PROVED
    prose: str = ""
    section: str = ""
    corrects: Claim | None = None
    place: str = ""
    where_defined: bool = False
    erratum: Erratum | None = None
    example: tuple[tuple[Any, Any], ...] = ()

    def __post_init__(self) -> None:
        for used in (*self.uses, *([self.corrects] if self.corrects is not None else [])):
            if not isinstance(used, Claim):
                raise InputError(f"claim {self.id}: `uses` and `corrects` take claims, got {used!r}")
        for given in self.assumptions:
            if not isinstance(given, Relation | ForAll):
                raise InputError(f"claim {self.id}: `given` takes relations such as ge(x, 0), got {given!r}")

    @property
    def kind(self) -> str:
        """A word for the form of the statement."""
        if self.expected in (Verdict.CITED, Verdict.OBSERVED):
            return {Verdict.CITED: "citation", Verdict.OBSERVED: "observation"}[self.expected]
        match self.statement:
            case Exists():
                return "existence"
            case Smooth():
                return "smoothness"
            case Runs():
                return "runs"
            case Relation() | All():
                parts = relations_of(self.statement)
                if any(part.has(sp.Limit) for part in parts):
                    return "limit"
                return "equality" if all(part.sign == "=" for part in parts) else "inequality"
        return "statement"

    @cached_property
    def content(self) -> str:
        """What is claimed, as a hash: statement, assumptions, flags, and the contents of all claims that it uses.

        Neither the id, the words nor the proof are part of it, so that who relies on a claim relies on what it says.
        """
        used = tuple(used.content for used in self.uses)
        return digest(self.statement, self.assumptions, self.where_defined, used)

    def contains(self, text: str) -> bool:
        """Whether the text stands in its id, title, section or labels, in small or large letters."""
        return any(text.lower() in word.lower() for word in (self.id, self.title, self.section, *self.labels))

    def goal(self) -> Goal:
        """What the proof receives."""
        return Goal(self.id, self.statement, self.assumptions, self.uses, self.where_defined, self.example)


@dataclass(frozen=True)
class Definition:
    """A displayed formula that introduces something: nothing to decide, but its label is covered.

    What the paper uses of it (an initial value, a sign, a limit) is stated as claims beside it.
    """

    id: str
    title: str
    labels: tuple[str, ...]
    statement: Statement
    prose: str = ""
    section: str = ""
    place: str = ""


def claim(
    id: str,
    title: str,
    states: Statement,
    *,
    given: Iterable[Assumption] = (),
    uses: Iterable[Claim] = (),
    labels: Iterable[str] = (),
    expected: str = "proved",
    corrects: Claim | None = None,
    place: str = "",
    where_defined: bool = False,
    grade: str = "",
    wrong: str = "",
    survives: str = "",
    example: Mapping[Any, Any] | None = None,
) -> Callable[[Proof], Claim]:
    """Make the decorated proof a :class:`Claim`; its docstring is the prose of the report.

    The section is the ``SECTION`` of the module in which this is called. ``grade``, ``wrong`` and ``survives`` make a
    printed claim that is refuted an :class:`~ptproof.proof.erratum.Erratum`.
    """
    section = _section_of_caller(inspect.currentframe())
    said, values = erratum(id, expected, grade, wrong, survives), tuple((example or {}).items())

    def make(prove: Proof) -> Claim:
        return Claim(
            id, title, states, prove, tuple(given), tuple(uses), labels_of(id, labels), Verdict(expected),
            inspect.cleandoc(prove.__doc__ or ""), section, corrects, place, where_defined, said, values,
        )  # fmt: skip

    return make


def _section_of_caller(frame: FrameType | None) -> str:
    caller = frame.f_back if frame is not None else None
    return str(caller.f_globals.get("SECTION", "")) if caller is not None else ""


def definition(
    id: str, title: str, states: Statement, *, labels: Iterable[str], prose: str = "", section: str = "",
    place: str = "",
) -> Definition:  # fmt: skip
    """A displayed definition, with its ``place`` if it has no label; ``section`` is that of the module that calls."""
    section = section or _section_of_caller(inspect.currentframe())
    return Definition(id, title, labels_of(id, labels), states, inspect.cleandoc(prose), section, place)


def labels_of(id: str, labels: Iterable[str]) -> tuple[str, ...]:
    """The labels that the item ``id`` names, refused where they are one text."""
    if isinstance(labels, str):
        raise InputError(f"{id}: `labels` takes a list of labels, got the text {labels!r}")
    return tuple(labels)


def facts_of(used: Claim) -> tuple[Fact, ...]:
    """What ``used`` says at its own symbols, as facts under its own assumptions; nothing if those are quantified.

    At other values it is :func:`ptproof.proof.engines.quantified.specialise` that says it. A claim that speaks only
    of where it is defined says nothing elsewhere.
    """
    if isinstance(used.statement, Prose | Smooth | Exists | Runs):
        return ()
    if any(not isinstance(item, Relation) for item in used.assumptions):
        return ()
    said = (Implication(plain(used.assumptions), part, source=used.id) for part in relations_of(used.statement))
    limited = (guarded(says) if used.where_defined else says for says in said)
    return tuple(from_claim(used.content, says) for says in limited if says is not None)


_SEAL = object()
_ENGINES = "ptproof.proof.", "ptproof.certify."


@dataclass(frozen=True)
class Certificate:
    """What an engine was asked about and what it said; nobody but :func:`engine` makes one."""

    goal: Goal
    says: Evidence
    seal: Any = field(default=None, repr=False, compare=False)

    @property
    def genuine(self) -> bool:
        """Whether it was made by :func:`engine`."""
        return self.seal is _SEAL


def engine(proof: Callable[Concatenate[Goal, P], Evidence]) -> Callable[Concatenate[Goal, P], Evidence]:
    """Mark a function as an engine: its evidence carries the goal that it was asked about, and its verdict.

    A claim takes evidence about nothing but its own goal (:func:`ptproof.proof.deciding.run_one`), so that a proof
    that changes the statement, adds an assumption or rewrites what the engine said shows nothing. An engine that stands
    outside of these packages may observe and cite; it proves and refutes nothing.
    """

    @wraps(proof)
    def certified(goal: Goal, *arguments: P.args, **options: P.kwargs) -> Evidence:
        found = proof(goal, *arguments, **options)
        if found.verdict in (Verdict.PROVED, Verdict.REFUTED) and not proof.__module__.startswith(_ENGINES):
            reason = f"{proof.__module__}.{proof.__name__} is no engine of ptproof, which said {found.verdict}"
            found = replace(found, verdict=Verdict.UNDECIDED, detail=f"{reason}: {found.detail}", witness=None)
        says = replace(found, certifies=None, besides=())
        return replace(says, certifies=Certificate(goal, says, _SEAL))

    # The name of the first parameter is lost in the type of a wrapped function.
    return cast("Callable[Concatenate[Goal, P], Evidence]", certified)


def cited(reference: str) -> Proof:
    """The proof of a statement that is taken from the literature: no proof, and it says so."""

    @engine
    def prove(goal: Goal) -> Evidence:
        return Evidence("citation", Verdict.CITED, reference)

    prove.__doc__ = f"Taken from the literature: {reference}."
    return prove
