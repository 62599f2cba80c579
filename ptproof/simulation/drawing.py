"""A canvas with Matplotlib in one style, and pictures with the same bytes for the same data."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

# Okabe and Ito's colours, told apart with every kind of colour vision.
BLUE, ORANGE, GREEN, RED, PURPLE, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#666666"
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
    with matplotlib.rc_context(_STYLE):
        figure.savefig(file, metadata=metadata)


_COLOURS = 128


def png(figure: Any) -> bytes:
    """The figure as PNG bytes, with a palette: line drawings need no more colours, and pages stay small.

    The palette covers the colours that there are, however small the mark; the most frequent ones alone would leave
    the source's star no red.
    """
    import matplotlib
    from PIL import Image

    drawn, packed = io.BytesIO(), io.BytesIO()
    with matplotlib.rc_context(_STYLE):
        figure.savefig(drawn, format="png", metadata={"Software": None})
    covering = Image.Quantize.MAXCOVERAGE
    picture = Image.open(drawn).convert("RGB").quantize(_COLOURS, method=covering, dither=Image.Dither.NONE)
    picture.save(packed, format="png", optimize=True)
    return packed.getvalue()
