"""What a claim says, as data: two sides and a relation, stored as they are written.

SymPy's own relations collapse (``Eq(x, x)`` is ``True``), so both sides are kept here. Symbols stand for all
values that their SymPy assumptions allow; what is assumed beyond that is a list of relations of the claim.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.relation import MEANING as MEANING
from ptproof.proof.relation import Relation as Relation
from ptproof.proof.relation import RelationSign as RelationSign
from ptproof.proof.runs import Runs as Runs


@dataclass(frozen=True)
class All:
    """Every one of the ``parts`` holds."""

    parts: tuple[Relation, ...]

    def __str__(self) -> str:
        return " and ".join(map(str, self.parts))

    def latex(self, **names: Any) -> str:
        return r",\quad ".join(part.latex(**names) for part in self.parts)


@dataclass(frozen=True)
class Exists:
    """There are values of ``variables`` such that every part of ``body`` holds, for all values of ``over``.

    The other free symbols are universal and come first: the chosen values may depend on them.
    """

    variables: tuple[sp.Symbol, ...]
    body: tuple[Relation, ...]
    over: tuple[sp.Symbol, ...] = ()

    def __str__(self) -> str:
        names = ", ".join(symbol.name for symbol in self.variables)
        rest = f" for all {', '.join(symbol.name for symbol in self.over)}" if self.over else ""
        return f"there is {names} with {' and '.join(map(str, self.body))}{rest}"

    def latex(self, **names: Any) -> str:
        variables = ", ".join(sp.latex(symbol, **names) for symbol in self.variables)
        over = r"\ \forall " + ", ".join(sp.latex(symbol, **names) for symbol in self.over) if self.over else ""
        return rf"\exists {variables}{over}:\ " + r",\ ".join(part.latex(**names) for part in self.body)


@dataclass(frozen=True)
class Smooth:
    """The ``expressions`` are ``order`` times continuously differentiable in ``variables``."""

    expressions: tuple[sp.Expr, ...]
    variables: tuple[sp.Symbol, ...]
    order: int
    assumed: tuple[tuple[AppliedUndef, int], ...] = ()

    def __str__(self) -> str:
        names = ", ".join(symbol.name for symbol in self.variables)
        return f"({', '.join(map(str, self.expressions))}) is C^{self.order} in {names}"

    def latex(self, **names: Any) -> str:
        column = sp.ImmutableDenseMatrix(list(self.expressions))
        return rf"{sp.latex(column, **names)} \in C^{{{self.order}}}"


@dataclass(frozen=True)
class Prose:
    """A statement in words. Only a citation or an observation may have one: no engine reads it."""

    text: str

    def __str__(self) -> str:
        return self.text

    def latex(self, **names: Any) -> str:
        return rf"\text{{{self.text}}}"


@dataclass(frozen=True)
class ForAll:
    """The relation holds for all values of ``variables`` that satisfy ``domain``: an assumption on a function."""

    variables: tuple[sp.Symbol, ...]
    relation: Relation
    domain: tuple[Relation, ...] = ()

    def __str__(self) -> str:
        names = ", ".join(symbol.name for symbol in self.variables)
        where = f" with {' and '.join(map(str, self.domain))}" if self.domain else ""
        return f"{self.relation} for all {names}{where}"

    def latex(self, **names: Any) -> str:
        variables = ", ".join(sp.latex(symbol, **names) for symbol in self.variables)
        domain = r",\ ".join(part.latex(**names) for part in self.domain)
        return rf"{self.relation.latex(**names)}\quad \forall {variables}" + (rf":\ {domain}" if domain else "")


@dataclass(frozen=True)
class Implication:
    """If all ``hypotheses`` hold, so does the ``conclusion``: a fact that a proof may use."""

    hypotheses: tuple[Relation, ...]
    conclusion: Relation
    source: str = field(default="", compare=False)

    def __str__(self) -> str:
        return f"{' and '.join(map(str, self.hypotheses)) or 'true'} => {self.conclusion}"


Statement: TypeAlias = Relation | All | Exists | Smooth | Runs | Prose
Assumption: TypeAlias = Relation | ForAll


def eq(left: Any, right: Any) -> Relation:
    """left = right.

    >>> x = sp.Symbol("x", real=True)
    >>> print(eq(x**2, x))
    x**2 = x
    """
    return Relation(left, "=", right)


def le(left: Any, right: Any) -> Relation:
    """left ≤ right.

    >>> x = sp.Symbol("x", real=True)
    >>> print(le(x**2, x))
    x**2 <= x
    """
    return Relation(left, "<=", right)


def lt(left: Any, right: Any) -> Relation:
    """left < right.

    >>> x = sp.Symbol("x", real=True)
    >>> print(lt(x**2, x))
    x**2 < x
    """
    return Relation(left, "<", right)


def ge(left: Any, right: Any) -> Relation:
    """left ≥ right.

    >>> x = sp.Symbol("x", real=True)
    >>> print(ge(x**2, x))
    x**2 >= x
    """
    return Relation(left, ">=", right)


def gt(left: Any, right: Any) -> Relation:
    """left > right.

    >>> x = sp.Symbol("x", real=True)
    >>> print(gt(x**2, x))
    x**2 > x
    """
    return Relation(left, ">", right)


def every(*parts: Relation) -> All:
    """All of the parts."""
    return All(tuple(parts))


def relations_of(statement: Statement) -> tuple[Relation, ...]:
    """The scalar relations of a statement that has no quantifier."""
    match statement:
        case Relation():
            return statement.components()
        case All(parts):
            return tuple(component for part in parts for component in part.components())
    raise InputError(f"not a conjunction of relations: {statement}")


def plain(assumptions: Iterable[Assumption]) -> tuple[Relation, ...]:
    """The assumptions that are relations, entry by entry."""
    return tuple(part for item in assumptions if isinstance(item, Relation) for part in item.components())


def expressions_of(statements: Sequence[Statement | Assumption]) -> Iterator[sp.Expr]:
    """Every scalar expression that occurs in the statements; of runs none, which have no letters but their own."""
    for statement in statements:
        match statement:
            case Relation():
                for part in statement.components():
                    yield part.left
                    yield part.right
            case All(parts):
                yield from expressions_of(parts)
            case Exists(body=body):
                yield from expressions_of(body)
            case ForAll(relation=relation, domain=domain):
                yield from expressions_of([relation, *domain])
            case Smooth(expressions=expressions):
                yield from expressions


def free_symbols(statements: Sequence[Statement | Assumption]) -> set[sp.Symbol]:
    """The symbols that occur free in the expressions, bound variables of integrals and limits excepted."""
    return set().union(*map(_free, expressions_of(statements)))


def undefined_functions(statements: Sequence[Statement | Assumption]) -> set[AppliedUndef]:
    """The applied undefined functions that occur."""
    return set().union(*map(_applied, expressions_of(statements)))


@lru_cache(maxsize=8192)
def _free(expression: sp.Expr) -> frozenset[sp.Symbol]:
    return frozenset(expression.free_symbols)


@lru_cache(maxsize=8192)
def _applied(expression: sp.Expr) -> frozenset[AppliedUndef]:
    return frozenset(expression.atoms(AppliedUndef))  # claims share what they assume, and it is asked again and again
