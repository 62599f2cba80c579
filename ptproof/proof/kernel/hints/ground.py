"""Values of unknown functions and of their derivatives as numbers: what is left is arithmetic in symbols.

A derivative of an unknown function at a place is one such number, however the claim writes it; a derivative of what is
composed of unknown functions is what the chain rule says.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.terms import SIGNS, NoTranslation, term
from ptproof.proof.statement import Relation

Values = Mapping[sp.Basic, sp.Basic]


@dataclass(frozen=True)
class Value:
    """An unknown function at ``places``, differentiated by the arguments with the numbers ``slots`` in turn."""

    function: Any
    places: tuple[sp.Expr, ...]
    slots: tuple[int, ...] = ()


@dataclass
class Ground:
    """Turns expressions into such without unknown functions; collects how Coq follows.

    ``names`` are the identifiers of the claim's symbols and of the values met so far, ``full`` what these are written
    out. ``same`` are values that were met again in other words, and ``rules`` lines for
    derivatives of what is composed.
    """

    names: dict[Any, str]
    full: dict[Any, str]
    made: dict[Value, sp.Symbol] = field(default_factory=dict)
    same: dict[Value, Value] = field(default_factory=dict)
    rules: list[str] = field(default_factory=list)

    @classmethod
    def over(cls, names: Names) -> Ground:
        """Without values yet."""
        return cls(dict(names), dict(names))

    def __call__(self, expression: sp.Basic, at: Values | None = None) -> sp.Basic:
        """The expression with values ``at`` put in for its symbols, which are without unknown functions themselves.

        Raises
        ------
        NoTranslation
            Where something else is bound, or what is differentiated is not a composed function of one variable.
        """
        at = at or {}
        if not expression.args:
            return at.get(expression, expression)
        match expression:
            case sp.Subs():
                places = [self(point, at) for point in expression.point]
                return self(expression.expr, {**at, **dict(zip(expression.variables, places, strict=True))})
            case sp.Derivative():
                return self._derivative(expression, at)
            case AppliedUndef():
                return self._value(Value(expression.func, tuple(self(item, at) for item in expression.args)))
            case sp.Integral() | sp.Limit() | sp.Piecewise():
                raise NoTranslation(f"values inside {type(expression).__name__}")
        return expression.func(*(self(item, at) for item in expression.args))

    def lines(self) -> Iterator[str]:
        """The rules, and then each value by its name: after those that stand in its places."""
        yield from self.rules
        known = set(self.made.values())
        again = {value: [other for other, first in self.same.items() if first == value] for value in self.made}
        left = dict(self.made)
        while left:
            inside = {value: set().union(*(p.free_symbols for v in (value, *again[value]) for p in v.places)) & known
                      for value in left}  # fmt: skip
            ready = [value for value in left if not inside[value] & set(left.values())]
            for value in ready or [next(iter(left))]:
                symbol = left.pop(value)
                text = self._text(value, self.names)
                yield from (f"try (same_call {self._text(other, self.names)} {text})" for other in again[value])
                signed = symbol.is_nonnegative or symbol.is_nonpositive
                yield f"try ({'atom' if signed else 'named'} {symbol} {text})"

    def _value(self, value: Value) -> sp.Symbol:
        if value.function not in self.names:
            raise NoTranslation(f"{value.function}, which has no name here")
        if value in self.made:
            return self.made[value]
        if value in self.same:
            return self.made[self.same[value]]
        for other in self.made:
            if (other.function, other.slots) == (value.function, value.slots) and all(
                map(_equal, other.places, value.places)
            ):
                self.same[value] = other
                return self.made[other]
        name = fresh(f"v{len(self.made)}", self.names)
        own = (
            {}
            if value.slots
            else {word: truth for word, truth in value.function._kwargs.items() if word != "commutative"}
        )
        symbol = sp.Symbol(name, **{"real": True, **own})
        self.made[value] = symbol
        self.full[symbol] = self._text(value, self.full)
        self.names[symbol] = name
        return symbol

    def _text(self, value: Value, names: Names) -> str:
        places = [term(place, names) for place in value.places]

        def write(slots: tuple[int, ...], arguments: list[str]) -> str:
            if not slots:
                return f"({names[value.function]} {' '.join(arguments)})"
            *rest, last = slots
            name = fresh(f"u{len(slots)}", names)
            inner = write(tuple(rest), [name if i == last else item for i, item in enumerate(arguments)])
            return f"(Derive (fun {name} => {inner}) {arguments[last]})"

        return write(value.slots, places)

    def _derivative(self, derivative: sp.Derivative, at: Values) -> sp.Basic:
        inner, variables = derivative.expr, derivative.variables
        if isinstance(inner, AppliedUndef) and all(_alone(variable, inner) for variable in variables):
            places = tuple(self(item, at) for item in inner.args)
            return self._value(Value(inner.func, places, tuple(inner.args.index(variable) for variable in variables)))
        if len(variables) != 1 or inner.has(sp.Derivative, sp.Integral, sp.Limit, sp.Subs):
            raise NoTranslation("a derivative of what is composed of derivatives or integrals")
        (variable,) = variables
        rate = self(sp.diff(inner, variable), at)
        moving = fresh("u", self.full)
        others = {symbol: value for symbol, value in at.items() if symbol != variable}
        # Written in the order of the claim, whatever the variable is called.
        body = term(inner.xreplace(others), {**self.full, variable: moving})
        place = term(at.get(variable, variable), self.full)
        rule = f"try (derivative_as (Derive (fun {moving} => {body}) {place}) {term(rate, self.full)})"
        if rule not in self.rules:
            self.rules.append(rule)
        return rate


def calls(expression: sp.Basic, at: Values | None = None) -> Iterator[tuple[AppliedUndef, tuple[int, ...]]]:
    """Calls of unknown functions with ``at`` put in, each with the numbers of the arguments that it is derived by."""
    at = at or {}
    match expression:
        case sp.Subs():
            places = [point.xreplace(dict(at)) for point in expression.point]
            yield from calls(expression.expr, {**at, **dict(zip(expression.variables, places, strict=True))})
            for point in expression.point:
                yield from calls(point, at)
        case sp.Derivative():
            inner, variables = expression.expr, expression.variables
            if isinstance(inner, AppliedUndef) and all(_alone(variable, inner) for variable in variables):
                yield inner.xreplace(dict(at)), tuple(inner.args.index(variable) for variable in variables)
                for argument in inner.args:
                    yield from calls(argument, at)
            elif len(variables) == 1 and not inner.has(sp.Derivative, sp.Integral, sp.Limit, sp.Subs):
                yield from calls(inner, at)
                yield from calls(sp.diff(inner, variables[0]), at)
        case sp.Integral() | sp.Limit():
            return
        case _:
            if isinstance(expression, AppliedUndef):
                yield expression.xreplace(dict(at)), ()
            for argument in expression.args:
                yield from calls(argument, at)


def written(relation: Relation, names: Names) -> str:
    """The relation for Coq."""
    return f"{term(relation.left, names)} {SIGNS[relation.sign]} {term(relation.right, names)}"


def _alone(variable: sp.Symbol, call: AppliedUndef) -> bool:
    """Whether the variable is one of the call's arguments and does not occur in another one."""
    return [item for item in call.args if item.has(variable)] == [variable]


def _equal(first: sp.Expr, second: sp.Expr) -> bool:
    return bool(first == second or sp.fraction(sp.together(first - second))[0].expand() == 0)
