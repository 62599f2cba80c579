"""The graph of claims as a picture: one band for each section, layers by dependence within it."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass

from ptproof.report.status import ALL, Status
from ptproof.report.templating import environment

PER_ROW = 6
BOX_WIDTH, BOX_HEIGHT = 184.0, 28.0
GAP, ROW_PITCH = 16.0, 46.0
BAND_HEAD, BAND_GAP, MARGIN = 34.0, 14.0, 12.0
_LABEL_LENGTH = 25


@dataclass(frozen=True)
class Node:
    """A claim in the graph; ``uses`` and ``corrects`` are ids."""

    id: str
    anchor: str
    title: str
    section: str
    status: Status
    uses: tuple[str, ...]
    corrects: str = ""


@dataclass(frozen=True)
class Box:
    """A node with its place; lengths in the units of the picture."""

    node: Node
    label: str
    tooltip: str
    x: float
    y: float


@dataclass(frozen=True)
class Edge:
    """A curve from a claim that is used to the one that uses it."""

    source: str
    target: str
    path: str
    correction: bool


@dataclass(frozen=True)
class Band:
    """The strip of one section."""

    title: str
    y: float
    height: float


@dataclass(frozen=True)
class Layout:
    """The picture: bands, boxes and curves."""

    width: float
    height: float
    bands: tuple[Band, ...]
    boxes: tuple[Box, ...]
    edges: tuple[Edge, ...]
    legend: tuple[Status, ...]


def layout(nodes: Sequence[Node]) -> Layout:
    """Place the nodes: sections from top to bottom, and in each the claims below those that they use.

    A layer that is wider than the picture goes on in the next row. Within a layer the claims stand near what
    they use, so that curves are short.
    """
    width = 2 * MARGIN + PER_ROW * BOX_WIDTH + (PER_ROW + 1) * GAP
    bands: list[Band] = []
    boxes: dict[str, Box] = {}
    top = MARGIN
    for section in dict.fromkeys(node.section for node in nodes):
        inside = [node for node in nodes if node.section == section]
        rows = _rows(inside)
        for number, row in enumerate(rows):
            y = top + BAND_HEAD + number * ROW_PITCH
            for node, x in zip(row, _columns(row, boxes), strict=True):
                boxes[node.id] = Box(node, _short(node.id), _tooltip(node), x, y)
        height = BAND_HEAD + len(rows) * ROW_PITCH - (ROW_PITCH - BOX_HEIGHT) + GAP
        bands.append(Band(section, top, height))
        top += height + BAND_GAP
    edges = tuple(
        Edge(other, node.id, _curve(boxes[other], boxes[node.id]), correction)
        for node in nodes
        for other, correction in [*((used, False) for used in node.uses), (node.corrects, True)]
        if other in boxes
    )
    used = {node.status for node in nodes}
    return Layout(
        width, top - BAND_GAP + MARGIN, tuple(bands), tuple(boxes.values()), edges,
        tuple(mark for mark in ALL if mark in used),
    )  # fmt: skip


def _rows(nodes: Sequence[Node]) -> list[list[Node]]:
    """The layers of one section, each cut into rows that fit."""
    import networkx as nx

    graph = nx.DiGraph()
    by_id = {node.id: node for node in nodes}
    graph.add_nodes_from(by_id)
    graph.add_edges_from((used, node.id) for node in nodes for used in node.uses if used in by_id)
    order = {node.id: place for place, node in enumerate(nodes)}
    rows: list[list[Node]] = []
    layers = [sorted(layer, key=order.__getitem__) for layer in nx.topological_generations(graph)]
    for layer in layers:
        chosen = [by_id[id] for id in layer]
        for start in range(0, len(chosen), PER_ROW):
            rows.append(chosen[start : start + PER_ROW])
    return rows


def _columns(row: Sequence[Node], placed: dict[str, Box]) -> list[float]:
    """Where the boxes of a row begin: in the columns nearest to what they use, in the order of the text."""
    wanted = []
    for place, node in enumerate(row):
        above = [placed[used].x for used in node.uses if used in placed]
        wanted.append(sum(above) / len(above) if above else _column_x(place))
    found: list[int] = []
    for place, x in enumerate(wanted):
        nearest = round((x - _column_x(0)) / (BOX_WIDTH + GAP))
        lowest = found[-1] + 1 if found else 0
        highest = PER_ROW - (len(row) - place)
        found.append(min(max(nearest, lowest), highest))
    return [_column_x(column) for column in found]


def _column_x(column: int) -> float:
    return MARGIN + GAP + column * (BOX_WIDTH + GAP)


def _curve(source: Box, target: Box) -> str:
    """From the bottom of what is used to the top of what uses it, the other way round where that stands above, and
    over the tops of the boxes within a row."""
    x1, x2 = source.x + BOX_WIDTH / 2, target.x + BOX_WIDTH / 2
    if source.y == target.y:
        y, top = source.y, source.y - 13
        return f"M{x1:.1f} {y:.1f}C{x1:.1f} {top:.1f} {x2:.1f} {top:.1f} {x2:.1f} {y:.1f}"
    down = source.y < target.y
    y1 = source.y + (BOX_HEIGHT if down else 0)
    y2 = target.y + (0 if down else BOX_HEIGHT)
    bend = max(abs(y2 - y1) / 2, 14.0) * (1 if down else -1)
    return f"M{x1:.1f} {y1:.1f}C{x1:.1f} {y1 + bend:.1f} {x2:.1f} {y2 - bend:.1f} {x2:.1f} {y2:.1f}"


def _short(id: str) -> str:
    """The last part of an id, cut where it does not fit."""
    name = id.rsplit("/", 1)[-1]
    return name if len(name) <= _LABEL_LENGTH else name[: _LABEL_LENGTH - 1] + "…"


def _tooltip(node: Node) -> str:
    return f"{node.id}: {node.title} ({node.status.word})"


def graph_svg(nodes: Sequence[Node], *, standalone: bool, page: str = "") -> str:
    """The picture as SVG.

    Parameters
    ----------
    nodes
        The claims in the order of the derivation.
    standalone
        Whether it is a file of its own, with its colours inside, or a part of a page that has them.
    page
        The address of the page that the boxes link to; empty within that page.
    """
    if not nodes:
        return ""
    template = environment(escape=True).get_template("graph.svg.j2")
    return template.render(
        plan=layout(nodes), standalone=standalone, page=html.escape(page, quote=True), box=(BOX_WIDTH, BOX_HEIGHT)
    )
