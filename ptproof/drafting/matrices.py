"""What a formula tells of columns and matrices: what is transposed, where letters lie, of what they are made."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ptproof.drafting.spelled import TRANSPOSE, name_at, spelled
from ptproof.reading.latex.cursor import RELATIONS
from ptproof.reading.latex.tokens import Token, argument

_CLOSING = {"[": "]", "(": ")", r"\begin{bmatrix}": r"\end{bmatrix}", r"\begin{pmatrix}": r"\end{pmatrix}"}


def transposed(tokens: Sequence[Token]) -> tuple[frozenset[str], tuple[tuple[str, str, str], ...]]:
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
        if len(above) == 1 and above[0].text in TRANSPOSE - {r"\text"}:
            letters.add(named[0])
            middle = name_at(tokens, after)
            last = name_at(tokens, middle[1]) if middle else None
            if middle and last:
                forms.append((named[0], middle[0], last[0]))
    return frozenset(letters), tuple(forms)


def members(tokens: Sequence[Token]) -> Iterator[tuple[str, tuple[int, int]]]:
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


def columns(tokens: Sequence[Token]) -> Iterator[tuple[str, tuple[str, ...]]]:
    r"""Letters that are a column of letters: ``x = [x_1, x_2]^\top``, or a bmatrix of them."""
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
    closing = _CLOSING.get(opening, "")
    if closing not in texts[position:]:
        return []
    end, mark = texts.index(closing, position), "," if opening in ("[", "(") else "\\\\"
    if mark == "," and (texts[end + 1 : end + 2] != ["^"] or not TRANSPOSE & set(texts[end + 2 : end + 4])):
        return []
    parts: list[list[Token]] = [[]]
    for item in tokens[position + 1 : end]:
        if item.text == mark:
            parts.append([])
        else:
            parts[-1].append(item)
    return [spelled(part) for part in parts if part] if len(parts) > 1 else []
