"""What calculus writes: derivatives, rates, gradients, brackets of fields, integrals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.reading.latex.cursor import differential
from ptproof.reading.latex.letters import Letters
from ptproof.reading.latex.rewrite import RATE
from ptproof.reading.latex.tokens import Token
from ptproof.reading.latex.values import entrywise, integral


class Calculus(Letters):
    """The part of the grammar that knows of derivatives; sums and products are given by ``Grammar``."""

    def derivative(self, above: list[Token], below: list[Token], at: Token) -> Any:
        """The derivative that a fraction of differentials writes, its orders above and below the same."""
        order, above = self.order_of(above, at)
        variables = [variable for part in _differentials(below) for variable in self.repeated(part, at)]
        if order != len(variables):
            raise self.refuse("derivative", "a derivative whose orders above and below are not the same", at)
        value = self.inner(above) if above else self.factor()
        for variable in reversed(variables):
            value = self.differentiated(value, variable, at)
        return value

    def order_of(self, tokens: list[Token], at: Token) -> tuple[int, list[Token]]:
        """The exponent that stands first, and the rest."""
        if not tokens or tokens[0].text != "^":
            return 1, tokens
        part = type(self)(tokens[1:], self.notation)
        exponent = part.argument(at)
        if len(exponent) != 1 or exponent[0].text not in ("2", "3", "4"):
            raise self.refuse("derivative", "a derivative of an order that is no small number", at)
        return int(exponent[0].text), part.tokens[part.position :]

    def repeated(self, tokens: Sequence[Token], at: Token) -> list[Any]:
        """What is differentiated by, as often as its exponent says; the exponent of x^* is none."""
        part = type(self)(tokens, self.notation)
        last = next((i for i in range(len(tokens) - 1, 0, -1) if tokens[i].text == "^"), 0)
        count = "".join(token.text for token in tokens[last + 1 :]).strip("{}")
        if last and count in ("2", "3", "4"):
            return [part.inner(tokens[:last])] * int(count)
        return [part.inner(tokens)]

    def differentiated(self, value: Any, variable: Any, at: Token) -> Any:
        """The derivative by a symbol, a rate where that is a time; by a column, a gradient as a row or a Jacobian."""
        if isinstance(variable, sp.MatrixBase):
            if isinstance(value, sp.MatrixBase) and 1 not in value.shape:
                raise self.refuse("derivative", "a derivative of a matrix by a column is not read", at)
            entries = list(value) if isinstance(value, sp.MatrixBase) else [value]
            return sp.ImmutableDenseMatrix([[sp.diff(entry, symbol) for symbol in variable] for entry in entries])
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("derivative", f"{variable} is no variable", at)
        if variable.name in self.notation.vocabulary.times:
            return self.along(value, variable)
        return entrywise(value, lambda entry: sp.diff(entry, variable))

    def listed(self, values: list[Any], at: Token) -> Any:
        """What ``[…, …]`` is: a row of numbers and rows, or the Lie bracket of two columns."""
        columns = [value for value in values if isinstance(value, sp.MatrixBase) and value.rows > 1]
        if len(values) == 2 and (columns or len(self.notation.state) == 1):
            return self.bracket(values[0], values[1], at)
        if columns:
            raise self.refuse("matrix", "a row of columns is not read", at)
        return sp.ImmutableDenseMatrix([[entry for value in values for entry in sp.Matrix([value])]])

    def bracket(self, first: Any, second: Any, at: Token) -> Any:
        """The Lie bracket of two vector fields, along the state that the notation names."""
        state = self.notation.state
        if not state:
            raise self.refuse("Lie bracket", "the notation does not say along which state this bracket is taken", at)
        if any(not isinstance(field, sp.MatrixBase) or field.shape != (len(state), 1) for field in (first, second)):
            raise self.refuse("Lie bracket", "a bracket of what are no vector fields of the state", at)
        return sp.ImmutableDenseMatrix(second.jacobian(state) * first - first.jacobian(state) * second)

    def along(self, value: Any, time: sp.Symbol) -> Any:
        """The rate; of a function of that time alone, the derivative by it."""

        def rate(entry: Any) -> Any:
            explicit = isinstance(entry, AppliedUndef) and entry.args == (time,)
            return sp.Derivative(entry, time) if explicit else RATE(entry, time)

        return entrywise(value, rate)

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
        arguments = value.args if isinstance(value, sp.Expr) else ()
        if not arguments or not all(isinstance(item, sp.Symbol) for item in arguments):
            raise self.refuse("derivative", "the gradient is read only of a function at a point", at)
        return sp.ImmutableDenseMatrix([sp.Derivative(value, item) for item in arguments])

    def read_int(self, at: Token) -> Any:
        lower, upper = self.limits(at)
        self.integrals += 1
        body = self.product()
        self.integrals -= 1
        found = self.differential(self.tokens[self.position :])
        if found is None or found[0] != "d":
            raise self.refuse("integral", "the integral has no differential", at)
        self.position = len(self.tokens) - len(found[1])
        variable = self.base()
        if not isinstance(variable, sp.Symbol):
            raise self.refuse("integral", f"{variable} is no variable of integration", at)
        return integral(body, (variable, self.inner(lower), self.inner(upper)), at)

    def limits(self, at: Token) -> tuple[list[Token], list[Token]]:
        lower, upper = self.scripts(at)
        if not lower or not upper:
            raise self.refuse("integral", f"{at.text} without its two limits is not read", at)
        return lower, upper


def _differentials(tokens: list[Token]) -> list[list[Token]]:
    """What stands between the signs of differentials: of ``x ∂y``, x and y."""
    parts: list[list[Token]] = [[]]
    depth = position = 0
    while position < len(tokens):
        depth += (tokens[position].text == "{") - (tokens[position].text == "}")
        found = differential(tokens[position:]) if depth == 0 and parts[-1] else None
        if found is not None and found[1] and tokens[position].text != "d":
            parts.append([])
            position = len(tokens) - len(found[1])
        else:
            parts[-1].append(tokens[position])
            position += 1
    return parts
