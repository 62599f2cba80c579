"""A canvas with Matplotlib in one style, and pictures with the same bytes for the same data."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

# Okabe and Ito's colours, told apart with every kind of colour vision.
# The orange and the purple are darker, so that each has a contrast of 3 to white; on black its partner in DARK has.
BLUE, ORANGE, GREEN, RED, PURPLE, GREY = "#0072b2", "#b97f00", "#009e73", "#d55e00", "#c0669a", "#666666"
DARK = {
    BLUE: "#56b4e9", ORANGE: "#e69f00", GREEN: "#2dc79a", RED: "#ff8a4c", PURPLE: "#e39cc4", GREY: "#9aa4af",
    "#000000": "#e2e6eb", "#ffffff": "#0e1116", "#b0b0b0": "#59636e", "#cccccc": "#2c333b",
}  # fmt: skip
_NUMBER = re.compile(r"-?\d+\.\d+")
_STYLE: Any = {
    "font.family": "DejaVu Sans", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.alpha": 0.25, "legend.frameon": False, "figure.dpi": 150, "savefig.dpi": 150,
    "svg.hashsalt": "ptproof", "svg.fonttype": "path",
}  # fmt: skip


def new_figure(rows: int = 1, columns: int = 1, size: tuple[float, float] = (5.0, 3.6), **options: Any) -> Any:
    """A figure and its axes in the house style, without touching Matplotlib's global state."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, columns, **options)
    return figure, axes


def save(figure: Any, path: str | Path) -> None:
    """Write a figure as .png, .svg or .pdf, without dates, so that the same figure gives the same bytes."""
    import matplotlib

    file = Path(path)
    metadata: dict[str, Any] = {".svg": {"Date": None}, ".png": {"Software": None}}.get(
        file.suffix.lower(), {"CreationDate": None, "Producer": None, "Creator": None}
    )
    with _placed(figure, file.suffix.lower()[1:]), matplotlib.rc_context(_STYLE):
        figure.savefig(file, metadata=metadata)


def png(figure: Any) -> bytes:
    """The figure as PNG bytes."""
    return _drawn(figure, "png", {"Software": None})


def svg(figure: Any) -> bytes:
    """The figure as SVG bytes that follow light and dark, with letters as outlines, to a hundredth of a point."""
    dark = "".join(f"--c{light[1:]}:{other};" for light, other in DARK.items())
    style = f"@media (prefers-color-scheme:dark){{svg{{{dark}fill:{DARK['#000000']}}}}}"
    with _placed(figure, "svg"):
        text = _drawn(figure, "svg", dict.fromkeys(("Date", "Creator", "Format", "Type"))).decode()
    text = re.sub(r"^.*?(?=<svg)|<!--.*?-->|<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r' (?:d|x|y)="[^"]+"', lambda part: _NUMBER.sub(_rounded, part[0]), re.sub(r"\s*\n\s*", "\n", text))
    text = re.sub(r"#[0-9a-f]{6}\b", lambda hue: f"var(--c{hue[0][1:]},{hue[0]})" if hue[0] in DARK else hue[0], text)
    return text.replace("</style>", f"{style}</style>", 1).encode()


@contextmanager
def _placed(figure: Any, kind: str) -> Iterator[None]:
    """Meanwhile its axes stay where their layout puts them in a file of that kind.

    To find that out, Matplotlib would draw the whole figure once for nothing; the layout measures what it needs.
    """
    import matplotlib
    from matplotlib.backend_bases import get_registered_canvas_class

    layout, canvas, drawn_on = figure.get_layout_engine(), figure.canvas, get_registered_canvas_class(kind)
    if layout is None or drawn_on is None:  # nothing to lay out, or no kind that Matplotlib writes: it says so itself
        yield
        return
    with matplotlib.rc_context(_STYLE):
        drawn_on(figure)
        layout.execute(figure)
        figure.set_canvas(canvas)
    figure.set_layout_engine(None)
    try:
        yield
    finally:
        figure.set_layout_engine(layout)


def _drawn(figure: Any, kind: str, metadata: dict[str, Any]) -> bytes:
    import matplotlib

    drawn = io.BytesIO()
    with matplotlib.rc_context(_STYLE):
        figure.savefig(drawn, format=kind, metadata=metadata)
    return drawn.getvalue()


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")
