"""Exact algebra: expressions as rational functions in generators, with a normal form of zero.

Every subexpression that is not arithmetic becomes a *generator*, a fresh symbol: a derivative or value of an
undefined function, sin and cos of one argument, an exponential or a power whose exponent is not an integer.
Powers of one base share their generators, so that V^(2q) is recognised as (V^q)², and the relations that
generators satisfy (sin² + cos² = 1, (√b)² = b, |x|² = x²) are kept beside them. Two expressions that agree
as rational functions modulo these relations are equal wherever both are defined; the converse is not claimed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.content import digest
from ptproof.proof.powers import exponent_terms, fraction, positive_multiples, split_powers, symbolic_power
from ptproof.proof.prepared import NotAlgebraic as NotAlgebraic
from ptproof.proof.prepared import by_comparisons, prepare, real_where_defined

_letters: dict[Any, sp.Dummy] = {}


def _letter(meaning: sp.Expr, **assumptions: bool) -> sp.Dummy:
    """The symbol for this meaning, the same one in every problem: what is found out about it is found out once.

    Its name says what it stands for, so that problems are written in the same order in every run.
    """
    key = (meaning, tuple(sorted(assumptions.items())))
    if key not in _letters:
        _letters[key] = sp.Dummy(f"g{digest(meaning)[:16]}", **assumptions)
    return _letters[key]


@dataclass(frozen=True)
class _Read:
    """An expression with letters for values and derivatives of undefined functions, and the powers in it."""

    expression: sp.Expr
    letters: tuple[tuple[sp.Expr, sp.Dummy], ...]
    powers: tuple[tuple[sp.Expr, sp.Expr], ...]


@lru_cache(maxsize=8192, typed=True)
def _read(expression: sp.Expr) -> _Read:
    """The expression, prepared and masked before anything can rewrite the insides of functions, its powers split."""
    prepared = prepare(expression)
    nodes = sorted(prepared.atoms(AppliedUndef, sp.Derivative, sp.Subs), key=sp.default_sort_key)
    letters = {node: _letter(node, **_known_of(node)) for node in nodes}
    split = split_powers(prepared.xreplace(letters))
    pairs = map(symbolic_power, sp.preorder_traversal(split))
    return _Read(split, tuple(letters.items()), tuple(pair for pair in pairs if pair is not None))


@dataclass(frozen=True)
class _Roots:
    """Exponents of one base as integer combinations: their common denominator, and for each monomial a root."""

    common: sp.Expr
    roots: tuple[tuple[sp.Expr, sp.Expr, int, bool, str | None], ...]


@lru_cache(maxsize=8192)
def _roots_of(base: sp.Expr, exponents: tuple[sp.Expr, ...]) -> _Roots:
    """Exponents e_j such that every exponent of this base is an integer combination of them."""
    common: sp.Expr = sp.S.One
    for _, denominator in map(fraction, exponents):
        if denominator != 1:
            common = sp.lcm(common, denominator)
    if not base.is_positive and positive_multiples(exponents):
        common = 1 / exponents[0]  # no quotient of roots, which says nothing where the base is 0
    parts: dict[sp.Expr, list[sp.Rational]] = defaultdict(list)
    for exponent in exponents:
        for monomial, coefficient in exponent_terms(exponent, common):
            parts[monomial].append(coefficient)
    roots = []
    for monomial, coefficients in parts.items():
        lcm = int(sp.ilcm(1, *(coefficient.q for coefficient in coefficients)))
        sign = "positive" if base.is_positive else "nonnegative" if base.is_nonnegative else None
        # A quotient of real numbers is real wherever it is defined.
        real = bool(monomial.is_real and (common.is_real or (1 / common).is_real))
        roots.append((monomial, base ** (monomial / common / lcm), lcm, real, sign))
    return _Roots(common, tuple(roots))


@dataclass
class Generators:
    """The generators met so far, the symbols that stand for them, and their relations.

    One object must see all expressions that are to be compared: :meth:`read` first, :meth:`rational` then. With
    ``real`` the generators will be taken for real numbers, and the relation of a root holds only where its base, kept
    in ``bases``, is not negative.
    """

    real: bool = False
    symbols: dict[sp.Expr, sp.Symbol] = field(default_factory=dict)
    relations: list[tuple[sp.Symbol, sp.Expr]] = field(default_factory=list)
    meaning: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    bases: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    _powers: dict[sp.Expr, dict[sp.Expr, None]] = field(default_factory=lambda: defaultdict(dict))
    _roots: dict[sp.Expr, dict[sp.Expr, tuple[sp.Symbol, int]]] = field(default_factory=dict)
    _denominators: dict[sp.Expr, sp.Expr] = field(default_factory=dict)
    _branches: dict[sp.Expr, sp.Expr] = field(default_factory=dict)

    def symbol(self, meaning: sp.Expr, **assumptions: bool) -> sp.Symbol:
        """The symbol that stands for ``meaning``; the same one each time."""
        if meaning not in self.symbols:
            self._take(meaning, _letter(meaning, **assumptions))
        return self.symbols[meaning]

    def _take(self, meaning: sp.Expr, letter: sp.Dummy) -> None:
        self.symbols[meaning] = letter
        self.meaning[letter] = meaning

    def read(self, expressions: Iterable[sp.Expr]) -> list[sp.Expr]:
        """Prepare the expressions and note each base with all exponents that it carries."""
        found = [_read(expression) for expression in expressions]
        for item in found:
            for meaning, letter in item.letters:
                if meaning not in self.symbols:
                    self._take(meaning, letter)
            for base, exponent in item.powers:
                self._powers[base][exponent] = None
        for base, exponents in self._powers.items():
            # A positive base is itself one of its powers, so that it is written by the same generators. A base that
            # may be 0 is not: it could come out as a quotient of generators that vanish.
            itself = [sp.S.One] if base.is_positive and base is not sp.E else []
            self._choose_roots(base, tuple(dict.fromkeys([*exponents, *itself])))
        return [item.expression for item in found]

    def _choose_roots(self, base: sp.Expr, exponents: tuple[sp.Expr, ...]) -> None:
        """Symbols for roots of the base, by which every power of it is written."""
        chosen = _roots_of(base, exponents)
        self._denominators[base] = chosen.common
        self._roots[base] = {}
        for monomial, root, degree, real, sign in chosen.roots:
            generator = self.symbol(root, **({sign: True} if sign and real else {}))
            self._roots[base][monomial] = (generator, degree)
            if not base.is_nonnegative:
                self.bases[generator] = base

    def choice(self, generator: sp.Symbol) -> tuple[type, list[sp.Expr]] | None:
        """For a generator that stands for a maximum or minimum: which, and of what."""
        meaning = self.meaning[generator]
        if not isinstance(meaning, sp.Max | sp.Min):
            return None
        return type(meaning), [self._branches[argument] for argument in meaning.args]

    def pieces(self, generator: sp.Symbol) -> list[tuple[sp.Expr, tuple[sp.Expr, Any, sp.Expr] | None]]:
        """For a generator that stands for a Piecewise: each value with the comparison that it needs, or None."""
        meaning = self.meaning[generator]
        if not (isinstance(meaning, sp.Piecewise) and by_comparisons(meaning)):
            return []
        branches = self._branches
        return [
            (
                branches[value],
                None if condition is sp.true
                else (branches[condition.lhs], condition.rel_op, branches[condition.rhs]),
            )
            for value, condition in meaning.args
        ]  # fmt: skip

    def rational(self, expression: sp.Expr) -> sp.Expr:
        """Replace everything that is not arithmetic by its generator (after :meth:`read`)."""
        match expression:
            # Of a symbol that may be 0 or negative, its own roots say less than it.
            case sp.Symbol() if expression in self._roots and expression.is_positive:
                return self._product(expression, sp.S.One)
            case sp.Symbol() | sp.Rational():
                return expression
            case sp.Add() | sp.Mul():
                return expression.func(*(self.rational(argument) for argument in expression.args))
            case sp.sin() | sp.cos():
                sine = self.symbol(sp.sin(expression.args[0]), real=True)
                cosine = self.symbol(sp.cos(expression.args[0]), real=True)
                self._relate(sine, 1 - cosine**2)
                return sine if isinstance(expression, sp.sin) else cosine
            case sp.Abs():
                argument = expression.args[0]
                generator = self.symbol(expression, nonnegative=True)
                if real_where_defined(argument):
                    self._relate(generator, self.rational(argument) ** 2)
                return generator
            case sp.Max() | sp.Min():
                for argument in expression.args:
                    self._branches[argument] = self.rational(argument)
                return self.symbol(expression, real=True)
            case sp.Piecewise() if by_comparisons(expression):
                for value, condition in expression.args:
                    for side in (value, *condition.args):
                        self._branches[side] = self.rational(side)
                return self.symbol(expression, **({"real": True} if real_where_defined(expression) else {}))
        pair = symbolic_power(expression)
        if pair is not None:
            return self._power(*pair)
        if isinstance(expression, sp.Pow) and expression.exp.is_Integer:
            return self.rational(expression.base) ** expression.exp
        if isinstance(expression, sp.Function | sp.Integral | sp.Piecewise):
            return self.symbol(expression, **({"real": True} if expression.is_real else {}))
        if expression in (sp.pi, sp.E) or expression.is_NumberSymbol:
            return self.symbol(expression, positive=True)
        raise NotAlgebraic(f"no rule for {type(expression).__name__}: {expression}")

    def split_bases(self) -> list[tuple[sp.Expr, sp.Expr]]:
        """The positive symbols and numbers that are written as products of roots, each with its product."""
        bases = [base for base in self._roots if (base.is_Symbol or base.is_Rational) and base.is_positive]
        return [(base, self._product(base, sp.S.One)) for base in bases]

    def _power(self, base: sp.Expr, exponent: sp.Expr) -> sp.Expr:
        if base is not sp.E and not (base.is_Symbol and base.is_positive):
            own = exponent_terms(sp.S.One, self._denominators[base])
            if len(own) == 1 and own[0][0] in self._roots[base]:  # a root of the base, such as √b
                monomial, coefficient = own[0]
                generator, lcm = self._roots[base][monomial]
                self._relate(generator, self.rational(base), int(coefficient * lcm))
        return self._product(base, exponent)

    def _product(self, base: sp.Expr, exponent: sp.Expr) -> sp.Expr:
        """A power of the base as a product of powers of its roots."""
        result: sp.Expr = sp.Integer(1)
        for monomial, coefficient in exponent_terms(exponent, self._denominators[base]):
            generator, lcm = self._roots[base][monomial]
            result *= generator ** int(coefficient * lcm)
        return result

    def _relate(self, generator: sp.Symbol, value: sp.Expr, degree: int = 2) -> None:
        entry = (generator, generator**degree - value)
        if entry not in self.relations:
            self.relations.append(entry)


def _known_of(node: sp.Expr) -> dict[str, bool]:
    """What an undefined function's value was declared to be; a derivative of a real function is real."""
    if isinstance(node, AppliedUndef):
        for word in ("positive", "nonnegative", "negative", "nonpositive", "nonzero", "real"):
            if getattr(node, f"is_{word}"):
                return {word: True, **({"real": True} if word == "nonzero" and node.is_real else {})}
        return {}
    return {"real": True} if node.args[0].is_real else {}


def reduce_modulo(numerator: sp.Expr, relations: Sequence[tuple[sp.Symbol, sp.Expr]]) -> sp.Expr:
    """The remainder of a polynomial by each relation in turn, until nothing changes."""
    current = sp.expand(numerator)
    for _ in range(len(relations) + 1):
        before = current
        for generator, polynomial in relations:
            if current.has(generator):
                lifted = sp.fraction(sp.together(polynomial))[0]
                if sp.degree(current, generator) < sp.degree(lifted, generator):
                    continue  # its own remainder, for which SymPy's pseudo-division by a cubic may raise
                current = sp.expand(sp.fraction(sp.together(sp.prem(current, lifted, generator)))[0])
        if current == before:
            break
    return current


def is_zero(expression: sp.Expr) -> bool:
    """Whether the expression has the normal form 0; True is a proof, False says only "not shown".

    >>> x, k = sp.symbols("x kappa", positive=True)
    >>> is_zero((x ** ((2 * k - 1) / (2 * k))) ** 2 - x ** (2 - 1 / k))
    True
    >>> is_zero(sp.cos(2 * x) - 1 + 2 * sp.sin(x) ** 2)
    True
    >>> is_zero(sp.cos(2 * x) - 1 + sp.sin(x) ** 2)
    False
    """
    return _vanishes(sp.sympify(expression))


@lru_cache(maxsize=4096, typed=True)
def _vanishes(expression: sp.Expr) -> bool:
    generators = Generators()
    (prepared,) = generators.read([expression])
    numerator, denominator = sp.fraction(sp.together(generators.rational(prepared)))
    if reduce_modulo(numerator, generators.relations) != 0:
        return False
    if reduce_modulo(denominator, generators.relations) == 0:
        raise NotAlgebraic("the denominator vanishes identically")
    return True
