"""An instrument as the pages show it: formulas in the paper's letters, values at the first positions, links."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.statement import Relation
from ptproof.report.formula import Line, latex, statement_lines
from ptproof.report.instruments.instrument import (
    Condition,
    Curve,
    Instrument,
    Plot,
    Quantity,
    Region,
    Vehicle,
    sources_of,
)
from ptproof.report.instruments.taken import Slider, Taken, compared
from ptproof.report.letters import Letter, Notation
from ptproof.report.ref import Ref


@dataclass(frozen=True)
class Control:
    """A slider; numbers as floats, ``decimal`` the first one as text, ``unit`` and ``meaning`` for the label."""

    name: str
    glyph: str
    unit: str
    meaning: str
    lowest: float
    highest: float
    start: float
    logarithmic: bool
    integer: bool

    @property
    def decimal(self) -> str:
        return decimal(self.start)


@dataclass(frozen=True)
class Row:
    """A number or a condition: its formula, its value, what it needs beside, and the claim.

    ``value`` is a number, or whether a condition holds (None: not defined); ``sides`` are those of a condition.
    """

    title: str
    lines: tuple[Line, ...]
    at: tuple[str, ...]
    value: float | bool | None
    sides: tuple[float, ...]
    unit: str
    key: str
    needs: tuple[str, ...]
    needed: tuple[bool | None, ...]
    ref: Ref

    @property
    def text(self) -> str:
        """The value in words or digits."""
        if isinstance(self.value, bool) or self.value is None:
            return {True: "holds", False: "does not hold", None: "not defined"}[self.value]
        return shown(self.value)


@dataclass(frozen=True)
class Picture:
    """A plot, a region or a vehicle: axes as LaTeX with units, and what is drawn with the claims behind it."""

    kind: str
    title: str
    across: str
    up: str
    lines: tuple[tuple[str, tuple[Line, ...], tuple[str, ...]], ...]
    names: tuple[str, ...]
    refs: tuple[Ref, ...]

    @property
    def proved(self) -> bool:
        """Whether all of the claims are."""
        return all(ref.status is None or ref.status.proved for ref in self.refs)


@dataclass(frozen=True)
class View:
    """An instrument with everything that a page says of it before anything is moved."""

    instrument: Instrument
    controls: tuple[Control, ...]
    rows: tuple[Row, ...]
    pictures: tuple[Picture, ...]

    @property
    def command(self) -> str:
        """The shell command with the first positions."""
        return filled(self.instrument, {item.symbol: float(item.start) for item in self.instrument.sliders})

    @property
    def refs(self) -> tuple[Ref, ...]:
        """The claims behind it, each once."""
        found = [*(row.ref for row in self.rows), *(ref for item in self.pictures for ref in item.refs)]
        return tuple({ref.id: ref for ref in found}.values())


def filled(instrument: Instrument, values: Mapping[sp.Symbol, float]) -> str:
    """The command for positions of the sliders."""
    text = instrument.command
    for symbol, value in values.items():
        text = text.replace(f"{{{symbol.name}}}", decimal(value))
    return text


def decimal(value: float) -> str:
    """A number as JavaScript writes it, where it is neither huge nor tiny."""
    return f"{value:.15g}"


def shown(value: float) -> str:
    """A number for people, as the page's script writes it."""
    if math.isnan(value):
        return "not defined"
    if math.isinf(value):
        return f"{'−' if value < 0 else ''}∞"
    exact = Decimal(f"{value:.6g}").normalize()
    text = f"{exact:f}" if value == 0 or 1e-6 <= abs(value) < 1e21 else f"{exact:e}".replace("e+", "e")
    return text.replace("-", "−").replace("e", "·10^")


def superscript(unit: str) -> str:
    """A unit without LaTeX: m^{2} as m², m^{2κ} as m^(2κ), since no raised κ exists."""
    raised = str.maketrans("0123456789-/", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᐟ")
    unit = re.sub(r"\^(-?\d+)|\^\{([-\d/]+)\}", lambda found: (found[1] or found[2]).translate(raised), unit)
    return re.sub(r"\^\{([^{}]*)\}", r"^(\1)", unit)


def evaluated(source: sp.Basic, values: Mapping[sp.Symbol, Any]) -> float:
    """The value of an expression at exact values; NaN where it has no real one."""
    try:
        found = sp.N(source.xreplace(dict(values)), 30)
    except (TypeError, ZeroDivisionError):  # SymPy's words for a comparison of what is not real, and for Mod(x, 0)
        return math.nan
    if found in (sp.oo, -sp.oo):
        return math.inf if found == sp.oo else -math.inf
    return float(found) if found.is_real else math.nan


def decided(source: sp.Basic, values: Mapping[sp.Symbol, Any]) -> bool | None:
    """Whether a condition holds at exact values; None where a side has no real value."""
    if any(math.isnan(evaluated(side, values)) for part in source.atoms(sp.Rel) for side in part.args):
        return None
    found = source.xreplace(dict(values))
    return bool(found) if found in (sp.true, sp.false) else None


def viewed(instrument: Instrument, notation: Notation, refs: Mapping[str, Ref]) -> View:
    """An instrument with its links, in the letters of the notation.

    Raises
    ------
    InputError
        If a claim that it shows is not among those of the derivation.
    """
    missing = [source.id for source in instrument.sources if source.id not in refs]
    if missing:
        raise InputError(f"instrument {instrument.name}: {', '.join(missing)}: no claim of this derivation")
    glyphs = {**notation.glyphs, **{item.symbol: item.glyph for item in instrument.sliders if item.glyph}}
    writer = _Writer(instrument, glyphs, refs, notation.by_symbol)
    rows = tuple(writer.row(part) for part in instrument.parts if isinstance(part, Quantity | Condition))
    pictures = tuple(writer.picture(part) for part in instrument.parts if isinstance(part, Plot | Region | Vehicle))
    return View(instrument, tuple(map(writer.control, instrument.sliders)), rows, pictures)


@dataclass(frozen=True)
class _Writer:
    instrument: Instrument
    glyphs: Mapping[Any, str]
    refs: Mapping[str, Ref]
    letters: Mapping[Any, Letter]

    def control(self, slider: Slider) -> Control:
        letter = self.letters.get(slider.symbol, Letter("", "", ""))
        unit, meaning = superscript(slider.unit or letter.unit), slider.meaning or letter.meaning or slider.symbol.name
        return Control(
            slider.symbol.name, latex(slider.symbol, self.glyphs), unit, meaning, float(slider.lowest),
            float(slider.highest), float(slider.start), slider.logarithmic, bool(slider.symbol.is_integer),
        )  # fmt: skip

    def row(self, part: Quantity | Condition) -> Row:
        values, taken = self.instrument.start, part.taken
        needs = taken.needs(self.instrument.symbols)
        value: float | bool | None
        sides: tuple[float, ...] = ()
        if isinstance(part, Condition):
            value, sides = decided(part.value, values), (evaluated(taken.left, values), evaluated(taken.right, values))
        else:
            value = evaluated(part.value, values)
        return Row(
            part.title, self.lines(part), self.put(taken), value, sides, getattr(part, "unit", ""),
            getattr(part, "key", ""), tuple(self.relation(item) for item in needs),
            tuple(decided(compared(item), values) for item in needs), self.refs[taken.source.id],
        )  # fmt: skip

    def picture(self, part: Plot | Region | Vehicle) -> Picture:
        refs = {source.id: self.refs[source.id] for source in sources_of(part)}
        across = up = ""
        lines: list[tuple[str, tuple[Line, ...], tuple[str, ...]]] = []
        match part:
            case Plot(across=across, up=up):
                lines = [(curve.title, self.lines(curve), self.put(curve.taken)) for curve in part.curves]
            case Region(x=x, y=y):
                across, up = (f"{latex(axis, self.glyphs)}{self.unit(axis)}" for axis in (x, y))
                lines = [
                    (way.source.title, tuple(Line(self.relation(item)) for item in way.given), ()) for way in part.ways
                ]
        names = part.names if isinstance(part, Vehicle) else ()
        return Picture(type(part).__name__.lower(), part.title, across, up, tuple(lines), names, tuple(refs.values()))

    def lines(self, part: Quantity | Condition | Curve) -> tuple[Line, ...]:
        if isinstance(part, Condition):
            return statement_lines(part.taken.own, self.glyphs)
        return (Line(latex(getattr(part.taken.own, part.side), self.glyphs)),)

    def relation(self, item: Relation) -> str:
        return " ".join(line.latex for line in statement_lines(item, self.glyphs))

    def put(self, taken: Taken) -> tuple[str, ...]:
        return tuple(rf"{latex(letter, self.glyphs)} = {latex(value, self.glyphs)}" for letter, value in taken.at)

    def unit(self, symbol: sp.Symbol) -> str:
        unit = self.letters.get(symbol, Letter("", "", "")).unit
        return rf"\ \text{{in {superscript(unit)}}}" if unit and unit != "1" else ""
