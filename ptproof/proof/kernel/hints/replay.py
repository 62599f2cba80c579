"""The steps of a claim's proof, taken again by Coq: the claims that it puts to use are lemmas there.

What is taken from the proof is only which claim is used at which values. Coq shows for itself whatever the lemma
assumes there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.kernel import declared
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.refuted import follows
from ptproof.proof.kernel.hints.told import Told, in_other_words, text_of
from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import Proposition, everywhere, given, outside
from ptproof.proof.statement import (
    ForAll,
    Implication,
    Relation,
    RelationSign,
    plain,
    relations_of,
    undefined_functions,
)
from ptproof.proof.steps import Anywhere, At, Lemma, Put, Step
from ptproof.proof.substitution import Substitution

# Tactics for one part, from what is known and the names.
Leaf = Callable[[Part, list[Relation], Names], str]


@dataclass(frozen=True)
class Replay:
    """The steps of a claim's proof for Coq.

    Parameters
    ----------
    said
        The claim.
    lemmas
        The claims that it uses, by their contents, with the names under which Coq knows them.
    assumed
        The names of the claim's premises in Coq, in their order.
    leaf
        Finds the tactics for one part.
    """

    said: Proposition
    lemmas: Mapping[str, tuple[str, Proposition]]
    assumed: tuple[str, ...]
    leaf: Leaf

    def take(self, steps: Iterable[Step], told: Told) -> None:
        """Take the steps one after the other; one that Coq cannot take is left out there.

        A claim is put to use once what it assumes follows from what is known; where it never does, last.
        """
        left = list(steps)
        while left:
            ready = [step for step in left if self._is_ready(step, told)] or left
            self._take(ready[:1] if ready is left else ready, told)
            left = [step for step in left if step not in (ready[:1] if ready is left else ready)]

    def _take(self, steps: Iterable[Step], told: Told) -> None:
        for step in steps:
            here = Told(told.names, list(told.known), [])
            try:
                match step:
                    case Put():
                        self._put(step, here)
                    case At(point):
                        self._at(point, here)
                    case Lemma(says):
                        self._lemma(says, here)
            except (NoTranslation, InputError):
                continue
            if here.lines:
                told.known[:] = here.known
                told.lines.append(f"try ({'; '.join(here.lines)})")

    def _is_ready(self, step: Step, told: Told) -> bool:
        """Whether nothing that a used claim assumes is seen not to follow yet."""
        if not isinstance(step, Put) or step.content not in self.lemmas:
            return True
        values = Substitution(dict(step.values), has_sign=lambda value, sign: True)
        known = set(map(Relation.standard, told.known))
        for item in self.lemmas[step.content][1].claim.assumptions:
            for part in () if isinstance(item, ForAll) else item.components():
                try:
                    wanted = values.relation(part)
                except InputError:
                    continue
                if wanted.standard() not in known and follows(Goal(wanted, tuple(told.known), told.names)) is False:
                    return False
        return True

    def _put(self, step: Put, told: Told) -> None:
        if step.content not in self.lemmas:
            return
        name, used = self.lemmas[step.content]
        if not step.values and not all(self._in_scope(item, told) for item in _items(used)):
            return
        # Of what nobody speaks here, the lemma is told one value that its kind allows.
        some = {item: sp.S.NegativeOne if item.is_negative else sp.S.One for item in _items(used)
                if isinstance(item, sp.Symbol) and not self._in_scope(item, told)}  # fmt: skip
        values = Substitution(some | dict(step.values), has_sign=lambda value, sign: True)
        key = told.new("K")
        told.lines.append(
            f"pose proof ({name} {' '.join(self._arguments(used, values, told))}) as {key}; cbv beta in {key}"
        )
        anywhere = iter(step.assumed)
        for tactic in self._premises(used, values, anywhere, told):
            told.lines.append(f"assumed {key} ltac:({tactic})")
        self._learn(key, used.conclusions, relations_of(used.claim.statement), values, told)

    def _arguments(self, used: Proposition, values: Substitution, told: Told) -> Iterator[str]:
        written = {key.func: (key, value) for key, value in values.values.items() if isinstance(key, AppliedUndef)}
        for item in _items(used):
            if item in written:
                key, value = written[item]
                names = dict(told.names)
                for symbol in key.args:
                    names[symbol] = fresh(
                        f"{used.names.get(symbol, 'u')}", {k: v for k, v in names.items() if k != symbol}
                    )
                yield f"(fun {' '.join(names[symbol] for symbol in key.args)} => {term(value, names)})"
            elif item in values.values:
                yield term(values.values[item], told.names)
            elif self._in_scope(item, told):
                yield told.names[item]
            else:
                arity = next(len(call.args) for call in _calls(used) if call.func == item)
                yield f"(fun {' '.join('_' * arity)} => 1)"

    def _in_scope(self, item: Any, told: Told) -> bool:
        """Whether the claim speaks of this letter for all its values, so that it stands in Coq's context."""
        return told.names.get(item) in self.said.binders

    def _premises(
        self, used: Proposition, values: Substitution, anywhere: Iterator[Anywhere], told: Told
    ) -> Iterator[str]:
        """A tactic for each premise of the lemma, in their order."""
        symbols = [item for item in _items(used) if isinstance(item, sp.Symbol)]
        count = 0
        for symbol in symbols:
            for text in declared.of_symbol(symbol, "x"):
                count += 1
                yield self._kind(text, values.into(symbol), told)
        own = [given(item, used.names) for item in outside(used.claim)]
        behind = sum(map(len, own))
        rest = len(used.premises) - behind
        if used.claim.where_defined:
            raise NoTranslation("only where it is defined")
        for _ in used.premises[count:rest]:
            yield "function_premise"
        for item, parts in zip(outside(used.claim), own, strict=True):
            if isinstance(item, ForAll):
                yield self._quantified(item, used.names, values, next(anywhere, Anywhere()), told)
                continue
            for part in parts:
                if part.base is not None and part.exponent is not None:
                    there = replace(part, base=values.into(part.base), exponent=values.into(part.exponent))
                    yield self.leaf(there, told.known, told.names)
                    continue
                yield self._shown(replace(part, relation=part.relation and values.relation(part.relation)), told)

    def _kind(self, text: str, value: sp.Expr, told: Told) -> str:
        if text.startswith("is_integer"):
            return "whole"
        signs: dict[str, RelationSign] = {
            "0 < x": ">", "x < 0": "<", "0 <= x": ">=", "x <= 0": "<=", "x <> 0": "!=", "x = 0": "=",
        }  # fmt: skip
        relation = Relation(value, signs[text], sp.S.Zero)
        if value.is_number:
            return "lra"
        return f"first [ sign | {self._shown(Part('', relation.standard() if '<' in text else relation), told)} ]"

    def _shown(self, part: Part, told: Told) -> str:
        """A premise, first as the claim itself would say it."""
        if part.relation is None:
            return f"simple_powers; {self.leaf(part, told.known, told.names)}"
        told.spoken(part.relation)
        return f"as_claimed ({text_of(part.relation, told.names)}) ltac:({self._leaf(part.relation, told)})"

    def _leaf(self, relation: Relation, told: Told) -> str:
        if relation.standard() in map(Relation.standard, told.known):
            return "quickly"
        if (said := in_other_words(relation, told.known)) is not None:
            return f"as_claimed ({text_of(said, told.names)}) ltac:(quickly)"
        return self.leaf(Part("", relation), told.known, told.names)

    def _quantified(
        self, item: ForAll, names: Names, values: Substitution, anywhere: Anywhere, told: Told
    ) -> str:  # fmt: skip
        """An assumption of the lemma, for all values: assumed, or shown at an arbitrary one."""
        inside = told.inside()
        points = anywhere.point or item.variables
        for variable, point in zip(item.variables, points, strict=True):
            inside.names[point] = fresh(f"{variable.name if variable.name.isidentifier() else 'u'}_", inside.names)
        there = Substitution(dict(zip(item.variables, points, strict=True)), has_sign=lambda value, sign: True)
        inside.known += [there.relation(part) for part in plain(values.quantified(item).domain)]
        intro = f"intros {' '.join(inside.names[point] for point in points)}; intros; facts"
        self._at(tuple(points), inside)
        self.take(anywhere.steps, inside)
        parts = [
            replace(
                part,
                relation=part.relation
                and there.relation(values.quantified(replace(item, relation=part.relation)).relation),
            )
            for part in everywhere(item, names)
        ]
        leaves = " | ".join(self._shown(part, inside) for part in parts)
        return f"assumption || ({'; '.join([intro, *inside.lines, 'pieces'])}; [> {leaves} ])"

    def _at(self, point: tuple[Any, ...], told: Told) -> None:
        """The claim's own quantified assumptions at a point, those that can be taken there."""
        position = len(self.said.premises) - sum(len(given(item, self.said.names)) for item in outside(self.said.claim))
        for item in outside(self.said.claim):
            if isinstance(item, ForAll) and len(item.variables) == len(point):
                here = Told(told.names, list(told.known), [])
                with suppress(NoTranslation, InputError):
                    self._instance(item, self.assumed[position], point, here)
                    told.known[:] = here.known
                    told.lines.append(f"try ({'; '.join(here.lines)})")
            position += len(given(item, self.said.names))

    def _instance(self, item: ForAll, name: str, point: tuple[Any, ...], told: Told) -> None:
        """An assumption, which Coq knows by its name, at a point.

        Raises
        ------
        NoTranslation
            Also where the point is seen not to be one of its domain.
        """
        point = tuple(map(sp.sympify, point))
        there = Substitution(dict(zip(item.variables, point, strict=True)), has_sign=lambda value, sign: True)
        key = told.new("I")
        values = " ".join(term(value, told.names) for value in point)
        told.lines.append(f"pose proof ({name} {values}) as {key}; cbv beta in {key}")
        for variable in item.variables:
            for text in declared.of_symbol(variable, "x"):
                told.lines.append(f"assumed {key} ltac:({self._kind(text, there.into(variable), told)})")
        for part in plain(item.domain):
            for piece in given(part, self.said.names):
                said = replace(piece, relation=piece.relation and there.relation(piece.relation))
                if said.relation and follows(Goal(said.relation, tuple(told.known), told.names)) is False:
                    raise NoTranslation("not in the domain")
                told.lines.append(f"assumed {key} ltac:({self._shown(said, told)})")
        self._learn(key, everywhere(item, self.said.names), item.relation.components(), there, told)

    def _lemma(self, says: Implication, told: Told) -> None:
        names, known = told.names, told.known
        if not says.conclusion.free_symbols or not self._is_met(says, told):
            return
        for part in says.hypotheses:
            told.lines.append(f"assert ({text_of(part, names)}) by (first [ assumption | {self._leaf(part, told)} ])")
        told.lines.append(f"assert ({text_of(says.conclusion, names)}) by library_lemma")
        known.append(says.conclusion)

    def _is_met(self, says: Implication, told: Told) -> bool:
        """Whether nothing that the implication assumes is seen not to follow."""
        known = tuple(told.known)
        return all(item in known or follows(Goal(item, known, told.names)) is not False for item in says.hypotheses)

    def _learn(
        self, key: str, parts: Sequence[Part], spoken: Sequence[Relation], values: Substitution, told: Told
    ) -> None:  # fmt: skip
        """The parts by names of their own, and what was ``spoken`` in the claim's words; not what has to be defined."""
        names = [told.new("T") for _ in parts]
        pattern = names[-1]
        for name in reversed(names[:-1]):
            pattern = f"[{name} {pattern}]"
        told.lines.append(f"destruct {key} as {pattern}" if len(names) > 1 else f"rename {key} into {pattern}")
        for name, part in zip(names, parts, strict=True):
            if part.relation not in spoken or part.relation is None or part.limit is not None:
                continue
            said = told.spoken(values.relation(part.relation))
            told.known.append(said)
            told.lines.append(f"as_known ({text_of(said, told.names)}) {name}")


def _items(said: Proposition) -> list[Any]:
    """The functions and symbols that a proposition is about, in the order of its binders."""
    items = {name: item for item, name in said.names.items()}
    return [items[name] for name in said.binders]


def _calls(used: Proposition) -> set[AppliedUndef]:
    return undefined_functions([used.claim.statement, *used.claim.assumptions])
