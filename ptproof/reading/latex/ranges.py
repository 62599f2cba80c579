"""What runs over a range: sums over indices, limits, values at a point."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp

from ptproof.reading.latex.calculus import Calculus
from ptproof.reading.latex.cursor import RELATIONS
from ptproof.reading.latex.tokens import Token
from ptproof.reading.latex.values import add, entrywise

_MOST = 200


class Ranges(Calculus):
    """The part of the grammar that knows of sums and limits; the arithmetic is given by ``Grammar``."""

    def read_sum(self, at: Token) -> Any:
        """The sum written out, over the numbers that the range says; each index is put in as a number."""
        lower, upper = self.scripts(at)
        start, total = self.position, None
        for values in self.indices(lower, upper, at):
            part = type(self)([*self.tokens[:start], *_put_in(self.tokens[start:], values)], self.notation)
            part.position, part.bars, part.braces, part.integrals = start, self.bars, self.braces, self.integrals
            part.terms = self.terms
            self.terms.append(at)
            if len(self.terms) > _MOST:
                raise self.refuse("sum", "sums of so many terms are not read", at)
            term = part.product()
            total = term if total is None else add(total, term, at)
            self.position = len(self.tokens) - (len(part.tokens) - part.position)
        if total is None:
            raise self.refuse("sum", "a sum of no terms is not read", at)
        return total

    def indices(self, lower: list[Token], upper: list[Token], at: Token) -> Iterable[Mapping[str, int]]:
        """The values of the indices: of ``i=1`` and a last number, or of chains such as ``1 ≤ i < j ≤ l``."""
        lines = _lines(lower)
        if not any(lines):
            raise self.refuse("sum", "a sum over this range is not read", at)
        last = [self.last(upper, at)] * len(lines) if upper else []
        found: list[dict[str, int]] = [{}]
        for number, line in enumerate(lines):
            texts = [token.text for token in line]
            if last:
                if len(texts) < 3 or texts[1] != "=" or not texts[0].isalpha():
                    raise self.refuse("sum", "a sum over this range is not read", at)
                if any(name in found[0] for name in texts[2:]):
                    raise self.refuse("two readings", "an index that another one begins can end there or go on", at)
                found = [
                    {**known, texts[0]: value} for known in found
                    for value in range(self.number(line[2:], known, at), last[number] + 1)
                ]  # fmt: skip
            else:
                found = [more for known in found for more in self.between(line, known, at)]
            if len(found) > _MOST:
                raise self.refuse("sum", "a sum of so many terms is not read", at)
        return found

    def between(self, line: list[Token], known: Mapping[str, int], at: Token) -> Iterable[dict[str, int]]:
        """The values of the indices in a chain of inequalities whose ends are numbers."""
        sides: list[list[Token]] = [[]]
        strict: list[bool] = []
        for token in line:
            if RELATIONS.get(token.text) in ("<", "<="):
                strict.append(RELATIONS[token.text] == "<")
                sides.append([])
            else:
                sides[-1].append(token)
        names = [side[0].text for side in sides[1:-1] if len(side) == 1]
        if len(sides) < 3 or len(names) != len(sides) - 2 or any(name in known or not name.isalpha() for name in names):
            raise self.refuse("sum", "a sum over this range is not read", at)
        low, high = self.number(sides[0], known, at), self.number(sides[-1], known, at)
        found: list[tuple[dict[str, int], int]] = [(dict(known), low)]
        for name, less in zip(names, strict, strict=False):
            found = [({**held, name: n}, n) for held, before in found for n in range(before + less, high + 1)]
        return [held for held, before in found if before + strict[-1] <= high]

    def number(self, tokens: list[Token], known: Mapping[str, int], at: Token) -> int:
        """A number, also by a letter that the notation counts, and one more or less than an index."""
        count = self.notation.counts.get("".join(token.text for token in tokens))
        value = count if count is not None else self.inner(_put_in(tokens, known))
        if not isinstance(value, int | sp.Integer):
            raise self.refuse("sum", "the notation does not say how many terms the sum has", at)
        return self.few(int(value), at)

    def last(self, upper: list[Token], at: Token) -> int:
        count = self.notation.counts.get("".join(token.text for token in upper))
        if count is None and not (len(upper) == 1 and upper[0].text.isdigit()):
            raise self.refuse("sum", "the notation does not say how many terms the sum has", at)
        return self.few(int(upper[0].text) if count is None else count, at)

    def few(self, number: int, at: Token) -> int:
        if abs(number) > _MOST:
            raise self.refuse("sum", "a sum of so many terms is not read", at)
        return number

    def read_lim(self, at: Token) -> Any:
        if self.take().text != "_":
            raise self.refuse("limit", "a limit without its variable", at)
        under = self.argument(at)
        arrow = next((i for i, token in enumerate(under) if token.text in (r"\to", r"\rightarrow")), 0)
        variable, target = self.inner(under[:arrow]), self.inner(under[arrow + 1 :])
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("limit", f"{variable} is no variable", at)
        value = self.product()
        constant = isinstance(value, sp.MatrixBase)  # of which entries may have no limit to take

        def limit(entry: Any) -> Any:
            return entry if constant and variable not in entry.free_symbols else sp.Limit(entry, variable, target, "-")

        return entrywise(value, limit)

    def read_evaluate(self, at: Token) -> Any:
        value = self.expression()
        self.expect(r"\at", at)
        if self.text != "_":
            raise self.refuse("grammar", "it is not said where this is taken", at)
        self.take()
        where = self.argument(at)
        equal = next((i for i, token in enumerate(where) if token.text == "="), 0)
        variable, point = self.inner(where[:equal]), self.inner(where[equal + 1 :])
        pairs = list(zip(variable, point, strict=True)) if isinstance(variable, sp.MatrixBase) else [(variable, point)]
        return entrywise(value, lambda entry: sp.Subs(entry, *map(tuple, zip(*pairs, strict=True))))


def _lines(lower: list[Token]) -> list[list[Token]]:
    """The lines under a sum: those of a substack, or the one that stands there."""
    if not lower or lower[0].text != r"\substack":
        return [lower]
    lines: list[list[Token]] = [[]]
    for token in lower[2:-1]:
        if token.text == "\\\\":
            lines.append([])
        elif token.text != "&":
            lines[-1].append(token)
    return [line for line in lines if line]


def _put_in(tokens: Iterable[Token], values: Mapping[str, int]) -> list[Token]:
    return [Token(str(values[token.text]), token.line) if token.text in values else token for token in tokens]
