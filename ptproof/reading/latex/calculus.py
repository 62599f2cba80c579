"""What calculus writes: derivatives, rates, gradients, integrals, limits, sums over an index, values at a point."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Any

import sympy as sp

from ptproof.reading.latex.cursor import differential
from ptproof.reading.latex.letters import Letters
from ptproof.reading.latex.rewrite import RATE
from ptproof.reading.latex.tokens import Token
from ptproof.reading.latex.values import add


class Calculus(Letters):
    """The part of the grammar that knows of derivatives; sums and products are given by ``Grammar``."""

    @abstractmethod
    def factor(self) -> Any: ...

    @abstractmethod
    def base(self) -> Any: ...

    @abstractmethod
    def product(self) -> Any: ...

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
        """The derivative by a symbol, a rate where that is a time; by a column, a gradient as a row or a Jacobian."""
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

    def bracket(self, first: Any, second: Any, at: Token) -> Any:
        """The Lie bracket of two vector fields, along the state that the notation names."""
        state = self.notation.state
        if not state:
            raise self.refuse("Lie bracket", "the notation does not say along which state this bracket is taken", at)
        if any(not isinstance(field, sp.MatrixBase) or field.shape != (len(state), 1) for field in (first, second)):
            raise self.refuse("Lie bracket", "a bracket of what are no vector fields of the state", at)
        return sp.ImmutableDenseMatrix(second.jacobian(state) * first - first.jacobian(state) * second)

    def along(self, value: Any, time: sp.Symbol) -> Any:
        if isinstance(value, sp.MatrixBase):
            return value.applyfunc(lambda entry: RATE(entry, time))
        return RATE(value, time)

    def read_dot(self, at: Token, order: int = 1) -> Any:
        tokens = self.argument(at)
        if not self.notation.dot:
            raise self.refuse("derivative", "the notation does not say along what a dot is taken", at)
        time = self.notation.vocabulary.symbol(self.notation.dot)
        # An index, and what the letter is applied to, stand behind the dot.
        value, exponent = self.dotted(tokens, at)
        for _ in range(order):
            value = self.along(value, time)
        return self.raised(value, exponent, at) if exponent else value

    def read_ddot(self, at: Token) -> Any:
        return self.read_dot(at, 2)

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
            part = type(self)(
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
