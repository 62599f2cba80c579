"""Exponents of the frequency, linear in their parameters and compared for all allowed values, and what has them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.averaging.refusal import AveragingUndecided
from ptproof.errors import InputError
from ptproof.proof.engines.terms import asked, library, term, variable_of
from ptproof.proof.statement import MEANING, Relation, RelationSign

Point = Mapping[sp.Symbol, sp.Expr]
_MILLISECONDS = 20_000


@dataclass(frozen=True)
class Exponents:
    """The values of the parameters of exponents that are allowed: those for which all ``relations`` hold.

    Every question is one of linear arithmetic over the reals, which z3 decides for all values at once; a value at
    which something holds is rational. Relations and exponents have rational coefficients.

    >>> p = sp.Symbol("p", positive=True)
    >>> allowed = Exponents((Relation(sp.Rational(1, 2), "<", p), Relation(p, "<", 1)))
    >>> sorted(allowed.signs(1 - 2 * p)), sorted(allowed.signs(sp.Rational(2, 3) - p))
    ([-1], [-1, 0, 1])
    """

    relations: tuple[Relation, ...]

    def __post_init__(self) -> None:
        for relation in self.relations:
            for side in (relation.left, relation.right):
                check_linear(sp.sympify(side), str(relation))

    def point(self, *more: Relation) -> Point | None:
        """Values of all parameters at which ``more`` holds too, or None if there are none."""
        return _point((*self.relations, *more))

    def signs(self, exponent: sp.Expr) -> dict[int, Point]:
        """Each sign (−1, 0, 1) that ``exponent`` has for allowed values, with such values."""
        found = {}
        signs: tuple[tuple[int, RelationSign], ...] = ((-1, "<"), (0, "="), (1, ">"))
        for sign, word in signs:
            if (there := self.point(Relation(exponent, word, sp.S.Zero))) is not None:
                found[sign] = there
        return found

    def always(self, relation: Relation) -> bool:
        """Whether the relation holds for all allowed values."""
        return self.point(relation.negation()) is None

    def equal(self, first: sp.Expr, second: sp.Expr) -> bool:
        """Whether two exponents are equal for all allowed values."""
        return bool(sp.expand(first - second) == 0) or self.always(Relation(first, "=", second))

    def __str__(self) -> str:
        return ", ".join(map(str, self.relations))


def check_linear(expression: sp.Expr, where: str) -> sp.Expr:
    """``expression``, if it is linear in its symbols with rational coefficients."""
    symbols = sorted(expression.free_symbols, key=str)
    terms = sp.Add.make_args(sp.expand(expression))
    for entry in terms:
        factor, rest = entry.as_independent(*symbols, as_Add=False) if symbols else (entry, sp.S.One)
        if not factor.is_Rational or not (rest == 1 or rest in symbols):
            raise InputError(f"{where}: {expression} is not linear in its parameters with rational coefficients")
    return expression


def told(point: Point) -> str:
    """The values in words."""
    return ", ".join(f"{symbol} = {value}" for symbol, value in sorted(point.items(), key=lambda item: str(item[0])))


@lru_cache(maxsize=4096)
def _point(relations: tuple[Relation, ...]) -> Point | None:
    return asked(lambda: _solved(relations))


def _solved(relations: Sequence[Relation]) -> Point | None:
    z3 = library()
    solver = z3.Solver()
    solver.set("timeout", _MILLISECONDS)
    symbols = sorted(set().union(*(relation.free_symbols for relation in relations)), key=str)
    for symbol in symbols:
        if symbol.is_positive:
            solver.add(variable_of(symbol) > 0)
    for relation in relations:
        left, right = (term(sp.expand(side))[0] for side in (relation.left, relation.right))
        solver.add(MEANING[relation.sign](left, right))
    answer = solver.check()
    if answer == z3.unsat:
        return None
    if answer != z3.sat:
        raise AveragingUndecided(f"z3 has no answer about the exponents: {', '.join(map(str, relations))}")
    model = solver.model()
    values = (model.eval(variable_of(symbol), model_completion=True) for symbol in symbols)
    return {
        symbol: sp.Rational(value.numerator_as_long(), value.denominator_as_long())
        for symbol, value in zip(symbols, values, strict=True)
    }


@dataclass(frozen=True)
class Gamma:
    """γ(ω) = ω^exponent · mean, the factor of [f_i, f_j] or [[f_i, f_j], f_m]; ``signs``: those of the exponent.

    γ_ij = ω^(p_i + p_j)/T ∫₀^T u_j(s) ∫₀^s u_i(p) dp ds, and γ_ijm = ω^(p_i + p_j + p_m)/(3T) ∫₀^T u_m(τ)
    ∫₀^τ ∫₀^s (u_j(s) u_i(p) − u_i(s) u_j(p)) dp ds dτ, at the phases ω times these, over a common period T.
    """

    mean: sp.Expr
    exponent: sp.Expr
    signs: Mapping[int, Point]

    @property
    def limit(self) -> sp.Expr | None:
        """The limit as ω → ∞ for all allowed values of the powers; None where there is none, or not the same one."""
        if self.mean == 0 or self.signs.keys() == {-1}:
            return sp.S.Zero
        return self.mean if self.signs.keys() == {0} else None

    @property
    def condition(self) -> str:
        """What the limit rests on, in words."""
        if self.mean == 0:
            return "it vanishes for every omega"
        if self.signs.keys() == {-1}:
            return f"{self.exponent} < 0"
        if self.signs.keys() == {0}:
            return "it does not depend on omega"
        return f"it tends to 0 where {self.exponent} < 0 only"

    def to_json(self, omega: sp.Symbol) -> dict[str, Any]:
        limit = self.limit
        return {
            "value": str(self.mean * omega**self.exponent),
            "exponent": str(self.exponent),
            "limit": None if limit is None else str(limit),
            "condition": self.condition,
        }
