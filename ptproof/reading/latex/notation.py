"""A paper's notation, from one table: what each letter of its LaTeX means, and what the claims call it.

``notation.toml`` stands beside a derivation. Its keys are LaTeX, its values expressions in the names of the derivation.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.latex.rewrite import Rules, Vocabulary, rules
from ptproof.reading.latex.tokens import NotUnderstood, Token, read, written
from ptproof.reading.tables import build_from

DIVISIONS = ("", "product", "factor")


@dataclass(frozen=True)
class Where:
    """Where letters mean something else: in the formulas whose place matches one of these patterns."""

    formulas: list[str]
    letters: dict[str, Any] = field(default_factory=dict)
    functions: dict[str, Any] = field(default_factory=dict)
    means: dict[str, str] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    dot: str = ""
    state: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Says:
    """What claims mean: ``has`` explains their letters, ``takes`` what they take for letters of the paper.

    ``left`` says, in LaTeX, what the left sides of its relations are printed as, where a claim gives the printed
    side alone: one for each relation, a column for several, nothing where it is left out. ``right`` says so of its
    right sides.
    With ``inside`` the printed side is what the claim differentiates, takes the limit of or puts a value in; with
    ``both`` the claim's own relation is printed as well.
    ``at`` names the places of formulas without a label that the claims are about.
    """

    claims: list[str]
    has: dict[str, str] = field(default_factory=dict)
    takes: dict[str, str] = field(default_factory=dict)
    left: list[str] = field(default_factory=list)
    right: list[str] = field(default_factory=list)
    inside: bool = False
    both: bool = False
    at: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Table:
    """The table as it is written.

    Attributes
    ----------
    letters
        LaTeX of a letter, with its accents, index and star, and the expression that it means; a list for a column, a
        list of lists for a matrix, and the name of a matrix of the derivation's own notation. With its arguments,
        as in ``V(0)``, it means that only together with them.
    functions
        Letters that are applied to what stands behind them in parentheses: the function's name, several for a
        column, rows of them for a matrix.
    norms
        What the norms mean that are not computed, such as that of an unknown matrix.
    means
        What names stand for in both the paper and the claims: ``"nu(_s)" = "1 - _s/T"``.
    positive
        Expressions that are positive wherever the paper writes powers of them, by a name for each.
    counts
        The numbers of terms of sums that a claim writes out.
    times
        Names of the variables along which things move: a derivative by one is a rate, whatever moves.
    dot
        The time along which a dot is taken.
    state
        The names by which the brackets ``[f, g]`` = (∂g/∂x) f − (∂f/∂x) g differentiate; left out, none is read.
    division
        What ``a/bc`` is divided by: ``product`` (bc) or ``factor`` (b); left out, it is not read.
    """

    letters: dict[str, Any] = field(default_factory=dict)
    functions: dict[str, Any] = field(default_factory=dict)
    norms: dict[str, str] = field(default_factory=dict)
    means: dict[str, str] = field(default_factory=dict)
    positive: dict[str, str] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    times: list[str] = field(default_factory=list)
    dot: str = ""
    state: list[str] = field(default_factory=list)
    division: str = ""
    where: list[Where] = field(default_factory=list)
    says: list[Says] = field(default_factory=list)


@dataclass(frozen=True)
class Notation:
    """What the letters mean in one formula, ready to be looked up by their LaTeX in one spelling."""

    letters: Mapping[str, Any]
    functions: Mapping[str, tuple[tuple[str, ...], ...]]
    norms: Mapping[str, sp.Expr]
    counts: Mapping[str, int]
    vocabulary: Vocabulary
    dot: str
    division: str
    state: tuple[sp.Symbol, ...] = ()


def read_table(text: str, where: str) -> Table:
    """The table that ``text`` writes in TOML.

    Raises
    ------
    InputError
        For a key that is not known, and a value that is of another kind.
    """

    def build(data: dict[str, Any]) -> Table:
        whole = {key: value for key, value in data.items() if key not in ("where", "says")}
        if whole.get("division", "") not in DIVISIONS:
            raise InputError(f"division: expected product or factor, got {whole['division']!r}")
        places = [Where(**entry) for entry in data.get("where", [])]
        return Table(**whole, where=places, says=[Says(**entry) for entry in data.get("says", [])])

    return build_from(text, where, Table, build)


def spelled(key: str, where: str) -> str:
    """A key of the table in the spelling in which letters are looked up: the index before the exponent."""
    try:
        found = read(key, 0, {})
    except NotUnderstood as error:
        raise InputError(f"{where}: {key!r} is not LaTeX ({error.reason})") from None
    depth = 0
    for place, token in enumerate(found):
        if place and depth == 0 and token.text == "(" and found[-1].text == ")":
            return spelling(found[:place]) + written(found[place:])
        depth += (token.text == "{") - (token.text == "}")
    return spelling(found)


def spelling(found: list[Token]) -> str:
    """One spelling of a letter: ``c^2_{\\kappa, 1}`` and ``c_{\\kappa,1}^{2}`` are one."""
    parts, part, depth = {"": "", "_": "", "^": ""}, "", 0
    for sign in written(found):
        if depth == 0 and sign in "_^":
            part = sign
        else:
            depth += (sign == "{") - (sign == "}")
            parts[part] += sign
    return parts[""] + "".join(f"{sign}{_bare(parts[sign])}" for sign in "_^" if parts[sign])


def _bare(text: str) -> str:
    return text[1:-1] if text.startswith("{") and text.endswith("}") else text


def vocabulary(table: Table, known: Mapping[str, Any]) -> Vocabulary:
    """The names that occur; those of the derivation, its symbols and matrices, with what it knows of them."""
    symbols = {name: value for name, value in known.items() if isinstance(value, sp.Symbol)}
    matrices = {name: value for name, value in known.items() if isinstance(value, sp.MatrixBase)}
    states = {
        text
        for letters in (table.letters, *(item.letters for item in table.where))
        for value in letters.values()
        for text in flat(value)
        if text.isidentifier()
    }
    named = {name: symbols.get(name) or sp.Symbol(name, real=True) for name in (*table.times, *states)}
    return Vocabulary({**named, **symbols}, frozenset(table.times), frozenset(states), matrices)


def flat(value: Any) -> Iterable[str]:
    """The texts of a list of lists, or the one that it is."""
    if isinstance(value, list):
        for entry in value:
            yield from flat(entry)
    else:
        yield str(value)


def context(table: Table, place: str) -> tuple[int, ...]:
    """Which of the table's ``where`` are about the formula at ``place``; with the same ones letters mean the same."""
    return tuple(
        number for number, item in enumerate(table.where)
        if any(fnmatchcase(place, pattern) for pattern in item.formulas)
    )  # fmt: skip


def notation(table: Table, names: Vocabulary, place: str, where: str) -> Notation:
    """What letters mean in the formula at ``place``."""
    here = [table.where[number] for number in context(table, place)]
    letters, functions, counts = (
        {key: value for item in (table, *here) for key, value in getattr(item, kind).items()}
        for kind in ("letters", "functions", "counts")
    )
    return Notation(
        {spelled(key, where): _value(value, names, f"{where}, {key}") for key, value in letters.items()},
        {spelled(key, where): _names(value) for key, value in functions.items()},
        {spelled(key, where): names.expression(value, f"{where}, {key}") for key, value in table.norms.items()},
        {spelled(key, where): int(value) for key, value in counts.items()},
        names,
        next((item.dot for item in here if item.dot), table.dot),
        table.division,
        tuple(names.symbol(name) for name in next((item.state for item in here if item.state), table.state)),
    )


def _names(value: Any) -> tuple[tuple[str, ...], ...]:
    """The names of a function, row by row: one, a column or a matrix of them."""
    return tuple(tuple(flat(row)) for row in (value if isinstance(value, list) else [value]))


def _value(value: Any, names: Vocabulary, where: str) -> Any:
    if not isinstance(value, list):
        matrix = names.matrices.get(str(value))
        return names.expression(str(value), where) if matrix is None else sp.ImmutableDenseMatrix(matrix)
    rows = [entry if isinstance(entry, list) else [entry] for entry in value]
    if not rows or len({len(row) for row in rows}) > 1:
        raise InputError(f"{where}: the rows of a matrix are of one length")
    return sp.ImmutableDenseMatrix([[names.expression(str(entry), where) for entry in row] for row in rows])


def meanings(table: Table, names: Vocabulary, place: str, takes: Mapping[str, str], where: str) -> Rules:
    """What names stand for in the formula at ``place``, for a claim that ``takes`` some letters for others."""
    here = [table.where[number].means for number in context(table, place)]
    found = rules([takes, *here, table.means], names, where)
    powers = {
        found(names.expression(text, where)): sp.Symbol(name, positive=True) for name, text in table.positive.items()
    }
    return replace(found, positive=powers)


def says_of(table: Table, claim: str) -> Says:
    """What the table says of one claim: the entries that match its id, put together, the first ones first."""
    found = Says([claim])
    for item in table.says:
        if any(fnmatchcase(claim, pattern) for pattern in item.claims):
            found = replace(
                found,
                has={**item.has, **found.has},
                takes={**item.takes, **found.takes},
                left=found.left or item.left,
                right=found.right or item.right,
                inside=found.inside or item.inside,
                both=found.both or item.both,
                at=[*found.at, *item.at],
            )
    return found
