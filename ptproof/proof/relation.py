"""Two sides and a relation between them, stored as they are written: SymPy's own relations collapse."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.written import written

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
        if self.left.has(sp.Subs) or self.right.has(sp.Subs):
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
        return f"{written(self.left)} {self.sign} {written(self.right)}"

    def latex(self, **names: Any) -> str:
        return f"{sp.latex(self.left, **names)} {_LATEX[self.sign]} {sp.latex(self.right, **names)}"
