"""Concrete functions for undefined ones: expressions in arguments of their own, of every declared kind."""

from __future__ import annotations

import itertools
import random
from collections.abc import Collection, Sequence
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.putting import concretely
from ptproof.proof.attack.tree import BINDERS
from ptproof.proof.statement import ForAll


@lru_cache(maxsize=64)
def _arguments(count: int) -> tuple[sp.Symbol, ...]:
    return tuple(sp.Symbol(f"_argument{i}", real=True) for i in range(count))


class Maker:
    """Makes functions for ``applied``, of its declared kind: the plainest first, then any.

    Some vanish, or have an extremum, where the arguments of ``applied`` are, if these are symbols that are ``known``.
    """

    def __init__(self, applied: Any, known: Collection[Any]) -> None:
        self.applied = applied
        self.count = len(applied.args)
        self.integer = applied.is_integer
        self.kind = next((word for word in _SIGNS if getattr(applied, f"is_{word}")), "")
        self.centre = tuple(applied.args) if all(argument in known for argument in applied.args) else None

    def drawn(self, seed: str, attempt: int) -> Concrete:
        """The same one for a seed."""
        if self.integer:
            whole = _whole(self.applied, random.Random(f"{seed}:{attempt}"))
            return Concrete(_arguments(self.count), sp.Integer(whole))
        return _of_kind(self.count, self.kind, seed, attempt, self.centre if attempt % 10 >= 7 else None)


_SIGNS = ("positive", "negative", "nonnegative", "nonpositive", "nonzero")


@lru_cache(maxsize=4096)
def _of_kind(count: int, kind: str, seed: str, attempt: int, centre: tuple[Any, ...] | None) -> Concrete:
    """A function of ``count`` arguments with values of a sign: made once for all claims."""
    places, generator = _arguments(count), random.Random(f"{seed}:{attempt}")
    style = attempt % 3
    if style == 2 and kind not in ("", "nonzero"):
        least, sign = int(kind in ("positive", "negative")), 1 if kind in ("positive", "nonnegative") else -1
        return Concrete(places, sp.Integer(sign * generator.randint(least, least + 2)))
    body = _real(places, generator, attempt, centre)
    match kind:
        case "positive":
            body = (sp.exp(body / 4), 1 + body**2)[style]
        case "negative":
            body = (-sp.exp(body / 4), -1 - body**2)[style]
        case "nonnegative":
            body = (body**2, sp.exp(body / 4))[style]
        case "nonpositive":
            body = (-(body**2), -sp.exp(body / 4))[style]
        case "nonzero":
            body = (sp.exp(body / 4), -1 - body**2, -sp.exp(body / 4))[style]
    return Concrete(places, body)


def differentiable(applied: Any, order: int, generator: random.Random) -> Concrete:
    """A function that is ``order`` times continuously differentiable, and no more where ``applied`` is."""
    plain = _real(_arguments(len(applied.args)), generator, generator.randint(0, 5), None)
    if generator.random() < 0.3:
        return Concrete(_arguments(len(applied.args)), plain)
    rough = sp.S.Zero
    for place, argument in zip(_arguments(len(applied.args)), applied.args, strict=True):
        middle = argument if argument.is_Symbol else sp.S.Zero
        rough += generator.choice((1, -2)) * sp.Abs(place - middle) ** sp.Rational(2 * order + 1, 2)
    return Concrete(_arguments(len(applied.args)), plain + rough)


def _whole(applied: Any, generator: random.Random) -> int:
    choice = [n for n in range(-3, 4) if applied.func and _may_be(applied, n)]
    return generator.choice(choice or [1])


def _may_be(applied: Any, value: int) -> bool:
    signs = {"positive": value > 0, "negative": value < 0, "nonnegative": value >= 0, "nonpositive": value <= 0}
    signs |= {"zero": value == 0, "even": value % 2 == 0, "odd": value % 2 == 1}
    return all(getattr(applied, f"is_{word}") in (None, held) for word, held in signs.items())


def _real(places: tuple[sp.Symbol, ...], generator: random.Random, attempt: int, centre: Any) -> sp.Expr:
    def small() -> sp.Rational:
        return sp.Rational(generator.choice((-3, -2, -1, 1, 2, 3, 5)), generator.choice((1, 1, 2, 3)))

    def line(of: Sequence[sp.Expr]) -> list[sp.Expr]:
        return [sp.Mul(small(), one) for one in of]

    def square(of: Sequence[sp.Expr]) -> list[sp.Expr]:
        return [sp.Mul(small(), a, b) for a, b in itertools.combinations_with_replacement(of, 2)]

    kind = attempt % 10
    if kind >= 7 and centre is not None:
        away = [place - middle for place, middle in zip(places, centre, strict=True)]
        if kind == 8:
            return sp.Add(*line(away))
        return sp.Add(*square(away), small() if kind == 7 else sp.S.Zero)
    if kind == 6:
        return sp.Integer(generator.choice((0, 0, 1, -1, 2)))
    if kind == 4:
        return small() * sp.cos(generator.choice(places)) + small() * sp.exp(-(generator.choice(places) ** 2))
    if kind == 5:
        return small() * generator.choice(places) ** generator.randint(1, 4)
    terms = [small(), *line(places)]
    if kind in (1, 3):
        terms += square(places)
    if kind == 2:
        terms.append(sp.Mul(small(), sp.sin(sp.Add(*line(places)))))
    return sp.Add(*terms)


@lru_cache(maxsize=512)
def solutions(item: ForAll) -> tuple[tuple[Any, Concrete], ...]:
    """Functions that satisfy a differential inequality y' ≤ a(s) + b(s) y^p with equality, where that is easy.

    The constant of integration is the symbol ``_start``, which whoever uses them gives a value.
    """
    found = (*_rates(item), *_ends(item))
    return found if found and item.relation.sign != "=" else (*found, *_at_rest(item))


def _at_rest(item: ForAll) -> list[tuple[Any, Concrete]]:
    """Constant functions of one time that satisfy y' = rhs: all the same, or all 0."""
    left = item.relation.left
    if len(item.variables) != 1 or not isinstance(left, sp.Derivative) or left.variables != item.variables:
        return []
    moving = [node for node in sp.Tuple(left, item.relation.right).atoms(AppliedUndef) if node.args == item.variables]
    for value, forbidden in ((START, ("negative", "nonpositive", "integer")), (sp.S.Zero, ("nonzero",))):
        if any(getattr(node, f"is_{word}") for node in moving for word in forbidden):
            continue
        resting = {node.func: Concrete(_arguments(1), value) for node in sorted(moving, key=str)}
        rate = concretely(item.relation.right, resting)
        if (rate.doit() if rate.has(*BINDERS) else rate) == 0:
            return list(resting.items())
    return []


def _ends(item: ForAll) -> list[tuple[Any, Concrete]]:
    """Functions that are everywhere at the end that an inequality allows them."""
    found = []
    for part in item.relation.components():
        difference = part.left - part.right
        applied = [node for node in difference.atoms(AppliedUndef) if set(node.args) <= set(item.variables)]
        for node in sorted(applied, key=str):
            if difference.has(sp.Derivative) or len(set(node.args)) < len(node.args):
                continue
            letter = sp.Dummy()
            coefficients = difference.xreplace({node: letter}).as_poly(letter)
            if coefficients is None or coefficients.degree() != 1:
                continue
            slope, rest = coefficients.all_coeffs()
            body = (-rest / slope).replace(node.func, lambda *_: START)
            places = _arguments(len(node.args))
            if set(item.variables) <= set(node.args):
                found.append((node.func, Concrete(places, body.xreplace(dict(zip(node.args, places, strict=True))))))
    return found


def _rates(item: ForAll) -> list[tuple[Any, Concrete]]:
    relation = item.relation
    if len(item.variables) != 1 or not isinstance(relation.left, sp.Derivative):
        return []
    (time,) = item.variables
    applied = relation.left.args[0]
    if not isinstance(applied, AppliedUndef) or applied.args != (time,):
        return []
    if relation.left.variable_count != sp.Derivative(applied, time).variable_count:
        return []
    right = relation.right.xreplace({applied: VALUE})
    place = _arguments(1)
    right = sp.expand(right, power_exp=False)  # a power of the state stays one power
    found = closed_forms(right, VALUE, time)
    moving = sp.Add(*(term for term in sp.Add.make_args(right) if term.has(VALUE)))
    if relation.sign in ("<=", "<") and moving not in (0, right):
        found += closed_forms(moving, VALUE, time)  # it satisfies the inequality where what is left out is not negative
    return [(applied.func, Concrete(place, body.xreplace({time: place[0]}))) for body in found]


START = sp.Symbol("_start", positive=True)
VALUE = sp.Dummy("value", positive=True)
"""The state itself, while its equation is solved."""


def closed_forms(right: sp.Expr, value: sp.Symbol, time: sp.Symbol, faster: Sequence[int] = (1, 2, 6)) -> list[sp.Expr]:
    """Solutions of value' = ``right``, a sum of terms that are free of the value or have one power of it.

    Where the rate is linear some are ``faster``, so many times as fast: that satisfies an inequality.
    """
    free, rates, powers = sp.S.Zero, sp.S.Zero, set()
    for term in sp.Add.make_args(right):
        if not term.has(value):
            free += term
            continue
        inside = [factor for factor in sp.Mul.make_args(term) if factor.has(value)]
        if len(inside) != 1 or inside[0].as_base_exp()[0] != value:
            return []
        (power,) = inside  # taken out of the product as it stands: SymPy does not cancel powers with letters in them
        rest = sp.Mul(*(factor for factor in sp.Mul.make_args(term) if factor != power))
        exponent = power.exp if isinstance(power, sp.Pow) else sp.S.One
        powers.add(exponent)
        rates += rest
    if len(powers) > 1:
        return []
    if not powers:
        whole = antiderivative(free, time)
        return [] if whole is None else [START + whole]
    exponent = powers.pop()
    found = []
    if not rates.has(time) and not free.has(time) and free != 0:
        rest_point = (-free / rates) ** (1 / exponent)
        found.append(rest_point)
        if exponent == 1:
            found.append(-free / rates + START * sp.exp(rates * time))
    if free == 0 and (whole := antiderivative(rates, time)) is not None:
        if exponent == 1:
            found += [START * sp.exp(times * whole) for times in faster]
        else:
            found.append((START + (1 - exponent) * whole) ** (1 / (1 - exponent)))
    return found


@lru_cache(maxsize=1024)
def antiderivative(expression: sp.Expr, time: sp.Symbol) -> sp.Expr | None:
    """∫ of a sum of constants times powers of something linear in ``time``; None for anything else."""
    total = sp.S.Zero
    for term in sp.Add.make_args(expression):
        if not term.has(time):
            total += term * time
            continue
        inside = [factor for factor in sp.Mul.make_args(term) if factor.has(time)]
        if len(inside) != 1:
            return None
        power = inside[0]
        root, exponent = power.as_base_exp()
        slope = sp.diff(root, time)
        if exponent.has(time) or slope.has(time) or exponent == -1:
            slope = sp.cancel(slope) if not exponent.has(time) and exponent != -1 else slope
            if exponent.has(time) or slope.has(time) or exponent == -1:
                return None
        total += term / power * root ** (exponent + 1) / (slope * (exponent + 1))
    return total
