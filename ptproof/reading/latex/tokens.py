"""LaTeX mathematics as tokens with the lines on which they stand, and the paper's own macros put in.

The tokens are pylatexenc's; what is only spacing is left out, and numbers are put together.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ptproof.reading.latex.source import braced

_DEFINITION = re.compile(
    r"\\(?:newcommand|renewcommand|providecommand|DeclareMathOperator|(def|gdef))\*?\s*(?:\{\s*(\\[a-zA-Z@]+)\s*\}|(\\[a-zA-Z@]+))"
)
_ARGUMENTS = re.compile(r"\s*\[(\d)\]")
_NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?")
_PARAMETERS = re.compile(r"(?:#\d)*")
# Nothing that they set changes what a formula says.
SPACING = frozenset(
    rf"\{name}" for name in (
        ",", ";", ":", "!", " ", ">", "/", "quad", "qquad", "hspace", "hspace*", "vspace", "vspace*", "left", "right",
        "big", "Big", "bigg", "Bigg", "bigl", "bigr", "Bigl", "Bigr", "biggl", "biggr", "displaystyle", "textstyle",
        "limits", "nolimits", "nonumber", "notag", "label", "tag", "thinspace", "enspace", "noindent", "allowbreak",
        "IEEEyesnumber", "IEEEnonumber", "IEEEyessubnumber", "IEEEnosubnumber",
    )
)  # fmt: skip
_WITH_ARGUMENT = frozenset({r"\hspace", r"\hspace*", r"\vspace", r"\vspace*", r"\label", r"\tag"})
_DEEPEST, _LONGEST = 20, 20_000


class NotUnderstood(Exception):
    """What of a formula was not understood, and on which line of the source it stands."""

    def __init__(self, kind: str, reason: str, line: int) -> None:
        super().__init__(f"line {line}: {reason}")
        self.kind, self.reason, self.line = kind, reason, line


@dataclass(frozen=True)
class Token:
    """One token: its text, with ``\\begin{…}`` and ``\\end{…}`` as one, and its line."""

    text: str
    line: int


@dataclass(frozen=True)
class Macro:
    """What a macro of the paper stands for: its body, with ``#1`` and so on for its arguments."""

    arguments: int
    body: tuple[Token, ...]


def definitions(source: str) -> dict[str, Macro]:
    """The macros that ``\\newcommand``, ``\\def`` and the like define; a later definition replaces an earlier one."""
    found: dict[str, Macro] = {}
    for match in _DEFINITION.finditer(source):
        name, position = match.group(2) or match.group(3), match.end()
        if match.group(1):
            parameters = _PARAMETERS.match(source, position)
            count, position = (len(parameters.group()) // 2, parameters.end()) if parameters else (0, position)
        else:
            arguments = _ARGUMENTS.match(source, position)
            count, position = (int(arguments.group(1)), arguments.end()) if arguments else (0, position)
        body, _ = braced(source, position)
        if "DeclareMathOperator" in match.group():
            body = rf"\operatorname{{{body}}}"  # a word, not a product of letters
        found[name] = Macro(count, tuple(tokens(body, 0)))
    return found


def tokens(text: str, line: int) -> Iterator[Token]:
    """The tokens of a piece of LaTeX whose first line is number ``line``, spaces and comments left out.

    Digits that follow one another, and a point between two of them, are one token.
    """
    from pylatexenc.latexwalker import LatexWalker, LatexWalkerEndOfStream

    walker, position = LatexWalker(text, tolerant_parsing=True), 0
    while True:
        try:
            found = walker.get_token(position, environments=True, keep_inline_math=True)
        except LatexWalkerEndOfStream:
            return
        here, position = line + text.count("\n", 0, found.pos), found.pos + found.len
        # Its own word for it is an object for some tokens; the text itself is always there.
        written = text[found.pos : position].strip()
        if found.tok == "char" and (number := _NUMBER.match(text, found.pos)):
            written, position = number[0], number.end()
        elif found.tok == "macro":
            written = "\\" + found.arg
        elif found.tok in ("begin_environment", "end_environment"):
            written = rf"\{found.tok[: found.tok.index('_')]}{{{found.arg}}}"
        if found.tok == "specials":
            yield from (Token(sign, here) for sign in written if not written.startswith("~"))
        elif found.tok != "comment" and written:
            yield Token(written, here)


def _expanded(found: list[Token], macros: Mapping[str, Macro], depth: int) -> list[Token]:
    result: list[Token] = []
    position = 0
    while position < len(found):
        token = found[position]
        position += 1
        macro = macros.get(token.text)
        if macro is None:
            result.append(token)
            continue
        if depth > _DEEPEST or len(result) > _LONGEST:
            raise NotUnderstood("macro", f"the macro {token.text} does not come to an end", token.line)
        values: list[list[Token]] = []
        for _ in range(macro.arguments):
            value, position = argument(found, position, token)
            values.append(value)
        result += _expanded(_filled(macro, values, token.line), macros, depth + 1)
    return result


def _filled(macro: Macro, values: list[list[Token]], line: int) -> list[Token]:
    """The body of a macro with its arguments in their places."""
    result: list[Token] = []
    body = list(macro.body)
    position = 0
    while position < len(body):
        if body[position].text == "#" and position + 1 < len(body) and body[position + 1].text.isdigit():
            number = body[position + 1].text
            index, rest = int(number[0]) - 1, number[1:]
            result += values[index] if index < len(values) else []
            result += [Token(rest, line)] if rest else []
            position += 2
        else:
            result.append(Token(body[position].text, line))
            position += 1
    return result


def nesting(text: str) -> int:
    """1 for what opens a group, brackets or an environment, -1 for what closes one, 0 for anything else."""
    opens = text in ("(", "[", "{", r"\{") or text.startswith(r"\begin{")
    return opens - (text in (")", "]", "}", r"\}") or text.startswith(r"\end{"))


_NO_ARGUMENT = frozenset({"}", "^", "_", "&", "\\\\"})


def argument(found: Sequence[Token], position: int, of: Token) -> tuple[list[Token], int]:
    """The argument that begins at ``position``: a group, without its braces, or one token; and where it ends."""
    if position >= len(found) or found[position].text in _NO_ARGUMENT:
        raise NotUnderstood("bad LaTeX", f"{of.text} lacks an argument", of.line)
    if found[position].text != "{":
        return [found[position]], position + 1
    depth = 0
    for end in range(position, len(found)):
        depth += (found[end].text == "{") - (found[end].text == "}")
        if depth == 0:
            return list(found[position + 1 : end]), end + 1
    raise NotUnderstood("bad LaTeX", "a { has no }", found[position].line)


_FONTS = frozenset({r"\rm", r"\bf", r"\it", r"\em", r"\sf", r"\tt", r"\cal"})
_UPRIGHT = frozenset({r"\mathrm", r"\operatorname", r"\textrm", r"\mathop", r"\operatorname*", r"\mathsf"})


def _upright(found: list[Token]) -> list[Token]:
    """``{\\rm x}`` and ``\\mathrm{x}`` as ``\\text{x}``."""
    result: list[Token] = []
    for token in found:
        if token.text in _FONTS:
            if result and result[-1].text == "{":
                result.insert(len(result) - 1, replace(token, text=r"\text"))
        else:
            result.append(replace(token, text=r"\text") if token.text in _UPRIGHT else token)
    return result


def _evaluated(found: list[Token]) -> list[Token]:
    """``\\left. x \\right|`` as a pair of tokens of its own; other delimiters that are not printed are dropped."""
    result: list[Token] = []
    opened: list[int | None] = []
    position = 0
    while position < len(found):
        token, following = found[position], found[position + 1].text if position + 1 < len(found) else ""
        position += 1
        if token.text == r"\left":
            opened.append(len(result) if following == "." else None)
            position += following == "."
        elif token.text == r"\right":
            start = opened.pop() if opened else None
            if start is not None and following == "|":
                result.insert(start, replace(token, text=r"\evaluate"))
                result.append(replace(token, text=r"\at"))
            position += following == "." or (start is not None and following == "|")
        else:
            result.append(token)
    return result


def _without_spacing(found: list[Token]) -> Iterator[Token]:
    position = 0
    while position < len(found):
        token = found[position]
        position += 1
        if token.text in _WITH_ARGUMENT:
            position += position < len(found) and found[position].text == "*"
            _, position = argument(found, position, token)
        elif token.text not in SPACING:
            yield token


def written(found: Sequence[Token]) -> str:
    """The tokens as LaTeX, in one spelling: without spaces where none are needed and without needless braces."""
    text = ""
    for token in found:
        if re.search(r"\\[a-zA-Z]+$", text) and token.text[:1].isalpha():
            text += " "
        text += token.text
    return re.sub(r"(?<![a-zA-Z}])\{([^{}\\]|\\[a-zA-Z]+)\}", r"\1", text)


def checked(found: Sequence[Token]) -> None:
    """Refuse a formula whose braces or environments do not match."""
    open_: list[Token] = []
    for token in found:
        if token.text == "{" or token.text.startswith(r"\begin{"):
            open_.append(token)
        elif token.text == "}" or token.text.startswith(r"\end{"):
            wanted = "{" if token.text == "}" else token.text.replace(r"\end", r"\begin", 1)
            if not open_ or open_[-1].text != wanted:
                raise NotUnderstood("bad LaTeX", f"{token.text} without its {wanted}", token.line)
            open_.pop()
    if open_:
        raise NotUnderstood("bad LaTeX", f"{open_[-1].text} is not closed", open_[-1].line)


def read(text: str, line: int, macros: Mapping[str, Macro]) -> list[Token]:
    """Tokens of a piece of mathematics with the paper's macros put in, and spacing left out.

    Raises
    ------
    NotUnderstood
        Where it does not end, a macro lacks an argument or stands for itself, or braces do not match.
    """
    if len(text) > _LONGEST:
        raise NotUnderstood("bad LaTeX", "the formula does not come to an end", line)
    found = list(_without_spacing(_evaluated(_upright(_expanded(list(tokens(text, line)), macros, 0)))))
    checked(found)
    return found
