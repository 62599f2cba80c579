"""Figures as SVG: the same bytes again, in colours that hold on white and on black."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from ptproof.simulation.drawing import DARK, new_figure, save, svg


def luminance(colour: str) -> float:
    """As WCAG 2.2 defines the relative luminance."""
    parts = np.array([int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)])
    return float([0.2126, 0.7152, 0.0722] @ np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4))


def contrast(one: str, two: str) -> float:
    low, high = sorted((luminance(one), luminance(two)))
    return (high + 0.05) / (low + 0.05)


def wave():
    figure, axes = new_figure()
    for colour in DARK:
        t = np.linspace(0, 1, 3000)
        axes.plot(t, np.sin(3000 * t), color=colour, label="sine $10^{-3}$")
    axes.legend()
    return svg(figure).decode()


@pytest.mark.parametrize("colour", sorted({*DARK} - {"#ffffff", "#b0b0b0", "#cccccc"}))
def test_a_line_can_be_seen_on_white_and_on_black(colour):
    assert contrast(colour, "#ffffff") >= 3
    assert contrast(DARK[colour], DARK["#ffffff"]) >= 4.5


def test_the_same_figure_gives_the_same_bytes_without_a_date_or_a_place():
    drawn = wave()
    assert drawn == wave()
    assert not re.search(r"\d{4}-\d{2}-\d{2}|<metadata|<!DOCTYPE|\d\.\d{3}\d* L", drawn)
    assert len(drawn) < 300_000


@pytest.mark.parametrize("kind", ["of a page", "png", "svg", "pdf"])
def test_the_layout_alone_gives_the_bytes_that_drawing_twice_gives(monkeypatch, tmp_path, kind):
    from contextlib import nullcontext

    from matplotlib.figure import Figure

    def once():
        figure, axes = new_figure()
        axes.plot([0, 1], [0, 1e6], label="sine $10^{-3}$")
        axes.set(xlabel="$t$", ylabel="distance")
        axes.legend()
        if kind == "of a page":
            return svg(figure)
        save(figure, tmp_path / f"drawn.{kind}")
        return (tmp_path / f"drawn.{kind}").read_bytes()

    draw, count = Figure.draw, []
    monkeypatch.setattr(Figure, "draw", lambda *arguments: [count.append(1), draw(*arguments)])
    found, drawn = once(), len(count)
    monkeypatch.setattr("ptproof.simulation.drawing._placed", lambda figure, kind: nullcontext())
    assert once() == found
    assert (drawn, len(count)) == (1, 3)


def test_a_figure_keeps_its_layout_for_other_formats():
    figure, axes = new_figure()
    axes.plot([0, 1], [0, 1])
    layout, canvas = figure.get_layout_engine(), figure.canvas
    svg(figure)
    assert (figure.get_layout_engine(), figure.canvas) == (layout, canvas)


def test_every_colour_has_its_partner_in_the_dark():
    root = ElementTree.fromstring(wave())
    styles = [item.get("style", "") for item in root.iter()]
    assert sum("var(--c" in style for style in styles) > len(DARK)
    assert not any(re.search(r"(?<!,)#[0-9a-f]{6}", style) for style in styles)
    (rule,) = (item.text for item in root.iter("{http://www.w3.org/2000/svg}style"))
    used = {name for style in styles for name in re.findall(r"--c\w{6}", style)}
    assert {*re.findall(r"--c\w{6}", rule.partition("@media (prefers-color-scheme:dark)")[2])} >= used
