"""The page above several papers: what came out of each, and what is gravest in it."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from ptproof.report.headline import headline, plain
from ptproof.report.markdown import written
from ptproof.report.rendering import html, style
from ptproof.report.site import Site

GRAVEST = 3


def overview_files(sites: Mapping[str, Site]) -> dict[str, bytes]:
    """``index.html`` and ``report.md`` above the folders of the papers."""
    said = {name: headline(pages.report) for name, pages in sites.items()}
    page = html().get_template("overview.html.j2").render(
        sites=sites, said=said, most=GRAVEST, style=Markup(style())
    )  # fmt: skip
    words = {name: plain(pieces) for name, pieces in said.items()}
    return {
        "index.html": page.encode(),
        "report.md": written("overview.md.j2", sites=sites, said=words, most=GRAVEST).encode(),
    }
