"""The script of a page of instruments: their functions, printed from the expressions, and what moves the page."""

from __future__ import annotations

import json
from collections.abc import Sequence

import sympy as sp

from ptproof.report.instruments.instrument import Condition, Instrument, Part, Plot, Quantity, Region, Vehicle
from ptproof.report.instruments.javascript import HELPERS, function
from ptproof.report.instruments.taken import compared
from ptproof.report.templating import text


def script_of(instruments: Sequence[Instrument]) -> str:
    """The whole script; it needs nothing else."""
    inside = ",\n".join(map(_instrument, instruments))
    return f'"use strict";\n(() => {{\n{HELPERS}const INSTRUMENTS = [\n{inside}\n];\n{text("instruments.js")}}})();\n'


def _object(**entries: str) -> str:
    return "{" + ", ".join(f"{name}: {value}" for name, value in entries.items()) + "}"


def _instrument(of: Instrument) -> str:
    symbols = of.symbols
    sources: list[sp.Basic] = []
    rows = []
    for part in of.parts:
        if isinstance(part, Quantity | Condition):
            first = len(sources)
            sources.append(part.value)
            sides = [part.taken.left, part.taken.right] if isinstance(part, Condition) else []
            needs = [compared(item) for item in part.taken.needs(symbols)]
            sources += [*sides, *needs]
            rows.append({"at": first, "sides": len(sides), "needs": len(needs), "holds": bool(sides)})
    sliders = [
        {"name": item.symbol.name, "lowest": float(item.lowest), "highest": float(item.highest),
         "start": float(item.start), "log": item.logarithmic, "integer": bool(item.symbol.is_integer)}
        for item in of.sliders
    ]  # fmt: skip
    pictures = ",\n".join(_picture(part, of) for part in of.parts if isinstance(part, Plot | Region | Vehicle))
    return _object(
        name=json.dumps(of.name), sliders=json.dumps(sliders), command=json.dumps(of.command), rows=json.dumps(rows),
        values=function(sources, {"s": symbols}), pictures=f"[{pictures}]",
    )  # fmt: skip


def _picture(part: Part, of: Instrument) -> str:
    symbols = of.symbols
    match part:
        case Plot(variable=variable):
            own = symbols.index(variable) if variable in symbols else -1
            stand_in = sp.Dummy("v") if own >= 0 else variable
            put = {variable: stand_in}
            drawn = [
                item.xreplace(put)
                for curve in part.curves
                for item in (curve.value, curve.domain({*symbols, variable}))
            ]
            return _object(
                kind='"plot"', own=str(own), log=json.dumps(part.logarithmic), count=str(len(part.curves)),
                range=function([sp.sympify(part.lowest), sp.sympify(part.highest)], {"s": symbols}),
                at=function(drawn, {"s": symbols, "v": stand_in}),
            )  # fmt: skip
        case Region(x=x, y=y):
            return _object(
                kind='"region"', x=str(symbols.index(x)), y=str(symbols.index(y)),
                at=function([part.value], {"s": symbols}),
            )  # fmt: skip
        case Vehicle(system=system, beside=beside, starts=starts):
            moving = {
                name: _object(
                    rate=function(one.rhs, {"t": one.time, "x": one.state, "s": symbols}),
                    start=function([starts[state] for state in one.state], {"s": symbols}),
                    place=function(place, {"t": one.time, "x": one.state, "s": symbols}),
                )
                for name, one, place in zip(("system", "beside"), (system, beside), part.places, strict=True)
            }
            return _object(
                kind='"vehicle"', **moving, edges=function(part.edges, {"s": symbols}),
                clock=function([part.clock], {"t": system.time, "s": symbols}),
                source=function(part.source, {"s": symbols}),
                field=function([part.field], {"x": system.state[:2], "s": symbols}),
            )  # fmt: skip
    raise AssertionError(part)
