"""Formulas with a name for each rate in them, and why some cannot be claims."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from ptproof.drafting.guess import Declared, Guess, rate_name
from ptproof.drafting.names import RESERVED
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.rewrite import RATE
from ptproof.reading.latex.statements import Reading


@dataclass(frozen=True)
class Said:
    """A displayed formula with what it says in the names of the derivation, or why that is not known."""

    formula: Formula
    reading: Reading | None
    why: str = ""


class Rates:
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
        reading = said.reading.map(self.named)
        pairs = (*reading.pairs, *reading.conditions, *reading.braces)
        everything = [side for pair in pairs for side in (pair.left, pair.right)]
        for side in everything:
            if nodes := side.atoms(RATE):
                why = f"the rate of {min(nodes, key=str).args[0]} has no name yet"
                return Said(said.formula, None, f"line {said.formula.line}: {why}")
            if why := self.elsewhere(side, len(everything)):
                return Said(said.formula, None, f"line {said.formula.line}: {why}")
        return Said(said.formula, reading)

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
        if moved.func is RATE:
            return self.has_name(moved)
        return (
            isinstance(moved, sp.core.function.AppliedUndef)
            and moved.func is not RATE
            and (tuple(map(str, moved.args)) == self.guessed.generic.get(moved.func.__name__))
        )

    def name(self, node: sp.Expr) -> sp.Symbol:
        if node not in self.names:
            moved, time = node.args
            said = str(moved)
            if moved.func is RATE:
                moved = self.name(moved)
                said = self.rates[moved.name]
            word = str(moved.func.__name__ if moved.args else moved)
            known = {**self.guessed.declared, **self.declared}
            name = rate_name(word, str(time), len(self.guessed.times) == 1, known)
            line, glyph = (known[word].line, known[word].glyph) if word in known else (0, word)
            dotted = rf"\dot{{{glyph}}}" if str(time) == "t" else rf"\frac{{d {glyph}}}{{d {self.glyph(str(time))}}}"
            self.declared[name] = Declared(name, dotted, line)
            self.rates[name] = f"rate({said}, {time})"
            self.moved[name] = moved, time
            self.names[node] = sp.Symbol(name, real=True)
        return self.names[node]

    def declare_rest(self, every: Iterable[Said]) -> None:
        """Declare what formulas speak of and the paper has no letter for: names that are bound."""
        for pair in (pair for said in every if said.reading for pair in said.reading.pairs):
            for symbol in sorted(pair.left.atoms(sp.Symbol) | pair.right.atoms(sp.Symbol), key=str):
                if symbol.name.isidentifier() and symbol.name not in {**self.guessed.declared, **self.declared}:
                    self.declared[symbol.name] = Declared(symbol.name, symbol.name.replace("_", r"\_"), 0)

    def glyph(self, name: str) -> str:
        return self.guessed.declared[name].glyph if name in self.guessed.declared else name
