"""What holds along the solutions of a system of differential equations: a statement about runs, not about formulas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.relation import Relation


@dataclass(frozen=True)
class Runs:
    """Every solution of state' = rates from a start that is allowed exists on the whole span, and has the ``parts``.

    Attributes
    ----------
    time, state, rates
        The system; it has no letters beside these, and what it may start from, is said in numbers.
    span
        The first and the last instant.
    starts
        Relations between the states at the first instant. Whatever they leave open, any value is allowed: a heading
        that they don't mention may be any heading.
    parts
        Relations between the states, and the time, that hold
    during
        at every instant from the first to the second of these; at one instant, where they are the same.
    """

    time: sp.Symbol
    state: tuple[sp.Symbol, ...]
    rates: tuple[sp.Expr, ...]
    span: tuple[sp.Expr, sp.Expr]
    starts: tuple[Relation, ...]
    parts: tuple[Relation, ...]
    during: tuple[sp.Expr, sp.Expr]

    def __post_init__(self) -> None:
        for name in ("state", "rates", "span", "starts", "parts", "during"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        for name in ("rates", "span", "during"):
            object.__setattr__(self, name, tuple(map(sp.sympify, getattr(self, name))))
        if len(self.rates) != len(self.state) or len({self.time, *self.state}) != 1 + len(self.state):
            raise InputError("a statement about runs has a rate for each state, and another letter for the time")
        if not self.parts:
            raise InputError("a statement about runs says something about them")
        states, everything = {*self.state}, {self.time, *self.state}
        for names, allowed, items in (
            ("the rates", everything, self.rates), ("the parts", everything, _sides(self.parts)),
            ("the starts", states, _sides(self.starts)), ("instants", set(), (*self.span, *self.during)),
        ):  # fmt: skip
            for item in items:
                if unknown := (item.free_symbols - allowed) | item.atoms(AppliedUndef):
                    raise InputError(f"{names} of a statement about runs may not have {', '.join(map(str, unknown))}")
        for symbol in everything:
            if any(getattr(symbol, f"is_{kind}") is not None for kind in ("positive", "negative", "zero", "rational")):
                raise InputError(f"{symbol}: the time and the states of runs are declared real, and no more")

    @property
    def letters(self) -> tuple[sp.Symbol, ...]:
        """The time and the states, which are bound in it."""
        return (self.time, *self.state)

    @property
    def at_once(self) -> bool:
        """Whether it speaks of one instant."""
        return bool(self.during[0] == self.during[1])

    def __str__(self) -> str:
        rates = ", ".join(f"{x}' = {rate}" for x, rate in zip(self.state, self.rates, strict=True))
        starts = " and ".join(map(str, self.starts)) or "anything holds"
        said = " and ".join(map(str, self.parts))
        first, last = self.during
        when = f"at {self.time} = {first}" if self.at_once else f"for all {self.time} from {first} to {last}"
        return (
            f"every solution of {rates} where {starts} at {self.time} = {self.span[0]} exists until "
            f"{self.time} = {self.span[1]}, and {said} {when}"
        )

    def latex(self, **names: Any) -> str:
        return r",\quad ".join(part.latex(**names) for part in self.parts)


def _sides(relations: tuple[Relation, ...]) -> tuple[sp.Expr, ...]:
    found: list[sp.Expr] = []
    for part in relations:
        if isinstance(part.left, sp.MatrixBase):
            raise InputError("a statement about runs has relations between scalars")
        found += [part.left, part.right]
    return tuple(found)
