"""The grammar of formulas: sums, products, powers, fractions, norms, matrices, functions and braces.

Values are SymPy expressions or matrices. Nothing is guessed: what has two readings, or a letter of which the notation
says nothing, is not read, and the place is named.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp

from ptproof.reading.guards import arguments_refused
from ptproof.reading.latex.cursor import CLOSING, OTHER_RELATIONS, RELATIONS
from ptproof.reading.latex.letters import script
from ptproof.reading.latex.notation import spelling
from ptproof.reading.latex.sets import CASES, Sets
from ptproof.reading.latex.tokens import Token
from ptproof.reading.latex.values import NORMS, add, multiply, negate, norm, power

_DELIMITERS = {"(": ")", "[": "]", r"\{": r"\}", "{": "}"}
_BARS = {r"\lVert": r"\rVert", r"\lvert": r"\rvert", "|": "|", r"\|": r"\|"}
_FUNCTIONS: dict[str, Callable[..., sp.Expr]] = {
    r"\sin": sp.sin, r"\cos": sp.cos, r"\tan": sp.tan, r"\exp": sp.exp, r"\ln": sp.log, r"\log": sp.log,
    r"\sinh": sp.sinh, r"\cosh": sp.cosh, r"\tanh": sp.tanh, r"\arctan": sp.atan, r"\min": sp.Min, r"\max": sp.Max,
}  # fmt: skip
_MATRICES = frozenset({"bmatrix", "pmatrix", "matrix", "array", "smallmatrix", "vmatrix"})
_TRANSPOSE = frozenset({r"\top", "T", r"\intercal", r"\text{T}"})


class Grammar(Sets):
    """Reads one formula, or a piece of one, by a notation."""

    def inner(self, tokens: Sequence[Token]) -> Any:
        """The value of a piece that has to be one expression."""
        if not tokens:
            raise self.refuse("grammar", "an expression is missing", self.peek(-1))
        part = Grammar(tokens, self.notation)
        part.braces, part.terms = self.braces, self.terms
        value = part.expression()
        if part.text:
            raise part.refuse("grammar", f"{part.text} is not expected here")
        return value

    def expression(self) -> Any:
        value = self.signed()
        while self.text in ("+", "-"):
            sign = self.take()
            following = self.product()
            value = add(value, negate(following) if sign.text == "-" else following, sign)
        return value

    def signed(self) -> Any:
        if self.text not in ("+", "-"):
            return self.product()
        return self.product() if self.take().text == "+" else negate(self.product())

    def ends(self) -> bool:
        """Whether no further factor follows."""
        text = self.text
        if text in OTHER_RELATIONS and text != r"\in":
            raise self.refuse("relation", f"{OTHER_RELATIONS[text]} ({text}) is no relation between numbers")
        if text in CLOSING or text in RELATIONS or text in ("+", "-", r"\in") or text.startswith(r"\end{"):
            return True
        if self.bars and text == self.bars[-1]:
            return True
        if text == "d":
            return self.integrals > 0 and self.differential(self.tokens[self.position :]) is not None
        return text == r"\text" and (
            self.is_word() or self.differential(self.tokens[self.position : self.position + 4]) is not None
        )

    def product(self) -> Any:
        if self.ends():
            raise self.refuse("grammar", f"an expression is missing before {self.text or 'the end'}")
        value = self.factor()
        while not self.ends():
            token = self.peek()
            if token.text in (r"\cdot", r"\times", "*"):
                self.take()
                value = multiply(value, self.factor(), token)
            elif token.text == "/":
                self.take()
                value = multiply(value, power(self.divisor(token), sp.Integer(-1), token), token)
            else:
                value = multiply(value, self.factor(), token)
        return value

    def divisor(self, slash: Token) -> Any:
        """What stands behind a slash, up to where the notation says that it ends."""
        value = self.factor()
        count = 1
        while not self.ends() and self.text not in ("/", r"\cdot", r"\times", "*"):
            if not self.notation.division:
                raise self.refuse(
                    "two readings", "a/bc can mean (a/b)c and a/(bc); write `division` in the notation", slash
                )
            if self.notation.division == "factor":
                break
            value = multiply(value, self.factor(), slash)
            count += 1
        return value

    def factor(self) -> Any:
        """One factor with its exponents."""
        token = self.peek()
        value = self.base()
        while self.text == "^":
            self.take()
            value = self.raised(value, self.argument(token), token)
        if self.text == "_":
            raise self.refuse("letter", "an index stands at what is no letter")
        return value

    def raised(self, value: Any, exponent: list[Token], at: Token) -> Any:
        texts = [token.text for token in exponent]
        if len(texts) == 1 and texts[0] in _TRANSPOSE and isinstance(value, sp.MatrixBase):
            return value.T
        return power(value, self.inner(exponent), at)

    def base(self) -> Any:
        token = self.peek()
        text = token.text
        if text in _BARS:
            return self.between_bars()
        if text in _DELIMITERS:
            return self.group()
        if text[:1].isdigit():
            self.take()
            return sp.Rational(text)
        if text in _FUNCTIONS:
            return self.known_function()
        if text.startswith(r"\begin{"):
            return self.environment()
        reader = getattr(self, f"read_{text[1:]}", None) if text.startswith("\\") and text[1:].isalpha() else None
        if reader is not None:
            return reader(self.take())
        return self.letter()

    def group(self) -> Any:
        opened = self.take()
        values = self.separated() if opened.text == "[" else self.separated(1)
        self.expect(_DELIMITERS[opened.text], opened)
        return values[0] if len(values) == 1 else self.listed(values, opened)

    def between_bars(self) -> Any:
        """A norm: what the notation says that it is, or the one that is computed."""
        opened = self.take()
        closing = _BARS[opened.text]
        named = self.norm_by_name(opened, closing)
        if named is not None:
            return named
        self.bars.append(closing)
        value = self.expression()
        self.bars.pop()
        self.expect(closing, opened)
        if self.text != "_":
            return norm(value, opened)
        self.take()
        low = "".join(token.text for token in self.argument(opened))
        if low not in NORMS or not isinstance(value, sp.MatrixBase):
            raise self.refuse("norm", "the notation says nothing of this norm with an index", opened)
        return norm(value, opened, low)

    def norm_by_name(self, opened: Token, closing: str) -> sp.Expr | None:
        depth, end = 1, self.position
        while end < len(self.tokens):
            text = self.tokens[end].text
            depth += (text == opened.text and text != closing) - (text == closing)
            if depth == 0:
                break
            end += 1
        start, inside, low = self.position, self.tokens[self.position : end], []
        self.position = end + 1
        if self.text == "_":
            self.take()
            low = self.argument(opened)
        named = self.notation.norms.get(spelling([*inside, *script("_", low)]))
        if named is None:
            self.position = start
        return named

    def known_function(self) -> Any:
        name = self.take()
        exponent: list[Token] = []
        if self.text == "^":
            self.take()
            exponent = self.argument(name)
        function = _FUNCTIONS[name.text]
        values = self.arguments() if self.text in ("(", "{") else [self.plain_argument(name)]
        if exponent and [token.text for token in exponent] == ["-", "1"]:
            raise self.refuse("two readings", f"{name.text}^{{-1}} can mean an inverse and a reciprocal", name)
        column = values[0]
        if len(values) == 1 and isinstance(column, sp.MatrixBase) and name.text in (r"\sin", r"\cos", r"\exp"):
            value: Any = column.applyfunc(function)  # of each entry, as papers write it
        elif any(isinstance(item, sp.MatrixBase) for item in values):
            raise self.refuse("matrix", f"{name.text} of a matrix is not read", name)
        elif refused := arguments_refused(name.text[1:], values):
            raise self.refuse("grammar", refused, name)
        else:
            value = function(*values)
        return self.raised(value, exponent, name) if exponent else value

    def plain_argument(self, name: Token) -> Any:
        """The argument of a function without parentheses: numbers and letters that follow, and nothing else."""
        value = None
        while not self.ends() and self.text not in _FUNCTIONS and self.text not in _DELIMITERS and self.text != "/":
            factor = self.factor()
            value = factor if value is None else multiply(value, factor, name)
        if value is None:
            raise self.refuse("grammar", f"{name.text} has no argument", name)
        return value

    def environment(self) -> Any:
        opened = self.take()
        name = opened.text[len(r"\begin{") : -1].rstrip("*")
        if name in CASES:
            return self.cases(opened)
        if name not in _MATRICES:
            raise self.refuse("environment", f"the environment {name} is not read", opened)
        if name == "array":
            self.argument(opened)
        bars, self.bars = self.bars, []
        rows: list[list[Any]] = [[]]
        while not self.text.startswith(r"\end{"):
            if self.text == "\\\\":
                self.take()
                rows.append([])
            elif self.text == "&":
                self.take()
            else:
                rows[-1].append(self.expression())
            if not self.text:
                raise self.refuse("bad LaTeX", f"{opened.text} is not closed", opened)
        self.take()
        self.bars = bars
        return self.stacked([row for row in rows if row], opened)

    def stacked(self, rows: list[list[Any]], at: Token) -> Any:
        """A matrix of entries that may be columns themselves."""
        try:
            return sp.ImmutableDenseMatrix(sp.Matrix.vstack(*(sp.Matrix.hstack(*map(_block, row)) for row in rows)))
        except (ValueError, sp.ShapeError):
            raise self.refuse("matrix", "the rows of a matrix are not of one length", at) from None

    def read_sqrt(self, at: Token) -> Any:
        degree = self.optional()
        value = self.inner(self.argument(at))
        return power(value, 1 / self.inner(degree) if degree else sp.Rational(1, 2), at)

    def read_frac(self, at: Token) -> Any:
        above, below = self.argument(at), self.argument(at)
        first, second = self.differential(above), self.differential(below)
        if first and second and first[0] == second[0]:
            return self.derivative(first[1], second[1], at)
        return multiply(self.inner(above), power(self.inner(below), sp.Integer(-1), at), at)

    read_tfrac = read_dfrac = read_frac

    def read_underbrace(self, at: Token) -> Any:
        above = self.argument(at)
        value = self.inner(above)
        if self.text == "_":
            self.take()
            self.braces.append((self.argument(at), above))
        return value

    def read_infty(self, at: Token) -> Any:
        return sp.oo

    def read_pi(self, at: Token) -> Any:
        return sp.pi


def _block(entry: Any) -> sp.MatrixBase:
    return sp.Matrix(entry) if isinstance(entry, sp.MatrixBase) else sp.Matrix([[entry]])
