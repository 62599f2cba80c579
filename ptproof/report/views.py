"""What the report says of each claim and each definition, before it is known what became of printed sides."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

import sympy as sp

from ptproof.proof.claim import Claim, Definition
from ptproof.proof.load import Derivation
from ptproof.proof.result import Result, Verification
from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Prose,
    Relation,
    Statement,
    expressions_of,
    free_symbols,
    relations_of,
    undefined_functions,
)
from ptproof.proof.verdict import Evidence
from ptproof.report.formula import domain_of, latex
from ptproof.report.letters import spelled
from ptproof.report.model import ClaimView, DefinitionView, Ref
from ptproof.report.read import ReadSide
from ptproof.report.spoken import Letters, spoken
from ptproof.report.status import Status, status_of
from ptproof.report.typeset import Typeset
from ptproof.report.witness import witness_view

_View = TypeVar("_View", ClaimView, DefinitionView)


@dataclass(frozen=True)
class Views:
    """All that is said of each claim and definition but for what became of its printed side.

    ``spellings`` are those of the paper's letters.
    """

    refs: Mapping[str, Ref]
    claims: Mapping[str, ClaimView]
    definitions: tuple[DefinitionView, ...]
    spellings: frozenset[str]

    def beside(self, view: _View, read: ReadSide | None) -> _View:
        """The view with its printed side, whose letters may stand for something else."""
        if read is None:
            return view
        others = self.spellings.intersection(map(spelled, read.apart))
        return replace(view, read=read, unlike=tuple(sorted(others.union(view.unlike))))


def views_of(verification: Verification, derivation: Derivation, typeset: Typeset) -> Views:
    """What can be said before it is known what became of printed sides, which is nearly all."""
    results = {result.claim.id: result for result in verification.results}
    refs = _refs(verification.results, derivation.definitions, results)
    composer = _Composer(results, refs, typeset)
    claims = {result.claim.id: composer.claim(result) for result in verification.results}
    definitions = tuple(composer.definition(item) for item in derivation.definitions)
    return Views(refs, claims, definitions, frozenset(composer.spellings))


class _Composer:
    def __init__(
        self,
        results: Mapping[str, Result],
        refs: Mapping[str, Ref],
        typeset: Typeset,
    ) -> None:
        self.results, self.refs = results, refs
        self.lines, self.glyphs = typeset.lines, (glyphs := typeset.names)
        self.letters = Letters(glyphs)
        self.spellings = {spelled(glyph) for glyph in glyphs.values()}
        self.users: dict[str, list[str]] = {}
        self.corrections: dict[str, list[str]] = {}
        for result in results.values():
            for used in result.claim.uses:
                self.users.setdefault(used.id, []).append(result.claim.id)
            if result.claim.corrects is not None:
                self.corrections.setdefault(result.claim.corrects.id, []).append(result.claim.id)

    def links(self, ids: Sequence[str]) -> tuple[Ref, ...]:
        return tuple(self.refs[id] for id in dict.fromkeys(ids) if id in self.refs)

    def claim(self, result: Result) -> ClaimView:
        claim = result.claim
        witness = next((item.witness for item in result.evidence if item.witness is not None), None)
        corrects = self.links([claim.corrects.id]) if claim.corrects is not None else ()
        return ClaimView(
            ref=self.refs[claim.id],
            status=status_of(result, self.results),
            expected="" if result.as_expected else str(claim.expected),
            labels=claim.labels,
            place=claim.place,
            kind=claim.kind,
            lines=self.lines(claim.statement),
            words=claim.statement.text if isinstance(claim.statement, Prose) else "",
            same=_same(claim),
            domain=domain_of([claim.statement, *claim.assumptions], _bound(claim), self.glyphs),
            given=tuple(self.lines(item) for item in claim.assumptions),
            evidence=self.evidence(result),
            witness=None if witness is None else witness_view(witness, claim, self.glyphs),
            uses=self.links([used.id for used in claim.uses]),
            used_by=self.links(self.users.get(claim.id, [])),
            rests_on=self.links([id for id in result.rests_on if id != claim.id]),
            corrects=corrects[0] if corrects else None,
            corrected_by=self.links(self.corrections.get(claim.id, [])),
            prose=claim.prose,
            erratum=claim.erratum,
            unlike=self.unlike([claim.statement, *claim.assumptions]),
        )

    def evidence(self, result: Result) -> tuple[Evidence, ...]:
        """What the engines said, in the letters of the paper."""
        claim = result.claim
        letters = self.letters.of([claim.statement, *claim.assumptions])
        used = [item.id for item in claim.uses]
        return tuple(
            replace(item, detail=spoken(without_places(item.detail), letters, used)) for item in result.evidence
        )

    def definition(self, item: Definition) -> DefinitionView:
        words = item.statement.text if isinstance(item.statement, Prose) else ""
        return DefinitionView(
            self.lines(item.statement), words, self.refs[item.id], item.labels, item.prose,
            self.unlike([item.statement]),
        )  # fmt: skip

    def unlike(self, statements: Sequence[Statement | Assumption]) -> tuple[str, ...]:
        """The glyphs that do not stand here for what the notation says: other letters, bound ones, functions."""
        quantified = [said for said in statements if isinstance(said, Exists | ForAll)]
        bound = {symbol for said in quantified for symbol in (*said.variables, *getattr(said, "over", ()))}
        free = free_symbols(statements) - (
            bound - free_symbols([said for said in statements if said not in quantified])
        )
        named = set[sp.Symbol]().union(*map(_letters, expressions_of(statements)))
        functions = {sp.Symbol(applied.func.__name__) for applied in undefined_functions(statements)}
        others = {item for item in named | functions if item not in self.glyphs or item not in free}
        return tuple(sorted({spelled(latex(item, self.glyphs)) for item in others} & self.spellings))


@lru_cache(maxsize=8192)
def _letters(expression: sp.Expr) -> frozenset[sp.Symbol]:
    return frozenset(expression.atoms(sp.Symbol))  # claims share what they assume


def _same(claim: Claim) -> bool:
    """Whether the two sides are one expression as they stand, which a reader should be told."""
    if not isinstance(claim.statement, Relation | All):
        return False
    return all(part.sign == "=" and part.left == part.right for part in relations_of(claim.statement))


def _bound(claim: Claim) -> tuple[object, ...]:
    return (*claim.statement.variables, *claim.statement.over) if isinstance(claim.statement, Exists) else ()


def _refs(results: Sequence[Result], definitions: Sequence[Definition], by_id: Mapping[str, Result]) -> dict[str, Ref]:
    """A link for each id; two ids that would become one anchor are told apart by a number."""
    taken: Counter[str] = Counter()
    found: dict[str, Ref] = {}

    def add(id: str, title: str, mark: Status | None) -> None:
        anchor = "c-" + (re.sub(r"[^A-Za-z0-9]+", "-", id).strip("-").lower() or "claim")
        taken[anchor] += 1
        if taken[anchor] > 1:
            anchor = f"{anchor}--{taken[anchor]}"
        found[id] = Ref(id, anchor, title, mark)

    for result in results:
        add(result.claim.id, result.claim.title, status_of(result, by_id))
    for item in definitions:
        add(item.id, item.title, None)
    return found


def without_places(text: str) -> str:
    """The text without folders and addresses of memory, which differ from machine to machine and run to run."""
    text = re.sub(r"(?<![\w/.])/(?:[\w.@+-]+/)+", "", text)
    return re.sub(r"0x[0-9a-fA-F]{6,}", "0x…", text)
