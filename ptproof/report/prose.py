"""The text of docstrings: paragraphs and lists with `code` and $formulas$, as HTML or Markdown."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from ptproof.report.formula import mathml

_INLINE = re.compile(r"``(.+?)``|(?::[a-z]+:)?`([^`]+)`|\$([^$\n]+)\$", re.DOTALL)
_SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|~$])")


@dataclass(frozen=True)
class Piece:
    """A run of text of one kind."""

    kind: Literal["text", "code", "math"]
    text: str


@dataclass(frozen=True)
class Block:
    """A paragraph, or one item of a list."""

    pieces: tuple[Piece, ...]
    item: bool = False


def blocks(text: str) -> tuple[Block, ...]:
    """Paragraphs are set apart by empty lines; a line that begins with ``- `` is an item."""
    found: list[Block] = []
    for paragraph in re.split(r"\n\s*\n", text.strip()):
        parts = re.split(r"(?m)^\s*[-*] +", paragraph)
        for index, part in enumerate(parts):
            if part.strip():
                found.append(Block(tuple(_pieces(" ".join(part.split()))), item=index > 0))
    return tuple(found)


def _pieces(text: str) -> Iterator[Piece]:
    position = 0
    for match in _INLINE.finditer(text):
        if match.start() > position:
            yield Piece("text", text[position : match.start()])
        if match.group(3) is not None:
            yield Piece("math", match.group(3))
        else:
            code = match.group(1) or match.group(2)
            yield Piece("code", code.removeprefix("~").rsplit(".", 1)[-1] if match.group().startswith(":") else code)
        position = match.end()
    if position < len(text):
        yield Piece("text", text[position:])


def to_html(text: str) -> str:
    """The text as HTML, everything in it escaped."""
    out: list[str] = []
    listing = False
    for block in blocks(text):
        if block.item != listing:
            out.append("<ul>" if block.item else "</ul>")
            listing = block.item
        inside = "".join(_html_piece(piece) for piece in block.pieces)
        out.append(f"<li>{inside}</li>" if block.item else f"<p>{inside}</p>")
    return "\n".join([*out, *(["</ul>"] if listing else [])])


def _html_piece(piece: Piece) -> str:
    if piece.kind == "math":
        return mathml(piece.text)
    return f"<code>{html.escape(piece.text)}</code>" if piece.kind == "code" else html.escape(piece.text)


def to_markdown(text: str) -> str:
    """The text as Markdown, everything in it escaped."""
    out: list[str] = []
    listing = False
    for block in blocks(text):
        inside = "".join(_markdown_piece(piece) for piece in block.pieces)
        if out and not (block.item and listing):
            out.append("")
        out.append(f"- {inside}" if block.item else inside)
        listing = block.item
    return "\n".join(out)


def _markdown_piece(piece: Piece) -> str:
    if piece.kind == "math":
        return inline_math(piece.text)
    if piece.kind == "code":
        return code(piece.text)
    # The spaces at its ends set it apart from what stands beside it.
    before, after = (" " if end.isspace() else "" for end in (piece.text[:1], piece.text[-1:]))
    return f"{before}{escape(piece.text)}{after}"


def escape(text: str) -> str:
    """Text in which no character means anything to Markdown."""
    escaped = _SPECIAL.sub(r"\\\1", " ".join(text.split()))
    return re.sub(r"^(\d+)([.)])(?=\s)|^([-+])(?=\s)", lambda m: f"{m[1]}\\{m[2]}" if m[1] else f"\\{m[3]}", escaped)


def code(text: str, *, cell: bool = False) -> str:
    """Text as inline code, also where it holds backticks; in the ``cell`` of a table a bar does not end it."""
    text = " ".join(text.split()) or " "
    if cell:
        text = text.replace("|", r"\|")
    fence = "`" * (1 + max((len(run) for run in re.findall(r"`+", text)), default=0))
    space = " " if "`" in text else ""
    return f"{fence}{space}{text}{space}{fence}"


def inline_math(source: str) -> str:
    """LaTeX within a line: in dollars with backticks, so that no character in it means anything to Markdown."""
    return f"$`{hosted(source)}`$"


def display_math(lines: list[str]) -> str:
    """LaTeX lines as a block of their own."""
    body = "\n".join(lines) if len(lines) == 1 else "\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}"
    return f"```math\n{hosted(body)}\n```"


def hosted(source: str) -> str:
    """LaTeX without what code hosts refuse (``\\operatorname``) and without bars, which would end a table's cell."""
    bars = {r"\|": r"\Vert ", "|": r"\vert "}
    source = re.sub(r"\\operatorname\s*\{", r"\\mathrm{", source)
    return re.sub(r"\\\\|\\\||\|", lambda match: bars.get(match.group(), match.group()), source)
