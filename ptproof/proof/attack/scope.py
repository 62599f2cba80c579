"""What an evaluation is handed on with: the values of the symbols, and who evaluates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import sympy as sp

from ptproof.proof.attack.numbers import Number
from ptproof.proof.attack.series import Calculus, Value

BINDERS = (sp.Derivative, sp.Integral, sp.Limit, sp.Sum, sp.Product, sp.Subs)


@dataclass(slots=True)
class Scope:
    """The values of the symbols that an expression may contain, and what was evaluated with them before."""

    symbols: Mapping[Any, Value]
    known: dict[Any, Value] = field(default_factory=dict)

    def with_values(self, values: Mapping[Any, Value]) -> Scope:
        """The same with other symbols, or with other values of the same ones."""
        return Scope({**self.symbols, **values})


class Valuer(Protocol):
    """Whoever gives expressions values."""

    calculus: Calculus

    def number(self, expression: sp.Expr, scope: Scope) -> Number:
        """The value where no derivative is taken."""
        ...


@dataclass
class Work:
    """How many nodes have been evaluated: what an attack costs, the same on every machine."""

    steps: int = 0
    limit: int = 10**9


class Inadmissible(Exception):
    """A concrete function takes a value that the function was not declared to take."""
