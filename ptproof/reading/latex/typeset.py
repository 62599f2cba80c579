r"""A formula of a paper as LaTeX that needs nothing of the paper: its macros put in, and no labels and numbers.

What it says is not touched: it reads as before (:mod:`ptproof.reading.latex.statements`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial

from ptproof.reading.latex.formulas import goes_on, split_rows
from ptproof.reading.latex.source import braced
from ptproof.reading.latex.tokens import Macro, nesting, written

_NUMBERS = re.compile(
    r"\\(?:label|tag)\s*\{[^{}]*\}|\\(?:nonumber|notag)(?![a-zA-Z])|\\[hv]space\*?\s*\{[^{}]*\}"
    r"|\\(?:begin|end)\s*\{(?:aligned|split|gathered|multlined)\}(?:\s*\[[a-z]\])?"
)
_UPRIGHT = re.compile(r"\{\s*\\rm\s+([^{}]*?)\s*\}")
_MACRO = re.compile(r"\\(?:[a-zA-Z@]+|.)", re.DOTALL)
_NESTED = re.compile(r"\\begin\s*\{[^{}]*\}|\\end\s*\{[^{}]*\}|\\text\s*\{[^{}]*\}|\\.|[&,(){}\[\]]", re.DOTALL)
_SPACE = re.compile(r"^(?:\\q?quad(?![a-zA-Z])|\\[,;:! ]|\s|&)+")
_CONDITION = re.compile(rf"(?:{_SPACE.pattern[1:]})?\\forall")
_DEEPEST = 20


def typeset(text: str, macros: Mapping[str, Macro]) -> str:
    """The formula with the paper's macros put in; rows stay apart by a double backslash, and lined up by ``&``."""
    bare = " ".join(_NUMBERS.sub(" ", _put_in(text, macros, 0)).replace("~", " ").split())
    bare = "".join(sign for sign in bare if sign.isprintable())
    return re.sub(r"(?:\s|[.,;]|\\\\)+$", "", _UPRIGHT.sub(r"\\mathrm{\1}", bare))


def _put_in(text: str, macros: Mapping[str, Macro], depth: int) -> str:
    parts: list[str] = []
    position = 0
    while depth < _DEEPEST and (match := _MACRO.search(text, position)):
        macro = macros.get(match.group())
        parts.append(text[position : match.start() if macro else match.end()])
        position = match.end()
        if macro is None:
            continue
        values: list[str] = []
        for _ in range(macro.arguments):
            value, position = _argument(text, position)
            values.append(value)
        body = re.sub(r"(\\[a-zA-Z]+)?#(\d)", partial(_filled, values), written(macro.body))
        follows = " " if body[-1:].isalpha() and text[position : position + 1].isalpha() else ""
        parts.append(_put_in(body, macros, depth + 1) + follows)
    return "".join(parts) + text[position:]


def _filled(values: list[str], found: re.Match[str]) -> str:
    """An argument in its place, not drawn together with the command before it."""
    value = values[int(found[2]) - 1] if int(found[2]) <= len(values) else ""
    return f"{found[1]} {value}" if found[1] and value[:1].isalpha() else f"{found[1] or ''}{value}"


def _argument(text: str, position: int) -> tuple[str, int]:
    """A group without its braces, a command or one character; and where it ends."""
    start = position + len(text[position:]) - len(text[position:].lstrip())
    if text[start : start + 1] == "{":
        return braced(text, start)
    command = _MACRO.match(text, start)
    return (command.group(), command.end()) if command else (text[start : start + 1], start + 1)


def rows(text: str) -> tuple[tuple[str, bool], ...]:
    """The rows of a formula, without what lines them up, and whether each goes on with the one before it."""
    found = [row for _, row in split_rows(text)]
    before = ["", *found]
    return tuple((_without_marks(row), number > 0 and goes_on(before[number], row)) for number, row in enumerate(found))


def pieces(text: str) -> tuple[str, ...]:
    """What stands side by side in a formula, or below each other; a condition stays with what it is about."""
    depth = start = 0
    found: list[str] = []
    for match in _NESTED.finditer(text):
        mark = match.group()
        between = mark == "," or (mark == "\\\\" and not goes_on(text[start : match.start()], text[match.end() :]))
        if between and depth <= 0 and not _CONDITION.match(text, match.end()):
            found.append(text[start : match.start()])
            start = match.end()
        depth += nesting(re.sub(r"\s", "", mark))
    return tuple(part for piece in [*found, text[start:]] if (part := _SPACE.sub("", piece).strip(" &")))


def _without_marks(text: str) -> str:
    """The text without each ``&`` that stands in no environment."""
    depth = position = 0
    parts: list[str] = []
    for match in _NESTED.finditer(text):
        mark = match.group()
        depth += mark.startswith(r"\begin") - mark.startswith(r"\end")
        if mark == "&" and not depth:
            parts.append(text[position : match.start()])
            position = match.end()
    return " ".join([*parts, text[position:]]).strip()
