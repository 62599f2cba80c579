"""A paper that is read by a guessed notation: each displayed formula as what it says, or why it was not read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import sympy as sp

from ptproof.drafting.guess import Declared, Guess, Letters, guess, rate_name
from ptproof.drafting.headings import Outline, outline
from ptproof.drafting.names import RESERVED
from ptproof.drafting.occurrences import Scanned, scan
from ptproof.drafting.spelled import name_at
from ptproof.drafting.toml import toml
from ptproof.errors import InputError
from ptproof.reading.latex.cursor import RELATIONS
from ptproof.reading.latex.formulas import Formula, find_formulas
from ptproof.reading.latex.grammar import Grammar
from ptproof.reading.latex.notation import Notation, meanings, notation, read_table, vocabulary
from ptproof.reading.latex.rewrite import RATE, Rules
from ptproof.reading.latex.statements import Reading, read_formula
from ptproof.reading.latex.tokens import Macro, NotUnderstood, Token, argument, read

_ROUNDS = 4
_TABLE = "notation.toml"
# Whoever writes e both alone and with an exponent may mean two things.
_E_TWICE = "two readings", "e stands alone elsewhere, so that e with an exponent can mean a power and an exponential"


@dataclass(frozen=True)
class Said:
    """A displayed formula with what it says in the names of the derivation, or why that is not known."""

    formula: Formula
    reading: Reading | None
    why: str = ""


@dataclass(frozen=True)
class Paper:
    """A paper as it was read.

    Attributes
    ----------
    said
        What became of each displayed formula, in the order of the text.
    running
        The relations in running text.
    declared
        Every name of the derivation: letters, functions, and the rates of what moves.
    rates
        For the name of each rate what it stands for, as the table of notation has it.
    moved
        For each name of a rate the moved expression and the time.
    generic
        For each function the names at which it is written most often.
    """

    outline: Outline
    said: tuple[Said, ...]
    running: tuple[Formula, ...]
    declared: Mapping[str, Declared]
    rates: Mapping[str, str]
    moved: Mapping[str, tuple[sp.Expr, sp.Symbol]]
    generic: Mapping[str, tuple[str, ...]]
    states: frozenset[str]
    table: Mapping[str, Any]


def read_with_guesses(source: str) -> Paper:
    """The paper whose LaTeX is ``source``, read by what :mod:`ptproof.drafting.guess` makes of its letters."""
    formulas = find_formulas(source)
    every = [*formulas.displayed, *formulas.running]
    tokens = {id(item): _tokens(item, formulas.macros) for item in every}
    letters = Letters.of(_scanned(tokens[id(item)]) for item in every)
    for _ in range(_ROUNDS):
        guessed, before = guess(letters), dict(letters.shapes)
        reader = _Reader(guessed, letters)
        for item in every:
            letters.shapes |= {**reader.shapes(tokens[id(item)], letters), **letters.forms_shaped()}
        if letters.shapes == before:
            break
    said = [reader.said(item, formulas.macros) for item in formulas.displayed]
    named = _Rates(guessed)
    translated = tuple(named.translated(item) for item in said)
    return Paper(
        outline(source), translated, formulas.running, {**guessed.declared, **named.declared}, named.rates,
        named.moved, guessed.generic, guessed.states, guessed.table(named.rates),
    )  # fmt: skip


def _tokens(formula: Formula, macros: Mapping[str, Macro]) -> list[Token]:
    try:
        return [] if formula.broken else read(formula.text, formula.line, macros)
    except (NotUnderstood, RecursionError):
        return []


def _scanned(tokens: Sequence[Token]) -> Scanned:
    try:
        return scan(tokens)
    except (NotUnderstood, RecursionError):
        return Scanned(())


class _Reader:
    """Reads formulas by one guess."""

    def __init__(self, guessed: Guess, letters: Letters) -> None:
        self.guessed, self.letters = guessed, letters
        self.table = read_table(toml(guessed.table(), ""), _TABLE)
        self.names = vocabulary(self.table, {})

    @cached_property
    def notation(self) -> Notation:
        return notation(self.table, self.names, "", _TABLE)

    @cached_property
    def meaning(self) -> Rules:
        return meanings(self.table, self.names, "", {}, _TABLE)

    def said(self, formula: Formula, macros: Mapping[str, Macro]) -> Said:
        """What the formula says in the names of the derivation, states without their time."""
        try:
            self.refuse_two_readings(_tokens(formula, macros), formula.line)
            reading, meaning = read_formula(formula, macros, self.notation), self.meaning
            parts = {
                name: tuple(replace(p, left=meaning(p.left), right=meaning(p.right)) for p in getattr(reading, name))
                for name in ("pairs", "conditions", "braces")
            }
            return Said(formula, replace(reading, **parts))
        except NotUnderstood as error:
            return Said(formula, None, str(error))
        except (InputError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError) as error:
            return Said(formula, None, f"line {formula.line}: no value: {' '.join(str(error).split())}")

    def refuse_two_readings(self, tokens: Sequence[Token], line: int) -> None:
        """Refuse a formula of which the paper does not tell what a letter in it is."""
        if "e" in self.letters.keys and _has_power_of_e(tokens):
            raise NotUnderstood(*_E_TWICE, line)
        for item in _scanned(tokens).occurrences:
            factor = item.key in self.letters.factors and item.arguments != ("+",)
            if item.arguments and (item.key in self.letters.two_readings or factor):
                reason = f"{item.key}(…) can mean a product and a function"
                raise NotUnderstood("two readings", reason, item.line)
            if not self.letters.is_sized(item.key):
                raise NotUnderstood("matrix", f"nothing tells of what size {item.key} is", item.line)

    def shapes(self, tokens: Sequence[Token], letters: Letters) -> dict[str, tuple[int, int]]:
        """The shapes of letters that stand alone beside a column or a matrix."""
        found: dict[str, tuple[int, int]] = {}
        for chain in _chains(tokens):
            alone = [(_alone(side), i) for i, side in enumerate(chain)]
            unknown = [(key, i) for key, i in alone if key and letters.shape(key) is None]
            if not unknown or len(chain) < 2:
                continue
            for key, place in unknown:
                for beside in (place + 1, place - 1):
                    value = self.value(chain[beside]) if 0 <= beside < len(chain) else None
                    if isinstance(value, sp.MatrixBase) and value.rows < 10 and value.cols < 10:
                        found.setdefault(key, value.shape)
        return found

    def value(self, tokens: Sequence[Token]) -> Any:
        try:
            return Grammar(tokens, self.notation).inner(tokens)
        except (NotUnderstood, InputError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError):
            return None


def _chains(tokens: Sequence[Token]) -> Iterator[list[list[Token]]]:
    """The sides of each relation of a formula, without what lines them up."""
    chain: list[list[Token]] = [[]]
    depth = 0
    for token in tokens:
        text = token.text
        depth += (text in ("{", "(", "[") or text.startswith(r"\begin{")) - (
            text in ("}", ")", "]") or text.startswith(r"\end{")
        )
        if depth == 0 and text in RELATIONS:
            chain.append([])
        elif depth == 0 and text in ("\\\\", ",", ";", ".") and len(chain) > 1:
            yield chain
            chain = [[]]
        elif not (depth == 0 and text == "&"):
            chain[-1].append(token)
    yield chain


def _alone(side: Sequence[Token]) -> str:
    """The letter that is all of a side, a dot over it and its arguments aside."""
    tokens = list(side[1:] if side and side[0].text == "-" else side)
    try:
        if tokens and tokens[0].text == r"\dot":
            inside, after = argument(tokens, 1, tokens[0])
            tokens = [*inside, *tokens[after:]]
        named = name_at(tokens, 0)
    except NotUnderstood:
        return ""
    if named is None:
        return ""
    rest = [token.text for token in tokens[named[1] :]]
    return (
        named[0] if not rest or (rest[0] == "(" and rest.index(")") == len(rest) - 1 if ")" in rest else False) else ""
    )


def _has_power_of_e(tokens: Sequence[Token]) -> bool:
    return any(pair == ("e", "^") for pair in pairwise(token.text for token in tokens))


class _Rates:
    """Names for the rates that formulas speak of."""

    def __init__(self, guessed: Guess) -> None:
        self.guessed = guessed
        self.declared: dict[str, Declared] = {}
        self.rates: dict[str, str] = {}
        self.moved: dict[str, tuple[sp.Expr, sp.Symbol]] = {}
        self.names: dict[sp.Expr, sp.Symbol] = {}

    def translated(self, said: Said) -> Said:
        """The formula with a name for each rate; one that has none, such as that of a sum, makes it a gap."""
        if said.reading is None:
            return said
        parts = {}
        for name in ("pairs", "conditions", "braces"):
            pairs = getattr(said.reading, name)
            parts[name] = tuple(replace(p, left=self.named(p.left), right=self.named(p.right)) for p in pairs)
        everything = [side for pairs in parts.values() for p in pairs for side in (p.left, p.right)]
        for side in everything:
            if nodes := side.atoms(RATE):
                return Said(
                    said.formula, None, f"line {said.formula.line}: the rate of {_first(nodes).args[0]} has no name yet"
                )
            if why := self.elsewhere(side, len(everything)):
                return Said(said.formula, None, f"line {said.formula.line}: {why}")
        return Said(said.formula, replace(said.reading, **parts))

    def elsewhere(self, side: sp.Expr, sides: int) -> str:
        """Why a side cannot be a claim: what moves is taken at an instant of its own, or a name is no name."""
        for node in side.atoms(sp.core.function.AppliedUndef):
            if node.func.__name__ in self.guessed.states and not (node == side and sides == 2):
                return f"{node} is a value along a trajectory; a claim about it says which system it solves"
        for node in side.atoms(sp.Limit, sp.Integral):
            moves = {*self.guessed.states, *self.rates}
            moving = sorted(s.name for s in node.args[0].free_symbols if s.name in moves)
            if moving and {s.name for s in node.atoms(sp.Symbol)} & set(self.guessed.times):
                return f"{moving[0]} moves, and this speaks of all of its trajectory"
        if names := [s.name for s in side.free_symbols if s.name in RESERVED]:
            return f"{names[0]} is the name of something else"
        return ""

    def named(self, side: sp.Expr) -> sp.Expr:
        return side.xreplace({node: self.name(node) for node in side.atoms(RATE) if self.has_name(node)})

    def has_name(self, node: sp.Expr) -> bool:
        moved = node.args[0]
        if moved.is_Symbol:
            return True
        return (
            isinstance(moved, sp.core.function.AppliedUndef)
            and moved.func is not RATE
            and (tuple(map(str, moved.args)) == self.guessed.generic.get(moved.func.__name__))
        )

    def name(self, node: sp.Expr) -> sp.Symbol:
        if node not in self.names:
            moved, time = node.args
            word = str(moved.func.__name__ if moved.args else moved)
            name = rate_name(word, str(time), len(self.guessed.times) == 1, {**self.guessed.declared, **self.declared})
            line = self.guessed.declared[word].line if word in self.guessed.declared else 0
            glyph = self.guessed.declared[word].glyph if word in self.guessed.declared else word
            dotted = rf"\dot{{{glyph}}}" if str(time) == "t" else rf"\frac{{d {glyph}}}{{d {self.glyph(str(time))}}}"
            self.declared[name] = Declared(name, dotted, line)
            self.rates[name] = f"rate({moved}, {time})"
            self.moved[name] = moved, time
            self.names[node] = sp.Symbol(name, real=True)
        return self.names[node]

    def glyph(self, name: str) -> str:
        return self.guessed.declared[name].glyph if name in self.guessed.declared else name


def _first(nodes: Any) -> Any:
    return min(nodes, key=str)
