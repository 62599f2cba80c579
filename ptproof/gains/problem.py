"""A problem's own gains: constants certified on the ball that the average can reach, and how loose each bound is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, Undefined, ball_from, interval, largest_along
from ptproof.balls.rounding import decimal_up, up
from ptproof.balls.tape import compile_tape
from ptproof.certify import FieldCertificate, certify_field
from ptproof.errors import InputError
from ptproof.gains.answer import Gains, gains
from ptproof.gains.data import GainData
from ptproof.gains.numbers import Quantity, sign
from ptproof.gains.tight import BoundCurve, distance_from_source, tight_bound
from ptproof.problem import Problem
from ptproof.problem.drift import Drift
from ptproof.problem.field import Field, FieldBounds
from ptproof.problem.model import TIME
from ptproof.proof.verdict import Verdict

_DIGITS = 6
_INTERVALS = 512
_UNCLIPPED = sp.Rational(19, 20)
_AFTER_CLIP = ("clip.k_min_after_clip",)
_LASTING = ("asymptotic.k_min", "asymptotic.k_min_printed", *_AFTER_CLIP)


@dataclass(frozen=True)
class Study:
    """What is certain about a problem.

    Attributes
    ----------
    curve
        The certified bound of the averaged distance; it also says which ball is never left.
    certificate
        The constants of the field on that ball, or on the whole space where no ball is certified; None where
        constants were declared.
    answer
        Every condition and bound with these constants; None where there are none.
    """

    problem: Problem
    curve: BoundCurve
    certificate: FieldCertificate | None
    answer: Gains | None

    @property
    def applies(self) -> bool:
        """Whether the constants certainly hold where this average moves up to the end, or were declared."""
        everywhere = self.certificate is None or self.certificate.domain.outer is None
        return everywhere or self.curve.evidence.verdict is Verdict.PROVED

    @property
    def condition(self) -> str:
        """Under which condition the constants apply along the averaged system."""
        if self.certificate is None:
            return "where the declared constants hold"
        if self.certificate.domain.outer is None:
            return "everywhere"
        where = f"within {float(self.certificate.domain.outer):.6g} of the source"
        if self.curve.evidence.verdict is not Verdict.PROVED:
            return where + ", if it stays there"
        return where + f", which is certified up to t = {self.curve.times[-1]:.6g} for this start"

    def doubt(self, key: str) -> str | None:
        """Why a condition on k for all time is not shown to suffice, None if it is; no other key has such a doubt.

        With k above it V falls wherever the gradient is not zero, which is certified on a ball. So the seeker converges
        if it starts on a level of V that lies in this ball, or in a larger one on which constants are certified too;
        after the clip it starts where the average is at t₀ + T.
        """
        level = None if self.answer is None else self.answer.data.level
        if self.answer is None or level is None or key not in _LASTING:
            return None
        problem, bounds = self.problem, self.answer.data.bounds
        if key in _AFTER_CLIP:
            start = bounds.a1 * sp.Rational(self.curve.final) ** (2 * bounds.kappa) if self.applies else sp.oo
        else:
            start = problem.peak - problem.field.value(problem.initial.x)
        if start.is_finite and (sign(level - start) >= 0 or _level_is_certified(problem, start, bounds)):
            return None
        return f"the constants hold {self.condition}, and later times are not shown to keep it there"

    @property
    def _closed(self) -> dict[str, Quantity | None]:
        keys = {"printed": "clip.residual_bound_printed", "closed_form": "clip.residual_bound"}
        return {name: None if self.answer is None else self.answer[key] for name, key in keys.items()}

    @property
    def bounds_at_end(self) -> Mapping[str, float | None]:
        """The averaged distance at t₀ + T: ``printed``, ``closed_form`` and ``tight``, None where there is none."""
        proved = self.curve.evidence.verdict is Verdict.PROVED and self.problem.tuning.nu_min is not None
        closed = {name: None if quantity is None else quantity.value for name, quantity in self._closed.items()}
        return {**closed, "tight": self.curve.final if proved else None}

    @property
    def exact_bounds_at_end(self) -> tuple[sp.Expr, ...]:
        """Those of them that certainly hold, exact; the tight one is a float that is rounded up."""
        if not self.applies:
            return ()
        closed = tuple(quantity.exact for quantity in self._closed.values() if quantity is not None)
        tight = self.bounds_at_end["tight"]
        return closed if tight is None else (*closed, sp.Rational(tight))

    def looseness(self, worst: float) -> dict[str, float | None]:
        """Each of :attr:`bounds_at_end` divided by the worst simulated distance."""
        if not worst > 0:
            return dict.fromkeys(self.bounds_at_end)
        return {name: None if value is None else value / worst for name, value in self.bounds_at_end.items()}


def study(
    problem: Problem, *, bounds: FieldBounds | None = None, radius: sp.Expr | None = None, rtol: float = 1e-3,
    **known: Any,
) -> Study:  # fmt: skip
    """Bound the averaged distance, certify the field's constants where it moves, and answer with them.

    Parameters
    ----------
    problem
        Without a ν_min the curve ends at 19/20 of the prescribed time, and nothing is said of its end.
    bounds
        Declared constants, to be used in the place of certified ones.
    radius
        Of the ball on which the constants are certified; left out, the largest certified distance.
    rtol
        Of the constants.
    known
        Further fields of :class:`GainData`, such as ``residual``, ``V0`` or ``tau_star``; they replace the problem's.

    Raises
    ------
    InputError
        If ``radius`` is smaller than the certified reach, or data contradict each other.

    Examples
    --------
    >>> from ptproof.problem import example
    >>> found = study(example("saturated"))
    >>> found.condition, found.answer["asymptotic.k_min"].exact
    ('within 2.82843 of the source, which is certified up to t = 1 for this start', 0)
    """
    until = None if problem.tuning.nu_min is not None else problem.tuning.T * _UNCLIPPED
    curve = _curve(problem, known.get("x0_norm"), until)
    if curve.evidence.verdict is Verdict.PROVED:
        reach = _rounded_up(max(curve.distances))
        if radius is None:
            radius = reach
        elif sign(radius - reach) < 0:
            raise InputError(
                f"radius must be at least {float(reach):g}, the distance that may be reached, got {radius}"
            )
    if bounds is not None:
        return Study(problem, curve, None, gains(gain_data(problem, bounds, radius, **known)))
    certificate = _certificate(problem.field, radius, rtol)
    answer = None
    if certificate.verdict is Verdict.PROVED:
        answer = gains(gain_data(problem, certificate.field_bounds(), radius, confined=True, **known))
    return Study(problem, curve, certificate, answer)


@lru_cache(maxsize=16)
def _curve(problem: Problem, x0_norm: sp.Expr | None, until: sp.Expr | None) -> BoundCurve:
    """The certified bound, once for all questions about one problem."""
    return tight_bound(problem, x0_norm, until=until)


@lru_cache(maxsize=16)
def _certificate(field: Field, radius: sp.Expr | None, rtol: float) -> FieldCertificate:
    return certify_field(field, radius=radius, rtol=rtol)


def _level_is_certified(problem: Problem, value: sp.Expr, bounds: FieldBounds) -> bool:
    """Whether {V ≤ value} lies in a ball on which the field certainly has constants; a few radii are tried."""
    for _ in range(3):
        radius = _rounded_up(float((value / bounds.a2) ** (1 / (2 * bounds.kappa))) * 1.01)
        certificate = certify_field(problem.field, radius=radius, rtol=0.1, seconds=10)
        if certificate.verdict is not Verdict.PROVED:
            return False
        bounds = certificate.field_bounds()
        if sign(bounds.a2 * radius ** (2 * bounds.kappa) - value) >= 0:
            return True
    return False


def gain_data(
    problem: Problem, bounds: FieldBounds, radius: sp.Expr | None = None, *, confined: bool = False, **known: Any
) -> GainData:
    """The problem's numbers with these constants; ``known`` replaces any of them.

    ``radius`` is that of the ball on which a bounded drift is enclosed, None for the whole space, and where
    ``confined`` says so, of the ball to which the constants are confined.
    """
    tuning, drift = problem.tuning, problem.drift
    data: dict[str, Any] = {
        "bounds": bounds, "x0_norm": distance_from_source(problem), "radius": radius if confined else None,
        "filter_error": sp.Abs(problem.field.value(problem.initial.x) - problem.measured),
        **{field.name: getattr(tuning, field.name) for field in fields(tuning)},
    }  # fmt: skip
    if "V0" in known and "x0_norm" not in known:
        data.pop("x0_norm")
    if drift.kind == "gradient":
        data["drift_matrix"] = drift.matrix
    elif drift.kind == "bounded" and known.get("drift_bound") is None:
        data["drift_bound"] = largest_drift(problem, radius)
        data["drift_bound_later"], data["drift_until_end"] = lasting_drift(problem, radius), True
    if known.get("drift_norm") is not None:
        data.pop("drift_matrix", None)
    data |= {name: value for name, value in known.items() if value is not None}
    return GainData(**data)


def largest_drift(problem: Problem, radius: sp.Expr | None) -> sp.Rational:
    """A rational upper bound of ‖f‖ on [t₀, t₀ + T] and ‖x − x*‖ ≤ radius, from the drift itself.

    The declared bound is used only where the drift has no finite enclosure there.
    """
    tuning, drift, field = problem.tuning, problem.drift, problem.field
    inside: dict[sp.Symbol, Any] = {}
    if radius is not None and radius.is_finite:
        reach = ball_from(radius)
        inside = {v: ball_from(c) + interval(-reach, reach) for v, c in zip(field.variables, field.source, strict=True)}
    for size in _sizes(drift):
        with suppress(Undefined):
            return _rounded_up(largest_along(size, inside, TIME, (tuning.t0, tuning.t0 + tuning.T), _INTERVALS))
    raise InputError(f"{problem.name}: the drift has no finite enclosure; give its bound")


def lasting_drift(problem: Problem, radius: sp.Expr | None) -> sp.Rational | None:
    """A rational upper bound of ‖f‖ for all time and ‖x − x*‖ ≤ radius, None where the whole line gives none."""
    whole = arb(0, math.inf)
    reach = whole if radius is None else interval(-ball_from(radius), ball_from(radius))
    for size in _sizes(problem.drift):
        with suppress(Undefined):
            tape = compile_tape([size], (TIME, *problem.field.variables))
            (value,) = tape.run([whole, *(ball_from(c) + reach for c in problem.source)], BALLS)
            if value.is_finite():
                return _rounded_up(up(value))
    return None


def _sizes(drift: Drift) -> list[sp.Expr]:
    """What ‖f‖ is at most: itself, and the bound that is declared, where one is."""
    norm = sp.sqrt(sp.Add(*(entry**2 for entry in drift.rate)))
    return [norm] if drift.bound is None else [norm, drift.bound]


def _rounded_up(value: float) -> sp.Rational:
    """A decimal of six digits that is at least ``value``."""
    return sp.Rational(str(decimal_up(value, _DIGITS)))
