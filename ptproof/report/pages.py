"""Every file of a report: of one paper or of several, as HTML, as Markdown, as JSON, and as a picture."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ptproof.report.exported import exported_json
from ptproof.report.markdown import markdown_page
from ptproof.report.model import Report
from ptproof.report.overview import overview_files
from ptproof.report.printing import printed
from ptproof.report.site import Cards, Site, single_page, site, site_files


def all_files(
    reports: Mapping[str, Report], *, single: bool = False, browser: str = "",
    cards: Mapping[str, Cards] = MappingProxyType({}),
) -> dict[str, bytes]:  # fmt: skip
    """The files of the reports by their paths: of one paper as they are, of several each in a folder of its name.

    ``cards`` are those that are set already. The rest is as for :func:`report_files`.
    """
    sites = {name: site(report, cards.get(name)) for name, report in reports.items()}
    if len(sites) == 1:
        return _files(next(iter(sites.values())), single, browser)
    files = overview_files(sites)
    for name, pages in sites.items():
        files.update(
            {f"{name}/{file}": content for file, content in _files(pages, single, browser, "../index.html").items()}
        )
    return files


def report_files(report: Report, *, single: bool = False, browser: str = "") -> dict[str, bytes]:
    """Every file of one report by its path: the pages, the same as Markdown and as JSON, the graph, and the figures.

    With ``single`` there is also one page that holds everything, with a ``browser`` also that page as PDF.

    Raises
    ------
    InputError
        If the browser does not print it.
    """
    return _files(site(report), single, browser)


def _files(pages: Site, single: bool, browser: str, above: str = "") -> dict[str, bytes]:
    files = {f"figures/{figure.file}": figure.content for figure in pages.report.figures}
    files["report.md"] = markdown_page(pages.report).encode()
    files["report.json"] = exported_json(pages)
    files.update(site_files(pages, above))
    if single or browser:
        page = single_page(pages.report).encode()
        files.update({"report.html": page} if single else {})
        files.update({"report.pdf": printed(page, browser)} if browser else {})
    return files
