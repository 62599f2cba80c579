"""Letters of a formula with their accents, indices and arguments, looked up in the notation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from sympy.core.alphabets import greeks

from ptproof.reading.latex.cursor import Cursor, differential
from ptproof.reading.latex.notation import Notation, spelling
from ptproof.reading.latex.rewrite import function
from ptproof.reading.latex.tokens import Token, written

ACCENTS = frozenset(
    rf"\{name}" for name in (
        "bar", "tilde", "hat", "check", "vec", "mathbf", "mathcal", "mathbb", "mathfrak", "boldsymbol", "text",
        "widetilde", "overline",
    )
)  # fmt: skip
_UPRIGHT_E = ("e", r"\text{e}", r"\text e", "{e}")


class Letters(Cursor):
    """What letters mean; the rest of the grammar is given by :class:`ptproof.reading.latex.grammar.Grammar`."""

    def __init__(self, tokens: Sequence[Token], notation: Notation) -> None:
        super().__init__(tokens)
        self.notation = notation
        self.bars: list[str] = []
        self.braces: list[tuple[list[Token], list[Token]]] = []
        self.integrals = 0
        self.terms: list[Token] = []  # of sums that were written out so far

    def differential(self, tokens: Sequence[Token]) -> tuple[str, list[Token]] | None:
        """The sign of a differential that opens the tokens; a plain d is none where it is a letter of the paper."""
        plain = bool(tokens) and tokens[0].text == "d" and "d" in {*self.notation.letters, *self.notation.functions}
        return None if plain else differential(tokens)

    def named(self) -> list[Token]:
        """The tokens of a letter with its accents, without index and exponent."""
        token = self.take()
        if token.text not in ACCENTS:
            known = token.text.isalpha() or (token.text.startswith("\\") and token.text[1:].isalpha())
            if not known:
                raise self.refuse("grammar", f"{token.text or 'the end'} is not expected here", token)
            return [token]
        found = self.argument(token)
        return [token, Token("{", token.line), *found, Token("}", token.line)]

    def letter(self) -> Any:
        """A letter, or a function at its arguments, with an exponent where that is no part of the name."""
        start = self.peek()
        return self.looked_up(self.named(), start)

    def looked_up(self, base: list[Token], start: Token) -> Any:
        low, high = self.scripts(start)
        for index, exponent, rest in ((low, high, []), (low, [], high)):
            key = spelling([*base, *script("_", index), *script("^", exponent)])
            if (value := self.at_arguments(key)) is not None:
                return self.raised(value, rest, start) if rest else value
            if key in self.notation.functions and (self.text == "(" or key not in self.notation.letters):
                return self.applied(key, rest, start)
            if key in self.notation.letters:
                value = self.notation.letters[key]
                return self.raised(value, rest, start) if rest else value
        if written(base) in _UPRIGHT_E and not low and high:
            return self.raised(sp.E, high, start)
        key = spelling([*base, *script("_", low)])
        raise self.refuse(*self.unknown(base, key, start), start)

    def unknown(self, base: list[Token], key: str, start: Token) -> tuple[str, str]:
        if start.text.startswith("\\") and start.text not in ACCENTS and len(base) == 1 and not low_letter(start.text):
            return "macro", f"{start.text} is not known"
        return "letter", f"the notation says nothing of {key}"

    def at_arguments(self, key: str) -> Any:
        """What the notation says of a letter together with the arguments behind it, as of ``λ_min(P)``."""
        if self.text != "(":
            return None
        depth = 0
        for end in range(self.position, len(self.tokens)):
            depth += (self.tokens[end].text == "(") - (self.tokens[end].text == ")")
            if depth == 0:
                value = self.notation.letters.get(key + written(self.tokens[self.position : end + 1]))
                self.position = self.position if value is None else end + 1
                return value
        return None

    def applied(self, key: str, exponent: list[Token], start: Token) -> Any:
        """A function at its arguments; a column or a matrix of them where the notation says so."""
        if self.text != "(":
            raise self.refuse("letter", f"the function {key} stands without arguments", start)
        flat: list[sp.Expr] = []
        for value in self.arguments():
            flat += list(value) if isinstance(value, sp.MatrixBase) else [value]
        rows = [[function(name)(*flat) for name in row] for row in self.notation.functions[key]]
        result: Any = rows[0][0] if rows == [rows[0][:1]] else sp.ImmutableDenseMatrix(rows)
        return self.raised(result, exponent, start) if exponent else result

    def arguments(self) -> list[Any]:
        """What stands in parentheses, or in a group, separated by commas."""
        opened = self.take()
        values = self.separated()
        self.expect(")" if opened.text == "(" else "}", opened)
        return values

    def separated(self, most: int = 0) -> list[Any]:
        """Expressions between commas, at ``most`` so many; bars that were open before do not close in them."""
        bars, self.bars = self.bars, []
        values = [self.expression()]
        while self.text == "," and len(values) != most:
            self.take()
            values.append(self.expression())
        self.bars = bars
        return values

    def dotted(self, tokens: list[Token], at: Token) -> tuple[Any, list[Token]]:
        """What a dot stands over: a letter, with the index and the arguments behind it; and the exponent there."""
        low, high = self.scripts(at)
        key = spelling([*tokens, *script("_", low)])
        if key in self.notation.functions and (self.text == "(" or key not in self.notation.letters):
            return self.applied(key, [], at), high
        return self.inner([*tokens, *script("_", low)]), high


def script(sign: str, tokens: list[Token]) -> list[Token]:
    """The tokens as an index or an exponent, in braces; nothing where there are none."""
    if not tokens:
        return []
    line = tokens[0].line
    return [Token(sign, line), Token("{", line), *tokens, Token("}", line)]


def low_letter(text: str) -> bool:
    """Whether a macro is a letter of an alphabet."""
    return text[1:].lower() in _GREEK


_VARIANTS = {"varepsilon", "vartheta", "varpi", "varrho", "varsigma", "varphi", "ell"}
_GREEK = _VARIANTS | {name.replace("lamda", "lambda") for name in greeks if name != "omicron"}
