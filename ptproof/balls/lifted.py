"""What the arithmetics of other numbers share with that of balls."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any, ClassVar

from flint import arb

from ptproof.balls.arithmetic import Arithmetic
from ptproof.balls.ball import BALLS
from ptproof.balls.tape import Undefined

_OPERATIONS = (
    "call", "integer_power", "root", "power", "absolute", "sign", "maximum", "minimum", "floor", "angle", "order",
)  # fmt: skip


class Lifted(Arithmetic):
    """The arithmetic of one ``kind`` of number.

    What is no such number is a ball, a constant, and an operation on balls alone is that of balls: a subclass
    defines the operations for its own kind only, those that do not follow from others.
    """

    kind: ClassVar[Any]

    def __init_subclass__(cls) -> None:
        for name in _OPERATIONS:
            setattr(cls, name, _or_balls(getattr(cls, name), getattr(BALLS, name), cls.kind))

    def constant(self, value: arb) -> Any:
        return value

    def integer_power(self, base: Any, exponent: int) -> Any:
        if exponent < 0:
            return self.inverse(self.integer_power(base, -exponent))
        result: Any = arb(1)
        for bit in bin(exponent)[2:]:
            result = result.square() if isinstance(result, self.kind) else result
            result = base * result if bit == "1" else result
        return result

    def inverse(self, value: Any) -> Any:
        """1/``value``, of a number of this kind."""
        raise NotImplementedError

    def power(self, base: Any, exponent: Any) -> Any:
        return self.call("exp", exponent * self.call("log", base))

    def absolute(self, value: Any) -> Any:
        return value * self.sign(value)

    def sign(self, value: Any) -> Any:
        known = self.order(value)
        if known is None:
            raise Undefined("a kink or a jump")
        return arb(known)

    def maximum(self, left: Any, right: Any) -> Any:
        known = self.order(left - right)
        if known is None or known == 0:
            raise Undefined("a kink")
        return left if known > 0 else right

    def angle(self, y: Any, x: Any) -> Any:
        if self.order(x) != 1:
            raise Undefined("an angle that is not smooth")
        return self.call("atan", y * self.integer_power(x, -1))

    def minimum(self, left: Any, right: Any) -> Any:
        return -self.maximum(-left, -right)

    def either(self, values: Sequence[Any]) -> Any:
        raise Undefined("a Piecewise that may jump")


def _or_balls(own: Callable[..., Any], balls: Callable[..., Any], kind: type) -> Callable[..., Any]:
    @functools.wraps(own)
    def operation(self: Lifted, *arguments: Any) -> Any:
        for argument in arguments:
            if isinstance(argument, kind):
                return own(self, *arguments)
        return balls(*arguments)

    return operation
