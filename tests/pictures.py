"""Looking at a picture: is the ink where the data say that it is, and in the right colour?"""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray
from PIL import Image

_NEAR = 70.0  # between colours, of 441 at most: lines are smoothed at their edges, and palettes are small
_PIXELS = 2


def pixels(picture: bytes | Path) -> NDArray[np.float64]:
    """The red, green and blue of each pixel, from 0 to 255: (height, width, 3)."""
    return np.asarray(Image.open(io.BytesIO(picture) if isinstance(picture, bytes) else picture).convert("RGB"), float)


def shown(picture: bytes | Path, axes: Any, x: ArrayLike, y: ArrayLike, colour: Any) -> float:
    """The share of the points (x, y) within the limits of ``axes`` at which the picture has the colour.

    ``axes`` are those of the figure that the picture was made from.
    """
    image, box = pixels(picture), axes.figure.bbox
    height, width = image.shape[:2]
    places = axes.transData.transform(np.column_stack(np.broadcast_arrays(x, y)))
    (left, bottom), (right, top) = axes.bbox.min, axes.bbox.max
    inside = (places > (left + 1, bottom + 1)).all(axis=1) & (places < (right - 1, top - 1)).all(axis=1)
    assert inside.any(), "none of the points lies within the limits of the axes"
    found = []
    for across, up in places[inside] / (box.width, box.height) * (width, height):
        column, row = int(across), int(height - up)
        around = image[
            max(row - _PIXELS, 0) : row + _PIXELS + 1, max(column - _PIXELS, 0) : column + _PIXELS + 1
        ].reshape(-1, 3)
        found.append(np.linalg.norm(around - 255 * np.array(to_rgb(colour)), axis=1).min() < _NEAR)
    return float(np.mean(found))


def ink(picture: bytes | Path, colour: Any) -> float:
    """The share of all pixels that have the colour."""
    return float(np.mean(np.linalg.norm(pixels(picture) - 255 * np.array(to_rgb(colour)), axis=2) < _NEAR))


def lines_shown(picture: bytes | Path, figure: Any) -> dict[str, float]:
    """For each curve with a name in the legend, the share of its own points that the picture shows in its colour."""
    return {
        str(line.get_label()): shown(picture, axes, line.get_xdata(), line.get_ydata(), line.get_color())
        for axes in figure.axes
        for line in axes.get_lines()
        if not str(line.get_label()).startswith("_") and line.get_transform() == axes.transData
    }
