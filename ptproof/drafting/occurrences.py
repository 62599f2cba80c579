"""Where the letters of a paper occur: with which scripts, applied to what, and whether along a time they move."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ptproof.reading.latex.cursor import RELATIONS, differential
from ptproof.reading.latex.letters import low_letter
from ptproof.reading.latex.notation import spelling
from ptproof.reading.latex.tokens import NotUnderstood, Token, argument, written

_ACCENTS = frozenset(
    rf"\{name}" for name in (
        "bar", "tilde", "hat", "check", "vec", "mathbf", "mathcal", "mathfrak", "boldsymbol", "widetilde", "overline",
    )
)  # fmt: skip
_IN_NAME = frozenset({"*", "+", r"\star", r"\ast", r"\dagger"})
_TRANSPOSE = frozenset({"T", r"\top", r"\intercal", r"\text"})
_CLOSED = {"(": ")", "[": "]", "{": "}"}
_NOT_SMOOTH = frozenset({"sat", "sgn", "sign", "sig", "dz"})


@dataclass(frozen=True)
class Occurrence:
    """One letter of a formula.

    Attributes
    ----------
    key
        Its spelling, with accents and index, and with an exponent that is part of the name (a star).
    arguments
        The spelling of each of its arguments where it stands before parentheses: empty for one that is no letter and
        no number, + for a sum; None where it stands alone.
    sums
        The letters in its arguments that are sums.
    along
        The spelling of the time along which a rate of it is taken.
    line
        Where in the source.
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
    return Scanned(tuple(found), tuple(_members(tokens)), tuple(_columns(tokens)), *_transposed(tokens))


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
            elif text == r"\dot":
                inside, after = argument(tokens, position + 1, token)
                after = _behind(tokens, after)
                yield from _walk(
                    [*inside, *tokens[position + 1 + _length(tokens, position + 1) : after]], integral, "t"
                )
                position = after
            elif text in (r"\text", r"\mathbb", r"\begin{array}") or text in (r"\label", r"\tag"):
                position = yield from _word(tokens, position)
            elif (named := name_at(tokens, position)) is not None:
                key, after, base = named
                if _is_differential(tokens, position, integral) or _is_exponential(base, tokens, position):
                    position += 1
                    continue
                arguments, end = arguments_at(tokens, after)
                inside = frozenset(item.key for item in _walk(tokens[after:end], False)) if arguments else frozenset()
                yield Occurrence(key, arguments, along, token.line, inside)
                along, position = "", after
            else:
                position += 1
                if text == "^" and position < len(tokens) and tokens[position].text in _TRANSPOSE:
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


def _word(tokens: list[Token], position: int) -> Iterator[Occurrence]:
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


def name_at(tokens: Sequence[Token], position: int) -> tuple[str, int, str] | None:
    """The letter that begins here: its spelling, where it ends, and its spelling without scripts."""
    if position >= len(tokens):
        return None
    token = tokens[position]
    if token.text in _ACCENTS:
        inside, after = argument(tokens, position + 1, token)
        base = [token, Token("{", token.line), *inside, Token("}", token.line)]
    elif (token.text.isalpha() and len(token.text) == 1) or (
        token.text[:1] == "\\" and low_letter(token.text) and token.text != r"\pi"
    ):
        base, after = [token], position + 1
    else:
        return None
    scripts: dict[str, list[Token]] = {}
    while after < len(tokens) and tokens[after].text in ("_", "^") and tokens[after].text not in scripts:
        inside, end = argument(tokens, after + 1, token)
        if tokens[after].text == "^" and not (len(inside) == 1 and inside[0].text in _IN_NAME):
            break
        scripts[tokens[after].text] = inside
        after = end
    full = list(base)
    for sign in ("_", "^"):
        if sign in scripts:
            full += [Token(sign, token.line), Token("{", token.line), *scripts[sign], Token("}", token.line)]
    return spelling(full), after, written(base)


def arguments_at(tokens: Sequence[Token], position: int) -> tuple[tuple[str, ...] | None, int]:
    """The spelling of each argument in the parentheses that open here, behind a transpose at most."""
    if position < len(tokens) and tokens[position].text == "^":
        above, behind = argument(tokens, position + 1, tokens[position])
        if len(above) != 1 or above[0].text not in _TRANSPOSE:
            return None, position
        return arguments_at(tokens, behind) if behind < len(tokens) and tokens[behind].text == "(" else (None, position)
    if position >= len(tokens) or tokens[position].text != "(":
        return None, position
    depth, parts = 0, [[]]  # type: ignore[var-annotated]
    for end in range(position, len(tokens)):
        text = tokens[end].text
        if text in _CLOSED:
            depth += 1
        elif text in _CLOSED.values():
            depth -= 1
        if depth == 0:
            return tuple(_spelled(part) for part in parts), end + 1
        if depth == 1 and text == ",":
            parts.append([])
        elif end > position:
            parts[-1].append(tokens[end])
    return None, position


def _spelled(part: list[Token]) -> str:
    if len(part) == 1 and part[0].text[:1].isdigit():
        return part[0].text
    named = name_at(part, 0)
    if named and named[1] == len(part):
        return named[0]
    depth = 0
    for place, token in enumerate(part):
        depth += (token.text in _CLOSED or token.text.startswith(r"\begin")) - (
            token.text in _CLOSED.values() or token.text.startswith(r"\end")
        )
        if depth == 0 and place and token.text in ("+", "-"):
            return "+"
    return ""


def _behind(tokens: Sequence[Token], position: int) -> int:
    """Where the scripts and the arguments that stand behind a group end."""
    while position + 1 < len(tokens) and tokens[position].text == "_":
        _, position = argument(tokens, position + 1, tokens[position])
    return arguments_at(tokens, position)[1]


def _length(tokens: Sequence[Token], position: int) -> int:
    return argument(tokens, position, tokens[position])[1] - position


def _is_differential(tokens: Sequence[Token], position: int, integral: bool) -> bool:
    return integral and tokens[position].text == "d" and name_at(tokens, position + 1) is not None


def _is_exponential(base: str, tokens: Sequence[Token], position: int) -> bool:
    return base == "e" and position + 1 < len(tokens) and tokens[position + 1].text == "^"


def _transposed(tokens: Sequence[Token]) -> tuple[frozenset[str], tuple[tuple[str, str, str], ...]]:
    """The letters with a transpose, and with the letters that stand behind it."""
    letters: set[str] = set()
    forms: list[tuple[str, str, str]] = []
    position = 0
    while position < len(tokens):
        named = name_at(tokens, position)
        position = position + 1 if named is None else named[1]
        if named is None or position + 1 >= len(tokens) or tokens[position].text != "^":
            continue
        above, after = argument(tokens, position + 1, tokens[position])
        if len(above) == 1 and above[0].text in (r"\top", "T", r"\intercal"):
            letters.add(named[0])
            middle = name_at(tokens, after)
            last = name_at(tokens, middle[1]) if middle else None
            if middle and last:
                forms.append((named[0], middle[0], last[0]))
    return frozenset(letters), tuple(forms)


def _members(tokens: Sequence[Token]) -> Iterator[tuple[str, tuple[int, int]]]:
    r"""Letters before ``\in \mathbb{R}^n`` or ``\in \mathbb{R}^{n \times m}`` with numbers n and m."""
    texts = [token.text for token in tokens]
    for place, text in enumerate(texts):
        if text != r"\in" or texts[place + 1 : place + 4] != [r"\mathbb", "{", "R"]:
            continue
        after = place + 5
        if after >= len(texts) or texts[after] != "^":
            continue
        size, _ = argument(tokens, after + 1, tokens[after])
        numbers = [item.text for item in size if item.text != r"\times"]
        if all(number.isdigit() and 0 < int(number) < 10 for number in numbers) and len(numbers) in (1, 2):
            shape = (int(numbers[0]), int(numbers[1]) if len(numbers) == 2 else 1)
            for key in _before(tokens[:place]):
                yield key, shape


def _before(tokens: Sequence[Token]) -> list[str]:
    """The letters, separated by commas, with which the tokens end."""
    found: list[str] = []
    position = 0
    while position < len(tokens):
        named = name_at(tokens, position)
        if named is None:
            if tokens[position].text != ",":
                found = []
            position += 1
        else:
            found.append(named[0])
            position = named[1]
    return found


def _columns(tokens: Sequence[Token]) -> Iterator[tuple[str, tuple[str, ...]]]:
    r"""Letters that are a column of letters: ``x = [x_1, x_2]^\top``, ``x = \begin{bmatrix} x_1 \\ x_2 \end{bmatrix}``."""
    for place, token in enumerate(tokens):
        if token.text not in RELATIONS or place == 0:
            continue
        named = _last_name(tokens[:place])
        entries = _entries(tokens, place + 1)
        if named and entries and all(entry and not entry[0].isdigit() and entry != "+" for entry in entries):
            yield named, tuple(entries)


def _last_name(tokens: Sequence[Token]) -> str:
    for start in range(len(tokens)):
        named = name_at(tokens, start)
        if named and named[1] == len(tokens) and (start == 0 or tokens[start - 1].text in (",", "&", "\\\\", ";")):
            return named[0]
    return ""


def _entries(tokens: Sequence[Token], position: int) -> list[str]:
    texts = [token.text for token in tokens]
    opening = texts[position] if position < len(texts) else ""
    if opening in ("[", "("):
        closing = "]" if opening == "[" else ")"
        if closing not in texts[position:]:
            return []
        end, mark = texts.index(closing, position), ","
        if texts[end + 1 : end + 2] != ["^"] or not _TRANSPOSE & set(texts[end + 2 : end + 4]):
            return []
    elif opening in (r"\begin{bmatrix}", r"\begin{pmatrix}"):
        closing = opening.replace(r"\begin", r"\end")
        if closing not in texts[position:]:
            return []
        end, mark = texts.index(closing, position), "\\\\"
    else:
        return []
    parts: list[list[Token]] = [[]]
    for item in tokens[position + 1 : end]:
        if item.text == mark:
            parts.append([])
        else:
            parts[-1].append(item)
    return [_spelled(part) for part in parts if part] if len(parts) > 1 else []
