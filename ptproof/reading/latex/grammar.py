"""The grammar of formulas: sums, products, powers, fractions, norms, matrices, derivatives, integrals, sums over an index.

Values are SymPy expressions or matrices. Nothing is guessed: what has two readings, or a letter of which the notation
says nothing, is not read, and the place is named.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp

from ptproof.reading.latex.cursor import CLOSING, OTHER_RELATIONS, RELATIONS, differential
from ptproof.reading.latex.letters import Letters
from ptproof.reading.latex.notation import Notation
from ptproof.reading.latex.rewrite import RATE
from ptproof.reading.latex.tokens import NotUnderstood, Token
from ptproof.reading.latex.values import add, multiply, negate, norm, power

_DELIMITERS = {"(": ")", "[": "]", r"\{": r"\}", "{": "}"}
_BARS = {r"\lVert": r"\rVert", r"\lvert": r"\rvert", "|": "|", r"\|": r"\|"}
_FUNCTIONS: dict[str, Callable[..., sp.Expr]] = {
    r"\sin": sp.sin, r"\cos": sp.cos, r"\tan": sp.tan, r"\exp": sp.exp, r"\ln": sp.log, r"\log": sp.log, r"\sinh": sp.sinh,
    r"\cosh": sp.cosh, r"\tanh": sp.tanh, r"\arctan": sp.atan, r"\min": sp.Min, r"\max": sp.Max,
}  # fmt: skip
_MATRICES = frozenset({"bmatrix", "pmatrix", "matrix", "array", "smallmatrix", "vmatrix"})
_TRANSPOSE = frozenset({r"\top", "T", r"\intercal", r"\text{T}"})


class Grammar(Letters):
    """Reads one formula, or a piece of one, by a notation."""

    def __init__(self, tokens: Sequence[Token], notation: Notation) -> None:
        super().__init__(tokens, notation)
        self.bars: list[str] = []
        self.braces: list[tuple[list[Token], list[Token]]] = []

    def inner(self, tokens: Sequence[Token]) -> Any:
        """The value of a piece that has to be one expression."""
        part = Grammar(tokens, self.notation)
        part.braces = self.braces
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
        value = self.product() if self.take().text == "+" else negate(self.product())
        return value

    def ends(self) -> bool:
        """Whether no further factor follows."""
        text = self.text
        if text in OTHER_RELATIONS:
            raise self.refuse("relation", f"{OTHER_RELATIONS[text]} ({text}) is no relation between numbers")
        if text in CLOSING or text in RELATIONS or text in ("+", "-") or text.startswith(r"\end{"):
            return True
        if self.bars and text == self.bars[-1]:
            return True
        return (
            text in (r"\forall", r"\text") and differential(self.tokens[self.position : self.position + 4]) is not None
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
        bars, self.bars = self.bars, []
        value = self.expression()
        self.bars = bars
        if self.text == "," and opened.text == "[":
            raise self.refuse("Lie bracket", "a bracket of two things is not read", opened)
        self.expect(_DELIMITERS[opened.text], opened)
        return value

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
        if self.text == "_":
            raise self.refuse("norm", "the notation says nothing of this norm with an index", opened)
        return norm(value, opened)

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
        named = self.named_norm(inside, low)
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
        if name == "cases":
            raise self.refuse("cases", "cases are not read", opened)
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
            return sp.ImmutableDenseMatrix(
                sp.Matrix([list(row) for row in rows])
                if not any(isinstance(entry, sp.MatrixBase) for row in rows for entry in row)
                else sp.Matrix.vstack(*(sp.Matrix.hstack(*map(_block, row)) for row in rows))
            )
        except (ValueError, sp.ShapeError):
            raise self.refuse("matrix", "the rows of a matrix are not of one length", at) from None

    def read_sqrt(self, at: Token) -> Any:
        degree = self.optional()
        value = self.inner(self.argument(at))
        return power(value, 1 / self.inner(degree) if degree else sp.Rational(1, 2), at)

    def read_frac(self, at: Token) -> Any:
        above, below = self.argument(at), self.argument(at)
        first, second = differential(above), differential(below)
        if first and second and first[0] == second[0]:
            return self.derivative(first[1], second[1], at)
        return multiply(self.inner(above), power(self.inner(below), sp.Integer(-1), at), at)

    read_tfrac = read_dfrac = read_frac

    def derivative(self, above: list[Token], below: list[Token], at: Token) -> Any:
        if any(token.text == "^" for token in [*above[:1], *below[-2:]]) or any(
            differential(below[i:]) for i in range(1, len(below))
        ):
            raise self.refuse("derivative", "a derivative of second order is not read", at)
        variable = self.inner(below)
        if not above:
            return self.differentiated(self.factor(), variable, at)
        return self.differentiated(self.inner(above), variable, at)

    def differentiated(self, value: Any, variable: Any, at: Token) -> Any:
        """The derivative by a symbol, a rate where that is a time; by a column, the gradient as a row or the Jacobian."""
        if isinstance(variable, sp.MatrixBase):
            entries = list(value) if isinstance(value, sp.MatrixBase) else [value]
            return sp.ImmutableDenseMatrix([[sp.diff(entry, symbol) for symbol in variable] for entry in entries])
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("derivative", f"{variable} is no variable", at)
        if variable.name in self.notation.vocabulary.times:
            return self.along(value, variable)
        return (
            value.applyfunc(lambda e: sp.diff(e, variable))
            if isinstance(value, sp.MatrixBase)
            else sp.diff(value, variable)
        )

    def along(self, value: Any, time: sp.Symbol) -> Any:
        if isinstance(value, sp.MatrixBase):
            return value.applyfunc(lambda entry: RATE(entry, time))
        return RATE(value, time)

    def read_dot(self, at: Token) -> Any:
        tokens = self.argument(at)
        if not self.notation.dot:
            raise self.refuse("derivative", "the notation does not say along what a dot is taken", at)
        # An index, and what the letter is applied to, stand behind the dot.
        return self.along(self.dotted(tokens, at), self.notation.vocabulary.symbol(self.notation.dot))

    def read_nabla(self, at: Token) -> Any:
        if self.text == "^":
            raise self.refuse("derivative", "a derivative of second order is not read", at)
        value = self.base()
        arguments = getattr(value, "args", ())
        if (
            not arguments
            or not all(isinstance(item, sp.Symbol) for item in arguments)
            or not isinstance(value, sp.Expr)
        ):
            raise self.refuse("derivative", "the gradient is read only of a function at a point", at)
        return sp.ImmutableDenseMatrix([sp.Derivative(value, item) for item in arguments])

    def read_underbrace(self, at: Token) -> Any:
        above = self.argument(at)
        value = self.inner(above)
        if self.text == "_":
            self.take()
            self.braces.append((self.argument(at), above))
        return value

    def read_int(self, at: Token) -> Any:
        lower, upper = self.limits(at)
        body = self.product()
        found = differential(self.tokens[self.position : self.position + 4])
        if found is None:
            raise self.refuse("integral", "the integral has no differential", at)
        self.position += 4
        variable = self.base()
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("integral", f"{variable} is no variable of integration", at)
        return sp.Integral(body, (variable, self.inner(lower), self.inner(upper)))

    def limits(self, at: Token) -> tuple[list[Token], list[Token]]:
        lower: list[Token] = []
        upper: list[Token] = []
        while self.text in ("_", "^"):
            if self.take().text == "_":
                lower = self.argument(at)
            else:
                upper = self.argument(at)
        if not lower or not upper:
            raise self.refuse("integral", f"{at.text} without its two limits is not read", at)
        return lower, upper

    def read_sum(self, at: Token) -> Any:
        lower, upper = self.limits(at)
        if any(token.text == r"\substack" for token in lower) or len(lower) < 3 or lower[1].text != "=":
            raise self.refuse("sum", "a sum over this range is not read", at)
        count = self.notation.counts.get("".join(token.text for token in upper))
        last = (
            count if count is not None else int(upper[0].text) if len(upper) == 1 and upper[0].text.isdigit() else None
        )
        if last is None or not lower[2].text.isdigit():
            raise self.refuse("sum", "the notation does not say how many terms the sum has", at)
        index, start = lower[0].text, self.position
        total: Any = None
        for number in range(int(lower[2].text), last + 1):
            part = Grammar(
                self.tokens[:start]
                + [Token(str(number), token.line) if token.text == index else token for token in self.tokens[start:]],
                self.notation,
            )
            part.position, part.bars, part.braces = start, self.bars, self.braces
            term = part.product()
            total = term if total is None else add(total, term, at)
            self.position = part.position
        return total

    def read_lim(self, at: Token) -> Any:
        if self.take().text != "_":
            raise self.refuse("limit", "a limit without its variable", at)
        under = self.argument(at)
        arrow = next((i for i, token in enumerate(under) if token.text in (r"\to", r"\rightarrow")), 0)
        variable, target = self.inner(under[:arrow]), self.inner(under[arrow + 1 :])
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("limit", f"{variable} is no variable", at)
        return sp.Limit(self.product(), variable, target, dir="-")

    def read_infty(self, at: Token) -> Any:
        return sp.oo

    def read_pi(self, at: Token) -> Any:
        return sp.pi

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
        change: Callable[[Any], Any] = lambda entry: sp.Subs(entry, *map(tuple, zip(*pairs, strict=True)))  # noqa: E731
        return value.applyfunc(change) if isinstance(value, sp.MatrixBase) else change(value)


def _block(entry: Any) -> sp.MatrixBase:
    return sp.Matrix(entry) if isinstance(entry, sp.MatrixBase) else sp.Matrix([[entry]])


__all__ = ["Grammar", "NotUnderstood"]
