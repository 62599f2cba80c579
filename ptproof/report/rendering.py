"""The templates of the pages with the filters that they use."""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from functools import lru_cache

from jinja2 import Environment
from markupsafe import Markup, escape

from ptproof.report.content import Figure
from ptproof.report.formula import mathml, width
from ptproof.report.headline import Piece
from ptproof.report.instruments.view import shown
from ptproof.report.model import Said
from ptproof.report.prose import to_html, worded
from ptproof.report.templating import environment, text


@lru_cache(maxsize=1)
def html() -> Environment:
    """The environment of the HTML pages."""
    jinja = environment(escape=True).overlay()
    filters: dict[str, Callable[..., str | float]] = {
        "math": lambda source: _formula(source, False),
        "display": lambda source: _formula(source, True),
        "prose": lambda source: Markup(to_html(source)),
        "data_uri": data_uri,
        "digits": shown,
        "width": width,
        "pieces": pieces,
        "worded": worded,
        "tex": tex,
    }
    jinja.filters = {**jinja.filters, **filters}
    return jinja


@lru_cache(maxsize=8192)
def _formula(source: str, display: bool) -> Markup:
    """A formula, which often stands on several pages."""
    return Markup(mathml(source, display=display))


def style() -> str:
    """The style of every page."""
    return "\n".join(text(name) for name in ("page.css", "front.css", "colours.css", "graph.css", "instruments.css"))


def script() -> str:
    """The script of every page."""
    return "\n".join(text(name) for name in ("letters.js", "page.js"))


def pieces(said: Sequence[Piece]) -> Markup:
    """A sentence with its links."""
    parts = (
        Markup('<a href="#{}">{}</a>').format(piece.anchor, piece.words) if piece.anchor else escape(piece.words)
        for piece in said
    )
    return Markup("").join(parts)


def tex(said: Said) -> str:
    """A formula as LaTeX to be put into a paper, in the paper's own letters where it was read in them."""
    lines = said.lines
    if said.printed and said.read is not None:
        inside = " \\\\\n".join(said.read.latex)
        return inside if len(said.printed) == 1 else f"\\begin{{aligned}}\n{inside}\n\\end{{aligned}}"
    if len(lines) == 1:
        return lines[0].latex
    inside = " \\\\\n".join("& " + r"\quad " * line.indent + line.latex for line in lines)
    return f"\\begin{{aligned}}\n{inside}\n\\end{{aligned}}"


def data_uri(figure: Figure) -> str:
    """A figure as an address that holds it."""
    kind = "image/svg+xml" if figure.kind == "svg" else "image/png"
    return f"data:{kind};base64,{base64.b64encode(figure.content).decode()}"
