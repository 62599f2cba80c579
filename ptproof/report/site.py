"""The report as many pages: which part stands on which page, none of them long, and links between them.

A claim's link is ``PAGE#ANCHOR``, where the anchor is made from its id and the page from the heading of its section.
``index.html#ANCHOR`` leads there as well, wherever it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from markupsafe import Markup

from ptproof.report.formula import width
from ptproof.report.graph import graph_svg
from ptproof.report.headline import headline
from ptproof.report.instruments.script import script_of
from ptproof.report.model import Report, Section
from ptproof.report.picture import FORMS, picture
from ptproof.report.rendering import html, script, style
from ptproof.report.search import formulas, meanings, search_index
from ptproof.report.status import ALL

MOST = 400_000  # bytes of a page beside what stands on every page
ERRATA_AT_FRONT = 5
SHOWN_LINES, SHOWN_WIDTH = 3, 90.0  # of a formula beside a name; characters
_ID = re.compile(r'<[a-zA-Z][^<>]*? id="([^"<>]+)"')
_LINK = re.compile(r'(<a\b[^<>]*? ?href=")#([^"<>]+)"')


@dataclass(frozen=True)
class Page:
    """A page: its file, its title, its content with links by anchors alone, and the anchor of its section, if any."""

    file: str
    title: str
    body: str
    section: str = ""


@dataclass(frozen=True)
class Site:
    """The pages of a report, with their content, and the script of its instruments; ``places`` says on which page each
    anchor stands."""

    report: Report
    pages: tuple[Page, ...]
    moving: str

    @cached_property
    def places(self) -> dict[str, str]:
        return {anchor: page.file for page in self.pages for anchor in _ID.findall(page.body)}

    def address(self, anchor: str) -> str:
        """Where an anchor is, from the folder of the report."""
        return f"{self.places.get(anchor, 'index.html')}#{anchor}"


@dataclass(frozen=True)
class Cards:
    """What is said of each erratum, and of what stands in each section by its anchor, and the script of the
    instruments: no figure changes it."""

    errata: tuple[str, ...]
    sections: Mapping[str, tuple[str, ...]]
    moving: str


def cards_of(report: Report) -> Cards:
    """The cards of a report, which may have no figures yet."""
    sections = {section.anchor: tuple(map(str, _cards(section))) for section in report.sections}
    return Cards(tuple(map(str, _errata(report))), sections, _moving(report) if report.instruments else "")


def site(report: Report, cards: Cards | None = None) -> Site:
    """Set every page of the report, whose cards may be set already."""
    cards = cards or cards_of(report)
    return Site(report, tuple(_pages(report, cards)), cards.moving)


def site_files(of: Site, above: str = "") -> dict[str, bytes]:
    """The pages, their style and script, the index for searching, and the graph; ``above`` leads to other papers."""
    files = {}
    for page in of.pages:
        whole = _skeleton(of.report, page, above=above, turn=_neighbours(of.pages, page))
        files[page.file] = linked(whole, of.places, page.file).encode()
    graph = graph_svg(of.report.nodes(), standalone=True)
    files["graph.svg"] = linked(graph, of.places, "graph.svg").encode()
    files["style.css"], files["page.js"] = style().encode(), script().encode()
    files["formulas.js"] = formulas(_short(of.report)).encode()
    files["letters.js"] = meanings(of.report).encode()
    if of.report.instruments:
        files["instruments.js"] = of.moving.encode()
    files["search.js"] = search_index(of.report, of.places).encode()
    return files


def single_page(report: Report) -> str:
    """One page that needs nothing else: styles, formulas, pictures and figures are inside."""
    parts = _parts()
    errata = "".join(map(str, _errata(report)))
    body = [
        _front(report), f'<section id="errata">\n<h2>Errata</h2>\n{errata}</section>', _graph(report),
        *(_section(section, [*_cards(section)]) for section in report.sections),
        *((_instruments(report),) if report.instruments else ()),
        *((parts.drawn(report, True),) if report.figures else ()), *_reference(report),
        *((parts.appended(report),) if report.appendix else ()),
        f'<section id="claims">\n<h2>Statements by verdict</h2>\n{_listed(report)}</section>',
        *((f"<script>\n{_moving(report)}</script>",) if report.instruments else ()),
    ]  # fmt: skip
    page = Page("", report.title, "\n".join(map(str, body)))
    return _skeleton(report, page, alone=True)


def slug(title: str) -> str:
    """The title as a part of an address: small letters, digits and hyphens."""
    words = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")
    return words[:60].rstrip("-") or "part"


def packed(items: Sequence[str], most: int = MOST) -> list[list[str]]:
    """The items in order, in parts of at most ``most`` bytes each; one that is longer has a part to itself."""
    parts: list[list[str]] = [[]]
    size = 0
    for item in items:
        length = len(item.encode())
        if parts[-1] and size + length > most:
            parts.append([])
            size = 0
        parts[-1].append(item)
        size += length
    return parts


def linked(content: str, places: Mapping[str, str], here: str) -> str:
    """The content with the page before each anchor that stands on another than ``here``."""

    def address(found: re.Match[str]) -> str:
        page = places.get(found[2], here)
        return f'{found[1]}{"" if page == here else page}#{found[2]}"'

    return _LINK.sub(address, content)


def _parts() -> Any:
    """The macros of the parts."""
    return html().get_template("parts.html.j2").module


def _pages(report: Report, cards: Cards) -> Iterator[Page]:
    parts = _parts()
    yield Page("index.html", report.title, _front(report))
    yield from _split("errata", "Errata", cards.errata, "errata")
    yield Page("graph.html", "Graph of the claims", _topped(_graph(report)))
    taken: dict[str, int] = {}
    for section in report.sections:
        name = slug(section.title)
        taken[name] = taken.get(name, 0) + 1
        name = f"section-{name}" + (f"--{taken[name]}" if taken[name] > 1 else "")
        cut = packed(cards.sections[section.anchor])
        for number, part in enumerate(cut, 1):
            file = f"{name}.html" if number == 1 else f"{name}-{number}.html"
            whole = _topped(_section(section, part, number, len(cut)))
            yield Page(file, section.title + _of(number, len(cut)), whole, section.anchor)
    yield from _split("statements", "Statements by verdict", [_listed(report)], "claims")
    if report.figures or report.appendix:
        drawn = [parts.drawn(report, False)] if report.figures else []
        drawn += [parts.appended(report)] if report.appendix else []
        yield Page("figures.html", "Figures", _topped("\n".join(drawn)))
    if report.instruments:
        tools = _topped(_instruments(report)) + '<script src="instruments.js"></script>'
        yield Page("instruments.html", "Instruments", tools)
    yield Page("reference.html", "Notation and sources", _topped("\n".join(_reference(report))))


def _topped(body: str) -> str:
    """The content with its first heading as that of the page; where it is the only one, those of entries come next."""
    topped = re.sub(r"<h2>(.*?)</h2>", r"<h1>\1</h1>", body, count=1)
    return topped if "<h2" in topped else re.sub(r"(</?)h3\b", r"\1h2", topped)


def _of(number: int, parts: int) -> str:
    """What a heading says of the part where there are several."""
    return f" ({number} of {parts})" if parts > 1 else ""


def _split(name: str, title: str, items: Sequence[str], anchor: str) -> Iterator[Page]:
    """The items on as many pages as they need; the anchor is on the first."""
    inside = packed(items)
    for number, part in enumerate(inside, 1):
        whole, mark = title + _of(number, len(inside)), f"-{number}" if number > 1 else ""
        body = f'<section id="{anchor}{mark}">\n<h2>{whole}</h2>\n' + "\n".join(map(str, part)) + "</section>"
        yield Page(f"{name}{mark}.html", whole, _topped(body))


def _front(report: Report) -> str:
    rows = picture(report.sections)
    return str(_parts().front(report, headline(report), rows, FORMS, ALL, ERRATA_AT_FRONT))


def _errata(report: Report) -> Iterator[str]:
    parts = _parts()
    yield parts.errata_table(report)
    for erratum in report.errata:
        yield parts.correction(erratum, "printed")
    if report.besides:
        yield parts.besides_head()
        for erratum in report.besides:
            yield parts.correction(erratum, "claimed")


def _graph(report: Report) -> str:
    return str(_parts().graphed(Markup(graph_svg(report.nodes(), standalone=False))))


def _cards(section: Section) -> Iterator[str]:
    parts = _parts()
    for item in section.definitions:
        yield parts.defined(item)
    for claim in section.claims:
        yield parts.card(claim)


def _section(section: Section, cards: Sequence[str], number: int = 1, parts: int = 1) -> str:
    inside = Markup("\n").join(map(Markup, cards))
    return str(_parts().sectioned(section, inside, number, parts, _of(number, parts)))


def _instruments(report: Report) -> str:
    parts: Any = html().get_template("instruments.html.j2").module
    return str(parts.page(report.instruments))


def _moving(report: Report) -> str:
    return script_of([view.instrument for view in report.instruments]).replace("</", r"<\/")


def _listed(report: Report) -> str:
    return str(_parts().listed(report, ALL))


def _short(report: Report) -> dict[str, str]:
    """The statements that can be shown beside a name, since they are short, by their anchors."""
    return {
        claim.ref.anchor: str(_parts().formula(claim.shown, claim.words))
        for claim in report.claims
        if len(claim.shown) <= SHOWN_LINES and sum(width(line.latex) for line in claim.shown) < SHOWN_WIDTH
    }


def _reference(report: Report) -> Iterator[str]:
    parts = _parts()
    yield parts.quoted(report)
    if report.labels:
        yield parts.indexed(report)
    if report.letters:
        yield parts.lettered(report)
    yield parts.verdicts(ALL)
    yield parts.versioned(report)


def _neighbours(pages: Sequence[Page], page: Page) -> tuple[Page | None, Page | None]:
    """The pages before and after among those of its kind: sections, parts of the errata, parts of a list."""
    kind = re.compile(re.split(r"[-.]", page.file)[0] + r"\b")
    inside = [item for item in pages if kind.match(item.file)]
    place = inside.index(page)
    return inside[place - 1] if place else None, inside[place + 1] if place + 1 < len(inside) else None


def _skeleton(
    report: Report,
    page: Page,
    *,
    alone: bool = False,
    above: str = "",
    turn: tuple[Page | None, Page | None] = (None, None),
) -> str:
    parts = [("errata", "Errata"), ("claims", "Statements"), ("graph", "Graph")]
    parts += [("instruments", "Instruments")] if report.instruments else []
    parts += [("figures", "Figures")] if report.figures else []
    parts += [("appendix", "Appendix")] if report.appendix else []
    parts += [("notation" if report.letters else "cited", "Notation" if report.letters else "Sources")]
    title = page.title if page.title == report.title else f"{page.title} · {report.title}"
    return html().get_template("page.html.j2").render(
        title=title, brand=report.title, parts=parts, sections=report.sections, current=page.section,
        side=alone or bool(page.section), turn=turn, body=Markup(page.body), alone=alone, above=above,
        style=Markup(style()), script=Markup((meanings(report) if alone else "") + script()),
    )  # fmt: skip
