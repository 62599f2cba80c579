"""A place in the tokens of a formula, and what can be asked there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ptproof.reading.latex.tokens import NotUnderstood, Token, argument

END = Token("", 0)
RELATIONS = {
    "=": "=", "<": "<", ">": ">", r"\lt": "<", r"\gt": ">", r"\le": "<=", r"\leq": "<=", r"\leqslant": "<=",
    r"\ge": ">=", r"\geq": ">=", r"\geqslant": ">=", r"\ne": "!=", r"\neq": "!=", r"\equiv": "=",
}  # fmt: skip
OTHER_RELATIONS = {
    r"\in": "membership", r"\subset": "sets", r"\subseteq": "sets", r"\approx": "approximation",
    r"\ll": "“much less”", r"\gg": "“much greater”", r"\sim": "“as large as”", r"\exists": "“there is”",
    r"\rightarrow": "an arrow", r"\to": "an arrow", r"\mapsto": "an arrow", r"\implies": "an implication",
    r"\Rightarrow": "an implication", r"\Leftrightarrow": "an equivalence", r"\iff": "an equivalence",
    r"\pm": "two signs at once", r"\mp": "two signs at once", r"\prec": "an order of matrices",
    r"\succ": "an order of matrices", ":": "a colon", r"\ldots": "dots", r"\dots": "dots", r"\cdots": "dots",
}  # fmt: skip
CLOSING = frozenset({")", "]", "}", r"\}", r"\rVert", r"\rvert", r"\at", "&", "\\\\", ",", ";", ".", r"\rangle", ""})


class Cursor:
    """Tokens that are read from left to right; what is annotated here is given by ``Grammar``."""

    expression: Callable[[], Any]
    signed: Callable[[], Any]
    product: Callable[[], Any]
    factor: Callable[[], Any]
    base: Callable[[], Any]
    inner: Callable[[Sequence[Token]], Any]
    raised: Callable[[Any, list[Token], Token], Any]

    def __init__(self, tokens: Sequence[Token]) -> None:
        self.tokens = list(tokens)
        self.position = 0

    def peek(self, ahead: int = 0) -> Token:
        place = self.position + ahead
        return self.tokens[place] if 0 <= place < len(self.tokens) else END

    @property
    def text(self) -> str:
        return self.peek().text

    @property
    def line(self) -> int:
        return self.peek().line or (self.tokens[-1].line if self.tokens else 0)

    def take(self) -> Token:
        token = self.peek()
        self.position += 1
        return token

    def expect(self, text: str, opened: Token) -> None:
        if self.text != text:
            found = f"{self.text} stands" if self.text else "the formula ends"
            raise NotUnderstood("bad LaTeX", f"{found} where the {opened.text} should end with {text}", self.line)
        self.position += 1

    def argument(self, of: Token) -> list[Token]:
        """The argument of a macro; of digits without braces, only the first."""
        token = self.peek()
        if token.text[:1].isdigit() and len(token.text) > 1:
            self.tokens[self.position : self.position + 1] = [Token(sign, token.line) for sign in token.text]
        found, self.position = argument(self.tokens, self.position, of)
        return found

    def scripts(self, of: Token) -> tuple[list[Token], list[Token]]:
        """What stands below and above, in either order; a second of one kind is left where it is."""
        low: list[Token] = []
        high: list[Token] = []
        while self.text in ("_", "^") and not (low if self.text == "_" else high):
            if self.take().text == "_":
                low = self.argument(of)
            else:
                high = self.argument(of)
        return low, high

    def optional(self) -> list[Token]:
        """An argument in brackets, or nothing."""
        if self.text != "[":
            return []
        start = self.position + 1
        while self.text not in ("]", ""):
            self.position += 1
        found = self.tokens[start : self.position]
        self.position += 1
        return found

    def refuse(self, kind: str, reason: str, at: Token | None = None) -> NotUnderstood:
        return NotUnderstood(kind, reason, (at or self.peek()).line or self.line)


def differential(found: Sequence[Token]) -> tuple[str, list[Token]] | None:
    """The sign of a differential that opens the tokens (``d`` or ``∂``), and what follows it."""
    texts = [token.text for token in found[:4]]
    if texts[:1] == [r"\partial"]:
        return "∂", list(found[1:])
    if texts == [r"\text", "{", "d", "}"]:
        return "d", list(found[4:])
    if texts[:1] == ["d"]:
        return "d", list(found[1:])
    return None
