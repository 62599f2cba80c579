"""Where the formulas of a paper stand: every displayed one, and every one in running text that is a relation."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from ptproof.reading.latex.sentences import sentence
from ptproof.reading.latex.source import expanded, without_comments
from ptproof.reading.latex.tokens import Macro, definitions

ROWS = frozenset({"align", "gather", "flalign", "alignat", "xalignat", "xxalignat", "eqnarray", "IEEEeqnarray"})
DISPLAYS = ROWS | {"equation", "multline", "displaymath", "dmath"}
_MARK = re.compile(
    r"\\begin\s*\{(?P<begin>[^{}]*)\}|\\end\s*\{(?P<end>[^{}]*)\}|(?P<open>\\\[)|(?P<close>\\\])|(?<!\\)(?P<dollars>\$\$?)"
    r"|\\(?P<part>section|subsection|appendix)(?P<star>\*?)(?![a-zA-Z])|\\(?P<paren>[()])|\\label\s*\{(?P<label>[^{}]*)\}"
    r"|(?P<blank>\n[ \t]*\n)|\\\\|\\\$"
)
_LABEL = re.compile(r"\\label\s*(?:\[[^\]]*\]\s*)?\{([^{}]*)\}")
_NO_NUMBER = re.compile(r"\\(nonumber|notag)(?![a-zA-Z])")
_MEMBER = re.compile(r"\\in(?![a-zA-Z])")
_RELATION = re.compile(r"=|<|>|\\(le|leq|leqslant|ge|geq|geqslant|ne|neq|equiv|ll|gg|approx|lt|gt)(?![a-zA-Z])")
# A row that begins with a relation goes on with the row before it; so does one that begins with a sign and has none.
_BEFORE = r"^(?:[\s&{}]|\\(?:q?quad(?![a-zA-Z])|[,;:!]|hspace\*?\{[^{}]*\}))*"
_RELATION_FIRST = re.compile(_BEFORE + r"(?:[=<>]|\\(?:le|leq|ge|geq|ne|neq)(?![a-zA-Z]))")
_SIGN_FIRST = re.compile(_BEFORE + r"(?:[-+/)\]]|\\(?:times|cdot|pm|right)(?![a-zA-Z]))")
_GOES_ON = re.compile(f"{_RELATION_FIRST.pattern}|{_SIGN_FIRST.pattern}")
_UNFINISHED = re.compile(r"(?:[-+=<>(\[]|\\(?:le|leq|ge|geq|times|cdot|implies|pm)(?![a-zA-Z]))[\s&{}]*$")
_NESTED = re.compile(r"\\(?:begin|end)\s*\{[^{}]*\}|\\\\(?:\*?\[[^\]]*\])?|(?<!\\)[{}]|\\[{}]")


@dataclass(frozen=True)
class Formula:
    """A formula of the paper as it is written, with the ``line`` of the source on which it begins.

    ``place`` is its first label, or the section and its number among the formulas displayed there (in running text,
    among the relations there); ``labels`` are its own and those of the group of equations in which it stands.
    ``broken`` says why it cannot be read, where its end is missing. ``around`` is what stands in its sentence before it
    and behind it; no part of what makes two formulas equal.
    """

    place: str
    labels: tuple[str, ...]
    line: int
    text: str
    displayed: bool = True
    broken: str = ""
    around: tuple[str, str] = field(default=("", ""), compare=False, repr=False)


@dataclass(frozen=True)
class Formulas:
    """The formulas of a paper in the order of the text, and the macros that its author defines.

    ``members`` are those of running text that say in what set something lies, and are no relation otherwise.
    """

    displayed: tuple[Formula, ...]
    running: tuple[Formula, ...]
    macros: dict[str, Macro] = field(default_factory=dict)
    members: tuple[Formula, ...] = ()


@dataclass
class _Place:
    """Where the scan is: sections counted as LaTeX counts them, and formulas in each."""

    section: int = 0
    subsection: int = 0
    appendix: bool = False
    number: int = 0
    relations: int = 0

    def name(self) -> str:
        return f"{self.part()} ({self.number})"

    def next_in_text(self) -> str:
        self.relations += 1
        return f"{self.part()}, text ({self.relations})"

    def part(self) -> str:
        if self.appendix:
            return "Appendix"
        if not self.section:
            return "Front"
        inner = f".{self.subsection}" if self.subsection else ""
        return f"Section {self.section}{inner}"

    def enter(self, part: str, star: str, title: str) -> None:
        self.relations = 0
        if part == "appendix" or (star and title.strip().lower().startswith("appendi")):
            self.appendix, self.number = True, 0
        elif part == "section":
            self.section, self.subsection, self.number = self.section + (not star), 0, 0
        elif not star:
            self.subsection, self.number = self.subsection + 1, 0


def find_formulas(source: str) -> Formulas:
    """Every formula of the LaTeX ``source``, with its place; a display that does not end is cut at the next paragraph.

    A row of align, gather, eqnarray and the like is a formula of its own, unless it goes on with another one.
    """
    clean = without_comments(source)
    scan = _Scan(expanded(clean))
    scan.run()
    return Formulas(tuple(scan.displayed), tuple(scan.running), definitions(clean), tuple(scan.members))


class _Scan:
    def __init__(self, text: str) -> None:
        self.text = text
        self.displayed: list[Formula] = []
        self.running: list[Formula] = []
        self.members: list[Formula] = []
        self.place = _Place()
        self.groups: list[list[str]] = []
        self.starts: list[int] = []

    def run(self) -> None:
        start = self.text.find(r"\begin{document}")
        position = 0 if start < 0 else start + len(r"\begin{document}")
        while match := _MARK.search(self.text, position):
            position = match.end()
            if match["begin"] is not None:
                name = match["begin"].strip().rstrip("*")
                if name in DISPLAYS:
                    position = self.display(name, match["begin"].strip(), position)
                elif name == "subequations":
                    self.groups.append([])
                    self.starts.append(len(self.displayed))
                elif name in ("tikzpicture", "thebibliography"):
                    end = self.text.find(rf"\end{{{name}}}", position)
                    position = len(self.text) if end < 0 else end
            elif match["end"] is not None:
                if match["end"].strip() == "document":
                    return
                if match["end"].strip() == "subequations" and self.groups:
                    self.close_group()
            elif match["open"] or match["dollars"] == "$$":
                position = self.bare(r"\]" if match["open"] else "$$", position)
            elif match["dollars"] or match["paren"] == "(":
                position = self.inline("$" if match["dollars"] else r"\)", position)
            elif match["part"]:
                title = re.match(r"\s*\{([^{}]*)", self.text[position : position + 200])
                self.place.enter(match["part"], match["star"], title.group(1) if title else "")
            elif match["label"] is not None and self.groups:
                self.groups[-1].append(match["label"].strip())

    def close_group(self) -> None:
        """Give the labels of a group to each formula in it."""
        labels, start = self.groups.pop(), self.starts.pop()
        for index in range(start, len(self.displayed)):
            formula = self.displayed[index]
            place = formula.place if formula.labels or not labels else f"{labels[0]} ({index - start + 1})"
            both = tuple(dict.fromkeys([*formula.labels, *labels]))
            self.displayed[index] = replace(formula, place=place, labels=both)

    def line(self, position: int) -> int:
        return self.text.count("\n", 0, position) + 1

    def end_of(self, closing: re.Pattern[str], position: int) -> tuple[int, int, str]:
        """Where the content of a display ends, where the text goes on, and what is wrong with it."""
        match = closing.search(self.text, position)
        end = match.start() if match else len(self.text)
        for other in (
            r"\n[ \t]*\n",
            r"\\begin\s*\{{(?:{})\*?\}}".format("|".join(DISPLAYS)),
            r"\\(?:sub)?section\b",
            r"\\end\s*\{document\}",
        ):
            cut = re.compile(other).search(self.text, position, end)
            if cut and (other[:2] != r"\n" or not match or self.foreign(position, end)):
                end, match = cut.start(), None
        if match is None:
            return end, end, "its end is missing"
        return end, match.end(), ""

    def foreign(self, position: int, end: int) -> bool:
        """Whether a second display begins before this one ends; a blank line alone does not break one."""
        display = r"\\(?:begin\s*\{{(?:{})\*?\}}|(?:sub)?section\b)".format("|".join(DISPLAYS))
        return re.search(display, self.text[position:end]) is not None

    def display(self, name: str, full: str, position: int) -> int:
        if name in ("alignat", "xalignat", "xxalignat", "IEEEeqnarray"):
            given = re.compile(r"\s*\{[^{}]*\}").match(self.text, position)
            position = given.end() if given else position
        end, after, broken = self.end_of(re.compile(rf"\\end\s*\{{{re.escape(full)}\}}"), position)
        for start, text, ended in self.rows(position, end, name in ROWS):
            self.add(start, text, broken if ended else "")
        return after

    def bare(self, closing: str, position: int) -> int:
        end, after, broken = self.end_of(re.compile(re.escape(closing)), position)
        self.add(position, self.text[position:end], broken)
        return after

    def inline(self, closing: str, position: int) -> int:
        match = re.compile(r"(?<!\\)\$" if closing == "$" else re.escape(closing)).search(self.text, position)
        blank = re.compile(r"\n[ \t]*\n").search(self.text, position)
        if match is None or (blank and blank.start() < match.start()):
            end = blank.start() if blank else len(self.text)
            place, text = self.place.next_in_text(), self.text[position:end]
            self.running.append(Formula(place, (), self.line(position), text, False, "its end is missing"))
            return end
        text = self.text[position : match.start()]
        if _RELATION.search(text):
            place = self.place.next_in_text()
            around = sentence(self.text, position - len(closing), match.end())
            self.running.append(Formula(place, (), self.line(position), text.strip(), False, around=around))
        elif _MEMBER.search(text):
            around = sentence(self.text, position - len(closing), match.end())
            self.members.append(Formula(self.place.part(), (), self.line(position), text.strip(), False, around=around))
        return match.end()

    def add(self, start: int, text: str, broken: str) -> None:
        if not re.sub(r"[\s&.,;{}]|\\label\{[^{}]*\}", "", text) and not broken:
            return
        self.place.number += 1
        labels = tuple(dict.fromkeys(label.strip() for label in _LABEL.findall(text)))
        start += len(text) - len(text.lstrip())
        place = labels[0] if labels else self.place.name()
        around = sentence(self.text, start, start + len(text.strip()))
        self.displayed.append(Formula(place, labels, self.line(start), text.strip(), broken=broken, around=around))

    def rows(self, position: int, end: int, split: bool) -> Iterator[tuple[int, str, bool]]:
        """The rows of a display: where each begins, its text, and whether it is the last."""
        if not split:
            yield position, self.text[position:end], True
            return
        pieces = split_rows(self.text[position:end])
        joined: list[tuple[int, str]] = []
        unfinished = False
        for offset, piece in pieces:
            bare = _LABEL.sub("", piece)
            goes_on = _RELATION_FIRST.match(bare) or (_SIGN_FIRST.match(bare) and not _RELATION.search(bare))
            if joined and (unfinished or goes_on):
                joined[-1] = (joined[-1][0], joined[-1][1] + (r"\\" if goes_on else "") + piece)
            else:
                joined.append((position + offset, piece))
            unfinished = bool(_NO_NUMBER.search(bare) or _UNFINISHED.search(_NO_NUMBER.sub("", bare)))
        for index, (start, text) in enumerate(joined):
            yield start, text, index == len(joined) - 1


def goes_on(before: str, row: str) -> bool:
    """Whether a row goes on with the one before it, by the sign that it begins with or that one ends with."""
    return bool(_GOES_ON.match(row) or _UNFINISHED.search(before))


def split_rows(text: str) -> list[tuple[int, str]]:
    """The text at its line breaks, those inside of environments and groups excepted."""
    rows: list[tuple[int, str]] = []
    depth = start = 0
    for match in _NESTED.finditer(text):
        mark = match.group()
        if mark.startswith(r"\begin") or mark == "{":
            depth += 1
        elif mark.startswith(r"\end") or mark == "}":
            depth -= 1
        elif mark.startswith("\\\\") and depth <= 0:
            rows.append((start, text[start : match.start()]))
            start = match.end()
    rows.append((start, text[start:]))
    return rows
