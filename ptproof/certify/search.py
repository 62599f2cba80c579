"""The search for a certificate: the source, infinity, the four constants, and a radius that works if they fail.

Near the source, the Taylor polynomial is divided by the power of ‖x − x*‖, and the remainder is enclosed by
Lagrange's form; the orders below 2κ are proved to vanish before. Far away, the radius is inverted, and what is not a
polynomial is bounded by how it grows. In between, boxes are halved until the mean value form decides.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from ptproof.balls.ball import precision
from ptproof.balls.tape import Undefined
from ptproof.certify.attack import unshaken
from ptproof.certify.certificate import FieldCertificate, FieldWitness, Range
from ptproof.certify.domain import Domain
from ptproof.certify.evaluator import Extremum, Goal, Place, start_boxes
from ptproof.certify.quotients import Quotients
from ptproof.certify.radius import RadiusSearch
from ptproof.certify.source import degenerate_direction, source_order
from ptproof.certify.witness import Prosecutor
from ptproof.errors import InputError
from ptproof.problem.field import Field
from ptproof.problem.smooth import roughness
from ptproof.proof.verdict import Verdict
from ptproof.reading.expressions import parse
from ptproof.reading.limits import check_seconds

GOALS = {
    "a2": Goal(slope=False, largest=False),
    "b1": Goal(slope=True, largest=False),
    "a1": Goal(slope=False, largest=True),
    "b2": Goal(slope=True, largest=True),
}
BITS = 96
"""The precision of all balls."""
RADIUS_SHARE = 0.25
"""What part of the time limit may go into looking for a radius that works."""
SMALLER_SHARE = 0.25
"""What part of it may then go into the constants up to that radius."""

Progress = Callable[[str], None]


def certify_field(
    field: Field | sp.Expr | str,
    variables: Sequence[sp.Symbol | str] = (),
    source: Sequence[Any] = (),
    kappa: Any = None,
    *,
    radius: Any = None,
    annulus: tuple[Any, Any] | None = None,
    rtol: float = 1e-3,
    seconds: float = 60.0,
    progress: Progress | None = None,
) -> FieldCertificate:
    """Enclose the best constants of a field on a domain, or find a witness that there are none.

    Parameters
    ----------
    field
        A :class:`~ptproof.problem.field.Field` (then the next three are left out), or F: a smooth expression in
        ``variables`` with exact numbers, SymPy or text.
    variables, source, kappa
        n ≥ 1 symbols or their names, the n exact coordinates of x*, and κ, a positive integer; numbers or text.
    radius, annulus
        The ball ‖x − x*‖ ≤ radius, or the annulus (r, R), exact; the whole space if both are left out.
    rtol, seconds
        The wanted relative width, between 1e-9 and 1; the time after which what is not decided is left undecided.
    progress
        Called with a sentence now and then.

    Returns
    -------
    FieldCertificate
        Proved with rigorous enclosures of the supremum and infimum of (F(x*) − F(x))/‖x − x*‖^(2κ) and of
        ‖∇F(x)‖/‖x − x*‖^(2κ−1) over the domain (eq:assumption2, eq:assumption3); refuted with a witness; or
        undecided with what was tried. Raises ``InputError`` for data that make no sense.

    Examples
    --------
    >>> certificate = certify_field("5 - x1^2/2 - x2^2", ["x1", "x2"], [0, 0], 1)
    >>> print(certificate.verdict, certificate.a2)
    proved [0.4996275, 0.5000306]
    """
    began = time.perf_counter()
    field = _field(field, variables, source, kappa)
    ends = None if annulus is None else (_exact(annulus[0], "annulus"), _exact(annulus[1], "annulus"))
    domain = Domain.of(_exact(radius, "radius"), ends)
    if isinstance(rtol, bool) or not (1e-9 <= rtol <= 1):
        raise InputError(f"the relative width must be between 1e-9 and 1, but is {rtol}")
    check_seconds(seconds)
    with precision(BITS):
        return _begun(field, domain, rtol, began, seconds, progress or (lambda text: None))


def _begun(field: Field, domain: Domain, rtol: float, began: float, seconds: float, tell: Progress) -> FieldCertificate:
    """The search's answer, or why there can be none: a field without a gradient, or without enclosures."""
    detail = not_differentiable(field, domain)
    if detail is not None:
        detail = f"the field has no gradient: {detail}"
        return FieldCertificate(field, domain, Verdict.UNDECIDED, detail=detail, rtol=rtol)
    try:
        quotients = Quotients(*_drop(field), field.kappa)
    except Undefined as error:
        detail = f"the field cannot be enclosed: {error}"
        return FieldCertificate(field, domain, Verdict.UNDECIDED, detail=detail, rtol=rtol)
    search = _Search(field, domain, quotients, Prosecutor(field, quotients, domain), rtol, began, seconds, tell)
    return unshaken(search.run(), rays=1)


def not_differentiable(field: Field, domain: Domain) -> str | None:
    """Why the field is not shown to have a continuous gradient on ``domain``, jumps and kinks named; None if it has.

    The quotients are enclosed all over the domain, so that poles need no look here.
    """
    return roughness(field.expression, field.variables, 1, domain.relations(field), covered=True)


def _field(
    field: Field | sp.Expr | str, variables: Sequence[sp.Symbol | str], source: Sequence[Any], kappa: Any
) -> Field:
    if isinstance(field, Field):
        if variables or source or kappa is not None:
            raise InputError("field: a Field has its variables, source and kappa; leave them out")
        return field
    symbols = tuple(sp.Symbol(entry, real=True) if isinstance(entry, str) else entry for entry in variables)

    at = tuple(_exact(entry, f"field.source[{i}]") for i, entry in enumerate(source))
    return Field(symbols, _exact(field, "field.expression", symbols), at, _exact(kappa, "field.kappa"))


def _exact(value: Any, where: str, symbols: Sequence[sp.Symbol] = ()) -> Any:
    return parse(value, symbols, where=where) if isinstance(value, str) else value


def _drop(field: Field) -> tuple[sp.Expr, tuple[sp.Symbol, ...]]:
    """V(y) = F(x*) − F(x* + y), and y."""
    offsets = tuple(sp.Symbol(f"y{index}", real=True) for index in range(1, field.dimension + 1))
    at = {x: s + y for x, s, y in zip(field.variables, field.source, offsets, strict=True)}
    return field.peak - field.expression.subs(at, simultaneous=True), offsets


def _tolerance(rtol: float, goal: Goal) -> float:
    """How far below the best value, in relation to it, the search may stop so that the constant has the width asked.

    The width is in relation to the lower end, and the constant is a root where the search is for a squared slope.
    """
    return 0.95 * (2 * rtol / (1 + rtol) ** 2 if goal.slope else rtol / (1 + rtol))


@dataclass(frozen=True)
class _Search:
    field: Field
    domain: Domain
    quotients: Quotients
    prosecutor: Prosecutor
    rtol: float
    began: float
    seconds: float
    tell: Progress

    @property
    def deadline(self) -> float:
        return self.began + self.seconds

    def certificate(self, verdict: Verdict, **members: Any) -> FieldCertificate:
        seconds = time.perf_counter() - self.began
        return FieldCertificate(self.field, self.domain, verdict, rtol=self.rtol, seconds=seconds, **members)

    def run(self) -> FieldCertificate:
        if self.domain.has_source:
            self.tell("the order of vanishing at the source")
            try:
                witness = source_order(self.field, self.quotients, self.prosecutor) or degenerate_direction(
                    self.field, self.quotients, self.prosecutor
                )
            except Undefined as error:
                return self.certificate(Verdict.UNDECIDED, detail=f"at the source: {error}")
            if witness is not None:
                return self.refuted(replace(witness, distance=0.0))
        if self.domain.outer is None:
            self.tell("the growth far from the source")
            if witness := self.prosecutor.at_infinity():
                return self.refuted(witness)
        return self.constants()

    def constants(self) -> FieldCertificate:
        boxes = list(start_boxes(self.quotients, self.domain))
        searches = {
            name: Extremum(self.quotients, goal, boxes, _tolerance(self.rtol, goal)) for name, goal in GOALS.items()
        }
        # First each has its share of the time, then the unfinished ones have what is left.
        for round_ in (1, 2):
            open_ = [name for name, search in searches.items() if not search.finished and search.stuck is None]
            for index, name in enumerate(open_):
                self.tell(f"enclosing {name}" if round_ == 1 else f"enclosing {name} further")
                now = time.perf_counter()
                share = max(0.0, self.deadline - now) / (len(open_) - index)
                if witness := self.examine(searches[name], now + share):
                    return self.refuted(witness)
                if not searches[name].goal.largest and searches[name].search.best >= 0:
                    return self.conclude({name: searches[name]})
        return self.conclude(searches)

    def examine(self, search: Extremum, deadline: float) -> FieldWitness | None:
        """Let one search work; returns the witness if it comes upon one."""
        found: FieldWitness | None = None

        def stop(place: Place, best: float) -> bool:
            nonlocal found
            found = self.prosecutor.at_place(place, best, search.goal.slope)
            return found is not None

        search.run(deadline, None if search.goal.largest else stop)
        if found is None and search.place is not None and not search.goal.largest and search.search.best >= 0:
            stop(search.place, search.search.best)  # a search that is finished at once has not asked
        if search.stuck is not None and not search.stuck.is_limit:
            return self.prosecutor.undefined_near(search.stuck.offset()) or found
        return found

    def conclude(self, found: dict[str, Extremum]) -> FieldCertificate:
        ranges = {name: extremum.range() for name, extremum in found.items()}
        if len(found) == len(GOALS) and all(item.width <= self.rtol for item in ranges.values()):
            return self.certificate(Verdict.PROVED, **ranges)
        return self.certificate(Verdict.UNDECIDED, **ranges, detail=self.tried(found, ranges))

    def tried(self, found: dict[str, Extremum], ranges: dict[str, Range]) -> str:
        parts = []
        for name, extremum in found.items():
            if ranges[name].width <= self.rtol:
                continue
            text = f"{name} after {extremum.search.looks} boxes"
            if extremum.stuck is not None:
                text += f", no enclosure exists near x = {self.near(extremum.stuck)}"
            elif extremum.place is not None:
                text += f", relative width {ranges[name].width:.3g}, best value near x = {self.near(extremum.place)}"
            parts.append(text)
        missing = [name for name in GOALS if name not in found]
        if missing:
            parts.append(f"{', '.join(missing)} not tried")
        limit = f"{time.perf_counter() - self.began:.1f} s of {self.seconds:g} s"
        return "; ".join(parts) + f" ({limit})"

    def near(self, place: Place) -> str:
        if place.is_limit:
            away = "infinity" if place.box.outer else "the source"
            return f"{away} in the direction ({', '.join(f'{entry:.4g}' for entry in place.direction())})"
        x = [float(s) + y for s, y in zip(self.field.source, place.offset(), strict=True)]
        return f"({', '.join(f'{entry:.6g}' for entry in x)})"

    # A field that fails on the whole domain may satisfy the assumption on a smaller one.

    def refuted(self, witness: FieldWitness) -> FieldCertificate:
        if witness.distance == 0:
            detail = "This is at the source, so no ball around it works"
            return self.certificate(Verdict.REFUTED, witness=witness, detail=detail)
        self.tell("looking for a radius that works")
        deadline = time.perf_counter() + RADIUS_SHARE * self.seconds
        search = RadiusSearch(self.field, self.quotients, self.domain.inner, deadline)
        radius, how = search.run(witness.distance)
        smaller = None
        if radius is not None:
            domain = Domain(self.domain.inner, radius)
            prosecutor, began = replace(self.prosecutor, domain=domain), time.perf_counter()
            seconds = SMALLER_SHARE * self.seconds
            smaller = replace(self, domain=domain, prosecutor=prosecutor, began=began, seconds=seconds).constants()
        return self.certificate(Verdict.REFUTED, witness=witness, smaller=smaller, detail=how)
