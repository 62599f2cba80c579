"""What moves in an instrument, taken out of the claim that proves it: nothing is typed a second time."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Definition
from ptproof.proof.declarations import is_kind
from ptproof.proof.statement import All, Relation, eq, plain, relations_of
from ptproof.proof.substitution import Substitution

_SIGNS = {
    "positive": lambda value: value > 0, "negative": lambda value: value < 0,
    "nonnegative": lambda value: value >= 0, "nonpositive": lambda value: value <= 0,
    "nonzero": lambda value: value != 0,
}  # fmt: skip


def exact(value: Any, where: str) -> sp.Expr:
    """An exact real number, also out of text; a float is refused."""
    found = sp.Rational(value) if isinstance(value, str) else sp.sympify(value)
    if not isinstance(found, sp.Expr) or found.free_symbols or not found.is_real or found.has(sp.Float):
        raise InputError(f'{where}: expected an exact number such as "1.8", got {value!r}')
    return found


@dataclass(frozen=True)
class Slider:
    """A symbol that a reader moves, from ``lowest`` to ``highest``; evenly in the logarithm where that is asked for.

    Glyph, unit and meaning are those of the derivation's notation where they are left out.

    Raises
    ------
    InputError
        If the symbol does not stand for all values of the range, or the start is not in it.
    """

    symbol: sp.Symbol
    lowest: Any
    highest: Any
    start: Any
    logarithmic: bool = False
    glyph: str = ""
    unit: str = ""
    meaning: str = ""

    def __post_init__(self) -> None:
        where = f"slider {self.symbol}"
        for name in ("lowest", "highest", "start"):
            value = exact(getattr(self, name), where)
            object.__setattr__(self, name, value)
            if not is_kind(self.symbol, value, lambda *_: False, lambda _: False):
                raise InputError(f"{where}: {value} is not of the kind that {self.symbol} stands for")
        if not self.lowest <= self.start <= self.highest or self.lowest == self.highest:
            raise InputError(
                f"{where}: needs lowest ≤ start ≤ highest, got {self.lowest}, {self.start}, {self.highest}"
            )
        if self.logarithmic and not self.lowest > 0:
            raise InputError(f"{where}: a logarithmic one begins above 0, got {self.lowest}")


@dataclass(frozen=True)
class Taken:
    """A relation of a claim or definition at some values, with those of its assumptions that speak of numbers.

    Made by :func:`taken` alone. ``own`` is the relation in the claim's own letters, ``at`` what was put in.
    """

    source: Claim | Definition
    own: Relation
    relation: Relation
    given: tuple[Relation, ...]
    at: tuple[tuple[Any, sp.Expr], ...]

    def needs(self, symbols: Collection[sp.Symbol]) -> tuple[Relation, ...]:
        """What is assumed of these symbols alone."""
        return tuple(item for item in self.given if item.free_symbols <= set(symbols))

    @property
    def left(self) -> sp.Expr:
        return self.relation.left

    @property
    def right(self) -> sp.Expr:
        return self.relation.right


def taken(
    source: Claim | Definition, sliders: Sequence[Slider], at: Mapping[Any, Any] | None = None,
    short: Mapping[sp.Symbol, sp.Expr] | None = None, *, part: int = 0, assumed: bool = False,
) -> Taken:  # fmt: skip
    """A relation of ``source``: the ``part`` of its statement, or of its plain assumptions where ``assumed``.

    A letter that is neither a slider nor given a value, and that the claim assumes to be equal to something, such as an
    abbreviation, is replaced by that.

    Parameters
    ----------
    at
        Symbols, and undefined functions as applied to symbols, with what is put in their place: a claim holds at all
        values of its letters. Each is checked to be of its kind, where need be over the range of the ``sliders``.
    short
        Letters for expressions that stand in the relation, such as the distance of a trajectory at its start.

    Raises
    ------
    InputError
        If there is no such part, a value is not of the kind of its letter, or what a letter is short for is not there.
    """
    if not isinstance(source, Claim | Definition):
        raise InputError(f"an instrument takes its expressions from claims and definitions, got {source!r}")
    if not isinstance(source.statement, Relation | All):
        raise InputError(f"{source.id}: an instrument shows relations, and this says {source.statement}")
    given = plain(source.assumptions) if isinstance(source, Claim) else ()
    parts = given if assumed else relations_of(source.statement)
    if not 0 <= part < len(parts):
        raise InputError(f"{source.id}: there is no part {part} of {len(parts)}")
    put = Substitution(dict(at or {}), lambda value, sign: _on_range(value, sign, sliders))
    kept = {item.symbol for item in sliders} | {*put.values, *(short or {})}
    spelled_out: dict[sp.Symbol, sp.Expr] = {}
    others = tuple(item for item in given if not (assumed and item is parts[part]))
    main, given = _spelled_out(parts[part], others, kept, spelled_out)
    letters = {put.into(meant): letter for letter, meant in (short or {}).items()}

    def said(relation: Relation) -> Relation:
        return put.relation(relation).map(lambda side: side.xreplace(letters))

    shown = put.relation(main)
    for meant, letter in letters.items():
        if not shown.left.has(meant) and not shown.right.has(meant):
            raise InputError(f"{source.id}: {letter} would be short for {meant}, which does not stand there")
    of_numbers = tuple(item for item in map(said, given) if not _functions(item) and compared(item) is not sp.true)
    own = parts[part].map(lambda side: side.xreplace({meant: letter for letter, meant in (short or {}).items()}))
    at_once = {letter: value for letter, value in put.values.items() if letter in own.free_symbols}
    spelled = {letter: said(eq(letter, meaning)).right for letter, meaning in spelled_out.items()}
    return Taken(source, own, said(main), of_numbers, tuple({**at_once, **spelled}.items()))


def _spelled_out(
    main: Relation, given: tuple[Relation, ...], kept: Collection[Any], found: dict[sp.Symbol, sp.Expr]
) -> tuple[Relation, tuple[Relation, ...]]:
    """A relation and the assumptions, with what letters are assumed to be equal to in their place; these are added to
    ``found``, where the relation has them."""
    for item in given:
        letter, meaning = item.left, item.right
        if item.sign == "=" and isinstance(letter, sp.Symbol) and letter not in kept and not meaning.has(letter):
            others = tuple(other for other in given if other is not item)
            put = {letter: meaning}
            found |= put if letter in main.free_symbols else {}
            spelled = [other.map(lambda side: side.xreplace(put)) for other in (main, *others)]  # noqa: B023
            return _spelled_out(spelled[0], tuple(spelled[1:]), kept, found)
    return main, given


def compared(relation: Relation) -> sp.Basic:
    """A relation as SymPy's; True or False where SymPy sees it."""
    kinds = {"=": sp.Eq, "!=": sp.Ne, "<=": sp.Le, "<": sp.Lt, ">=": sp.Ge, ">": sp.Gt}
    return kinds[relation.sign](relation.left, relation.right)


def _functions(relation: Relation) -> set[Any]:
    return {node for side in (relation.left, relation.right) for node in side.atoms(AppliedUndef)}


def _on_range(value: sp.Expr, sign: str, sliders: Sequence[Slider]) -> bool:
    """Whether a value that is affine in sliders has a sign at all their positions: it has it at the corners."""
    own = [slider for slider in sliders if slider.symbol in value.free_symbols]
    if sign not in _SIGNS or value.free_symbols - {slider.symbol for slider in own}:
        return False
    if any(sp.diff(value, one.symbol, other.symbol) != 0 for one in own for other in own):
        return False
    corners = product(*([(item.symbol, end) for end in (item.lowest, item.highest)] for item in own))
    return all(bool(_SIGNS[sign](value.subs(dict(corner)))) for corner in corners)
