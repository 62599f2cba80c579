"""What a claim says, as data: two sides and a relation, stored as they are written.

SymPy's own relations collapse (``Eq(x, x)`` is ``True``), so both sides are kept here. Symbols stand for all
values that their SymPy assumptions allow; what is assumed beyond that is a list of relations of the claim.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError

RelationSign: TypeAlias = Literal["=", "<=", "<", ">=", ">", "!="]
_LATEX = {"=": "=", "<=": r"\le", "<": "<", ">=": r"\ge", ">": ">", "!=": r"\ne"}
MEANING: Mapping[str, Callable[[Any, Any], Any]] = {
    "=": operator.eq, "!=": operator.ne, "<=": operator.le, "<": operator.lt, ">=": operator.ge, ">": operator.gt
}  # fmt: skip
_MIRROR: dict[str, RelationSign] = {">=": "<=", ">": "<"}
_NEGATION: dict[str, RelationSign] = {"=": "!=", "!=": "=", "<=": ">", "<": ">=", ">=": "<", ">": "<="}


@dataclass(frozen=True)
class Relation:
    """``left`` sign ``right`` for scalars, or for columns of one length with the sign ``=``."""

    left: sp.Basic
    sign: RelationSign
    right: sp.Basic

    def __post_init__(self) -> None:
        if self.sign not in _LATEX:
            raise InputError(f"a relation cannot have the sign {self.sign!r}")
        for side in ("left", "right"):
            value = getattr(self, side)
            if isinstance(value, list | tuple):
                value = sp.ImmutableDenseMatrix(list(value))
            elif isinstance(value, sp.MatrixBase):
                value = sp.ImmutableDenseMatrix(value)
            object.__setattr__(self, side, sp.sympify(value))
        shapes = [getattr(side, "shape", None) for side in (self.left, self.right)]
        if shapes[0] != shapes[1]:
            raise InputError(f"the two sides of a relation have the shapes {shapes[0]} and {shapes[1]}")
        if shapes[0] is not None and self.sign != "=":
            raise InputError("columns can be compared by = only")
        for node in sp.Tuple(self.left, self.right).atoms(sp.Subs):
            if not all(isinstance(variable, sp.Symbol) for variable in node.variables):
                raise InputError(f"{node} puts a value in place of an expression; only a symbol can be given one")

    def components(self) -> tuple[Relation, ...]:
        """The scalar relations that this one says, entry by entry."""
        if not isinstance(self.left, sp.MatrixBase):
            return (self,)
        return tuple(Relation(a, self.sign, b) for a, b in zip(self.left, self.right, strict=True))

    @property
    def free_symbols(self) -> set[sp.Symbol]:
        """The symbols that occur free in either side."""
        return self.left.free_symbols | self.right.free_symbols

    def has(self, *patterns: Any) -> bool:
        """Whether either side contains one of the patterns, as SymPy's ``has``."""
        return bool(self.left.has(*patterns) or self.right.has(*patterns))

    def standard(self) -> Relation:
        """The same relation with <= or < instead of >= or >."""
        if self.sign in _MIRROR:
            return Relation(self.right, _MIRROR[self.sign], self.left)
        return self

    def negation(self) -> Relation:
        """The scalar relation that holds exactly where this one fails."""
        return Relation(self.left, _NEGATION[self.sign], self.right)

    def map(self, change: Callable[[Any], Any]) -> Relation:
        """Apply ``change`` to every scalar of both sides."""

        def side(value: Any) -> Any:
            return value.applyfunc(change) if isinstance(value, sp.MatrixBase) else change(value)

        return Relation(side(self.left), self.sign, side(self.right))

    def __str__(self) -> str:
        def text(side: Any) -> str:
            return str(list(side)) if isinstance(side, sp.MatrixBase) else str(side)

        return f"{text(self.left)} {self.sign} {text(self.right)}"

    def latex(self, **names: Any) -> str:
        return f"{sp.latex(self.left, **names)} {_LATEX[self.sign]} {sp.latex(self.right, **names)}"


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


Statement: TypeAlias = Relation | All | Exists | Smooth | Prose
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
    """Every scalar expression that occurs in the statements."""
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
    return set().union(*(expression.free_symbols for expression in expressions_of(statements)))


def undefined_functions(statements: Sequence[Statement | Assumption]) -> set[AppliedUndef]:
    """The applied undefined functions that occur."""
    return set().union(*(expression.atoms(AppliedUndef) for expression in expressions_of(statements)))
