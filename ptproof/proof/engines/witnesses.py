"""Refutation: exact values that satisfy every assumption and at which the two sides are apart.

An explicit witness is checked; a witness that nobody gave is looked for among small rational points, with
concrete polynomials for undefined functions. Only disjoint enclosures at exact values count.
"""

from __future__ import annotations

import contextlib
import itertools
import random
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.balls.ball import enclose, enclosure_text
from ptproof.errors import InputError
from ptproof.proof.claim import Goal, engine
from ptproof.proof.declarations import admissible
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.evaluation import carried_out
from ptproof.proof.engines.partial import values_where_used
from ptproof.proof.engines.reals import follows
from ptproof.proof.signs import holds
from ptproof.proof.statement import All, Assumption, ForAll, Relation, free_symbols, relations_of, undefined_functions
from ptproof.proof.substitution import Substitution
from ptproof.proof.verdict import Evidence, Verdict, Witness
from ptproof.system import differentiated

DIFFER = "the two sides differ at exact values"
_TRIES = 3000
_SECONDS = 2.0
_PLAIN_TRIES = 40


@engine
def refute(goal: Goal, values: Mapping[Any, Any]) -> Evidence:
    """Check one explicit witness: exact values of all symbols and undefined functions of the goal."""
    witness, reason = check_witness(goal, values)
    if witness is None:
        return Evidence("witness", Verdict.UNDECIDED, f"the values given are no witness: {reason}")
    return Evidence("witness", Verdict.REFUTED, DIFFER, witness=witness)


def search(goal: Goal, seconds: float) -> tuple[Witness | None, int]:
    """A witness against the goal, looked for among its :func:`candidates`, and how many of them were tried."""
    end, count = time.monotonic() + seconds, 0
    for values in candidates(goal):
        if time.monotonic() > end:
            break
        count += 1
        witness, _ = check_witness(goal, values)
        if witness is not None:
            return witness, count
    return None, count


def check_witness(goal: Goal, values: Mapping[Any, Any]) -> tuple[Witness | None, str]:
    """The witness if these exact values satisfy every assumption and break a relation, else the reason."""
    try:
        there = values_where_used(goal, values)
    except InputError as error:
        return None, str(error)
    for assumption in goal.assumptions:
        if not _holds(assumption, there):
            return None, f"the assumption {assumption} is not shown to hold there"
    witness = _broken(goal, there)
    return witness, "" if witness is not None else "the statement is not shown to fail there"


def _broken(goal: Goal, there: Substitution) -> Witness | None:
    """The witness if a relation of the statement fails there, where the assumptions hold."""
    for part in relations_of(goal.statement):
        numbers = _at(part, there)
        if numbers is not None and holds(numbers.negation()):
            return Witness({str(key): str(value) for key, value in there.values.items()}, *_sides(numbers))
    return None


def at_example(goal: Goal, values: Mapping[Any, Any]) -> tuple[bool, str]:
    """Whether exact values satisfy every assumption, and the statement does not fail there; and what is said of it.

    Nothing is said of a statement that takes a function where its value is not known to be defined.
    """
    try:
        there = values_where_used(replace(goal, statement=All(())), values)
    except InputError as error:
        return False, f"the example is none: {error}"
    for assumption in goal.assumptions:
        if not _holds(assumption, there):
            return False, f"the example is none: {assumption} is not shown to hold there"
    try:
        everywhere = values_where_used(goal, values)
    except InputError:
        witness = None
    else:
        witness = _broken(goal, everywhere)
    if witness is not None:
        return False, f"the statement fails at the example: {witness.left} against {witness.right}"
    said = ", ".join(f"{key} = {value}" for key, value in values.items())
    return True, f"the assumptions hold at the example, {said}"


def satisfiable(assumptions: Sequence[Relation]) -> bool:
    """Whether exact values are found at which all the assumptions hold."""
    if not assumptions:
        return True
    end = time.monotonic() + _SECONDS
    goal = Goal("satisfiable", All(tuple(assumptions)), tuple(assumptions))
    for values in candidates(goal):
        if time.monotonic() > end:
            break
        with contextlib.suppress(InputError):
            there = Substitution(values)
            if all(_holds(assumption, there) for assumption in assumptions):
                return True
    return False


def _at(relation: Relation, values: Substitution) -> Relation | None:
    """The relation there, with derivatives, integrals and limits carried out, whose values are then plain numbers."""
    try:
        there = values.relation(relation)  # which may meet a Max of something that is not finite
        if any(not _may_be_defined(side) for side in (there.left, there.right)):
            return None
        left, right = carried_out(there.left), carried_out(there.right)
    except (ValueError, TypeError, NotImplementedError, ZeroDivisionError, AttributeError, RecursionError):
        return None
    if left is None or right is None or any(side.has(sp.nan, sp.zoo, sp.oo, -sp.oo) for side in (left, right)):
        return None
    return Relation(left, relation.sign, right)


def _may_be_defined(side: sp.Expr) -> bool:
    """False where a derivative is taken at a kink, an integral over a pole: SymPy would give it a value."""
    needs = (need for need in obligations(side, side.atoms(sp.Limit, sp.Integral)) if not need.settled)
    asked = (need.relation for need in needs if not need.given)
    return all(item is not None and (item.free_symbols or holds(item)) for item in asked)


def _holds(assumption: Assumption, values: Substitution) -> bool:
    match assumption:
        case Relation():
            parts = [_at(part, values) for part in assumption.components()]
            return all(part is not None and holds(part) for part in parts)
        case ForAll(variables=variables):
            # A bound variable may carry the name of a free one: its value at the witness is not meant here.
            free = {key: value for key, value in values.values.items() if key not in variables}
            there = Substitution(free, elsewhere=values.elsewhere).quantified(assumption)
            only = _only_value(there)
            if only is not None:
                numbers = _at(there.relation, Substitution({there.variables[0]: only}))
                return numbers is not None and holds(numbers)
            return follows(there.relation.map(differentiated), there.domain, seconds=_SECONDS).shown
    return False


def _only_value(quantified: ForAll) -> sp.Expr | None:
    """The one value that the domain leaves to the variable: it is between a number and the same number."""
    if len(quantified.variables) != 1:
        return None
    ends = [(part.sign, part.right) for part in quantified.domain if part.left == quantified.variables[0]]
    low, high = ({right for sign, right in ends if sign == wanted} for wanted in (">=", "<="))
    return next((value for value in low & high if value.is_number and value.is_real), None)


def _sides(relation: Relation) -> tuple[str, str]:
    def side(value: sp.Expr) -> str:
        if value.is_Rational:
            return str(value)
        enclosed = enclosure_text(enclose(value, {}))
        exact = str(value)
        return f"{exact} = {enclosed}" if len(exact) <= 80 else enclosed

    return side(relation.left), side(relation.right)


def candidates(goal: Goal) -> Iterator[dict[Any, Any]]:
    """Points that are worth a try: small rationals for symbols, polynomials for undefined functions.

    A symbol that an assumption sets equal to an expression gets its value from there. The order is fixed.
    """
    everything = [goal.statement, *goal.assumptions]
    given: dict[sp.Symbol, sp.Expr] = {}
    for relation in goal.relations:
        if relation.sign == "=" and isinstance(relation.left, sp.Symbol):
            given.setdefault(relation.left, relation.right)
    symbols = sorted(free_symbols(everything) - given.keys(), key=str)
    functions = _distinct(undefined_functions(everything))
    bound = {variable for item in goal.assumptions if isinstance(item, ForAll) for variable in item.variables}
    symbols = [symbol for symbol in symbols if symbol not in bound or symbol in free_symbols([goal.statement])]
    generator = random.Random(f"ptproof:{goal.id}")
    for attempt in itertools.count():
        if attempt >= _TRIES:
            return
        values: dict[Any, Any] = {symbol: _value(symbol, generator, attempt) for symbol in symbols}
        for applied in functions:
            values[applied] = _polynomial(applied, generator, attempt)
        for symbol, expression in given.items():
            with contextlib.suppress(InputError):
                values[symbol] = Substitution(values).into(expression)
        yield values


def _distinct(applied: set[AppliedUndef]) -> list[AppliedUndef]:
    """One application per function, the one whose arguments are plain symbols."""
    chosen: dict[Any, AppliedUndef] = {}
    for item in sorted(applied, key=str):
        if all(isinstance(argument, sp.Symbol) for argument in item.args):
            chosen.setdefault(item.func, item)
    for item in sorted(applied, key=str):
        if item.func not in chosen:
            arguments = tuple(sp.Dummy(f"s{i}", real=True) for i in range(len(item.args)))
            chosen[item.func] = item.func(*arguments)
    return list(chosen.values())


_PLAIN = (sp.S.One, sp.S.Zero, sp.Integer(2), -sp.S.One, sp.Rational(1, 2), sp.Integer(3))
_FRACTIONS = (sp.Rational(1, 4), sp.Rational(1, 10), sp.Rational(1, 30), sp.Rational(1, 100))


def _value(symbol: sp.Symbol, generator: random.Random, attempt: int) -> sp.Expr:
    """The plainest values first: a witness is for people. Later also small fractions, and larger numbers."""
    if attempt < _PLAIN_TRIES:
        first = attempt < len(_PLAIN)  # the same value for all symbols, then any mixture of them
        choice = [value for value in _PLAIN if admissible(symbol, value)]
        if choice:
            return choice[attempt % len(choice)] if first else generator.choice(choice)
    size = 3 if attempt < 140 else 8 if attempt < 270 else (40, 8, 3)[attempt % 3]
    numerator = generator.randint(1, size * (1 if symbol.is_integer else 2))
    denominator = 1 if symbol.is_integer else generator.choice((1, 1, 2, 3))
    value = sp.Rational(numerator, denominator)
    if not symbol.is_integer and generator.random() < 0.15:
        value = generator.choice(_FRACTIONS)
    if symbol.is_positive:
        return value
    if symbol.is_nonnegative:
        return sp.S.Zero if generator.random() < 0.1 else value
    if symbol.is_negative:
        return -value
    return value * generator.choice((-1, 1)) if generator.random() < 0.9 or symbol.is_nonzero else sp.S.Zero


def _polynomial(applied: AppliedUndef, generator: random.Random, attempt: int) -> sp.Expr:
    arguments = list(applied.args)
    if applied.is_positive or applied.is_nonnegative:
        offset = sp.Integer(generator.randint(1, 3))
        return offset + generator.choice((0, 1, 1, 2)) * generator.choice(arguments) ** 2
    if attempt < 80:  # the plainest functions first: a witness is for people
        slope = generator.choice((0, 1, 1, 2, -1))
        return sp.Integer(generator.randint(1, 3)) + slope * generator.choice(arguments)
    total: sp.Expr = sp.Integer(generator.randint(-2, 2))
    for argument in arguments:
        total += generator.randint(-3, 3) * argument + generator.choice((-1, 0, 1)) * argument**2
    for left, right in itertools.combinations(arguments, 2):
        total += generator.choice((-1, 0, 1)) * left * right
    return total
