"""What z3 is told: expressions as its terms, and what is known of each symbol."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any, TypeVar

import sympy as sp

from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.statement import MEANING, Implication, Relation
from ptproof.reading.limits import unbroken

Answer = TypeVar("Answer")
# z3's terms live in one context, which is not made for two threads, and a proof that has run out of time may still ask.
_one_at_a_time = threading.Lock()


def asked(question: Callable[[], Answer]) -> Answer:
    """What comes of a question to z3, asked alone and to its end.

    z3 counts the uses of each of its objects: one that a time limit leaves half made gives back a use that it never
    took, and the process ends in some later question.
    """

    def alone() -> Answer:
        with _one_at_a_time:
            return question()

    return unbroken(alone)


@cache
def library() -> Any:
    """z3, told that terms may be given up by another thread than the one that asks."""
    import z3

    z3.Z3_enable_concurrent_dec_ref(z3.main_ctx().ref())
    return z3


_variables: dict[sp.Symbol, Any] = {}
_named: dict[str, sp.Symbol] = {}


def variable_of(symbol: sp.Symbol) -> Any:
    """The unknown for a symbol, another one for each symbol."""
    if symbol not in _variables:
        name = symbol.name
        while name in _named:
            name += "'"
        _named[name] = symbol
        _variables[symbol] = library().Real(name)
    return _variables[symbol]


@lru_cache(maxsize=2**14)
def term(expression: sp.Expr) -> tuple[Any, dict[sp.Symbol, None]]:
    """The expression for z3, and the symbols in it."""
    symbols = dict.fromkeys(sorted(expression.free_symbols, key=sp.default_sort_key))
    return _to_z3(expression), symbols


@lru_cache(maxsize=2**14)
def _to_z3(expression: sp.Expr) -> Any:
    z3 = library()
    match expression:
        case sp.Rational():
            return z3.RealVal(f"{expression.p}/{expression.q}")
        case sp.Symbol():
            return variable_of(expression)
        case sp.Add():
            return z3.Sum([_to_z3(argument) for argument in expression.args])
        case sp.Mul():
            numerator, denominator = sp.fraction(expression)
            if denominator != 1:
                return _to_z3(numerator) / _to_z3(denominator)
            return z3.Product([_to_z3(argument) for argument in expression.args])
        case sp.Pow():
            base, exponent = _to_z3(expression.base), int(expression.exp)
            power = z3.Product([base] * abs(exponent)) if exponent else z3.RealVal(1)
            return power if exponent >= 0 else 1 / power
    raise NotAlgebraic(f"no rule for {expression}")


@lru_cache(maxsize=2**14)
def comparison_term(relation: Relation) -> tuple[Any, dict[sp.Symbol, None]]:
    """A relation for z3, and the symbols in it in the order in which they are met."""
    (left, some), (right, others) = term(relation.left), term(relation.right)
    return MEANING[relation.sign](left, right), some | others


@lru_cache(maxsize=2**14)
def implication_term(fact: Implication) -> tuple[Any, dict[sp.Symbol, None]]:
    """An implication for z3, and the symbols in it; problems share what is assumed, and ask with it again and again."""
    z3 = library()
    *hypotheses, (conclusion, symbols) = map(comparison_term, (*fact.hypotheses, fact.conclusion))
    met: dict[sp.Symbol, None] = {}
    for _, some in hypotheses:
        met |= some
    return z3.Implies(z3.And([said for said, _ in hypotheses]), conclusion), met | symbols


def solver_by(tactic: str) -> Any:
    """A fresh solver: of z3's own choice for "default", otherwise by the tactic."""
    return library().Solver() if tactic == "default" else library().Tactic(tactic).solver()


def known_of_value(symbol: sp.Symbol, variable: Any) -> list[Any]:
    """What holds of ``variable``, which has the value of a symbol, by the symbol's declaration."""
    facts = []
    whole = bool(symbol.is_integer)
    if symbol.is_positive:
        facts.append(variable >= 1 if whole else variable > 0)
    elif symbol.is_nonnegative:
        facts.append(variable >= 0)
    elif symbol.is_negative:
        facts.append(variable <= -1 if whole else variable < 0)
    elif symbol.is_nonpositive:
        facts.append(variable <= 0)
    elif symbol.is_nonzero:
        facts.append(variable != 0)
    return facts


@lru_cache(maxsize=2**14)
def known_of(symbol: sp.Symbol, meaning: sp.Expr | None) -> tuple[Any, ...]:
    """The facts that hold for a symbol by its declaration, or for a generator by its meaning."""
    z3, variable = library(), variable_of(symbol)
    facts = known_of_value(symbol, variable)
    if isinstance(meaning, sp.Pow) and meaning.exp.is_Rational and not meaning.exp.is_Integer:
        facts.append(variable >= 0)  # a root is real only of what is not negative, and is then not negative
    if isinstance(meaning, sp.sin | sp.cos):
        facts += [variable <= 1, variable >= -1]
    if meaning is not None and meaning.is_NumberSymbol:
        from ptproof.balls.ball import enclose

        ball = enclose(meaning, {}, bits=64)
        facts += [variable >= _fraction(ball.lower(), z3), variable <= _fraction(ball.upper(), z3)]
    return tuple(facts)


def _fraction(end: Any, z3: Any) -> Any:
    exact = end.fmpq()
    return z3.RealVal(f"{exact.p}/{exact.q}")
