"""A paper that is read by a guessed notation: each displayed formula as what it says, or why it was not read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import sympy as sp

from ptproof.drafting.guess import Declared, Guess
from ptproof.drafting.headings import Outline, outline
from ptproof.drafting.letters import Letters
from ptproof.drafting.occurrences import Scanned, scan
from ptproof.drafting.rates import Rates, Said
from ptproof.drafting.spelled import name_at
from ptproof.drafting.stated import Conditions, conditions
from ptproof.drafting.toml import toml
from ptproof.errors import InputError
from ptproof.reading.latex.cursor import RELATIONS
from ptproof.reading.latex.formulas import Formula, find_formulas
from ptproof.reading.latex.grammar import Grammar
from ptproof.reading.latex.notation import Notation, meanings, notation, read_table, vocabulary
from ptproof.reading.latex.rewrite import Rules
from ptproof.reading.latex.statements import read_formula
from ptproof.reading.latex.tokens import Macro, NotUnderstood, Token, argument, nesting, read

_ROUNDS = 4
_TABLE = "notation.toml"
# Whoever writes e both alone and with an exponent may mean two things.
_E_TWICE = "two readings", "e stands alone elsewhere, so that e with an exponent can mean a power and an exponential"


@dataclass(frozen=True)
class Paper:
    """A paper as it was read: what became of each displayed formula, and the relations in running text.

    ``declared`` are all names of the derivation: letters, functions, and the rates of what moves. ``rates`` has what
    the table of notation says for the name of each rate, ``moved`` the moved expression and the time, and
    ``conditions`` what the paper says of its letters alone.
    """

    outline: Outline
    said: tuple[Said, ...]
    running: tuple[Formula, ...]
    declared: Mapping[str, Declared]
    rates: Mapping[str, str]
    moved: Mapping[str, tuple[sp.Expr, sp.Symbol]]
    states: frozenset[str]
    table: Mapping[str, Any]
    conditions: Conditions


def read_with_guesses(source: str) -> Paper:
    """The paper whose LaTeX is ``source``, read by what :mod:`ptproof.drafting.guess` makes of its letters."""
    formulas = find_formulas(source)
    every = [*formulas.displayed, *formulas.running]
    tokens = {id(item): _tokens(item, formulas.macros) for item in every}
    letters = Letters.of(_scanned(tokens[id(item)]) for item in every)
    for _ in range(_ROUNDS):
        guessed, before = Guess(letters), dict(letters.shapes)
        reader = _Reader(guessed, letters)
        for item in every:
            letters.shapes |= {**reader.shapes(tokens[id(item)]), **letters.forms_shaped()}
        if letters.shapes == before:
            break
    said = [reader.said(item, formulas.macros) for item in formulas.displayed]
    named = Rates(guessed)
    translated = tuple(named.translated(item) for item in said)
    named.declare_rest(translated)
    beside = [item for item in (*formulas.running, *formulas.members) if not item.broken]
    stated = conditions(beside, said, lambda item: reader.said(item, formulas.macros), guessed)
    return Paper(
        outline(source), translated, formulas.running, {**guessed.declared, **named.declared}, named.rates,
        named.moved, frozenset(guessed.states), guessed.table(named.rates), stated,
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
            return Said(formula, read_formula(formula, macros, self.notation).map(self.meaning))
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
            if item.arguments and item.key in self.guessed.valued:
                reason = f"{item.key} has a value here, and the paper does not say of what it is a function"
                raise NotUnderstood("letter", reason, item.line)
            if not self.letters.is_sized(item.key):
                raise NotUnderstood("matrix", f"nothing tells of what size {item.key} is", item.line)

    def shapes(self, tokens: Sequence[Token]) -> dict[str, tuple[int, int]]:
        """The shapes of letters that stand alone beside a column or a matrix."""
        found: dict[str, tuple[int, int]] = {}
        for chain in _chains(tokens):
            alone = [(_alone(side), i) for i, side in enumerate(chain)]
            unknown = [(key, i) for key, i in alone if key and self.letters.shape(key) is None]
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
        depth += nesting(text)
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
        if tokens and tokens[0].text in (r"\dot", r"\ddot"):
            inside, after = argument(tokens, 1, tokens[0])
            tokens = [*inside, *tokens[after:]]
        named = name_at(tokens, 0)
    except NotUnderstood:
        return ""
    if named is None:
        return ""
    rest = [token.text for token in tokens[named[1] :]]
    return named[0] if not rest or (rest[0] == "(" and rest[-1] == ")" and rest.count(")") == 1) else ""


def _has_power_of_e(tokens: Sequence[Token]) -> bool:
    """Whether e has an exponent other than a whole number, of which whoever has a letter e means the power."""
    texts = [token.text for token in tokens]
    behind = (texts[at + 2 : at + 5] for at, pair in enumerate(pairwise(texts)) if pair == ("e", "^"))
    return any(not "".join(found[:1] if found[:1] != ["{"] else found).strip("{}").isdecimal() for found in behind)
