"""Instruments as data: sliders, and what follows them, each taken from a claim."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Definition
from ptproof.report.instruments.javascript import expression
from ptproof.report.instruments.taken import Slider, Taken, compared
from ptproof.system import System


@dataclass(frozen=True)
class Quantity:
    """A number: one side of a relation of a claim.

    ``key`` is where the JSON of the instrument's command has it, with dots, and ``unit`` what it is measured in.
    """

    title: str
    taken: Taken
    side: Literal["left", "right"] = "right"
    unit: str = ""
    key: str = ""

    @property
    def value(self) -> sp.Expr:
        found: sp.Expr = getattr(self.taken.relation, self.side)
        return found


@dataclass(frozen=True)
class Condition:
    """A relation of a claim that holds at some positions of the sliders and not at others."""

    title: str
    taken: Taken

    @property
    def value(self) -> sp.Basic:
        return compared(self.taken.relation)


@dataclass(frozen=True)
class Curve:
    """One side of a relation of a claim against the variable of its plot; drawn as long as all of ``within`` hold."""

    title: str
    taken: Taken
    side: Literal["left", "right"] = "right"
    within: tuple[Taken, ...] = ()

    @property
    def value(self) -> sp.Expr:
        found: sp.Expr = getattr(self.taken.relation, self.side)
        return found

    def domain(self, symbols: Collection[sp.Symbol]) -> sp.Basic:
        """Where it is drawn: where what is assumed of these symbols holds, and all of ``within``."""
        asked = [*self.taken.needs(symbols), *(item.relation for item in self.within)]
        return sp.And(*map(compared, asked))


@dataclass(frozen=True)
class Plot:
    """Curves against one variable, which may be a slider: then its position is marked."""

    title: str
    variable: sp.Symbol
    lowest: Any
    highest: Any
    curves: tuple[Curve, ...]
    across: str
    up: str
    logarithmic: bool = False


@dataclass(frozen=True)
class Region:
    """Where in the plane of two sliders a conclusion is proved: where all that one of its ``ways`` assumes holds."""

    title: str
    x: sp.Symbol
    y: sp.Symbol
    ways: tuple[Taken, ...]

    @property
    def value(self) -> sp.Basic:
        return sp.Or(*(sp.And(*map(compared, way.given)) for way in self.ways))


@dataclass(frozen=True)
class Vehicle:
    """A system that is integrated in the page, with another beside it, such as its average.

    Attributes
    ----------
    system, beside
        In one and the same time; their parameters are sliders.
    starts
        The first value of each state, in sliders.
    edges
        Instants of that time, in order: start, where right-hand sides have kinks, end.
    clock
        The time that is shown, as an expression in that time.
    source
        Where the vehicle is to go, in the plane.
    field
        What is sought, in the position; its level is drawn.
    claims
        What says that this is the system of the paper, and this its average.
    keys
        Where the JSON of the command has the last position, and that of the system beside.
    names
        Of the two, for the reader.
    places
        The position of each in the plane, in the time and the states; left out, the first two states.
    """

    title: str
    system: System
    beside: System
    starts: Mapping[sp.Symbol, sp.Expr] = field(hash=False)
    edges: tuple[sp.Expr, ...]
    clock: sp.Expr
    source: tuple[sp.Expr, sp.Expr]
    field: sp.Expr
    claims: tuple[Claim, ...] = ()
    keys: tuple[str, str] = ("", "")
    names: tuple[str, str] = ("vehicle", "its average")
    places: tuple[tuple[sp.Expr, sp.Expr], ...] = ()

    def __post_init__(self) -> None:
        both = (self.system, self.beside)
        if self.system.time != self.beside.time or any(set(one.state) - set(self.starts) for one in both):
            raise InputError(f"{self.title}: the two systems need one time, and a start of each state")
        object.__setattr__(self, "starts", {state: sp.sympify(value) for state, value in self.starts.items()})
        object.__setattr__(self, "edges", tuple(map(sp.sympify, self.edges)))
        if not self.places:
            object.__setattr__(self, "places", tuple((one.state[0], one.state[1]) for one in both))


Part = Quantity | Condition | Plot | Region | Vehicle


@dataclass(frozen=True)
class Instrument:
    """Sliders, and what follows them.

    Attributes
    ----------
    name
        For links: small letters, digits and hyphens.
    prose
        Markdown: what is seen, and of what it is a property.
    command
        A shell command that computes the same, with ``{k}`` for the value of the slider of the symbol k.

    Raises
    ------
    InputError
        If a symbol of a part has no slider, an expression has no counterpart in JavaScript, or the command names what
        is no slider.
    """

    name: str
    title: str
    prose: str
    sliders: tuple[Slider, ...]
    parts: tuple[Part, ...]
    command: str = ""

    def __post_init__(self) -> None:
        if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", self.name):
            raise InputError(f"an instrument is named by small letters, digits and hyphens, got {self.name!r}")
        if len({slider.symbol.name for slider in self.sliders}) < len(self.sliders) or not self.sliders:
            raise InputError(f"instrument {self.name}: needs sliders, and no two of one name")
        names = {slider.symbol.name for slider in self.sliders}
        if unknown := set(re.findall(r"\{(\w+)\}", self.command)) - names:
            raise InputError(f"instrument {self.name}: the command asks for {', '.join(sorted(unknown))}, no slider")
        for part in self.parts:
            for source, variables in _expressions(part, self.symbols):
                self._check(part.title, source, variables)
            if isinstance(part, Region) and not {part.x, part.y} <= {slider.symbol for slider in self.sliders}:
                raise InputError(f"instrument {self.name}: {part.title}: both axes have to be sliders")

    def _check(self, title: str, source: sp.Basic, variables: tuple[sp.Symbol, ...]) -> None:
        known = [*(slider.symbol for slider in self.sliders), *variables]
        if missing := source.free_symbols - set(known):
            names = ", ".join(sorted(map(str, missing)))
            raise InputError(f"instrument {self.name}: {title}: no slider moves {names}")
        try:
            expression(source, dict.fromkeys(known, "v"))
        except InputError as error:
            raise InputError(f"instrument {self.name}: {title}: {error}") from None

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        return tuple(slider.symbol for slider in self.sliders)

    @property
    def start(self) -> dict[sp.Symbol, sp.Expr]:
        """The sliders' first positions."""
        return {slider.symbol: slider.start for slider in self.sliders}

    def of(self, *kinds: type[Any]) -> tuple[Any, ...]:
        """The parts of some kinds."""
        return tuple(part for part in self.parts if isinstance(part, kinds))

    @property
    def sources(self) -> tuple[Claim | Definition, ...]:
        """The claims and definitions that it shows, each once."""
        found: dict[str, Claim | Definition] = {}
        for part in self.parts:
            found |= {item.id: item for item in sources_of(part)}
        return tuple(found.values())


def sources_of(part: Part) -> tuple[Claim | Definition, ...]:
    """The claims and definitions behind a part."""
    match part:
        case Plot(curves=curves):
            return tuple(item.source for curve in curves for item in (curve.taken, *curve.within))
        case Region(ways=ways):
            return tuple(way.source for way in ways)
        case Vehicle(claims=claims):
            return claims
    return (part.taken.source,)


def expressions_of(part: Part) -> tuple[str, ...]:
    """What is drawn, as text: curves, the condition of a region, the rates of a vehicle and of what is beside it."""
    match part:
        case Plot(curves=curves):
            return tuple(str(curve.value) for curve in curves)
        case Vehicle(system=system, beside=beside):
            return tuple(str(rate) for rate in (*system.rhs, *beside.rhs))
    return (str(part.value),)


def _expressions(part: Part, symbols: tuple[sp.Symbol, ...]) -> Iterator[tuple[sp.Basic, tuple[sp.Symbol, ...]]]:
    """Every expression of a part that is printed, with the variables that it has beside the sliders."""
    match part:
        case Quantity() | Condition():
            yield part.value, ()
        case Plot(variable=variable):
            yield from ((sp.sympify(end), ()) for end in (part.lowest, part.highest))
            for curve in part.curves:
                yield from ((item, (variable,)) for item in (curve.value, curve.domain({*symbols, variable})))
        case Region():
            yield part.value, ()
        case Vehicle(system=system, beside=beside):
            for moving, place in zip((system, beside), part.places, strict=True):
                yield from ((rate, (moving.time, *moving.state)) for rate in (*moving.rhs, *place))
                yield from ((part.starts[state], ()) for state in moving.state)
            yield from ((end, ()) for end in part.edges)
            yield part.clock, (system.time,)
            yield part.field, system.state
