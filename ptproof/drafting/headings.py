"""The sections of a paper: number, title, and the name of the file that holds what is displayed there."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

from ptproof.reading.latex.source import braced, expanded, without_comments

_PART = re.compile(r"\\(?:(?P<part>section|appendix)(?P<star>\*?)(?![a-zA-Z])|end\s*\{document\})")
_ENVIRONMENT = re.compile(r"\\begin\s*\{(?P<name>[A-Za-z]*(?:assum|hypoth)[A-Za-z]*\*?)\}")
_LONGEST = 40


@dataclass(frozen=True)
class Heading:
    """A section: its number (none where it is starred), its title, the line of its beginning, its file's name."""

    number: str
    title: str
    line: int
    file: str

    @property
    def words(self) -> str:
        """As the sections of a derivation are called."""
        return f"{self.number} {self.title}".strip()


@dataclass(frozen=True)
class Outline:
    """The title of a paper, its sections in the order of the text, and the lines on which something is assumed."""

    title: str
    headings: tuple[Heading, ...]
    assumed: tuple[tuple[int, int], ...]

    def heading(self, line: int) -> Heading:
        """The section in which a line stands."""
        return [item for item in self.headings if item.line <= line][-1]

    def is_assumed(self, line: int) -> bool:
        """Whether a line stands in an assumption of the paper."""
        return any(start <= line <= end for start, end in self.assumed)


def outline(source: str) -> Outline:
    """The sections of the LaTeX ``source``; what stands before the first one is a section "Front" of its own.

    Lines are those of :func:`ptproof.reading.latex.formulas.find_formulas`.
    """
    text = expanded(without_comments(source))
    start = text.find(r"\begin{document}")
    found: list[tuple[str, str, int]] = [("", "Front", 0)]
    number = appendix = 0
    for match in _PART.finditer(text, max(start, 0)):
        if match["part"] is None:
            break
        line = text.count("\n", 0, match.start()) + 1
        if match["part"] == "appendix":
            appendix = 1
            continue
        short = re.compile(r"\s*\[[^\]]*\]").match(text, match.end())
        title = plain(braced(text, short.end() if short else match.end())[0]) or "Untitled"
        if match["star"]:
            found.append(("", title, line))
        elif appendix:
            found.append((chr(ord("A") + min(appendix, 26) - 1), title, line))
            appendix += 1
        else:
            number += 1
            found.append((str(number), title, line))
    named = re.search(r"\\title\s*(?:\[[^\]]*\]\s*)?(?=\{)", text)
    title = plain(braced(text, named.end())[0]) if named else ""
    return Outline(title, _named(found), tuple(_assumed(text)))


def _named(found: Sequence[tuple[str, str, int]]) -> tuple[Heading, ...]:
    """With file names that stand in the order of the text when they are sorted."""
    width = len(str(max((int(number) for number, _, _ in found if number.isdigit()), default=0)))
    headings: list[Heading] = []
    last, behind = 0, 0
    for number, title, line in found:
        mark, name = "", title
        if number.isdigit():
            last, behind = int(number), 0
        else:
            mark = "z" * (behind // 26) + chr(ord("a") + behind % 26)
            name = f"appendix {number} {title}" if number else title
            behind += 1
        headings.append(Heading(number, title, line, f"section{last:0{width}d}{mark}_{slug(name)}"))
    return tuple(headings)


def _assumed(text: str) -> list[tuple[int, int]]:
    found = []
    for match in _ENVIRONMENT.finditer(text):
        end = text.find(rf"\end{{{match['name']}}}", match.end())
        end = len(text) if end < 0 else end
        found.append((text.count("\n", 0, match.start()) + 1, text.count("\n", 0, end) + 1))
    return found


def plain(latex: str) -> str:
    """A title in plain words: macros dropped, what they are applied to kept."""
    text = re.sub(r"\\(?:label|thanks|footnote)\s*\{[^{}]*\}", "", latex).replace("\\\\", " ").replace("~", " ")
    text = re.sub(r"\\[a-zA-Z]+\*?|[{}$]|\\.", "", text)
    return " ".join("".join(sign for sign in text if sign.isprintable() or sign.isspace()).split())[:120]


def slug(title: str, longest: int = _LONGEST) -> str:
    """A part of a name in small ASCII letters, digits and underscores."""
    ascii_ = unicodedata.normalize("NFKD", title).encode("ascii", "ignore").decode().lower()
    return re.sub(r"[^a-z0-9]+", "_", ascii_).strip("_")[:longest].strip("_") or "untitled"
