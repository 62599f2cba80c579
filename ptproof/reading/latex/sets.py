"""Cases, and what membership in an interval says of a number."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.reading.latex.cursor import RELATIONS
from ptproof.reading.latex.ranges import Ranges
from ptproof.reading.latex.tokens import Token

CASES = frozenset({"cases", "dcases"})
_RELATION = {"=": sp.Eq, "<": sp.Lt, ">": sp.Gt, "<=": sp.Le, ">=": sp.Ge, "!=": sp.Ne}
_REALS = frozenset({r"\mathbb{R}", r"\mathbb R", r"\R", r"\Re"})
_OTHERWISE = frozenset({"otherwise", "else", "else.", "otherwise."})
_IF = frozenset({"if", "for", "when"})
WORDS = _OTHERWISE | _IF | {"and"}


class Sets(Ranges):
    """The part of the grammar that knows of cases and intervals."""

    def cases(self, opened: Token) -> Any:
        """A value for each condition, in their order; nothing is said of what none of them covers."""
        bars, self.bars = self.bars, []
        pieces: list[tuple[Any, Any]] = []
        while not self.text.startswith(r"\end{"):
            value = self.expression()
            if isinstance(value, sp.MatrixBase):
                raise self.refuse("cases", "cases of columns are not read", opened)
            self.skip(",", "&")
            pieces.append((value, self.condition(opened)))
            self.skip(",", ";", ".", "\\\\")
            if not self.text:
                raise self.refuse("bad LaTeX", f"{opened.text} is not closed", opened)
        self.take()
        self.bars = bars
        if len(pieces) < 2:
            raise self.refuse("cases", "a single case is no distinction of cases", opened)
        return sp.Piecewise(*pieces, evaluate=False)

    def skip(self, *texts: str) -> None:
        while self.text in texts:
            self.take()

    def condition(self, opened: Token) -> Any:
        """What stands beside a case: relations of numbers, or “otherwise”."""
        found: list[Any] = []
        while True:
            word = self.word()
            if word in _OTHERWISE and not found:
                return sp.true
            if word and word not in _IF and not (found and word == "and"):
                raise self.refuse("cases", f"the condition of a case says “{word}”", opened)
            left = self.expression()
            if self.text not in RELATIONS:
                raise self.refuse("cases", "a case has no condition that is a relation of numbers", opened)
            while self.text in RELATIONS:
                sign = RELATIONS[self.take().text]
                right = self.expression()
                if isinstance(left, sp.MatrixBase) or isinstance(right, sp.MatrixBase):
                    raise self.refuse("cases", "the condition of a case is no relation of numbers", opened)
                found.append(_RELATION[sign](left, right, evaluate=False))
                left = right
            goes_on = self.text == "," and self.peek(1).text not in ("\\\\", "") and r"\end" not in self.peek(1).text
            if not goes_on and self.text != r"\text":
                return found[0] if len(found) == 1 else sp.And(*found, evaluate=False)
            self.skip(",")

    def word(self) -> str:
        """The word of a condition that stands in a text here."""
        start = self.position
        if self.text == r"\text":
            found = "".join(token.text for token in self.argument(self.take())).lower()
            if found in WORDS:
                return found
        self.position = start
        return ""

    def is_word(self) -> bool:
        start = self.position
        found = self.word()
        self.position = start
        return bool(found)

    def membership(self, values: list[Any], at: Token) -> list[tuple[Any, str, Any]]:
        """The relations that ``x ∈ (a, b]``, ``x ∈ ℝ_{>0}`` and the like are, for each of the values."""
        found: list[tuple[Any, str, Any]] = []
        if any(isinstance(value, sp.MatrixBase) for value in values):
            raise self.refuse("relation", "membership of a column in a set is no relation between numbers", at)
        for sign, bound in self.interval(at):
            found += [(value, sign, bound) for value in values]
        return found

    def interval(self, at: Token) -> list[tuple[str, Any]]:
        token = self.peek()
        if token.text in ("(", "["):
            self.take()
            bars, self.bars = self.bars, []
            low = self.expression()
            if self.text != ",":
                raise self.refuse("relation", "membership (\\in) in a set that is no interval", at)
            self.take()
            high = self.expression()
            closing = self.take().text
            self.bars = bars
            if closing not in (")", "]"):
                raise self.refuse("bad LaTeX", "an interval does not end", token)
            below, above = (">" if token.text == "(" else ">="), ("<" if closing == ")" else "<=")
            ends = [(below, low)] * (low != -sp.oo) + [(above, high)] * (high != sp.oo)
            if not ends:
                raise self.refuse("no relation", "membership in all real numbers says nothing of a number", at)
            return ends
        name = self.named()
        written = "".join(part.text for part in name)
        if written in _REALS and self.text == "_":
            self.take()
            low = self.argument(token)
            sign = RELATIONS.get(low[0].text) if low else None
            if sign in ("<", ">", "<=", ">=", "!=") and len(low) > 1:
                return [(sign, self.inner(low[1:]))]
            if len(low) == 1 and low[0].text == "+":
                raise self.refuse("two readings", "it is not said whether 0 belongs to this set", at)
        raise self.refuse("relation", "membership (\\in) in this set is no relation between numbers", at)
