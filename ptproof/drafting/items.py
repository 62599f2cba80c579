"""What each formula of a paper becomes: a definition, a claim or a gap.

- The first equation whose left side is one letter, its rate, or a function at letters is a *definition* of that, and so
  is one that can be solved for the rate of a letter of which nothing is said yet. So is one of a function at a shifted
  time, as ν(t − t₀), and of one at functions that occurs first there. So is what stands in an assumption of the paper,
  an inequality between bare letters or numbers, and a definition repeated.
- An equation for a rate that is defined, in which another letter that moves occurs for the first time, is no result of
  what was said before: another *system* begins. The rates of its letter, its solution and its laws are said anew.
- Every other relation is a *claim*, under the definitions of its letters that come before it in the text.
- The rate of what is defined is what the chain rule makes of it: an equation for it is a claim.
- What was not read, and what cannot be a claim, is a *gap*.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.drafting.facts import (
    Fact,
    depends,
    for_all,
    is_again,
    is_general,
    law_of,
    of_atoms,
    puts_in,
    unshifted,
    unwritable,
)
from ptproof.drafting.headings import Heading, slug
from ptproof.drafting.names import unused
from ptproof.drafting.paper import Paper
from ptproof.drafting.rates import Said
from ptproof.drafting.stated import Stated
from ptproof.drafting.systems import begins_anew, outdated
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.statements import Pair


@dataclass(frozen=True)
class Item:
    """One entry of a section file.

    ``facts`` are the equations of a definition that stand under a name of their own, ``known`` those of another entry,
    and ``others`` its other relations. A claim is under the ``givens``; ``again`` are those whose letter is its left
    side, which is what the paper says of it a second time, and ``stated`` is what the paper says of its letters alone.
    ``puts`` has for each of these relations the definitions of the functions that occur in it, and ``rules`` what the
    chain rule says of the rates that occur, where that is not said before.
    """

    kind: str
    id: str
    variable: str
    formula: Formula
    heading: Heading
    why: str = ""
    facts: tuple[Fact, ...] = ()
    known: tuple[Fact, ...] = ()
    others: tuple[Pair, ...] = ()
    pairs: tuple[Pair, ...] = ()
    conditions: tuple[Pair, ...] = ()
    givens: tuple[Fact, ...] = ()
    again: tuple[Fact, ...] = ()
    stated: tuple[Stated, ...] = ()
    puts: Mapping[Pair, tuple[Fact, ...]] = field(default_factory=dict)
    rules: tuple[Fact, ...] = ()
    remarks: tuple[str, ...] = ()


def items_of(paper: Paper) -> tuple[tuple[Item, ...], dict[str, str]]:
    """The entries of all section files, in the order of the text, and what functions mean for every argument."""
    twice = set[str]()
    while True:  # no single definition holds for a function that two systems have
        drafting = _Drafting(paper, twice=set(twice))
        items = tuple(item for said in paper.said for item in drafting.of(said))
        if drafting.twice == twice:
            break
        twice = drafting.twice
    return items, {key: value for fact in drafting.general.values() for key, value in [for_all(fact)]}


@dataclass
class _Drafting:
    paper: Paper
    facts: dict[sp.Expr, Fact] = field(default_factory=dict)
    general: dict[str, Fact] = field(default_factory=dict)
    ids: set[str] = field(default_factory=set)
    names: set[str] = field(default_factory=set)
    twice: set[str] = field(default_factory=set)

    def of(self, said: Said) -> Iterator[Item]:
        heading = self.paper.outline.heading(said.formula.line)
        number = heading.number or heading.file.split("_")[0].removeprefix("section")
        base = slug(said.formula.place.split(":", 1)[-1].replace("Section", ""), 60).replace("_", "-")
        self.id, self.formula, self.heading = unused(f"{number}/{base}", self.ids), said.formula, heading
        self.ids.add(self.id)
        if said.reading is None:
            yield self.gap(said.why)
            return
        pairs = [*said.reading.pairs, *said.reading.braces]
        if why := unwritable([*pairs, *said.reading.conditions]) or self.resting(pairs):
            yield self.gap(f"line {said.formula.line}: {why}")
            return
        yield from self.read(pairs, said.reading.conditions, said.reading.unread)

    def gap(self, why: str) -> Item:
        return Item("gap", self.id, self.variable("gap"), self.formula, self.heading, why=why)

    def variable(self, kind: str) -> str:
        word = slug(self.id.replace("/", "_"), 60)
        name = unused(f"{kind}_{word}", self.names)
        self.names.add(name)
        return name

    def read(self, pairs: Sequence[Pair], conditions: Sequence[Pair], unread: Sequence[str]) -> Iterator[Item]:
        facts, known, others, claims, rules = [], [], [], [], []
        assumed = self.paper.outline.is_assumed(self.formula.line)
        for pair in pairs:
            rules += self.chain_rule(pair)
            at_all = unshifted(pair, self.paper.table["times"])
            if at_all is not None and self.is_definition(at_all):
                facts.append(self.new_fact(at_all, pair.left.args[0]))
            elif self.is_definition(pair):
                facts.append(self.new_fact(pair))
            elif (law := law_of(pair, self.paper.moved, self.facts)) is not None and self.is_definition(law):
                facts.append(self.new_fact(law, written=pair))
            elif (fact := self.facts.get(pair.left)) is not None and is_again(fact, pair):
                known.append(fact)
            elif fact is not None and begins_anew(fact, pair, self.formula.line, self.paper):
                self.forget(pair.left)
                facts.append(self.new_fact(pair))
            elif assumed or of_atoms(pair, self.facts):
                others.append(pair)
            else:
                claims.append(pair)
        if facts or known or others:
            spoken = [*others, *conditions] if not claims else others
            yield Item(
                "definition", self.id, self.variable("defined"), self.formula, self.heading, facts=tuple(facts),
                known=tuple(known), others=tuple(spoken), rules=tuple(rules), remarks=tuple(unread),
            )  # fmt: skip
            rules = []
        if claims:
            id = self.id if not (facts or known or others) else unused(f"{self.id}-holds", self.ids)
            self.ids.add(id)
            yield self.claim(id, claims, conditions, rules, unread)

    def claim(
        self, id: str, claims: Sequence[Pair], conditions: Sequence[Pair], rules: Sequence[Fact], unread: Sequence[str]
    ) -> Item:
        givens = tuple(self.givens([*claims, *conditions]))
        again = tuple(
            fact for fact in givens if not fact.chain and any(p.sign == "=" and fact.head == p.left for p in claims)
        )
        every = [*claims, *conditions, *(fact.pair for fact in givens)]
        puts = puts_in(every, self.general)
        every += [fact.pair for used in puts.values() for fact in used]
        letters = {symbol for pair in every for symbol in pair.left.free_symbols | pair.right.free_symbols}
        return Item(
            "claim", id, self.variable("stated"), self.formula, self.heading, pairs=tuple(claims),
            conditions=tuple(conditions), givens=givens, again=again, puts=puts, rules=tuple(rules),
            remarks=tuple(unread), stated=self.paper.conditions.of(letters),
        )  # fmt: skip

    # --- Definitions -------------------------------------------------------------------------------------------------

    def is_definition(self, pair: Pair) -> bool:
        head = pair.left
        if pair.sign != "=" or head in self.facts or not self.may_be_head(head):
            return False
        times = self.paper.table["times"]
        if head.is_Symbol and head.name in times and not {s.name for s in pair.right.free_symbols} & {*times}:
            return False  # an instant; a change of time is a definition
        return not depends(pair.right, head, self.facts)

    def may_be_head(self, head: sp.Expr) -> bool:
        if head.is_Symbol:
            return head.name in self.paper.declared
        if not isinstance(head, AppliedUndef):
            return False
        name = head.func.__name__
        new = not any(isinstance(known, AppliedUndef) and known.func == head.func for known in self.facts)
        kinds = (sp.Symbol, AppliedUndef) if new else (sp.Symbol,)
        bare = all(isinstance(argument, kinds) for argument in head.args) and len(set(head.args)) == len(head.args)
        return (name in self.paper.states and len(head.args) == 1) or (bare and name not in self.general)

    def forget(self, rate: sp.Expr) -> None:
        """Forget what was said of another system."""
        for fact in [self.facts.pop(head) for head in outdated(rate, self.facts, self.paper)]:
            if isinstance(fact.head, AppliedUndef):
                self.twice.add(fact.head.func.__name__)
                self.general.pop(fact.head.func.__name__, None)

    def new_fact(self, pair: Pair, shift: sp.Expr | None = None, written: Pair | None = None) -> Fact:
        head = pair.left
        word = head.name if head.is_Symbol else head.func.__name__
        name = unused(f"{word}_is", {*self.names, *self.paper.declared})
        self.names.add(name)
        fact = self.facts[head] = Fact(name, head, pair, self.heading.file, shift, written)
        if isinstance(head, AppliedUndef) and word not in {*self.paper.states, *self.twice} and is_general(pair):
            self.general.setdefault(word, fact)
        return fact

    def resting(self, pairs: Sequence[Pair]) -> str:
        """Why a formula says where something is rather than what holds."""
        for pair in pairs:
            known = {*self.paper.states, *self.paper.table["times"]}
            moves = pair.left.is_Symbol and pair.left.name in known and pair.sign == "="
            if moves and pair.left not in self.facts and not self.moving(pair.right):
                return f"{pair.left} moves, and this says where it is at some instant"
        return ""

    def moving(self, expression: sp.Expr) -> bool:
        names = {symbol.name for symbol in expression.free_symbols}
        return bool(
            names & ({*self.paper.states, *self.paper.table["times"]})
            or expression.atoms(AppliedUndef)
            or any(self.moving(self.facts[s].pair.right) for s in expression.free_symbols if s in self.facts)
        )

    # --- The chain rule ----------------------------------------------------------------------------------------------

    def chain_rule(self, pair: Pair) -> list[Fact]:
        """For each rate in a relation that is the rate of something defined, what the chain rule says of it."""
        found = []
        for symbol in sorted(pair.left.free_symbols | pair.right.free_symbols, key=str):
            if symbol.name in self.paper.moved and symbol not in self.facts:
                fact = self.by_chain_rule(symbol, *self.paper.moved[symbol.name])
                if fact is not None:
                    self.facts[symbol] = fact
                    self.names.add(fact.name)
                    found.append(fact)
        return found

    def by_chain_rule(self, rate: sp.Symbol, moved: sp.Expr, time: sp.Symbol) -> Fact | None:
        said = self.facts.get(moved)
        if said is None or said.chain or rate.name == moved:
            return None
        value = said.pair.right
        inner: list[tuple[Fact, ...]] = []
        rates = {of: name for name, (of, along) in self.paper.moved.items() if along == time}
        for _ in self.facts:  # what moves without a rate of its own is put in
            put = [s for s in sorted(value.free_symbols, key=str) if s not in rates and s in self.facts
                   and self.moving(self.facts[s].pair.right)]  # fmt: skip
            if not put:
                break
            inner.append(tuple(self.facts[s] for s in put))
            value = value.subs({s: self.facts[s].pair.right for s in put}, simultaneous=True)
        chain = tuple((s.name, rates[s]) for s in sorted(value.free_symbols, key=str) if s in rates and s != time)
        if time in value.free_symbols:
            chain += ((time.name, ""),)
        if not chain or any(name == rate.name for _, name in chain):
            return None
        terms = [
            sp.diff(value, sp.Symbol(of, real=True)) * (sp.Symbol(name, real=True) if name else 1) for of, name in chain
        ]
        pair = Pair(rate, "=", sp.Add(*terms))
        if depends(pair.right, rate, self.facts):
            return None
        name = unused(f"{rate.name}_is", {*self.names, *self.paper.declared})
        return Fact(name, rate, pair, self.heading.file, of=said, chain=chain, inner=tuple(inner))

    # --- What claims are under ---------------------------------------------------------------------------------------

    def givens(self, pairs: Sequence[Pair]) -> Iterator[Fact]:
        """The definitions of all letters that occur, each behind those of the letters that occur in it."""
        seen: set[sp.Expr] = set()
        for pair in pairs:
            yield from self.behind(pair.left, seen)
            yield from self.behind(pair.right, seen)

    def behind(self, expression: sp.Expr, seen: set[sp.Expr]) -> Iterator[Fact]:
        for part in sorted(expression.atoms(sp.Symbol, AppliedUndef), key=str):
            if part in seen:
                continue
            seen.add(part)
            if isinstance(part, AppliedUndef) and part.func.__name__ in self.general:
                yield from self.behind(self.general[part.func.__name__].pair.right, seen)
            elif part in self.facts:
                yield from self.behind(self.facts[part].pair.right, seen)
                yield self.facts[part]
