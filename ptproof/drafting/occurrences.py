"""Where the letters of a paper occur: with which scripts, applied to what, and whether along a time they move."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass

from ptproof.drafting.matrices import columns, members, transposed
from ptproof.drafting.spelled import TRANSPOSE, arguments_at, name_at
from ptproof.reading.latex.cursor import differential
from ptproof.reading.latex.notation import spelling
from ptproof.reading.latex.tokens import NotUnderstood, Token, argument

_NOT_SMOOTH = frozenset({"sat", "sgn", "sign", "sig", "dz"})


@dataclass(frozen=True)
class Occurrence:
    """One letter of a formula, spelled with accents and index, and with an exponent that is part of the name (a star).

    ``arguments`` has the spelling of each argument where it stands before parentheses (empty for one that is no letter
    and no number, + for a sum), None where it stands alone; ``sums`` the letters in its arguments that are sums.
    ``along`` is the time along which a rate of it is taken.
    """

    key: str
    arguments: tuple[str, ...] | None
    along: str
    line: int
    sums: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Scanned:
    """What a formula tells of its letters.

    ``members`` are the spaces in which they lie (rows, columns), ``columns`` the letters of which one is made,
    ``transposed`` those with a transpose, and ``forms`` the three letters of each xᵀ P y.
    """

    occurrences: tuple[Occurrence, ...]
    members: tuple[tuple[str, tuple[int, int]], ...] = ()
    columns: tuple[tuple[str, tuple[str, ...]], ...] = ()
    transposed: frozenset[str] = frozenset()
    forms: tuple[tuple[str, str, str], ...] = ()


def scan(tokens: Sequence[Token]) -> Scanned:
    """What the tokens of one formula tell of its letters."""
    found = list(_walk(list(tokens), any(token.text == r"\int" for token in tokens)))
    return Scanned(tuple(found), tuple(members(tokens)), tuple(columns(tokens)), *transposed(tokens))


def _walk(tokens: list[Token], integral: bool, along: str = "") -> Iterator[Occurrence]:
    position = 0
    while position < len(tokens):
        token = tokens[position]
        text = token.text
        try:
            if text in (r"\frac", r"\tfrac", r"\dfrac"):
                above, after = argument(tokens, position + 1, token)
                below, after = argument(tokens, after, token)
                yield from _quotient(above, below, tokens, after, integral)
                position = after
            elif text in (r"\dot", r"\ddot"):
                inside, end = argument(tokens, position + 1, token)
                after = _behind(tokens, end)
                yield from _walk([*inside, *tokens[end:after]], integral, "t")
                position = after
            elif text in (r"\text", r"\mathbb", r"\begin{array}", r"\label", r"\tag"):
                position = yield from _word(tokens, position)
            elif (named := name_at(tokens, position)) is not None:
                key, after, base = named
                exponential = base == "e" and position + 1 < len(tokens) and tokens[position + 1].text == "^"
                if exponential or (integral and text == "d" and name_at(tokens, position + 1) is not None):
                    position += 1
                    continue
                arguments, end = arguments_at(tokens, after)
                within = frozenset(item.key for item in _walk(tokens[after:end], False)) if arguments else frozenset()
                yield Occurrence(key, arguments, along, token.line, within)
                along, position = "", after
            else:
                position += 1
                if text == "^" and position < len(tokens) and tokens[position].text in TRANSPOSE:
                    position += 1
        except NotUnderstood:
            position += 1


def _quotient(
    above: list[Token], below: list[Token], tokens: list[Token], after: int, integral: bool
) -> Iterator[Occurrence]:
    """A fraction, or a derivative: by a letter with an upright or italic d it is one along a time."""
    first, second = differential(above), differential(below)
    if not (first and second and first[0] == second[0]):
        yield from _walk(above, integral)
        yield from _walk(below, integral)
        return
    named = name_at(second[1], 0)
    time = named[0] if named and named[1] == len(second[1]) and first[0] == "d" else ""
    moved = first[1] or tokens[after : _behind(tokens, after + 1)]
    found = list(_walk(list(moved), integral, time))
    yield from found if first[1] else found[:1]
    yield from _walk(second[1], integral)


def _word(tokens: list[Token], position: int) -> Generator[Occurrence, None, int]:
    """Text in a formula: nothing, unless it is one word before parentheses."""
    token = tokens[position]
    inside, after = argument(tokens, position + 1, token)
    word = "".join(item.text for item in inside)
    applied = after < len(tokens) and tokens[after].text == "("
    if token.text == r"\text" and applied and word.isalpha() and word not in ("d", "where", "for", "if", "and", "with"):
        arguments, _ = arguments_at(tokens, after)
        if word not in _NOT_SMOOTH:
            yield Occurrence(spelling([token, Token("{", 0), *inside, Token("}", 0)]), arguments, "", token.line)
    return after


def _behind(tokens: Sequence[Token], position: int) -> int:
    """Where the scripts and the arguments that stand behind a group end."""
    while position + 1 < len(tokens) and tokens[position].text == "_":
        _, position = argument(tokens, position + 1, tokens[position])
    return arguments_at(tokens, position)[1]
