"""The answer: enclosures of the best constants of a field, or a witness against them."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import field as member
from typing import Any

import sympy as sp

from ptproof.balls.rounding import decimal_down, decimal_up
from ptproof.certify.domain import Domain
from ptproof.errors import InputError
from ptproof.problem.field import Field, FieldBounds
from ptproof.proof.verdict import Verdict

NAMES = ("a1", "a2", "b1", "b2")


def distance_to(power: int) -> str:
    """A power of the distance from the source, for people."""
    return f"‖x − x*‖^{power}" if power > 1 else "‖x − x*‖"


@dataclass(frozen=True)
class Range:
    """A rigorous enclosure of a constant; an end that is not known is None.

    >>> print(Range(1 / 3, 0.5), Range(2.0))
    [0.3333333, 0.5] [2, …]
    """

    lower: float | None = None
    upper: float | None = None

    @property
    def width(self) -> float:
        """The relative width, infinite where an end is not known."""
        if self.lower is None or self.upper is None or self.lower <= 0:
            return math.inf
        return (self.upper - self.lower) / self.lower

    def to_json(self) -> dict[str, float | None]:
        """Both ends, null where not known."""
        return {"lower": self.lower, "upper": self.upper}

    def __str__(self) -> str:
        if self.lower is None and self.upper is None:
            return "not known"
        digits = 7 if self.width > 1e-6 else 12
        low = "…" if self.lower is None else f"{decimal_down(self.lower, digits).normalize():g}"
        high = "…" if self.upper is None else f"{decimal_up(self.upper, digits).normalize():g}"
        return f"[{low}, {high}]"


@dataclass(frozen=True)
class FieldWitness:
    """Why a field does not satisfy the assumption on a domain.

    ``values`` are the exact coordinates of the point, or of a ray x* + r·d along which a limit fails; ``left`` and
    ``right`` are the two sides that contradict each other. ``distance`` is a radius such that every ball of at least
    this radius fails: 0 for a failure at the source, infinity for one at infinity.
    """

    statement: str
    values: Mapping[str, str]
    left: str
    right: str
    distance: float

    def to_json(self) -> dict[str, Any]:
        """The witness as data."""
        return {"statement": self.statement, "values": dict(self.values), "left": self.left, "right": self.right}


@dataclass(frozen=True)
class FieldCertificate:
    """What is certain about the constants of eq:assumption2 and eq:assumption3 on a domain.

    Proved: the enclosures are rigorous, have the wanted relative width, and are positive. Refuted: ``witness`` says
    where or in which limit the assumption fails; ``smaller`` is the certificate up to the largest radius for which
    the search has shown that positive constants exist, None if it found none. Undecided: ``detail`` says what was
    tried; the ends that are given are rigorous all the same.
    """

    field: Field
    domain: Domain
    verdict: Verdict
    a1: Range = Range()
    a2: Range = Range()
    b1: Range = Range()
    b2: Range = Range()
    witness: FieldWitness | None = None
    smaller: FieldCertificate | None = None
    detail: str = ""
    rtol: float = 1e-3
    seconds: float = member(default=0.0, compare=False)

    @property
    def largest_radius(self) -> sp.Expr | None:
        """The largest radius for which positive constants are certified where they are not on the whole domain."""
        return None if self.smaller is None else self.smaller.domain.outer

    def field_bounds(self, digits: int = 9) -> FieldBounds:
        """Exact constants that certainly hold: the outer ends, rounded outwards to ``digits`` digits.

        Raises
        ------
        InputError
            If the verdict is not proved.
        """
        if self.verdict is not Verdict.PROVED:
            raise InputError(f"the field has no certified constants on {self.domain}: {self.verdict}")
        ends: list[sp.Expr] = []
        for end, rounded in (
            (self.a1.upper, decimal_up), (self.a2.lower, decimal_down),
            (self.b1.lower, decimal_down), (self.b2.upper, decimal_up),
        ):  # fmt: skip
            assert end is not None
            ends.append(sp.Rational(str(rounded(end, digits))))
        return FieldBounds(self.field.kappa, *ends)

    def to_json(self) -> dict[str, Any]:
        """The contract of ``ptproof bounds --json``."""
        witness = None
        if self.witness is not None:
            smaller = self.smaller and self.smaller._constants()
            radius = None if self.largest_radius is None else str(self.largest_radius)
            witness = {**self.witness.to_json(), "largest_radius": radius, "constants": smaller}
        return {"verdict": str(self.verdict), "domain": str(self.domain), **self._constants(), "witness": witness}

    def _constants(self) -> dict[str, Any]:
        return {name: getattr(self, name).to_json() for name in NAMES}

    def rows(self) -> list[tuple[str, str, str]]:
        """(name, what it is, enclosure) for each constant: on the smaller domain where they fail on this one."""
        if self.verdict is Verdict.REFUTED:
            return [] if self.smaller is None else self.smaller.rows()
        power, lower = 2 * self.field.kappa, 2 * self.field.kappa - 1
        drop, slope = f"(F(x*) − F(x)) / {distance_to(power)}", f"‖∇F(x)‖ / {distance_to(lower)}"
        meanings = {"a1": f"sup {drop}", "a2": f"inf {drop}", "b1": f"inf {slope}", "b2": f"sup {slope}"}
        return [(name, meanings[name], str(getattr(self, name))) for name in NAMES]

    @property
    def summary(self) -> str:
        """The verdict in a sentence."""
        text = f"{self.verdict} on {self.domain.readable}"
        if self.verdict is Verdict.PROVED:
            return f"{text}, each constant to a relative width of {self.rtol:g}"
        if self.witness is None:
            return f"{text}: {self.detail}"
        text += f": {self.witness.statement}"
        if self.smaller is not None:
            text += f". Positive constants are certified on {self.smaller.domain.readable}"
        return f"{text}{', ' if self.smaller else '. '}{self.detail}" if self.detail else text

    def __str__(self) -> str:
        source = ", ".join(map(str, self.field.source))
        lines = [f"F = {self.field.expression}, source ({source}), κ = {self.field.kappa}", self.summary]
        if self.witness is not None:
            lines += [f"  {name} = {value}" for name, value in self.witness.values.items()]
            lines.append(f"  {self.witness.left}, but the assumption wants {self.witness.right}")
        rows = self.rows()
        width = max((len(meaning) for _, meaning, _ in rows), default=0)
        return "\n".join(lines + [f"  {name} = {meaning:<{width}}  ∈ {text}" for name, meaning, text in rows])

    def _repr_html_(self) -> str:
        rows = ("".join(f"<td>{html.escape(text)}</td>" for text in row) for row in self.rows())
        cells = "".join(f"<tr>{row}</tr>" for row in rows)
        return f"<p>{html.escape(self.summary)}</p><table>{cells}</table>"

    def _repr_latex_(self) -> str:
        rows = [
            rf"{name[0]}_{name[1]} &\in {text}".replace("…", r"\dots").replace("not known", r"\text{not known}")
            for name, _, text in self.rows()
        ]
        return r"$\displaystyle \begin{aligned}" + r" \\ ".join(rows) + r"\end{aligned}$"

    def plot(self, path: str | None = None) -> Any:
        """A figure of both quotients along many directions, with the certified band; saved if ``path`` is given.

        The lines are sampled and show, they do not prove.
        """
        from ptproof.certify.certificate import plot_quotients

        bands = {name: getattr(self.smaller or self, name) for name in NAMES}
        return plot_quotients(self.field, self.domain, bands, f"{self.verdict} on {self.domain.readable}", path)


def plot_quotients(field: Field, domain: Domain, bands: Mapping[str, Any], title: str, path: str | None = None) -> Any:
    """Draw both quotients against ‖x − x*‖ along rays, with the enclosures of the constants as bands.

    Returns the matplotlib figure; writes it to ``path`` if that is given. Without an outer radius the picture ends
    at 10, or at ten times the inner radius.
    """
    import numpy as np
    from matplotlib.figure import Figure

    inner = float(domain.inner)
    outer = float(domain.outer) if domain.outer is not None else max(10.0, 10 * inner)
    radii = np.linspace(max(inner, outer / 400), outer, 400)
    value = sp.lambdify(field.variables, field.peak - field.expression, "numpy")
    slope = sp.lambdify(field.variables, list(field.gradient), "numpy")
    source = np.array([float(entry) for entry in field.source])
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    power = 2 * field.kappa
    with np.errstate(all="ignore"):
        for direction in _directions(field.dimension):
            points = source[:, None] + np.outer(direction, radii)
            drops = np.broadcast_to(value(*points), radii.shape)
            left.plot(radii, drops / radii**power, color="0.6", linewidth=0.6)
            parts = [np.broadcast_to(part, radii.shape) for part in slope(*points)]
            right.plot(radii, np.sqrt(sum(p**2 for p in parts)) / radii ** (power - 1), color="0.6", linewidth=0.6)
    for axis, names in ((left, ("a1", "a2")), (right, ("b2", "b1"))):
        for name, colour in zip(names, ("tab:red", "tab:blue"), strict=True):
            ends = bands[name]
            if ends.lower is not None and ends.upper is not None:
                axis.axhspan(ends.lower, ends.upper, color=colour, alpha=0.4)
                axis.axhline(ends.upper, color=colour, linewidth=1.2, label=f"{name} ∈ {ends}")
        axis.set_xlabel("‖x − x*‖")
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8)
    left.set_title(f"(F(x*) − F(x)) / ‖x − x*‖^{power}", fontsize=9)
    right.set_title(f"‖∇F(x)‖ / ‖x − x*‖^{power - 1}", fontsize=9)
    figure.suptitle(title, fontsize=10)
    if path is not None:
        figure.savefig(path, dpi=150)
    return figure


def _directions(n: int) -> list[Any]:
    import numpy as np

    if n == 1:
        return [np.array([1.0]), np.array([-1.0])]
    if n == 2:
        return [np.array([math.cos(a), math.sin(a)]) for a in np.linspace(0, 2 * math.pi, 48, endpoint=False)]
    rows = np.random.default_rng(0).normal(size=(80, n))
    return list(rows / np.linalg.norm(rows, axis=1, keepdims=True))
