"""The report as one HTML page, as Markdown, and as a picture."""

from __future__ import annotations

import base64
from collections.abc import Callable

from markupsafe import Markup

from ptproof.report.content import Figure
from ptproof.report.formula import Line, mathml
from ptproof.report.graph import graph_svg
from ptproof.report.model import Report
from ptproof.report.prose import code, display_math, escape, inline_math, to_html, to_markdown
from ptproof.report.status import ALL
from ptproof.report.templating import environment, text


def report_files(report: Report) -> dict[str, bytes]:
    """Every file of the report by its path: the page, the same as Markdown, the graph, and the figures."""
    files = {f"figures/{figure.file}": figure.content for figure in report.figures}
    files["graph.svg"] = graph_svg(report.nodes(), standalone=True, page="index.html").encode()
    files["report.md"] = markdown_page(report).encode()
    files["index.html"] = html_page(report).encode()
    return files


def html_page(report: Report) -> str:
    """One page that needs nothing else: styles, formulas, pictures and figures are inside."""
    jinja = environment(escape=True).overlay()
    filters: dict[str, Callable[..., str]] = {
        "math": lambda source: Markup(mathml(source)),
        "display": lambda source: Markup(mathml(source, display=True)),
        "prose": lambda source: Markup(to_html(source)),
        "data_uri": _data_uri,
    }
    jinja.filters = {**jinja.filters, **filters}
    return jinja.get_template("page.html.j2").render(
        report=report,
        graph=Markup(graph_svg(report.nodes(), standalone=False)),
        style=Markup("\n".join(text(name) for name in ("page.css", "colours.css", "graph.css"))),
        script=Markup(text("page.js")),
        statuses=ALL,
    )


def markdown_page(report: Report) -> str:
    """The same content in the Markdown of code hosts, with formulas as they render them."""
    jinja = environment(escape=False).overlay()
    filters: dict[str, Callable[..., str]] = {
        "math": inline_math,
        "lines": _markdown_lines,
        "prose": to_markdown,
        "esc": escape,
        "code": code,
        "cellcode": lambda source: code(source, cell=True),
    }
    jinja.filters = {**jinja.filters, **filters}
    page = jinja.get_template("report.md.j2").render(report=report, statuses=ALL)
    lines = [line.rstrip() for line in page.split("\n")]
    kept = [line for place, line in enumerate(lines) if line or (place and lines[place - 1])]
    return "\n".join(kept).strip() + "\n"


def _markdown_lines(lines: tuple[Line, ...]) -> str:
    if len(lines) == 1:
        return display_math([lines[0].latex])
    return display_math(["& " + r"\quad " * line.indent + line.latex for line in lines])


def _data_uri(figure: Figure) -> str:
    kind = "image/svg+xml" if figure.kind == "svg" else "image/png"
    return f"data:{kind};base64,{base64.b64encode(figure.content).decode()}"
