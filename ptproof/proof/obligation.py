"""One thing that has to hold for an expression to have a real value."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ptproof.proof.statement import Relation

_ENOUGH = {
    "!=": ("nonzero", "positive", "negative"), ">": ("positive",), ">=": ("nonnegative", "positive"),
    "<": ("negative",), "<=": ("nonpositive", "negative"), "=": ("zero",),
}  # fmt: skip


def is_declared(relation: Relation) -> bool:
    """Whether what the symbols are declared to be is enough for the relation."""
    difference = relation.left - relation.right
    return any(getattr(difference, f"is_{word}") for word in _ENOUGH[relation.sign])


@dataclass(frozen=True)
class Obligation:
    """``relation`` has to hold wherever all of ``given`` does, lest ``node`` is not defined and real.

    Without a relation nothing is known that would show it, and ``why`` says what is missing.
    """

    node: sp.Basic
    relation: Relation | None
    given: tuple[Relation, ...] = ()
    why: str = ""
    under_binder: bool = False

    @property
    def necessary(self) -> bool:
        """Whether ``node`` being defined shows the relation; otherwise it is only enough.

        A power of 0 or of a negative number may be defined where its exponent is a letter, and so may a derivative at
        a place where two branches meet smoothly, or an integral over an integrand that is not everywhere.
        """
        if self.relation is None or self.under_binder:
            return False
        if not isinstance(self.node, sp.Pow):
            return True
        exponent = self.node.exp
        if exponent.is_integer is False:
            return exponent.is_positive is not None
        return bool(exponent.is_integer and exponent.is_negative)

    @cached_property
    def settled(self) -> bool:
        """Whether what the symbols are declared to be is enough."""
        return self.relation is not None and is_declared(self.relation)

    def __str__(self) -> str:
        if self.relation is None:
            return self.why
        where = f" where {' and '.join(map(str, self.given))}" if self.given else ""
        return f"{self.relation}{where}"
