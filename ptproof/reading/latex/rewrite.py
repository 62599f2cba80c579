"""What letters stand for: rules from a name, or a function at some arguments, to an expression, put in to the end."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction

from ptproof.errors import InputError
from ptproof.reading.expressions import FUNCTIONS, parse

_CALL = re.compile(r"\s*([A-Za-z_]\w*)\s*(?:\(([^()]*)\))?\s*")
_NAME = re.compile(r"([A-Za-z_]\w*)\s*(\()?")
_DEEPEST = 40
RATE = sp.Function("rate", real=True)


@dataclass(frozen=True)
class Vocabulary:
    """The symbols that names stand for, those of a derivation first, and which of them are times."""

    symbols: Mapping[str, sp.Symbol]
    times: frozenset[str] = frozenset()
    states: frozenset[str] = frozenset()
    matrices: Mapping[str, sp.MatrixBase] = field(default_factory=dict)

    def symbol(self, name: str) -> sp.Symbol:
        """The symbol of this name, a real one where the derivation has none."""
        return self.symbols.get(name) or sp.Symbol(name, real=True)

    def expression(self, text: str, where: str) -> sp.Expr:
        """A text of the table as an expression, in which any name may occur."""
        names: dict[str, Any] = {}
        for match in _NAME.finditer(text):
            name = match.group(1)
            if match.group(2):
                if name not in FUNCTIONS:
                    names[name] = function(name)
            elif name not in ("pi", "E", "Derivative", "Piecewise") or name in self.symbols:
                names.setdefault(name, self.symbol(name))
        return parse(text, names, where=where)


def function(name: str) -> UndefinedFunction:
    """The undefined function of this name."""
    return RATE if name == "rate" else sp.Function(name, real=True)


@dataclass(frozen=True)
class Rule:
    """``name``, or ``name(…)`` where arguments that are symbols in ``given`` have to be just these, is ``value``."""

    name: str
    given: tuple[sp.Symbol, ...] | None
    free: frozenset[sp.Symbol]
    value: sp.Expr

    def matches(self, arguments: tuple[sp.Expr, ...]) -> dict[sp.Symbol, sp.Expr] | None:
        """What the free arguments are, or None where the rule is about something else."""
        if self.given is None or len(arguments) != len(self.given):
            return None
        found: dict[sp.Symbol, sp.Expr] = {}
        for wanted, argument in zip(self.given, arguments, strict=True):
            if wanted in self.free:
                if found.setdefault(wanted, argument) != argument:
                    return None
            elif wanted != argument:
                return None
        return found


def rule(key: str, text: str, vocabulary: Vocabulary, where: str) -> Rule:
    """The rule that a line of a table writes: ``"nu(_s)" = "1 - _s/T"``, ``"R" = "sqrt(x1**2 + x2**2)"``.

    An argument that begins with an underscore, as in ``"nu(_s)"``, stands for any expression.
    """
    match = _CALL.fullmatch(key)
    if match is None:
        raise InputError(f"{where}: {key!r} is no name and no function of names")
    value = vocabulary.expression(text, f"{where}, {key}")
    if match.group(2) is None:
        return Rule(match.group(1), None, frozenset(), value)
    arguments = tuple(vocabulary.symbol(name.strip()) for name in match.group(2).split(","))
    free = frozenset(argument for argument in arguments if argument.name.startswith("_"))
    return Rule(match.group(1), arguments, free, value)


@dataclass(frozen=True)
class Rules:
    """Rules by name, put into expressions until none applies. Those that come first win."""

    vocabulary: Vocabulary
    rules: tuple[Rule, ...]
    positive: Mapping[sp.Expr, sp.Symbol] = field(default_factory=dict)

    @cached_property
    def _by_name(self) -> dict[str, list[Rule]]:
        found: dict[str, list[Rule]] = {}
        for item in self.rules:
            found.setdefault(item.name, []).append(item)
        return found

    def __call__(self, expression: Any) -> Any:
        """The expression with every letter replaced by what it stands for."""
        if expression not in self._known:
            self._known[expression] = self._of(expression, 0).xreplace(self.positive)
        return self._known[expression]

    @cached_property
    def _known(self) -> dict[Any, Any]:
        """What was asked before; the same sides are asked for many formulas."""
        return {}

    def _of(self, expression: Any, depth: int) -> Any:
        if depth > _DEEPEST:
            raise InputError(f"the notation explains {expression} by itself")
        if isinstance(expression, sp.MatrixBase):
            return expression.applyfunc(lambda entry: self._of(entry, depth))
        if expression not in self._parts:
            self._parts[expression] = self._rewritten(expression, depth)
        return self._parts[expression]

    @cached_property
    def _parts(self) -> dict[Any, Any]:
        """What came of each part: the sides of a paper and of its claims have most of theirs in common."""
        return {}

    def _rewritten(self, expression: Any, depth: int) -> Any:
        match expression:
            case sp.Symbol():
                return self._symbol(expression, depth)
            case AppliedUndef():
                return self._applied(expression, depth)
            case sp.Derivative():
                return self._derivative(expression, depth)
            case sp.Integral():
                return self._integral(expression.function, expression.limits, depth)
            case sp.Subs():
                inner = self._of(expression.expr, depth)
                point = [self._of(value, depth) for value in expression.point]
                variables = [self._of(variable, depth) for variable in expression.variables]
                pairs = dict(zip(variables, point, strict=True))
                return inner.subs(pairs, simultaneous=True) if all(v.is_Symbol for v in variables) else expression
        if not expression.args:
            return expression
        arguments = [self._of(item, depth) for item in expression.args]
        return expression.func(*arguments)

    def _symbol(self, symbol: sp.Symbol, depth: int) -> sp.Expr:
        for item in self._by_name.get(symbol.name, ()):
            if item.given is None and item.value != symbol:
                if item.value.is_Symbol and item.value.name == symbol.name:
                    return item.value
                return self._of(item.value, depth + 1)
        return self.vocabulary.symbol(symbol.name) if not isinstance(symbol, sp.Dummy) else symbol

    def _applied(self, node: sp.Expr, depth: int) -> sp.Expr:
        name = node.func.__name__
        arguments = tuple(self._of(argument, depth) for argument in node.args)
        for item in self._by_name.get(name, ()):
            found = item.matches(arguments)
            if found is not None:
                return self._of(item.value.subs(found, simultaneous=True), depth + 1)
        return function(name)(*(arguments if name == "rate" else map(_settled, arguments)))

    def _derivative(self, node: sp.Expr, depth: int) -> sp.Expr:
        inner = self._of(node.expr, depth)
        for variable, count in node.variable_count:
            along = self._of(variable, depth)
            for _ in range(int(count)):
                if along.is_Symbol and along.name in self.vocabulary.times:
                    inner = self._state(inner, along, depth)
                    inner = (
                        sp.diff(inner, along) if self._explicit(inner, node, along) else RATE(sp.expand(inner), along)
                    )
                elif along.is_Symbol:
                    inner = sp.diff(inner, along)
                else:
                    inner = sp.Function("slope", real=True)(inner, along)
        return inner

    def _integral(self, function: sp.Expr, limits: Sequence[sp.Tuple], depth: int) -> sp.Expr:
        """The integral with one spelling of its bound variables, its integrand multiplied out."""
        if not limits:
            return sp.expand(self._of(function, depth))
        (variable, *ends), inner = limits[-1], list(limits[:-1])
        bound = sp.Symbol(f"bound_{len(limits) + _nested(function)}", real=True)
        free = True  # until one of the inner integrals binds the same letter anew
        for place in reversed(range(len(inner))):
            own, *between = inner[place]
            inner[place] = sp.Tuple(own, *(end.xreplace({variable: bound}) if free else end for end in between))
            free = free and own != variable
        body = self._integral(function.xreplace({variable: bound}) if free else function, inner, depth)
        factor, inside = _single(body)
        if inside is not None:
            body = sp.Integral(sp.expand(factor * inside.function), *inside.limits)
        return sp.Integral(body, (bound, *(self._of(end, depth) for end in ends)))

    def _explicit(self, inner: sp.Expr, node: sp.Derivative, time: sp.Symbol) -> bool:
        """Whether what is differentiated is a function of this time alone, and known."""
        alone = isinstance(node.expr, AppliedUndef) and node.expr.args == (time,)
        return alone and inner.has(time) and not inner.has(AppliedUndef)

    def _state(self, moved: sp.Expr, time: sp.Symbol, depth: int) -> sp.Expr:
        """The letter of a state that is written as a function of the time along which it moves."""
        if isinstance(moved, AppliedUndef) and moved.args == (time,) and moved.func.__name__ in self.vocabulary.states:
            return self._symbol(sp.Symbol(moved.func.__name__), depth + 1)
        return moved


def _nested(function: sp.Expr) -> int:
    """How many integrals stand in one another in the function, at most."""
    found = [len(node.limits) + _nested(node.function) for node in function.atoms(sp.Integral)]
    return max(found, default=0)


def _single(body: sp.Expr) -> tuple[sp.Expr, sp.Integral | None]:
    """A product as an integral and what multiplies it, where just one factor is an integral."""
    integrals = [factor for factor in sp.Mul.make_args(body) if isinstance(factor, sp.Integral)]
    if len(integrals) != 1 or body == integrals[0]:
        return sp.S.One, None
    return body / integrals[0], integrals[0]


@lru_cache(maxsize=4096)
def _settled(argument: sp.Expr) -> sp.Expr:
    """An argument in one spelling, so that a function at t − t₀ is the function at −(t₀ − t)."""
    if argument.is_Symbol or argument.is_number:
        return argument
    try:
        return sp.factor(sp.cancel(sp.together(argument)))
    except (sp.PolynomialError, NotImplementedError):
        return sp.expand(argument)


def rules(tables: Iterable[Mapping[str, str]], vocabulary: Vocabulary, where: str) -> Rules:
    """The rules of several tables, those of the first ones before the others'."""
    found = [rule(key, value, vocabulary, where) for table in tables for key, value in table.items()]
    return Rules(vocabulary, tuple(found))
