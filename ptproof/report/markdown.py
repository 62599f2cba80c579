"""The report as Markdown."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from jinja2 import Environment

from ptproof.report.formula import Line
from ptproof.report.model import Report
from ptproof.report.prose import code, display_math, escape, inline_math, to_markdown
from ptproof.report.status import ALL
from ptproof.report.templating import environment


def markdown_page(report: Report) -> str:
    """The same content in the Markdown of code hosts, with formulas as they render them."""
    return written("report.md.j2", report=report, statuses=ALL)


def written(template: str, **content: object) -> str:
    """A template of Markdown, without lines that say nothing."""
    page = _environment().get_template(template).render(**content)
    lines = [line.rstrip() for line in page.split("\n")]
    kept = [line for place, line in enumerate(lines) if line or (place and lines[place - 1])]
    return "\n".join(kept).strip() + "\n"


@cache
def _environment() -> Environment:
    """Made once, as it keeps the templates that it has compiled."""
    jinja = environment(escape=False).overlay()
    filters: dict[str, Callable[..., str]] = {
        "math": inline_math,
        "lines": _lines,
        "prose": to_markdown,
        "esc": escape,
        "code": code,
        "cellcode": lambda source: code(source, cell=True),
    }
    jinja.filters = {**jinja.filters, **filters}
    return jinja


def _lines(lines: tuple[Line, ...]) -> str:
    if len(lines) == 1:
        return display_math([lines[0].latex])
    return display_math(["& " + r"\quad " * line.indent + line.latex for line in lines])
