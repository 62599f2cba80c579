"""Where a letter of a formula begins and ends, how it is spelled, and what stands in the parentheses behind it."""

from __future__ import annotations

from collections.abc import Sequence

from ptproof.reading.latex.letters import ACCENTS, low_letter
from ptproof.reading.latex.notation import spelling
from ptproof.reading.latex.tokens import Token, argument, nesting, written

_ACCENTS = ACCENTS - {r"\mathbb", r"\text"}
_IN_NAME = frozenset({"*", "+", r"\star", r"\ast", r"\dagger"})
TRANSPOSE = frozenset({"T", r"\top", r"\intercal", r"\text"})


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
        if len(above) != 1 or above[0].text not in TRANSPOSE:
            return None, position
        return arguments_at(tokens, behind) if behind < len(tokens) and tokens[behind].text == "(" else (None, position)
    if position >= len(tokens) or tokens[position].text != "(":
        return None, position
    depth, parts = 0, [[]]  # type: ignore[var-annotated]
    for end in range(position, len(tokens)):
        text = tokens[end].text
        depth += nesting(text)
        if depth == 0:
            return tuple(spelled(part) for part in parts), end + 1
        if depth == 1 and text == ",":
            parts.append([])
        elif end > position:
            parts[-1].append(tokens[end])
    return None, position


def spelled(part: list[Token]) -> str:
    if len(part) == 1 and part[0].text[:1].isdigit():
        return part[0].text
    named = name_at(part, 0)
    if named and named[1] == len(part):
        return named[0]
    depth = 0
    for place, token in enumerate(part):
        depth += nesting(token.text)
        if depth == 0 and place and token.text in ("+", "-"):
            return "+"
    return ""
