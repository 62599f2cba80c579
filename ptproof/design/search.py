"""The search for numbers: first what the average's bound and the inputs' limits rule out, then certificates.

For each choice of k, T and ν_min, those in which fewest change first, the average's certified bound is computed; it
depends on neither ω nor μ, and a choice whose average is not within the residual is left. Then ω is raised, from where
a certificate can exist at all (its bound contains the radius 1/√ω of the vehicle's circle) to where the inputs' limits
end, until one does, and lowered again between the last two.
"""

from __future__ import annotations

import itertools
import math
import time as clock
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.balls.rounding import at_most
from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.certify.loop.certify import certify_loop
from ptproof.design.answer import NAMES, Design, Trial, numbers_of
from ptproof.design.limits import Limits, angular_peak, forward_peak, largest_gain
from ptproof.errors import InputError
from ptproof.gains import tight_bound
from ptproof.problem import Problem
from ptproof.problem.model import number, positive
from ptproof.proof.verdict import Verdict

_LADDERS = {
    "k": (1, 1.4, 2, 2.8, 4, 5.6, 8, 0.7, 0.5),
    "T": (1, 1.4, 2, 2.8, 4, 5.6, 8),
    "nu_min": (1, 0.8, 0.64, 0.5, 0.4, 0.32, 0.25, 1.25, 1.6),
}
_OMEGA_STEP, _OMEGA_MOST = 2.0, 1e7
_REFINED = 2
_COARSE, _FINE = 0.5, 0.12
_NEAR = 2.5  # a coarse bound that is farther off is not worth a fine one
_CHOICES = 60
Advance = Callable[[int, str], None]


@dataclass
class _Asked:
    """What is wanted, and what has been tried for it so far."""

    problem: Problem
    residual: sp.Expr
    limits: Limits
    free: tuple[str, ...]
    radius: sp.Expr
    gap: sp.Expr
    deadline: float
    workers: int | None
    advance: Advance
    trials: list[Trial] = field(default_factory=list)

    @property
    def late(self) -> bool:
        """Whether the time is over."""
        return clock.monotonic() > self.deadline


def design(
    problem: Problem, residual: Any, *, limits: Limits | None = None, free: Sequence[str] = ("omega", "mu"),
    radius: Any = None, filter_gap: Any = 0, time_limit: float = 600.0, workers: int | None = None,
    progress: Advance | None = None,
) -> Design:  # fmt: skip
    """Numbers with which the prescribed-time seeker's vehicle certainly is within ``residual`` of the source at t₀ + T.

    Certain is what :func:`ptproof.certify_loop` proves: for every heading and every start within ``radius``. The
    inputs' limits are kept by a bound along the whole run.

    Parameters
    ----------
    problem
        Its numbers are where the search begins; those that are not free stay.
    residual
        The distance wanted, exact and positive. [length]
    limits
        Of the inputs; none if left out.
    free
        Which of k, T, omega, mu and nu_min may change. μ, if free, is chosen so that μω stays as it is, or smaller.
    radius, filter_gap
        As for the certificate.
    time_limit
        Seconds after which the search ends with what it has. The last certificate may take longer.

    Returns
    -------
    Design
        ``proved`` with numbers, rounded to three digits before they were certified; or ``undecided``.

    Raises
    ------
    InputError
        For bad input.

    Examples
    --------
    >>> import ptproof
    >>> found = ptproof.design(ptproof.example("saturated"), "0.5", free=["mu"])
    >>> str(found.verdict), found.certificate.final <= 0.5
    ('proved', True)
    """
    begin = clock.perf_counter()
    asked = _asked(problem, residual, limits, free, radius, filter_gap, time_limit, workers, progress)
    found: tuple[Problem, LoopCertificate] | None = None
    for choice in _choices(asked):
        if asked.late:
            break
        found = _with_frequency(asked, choice)
        if found is not None:
            break
    seconds = clock.perf_counter() - begin
    if found is None:
        return Design(
            Verdict.UNDECIDED, problem, asked.residual, None, None, None, tuple(asked.trials), _why_none(asked), seconds
        )
    chosen, certificate = found
    peaks = forward_peak(chosen), angular_peak(chosen, max(certificate.distances), asked.gap)
    detail = f"{len(asked.trials)} tried; the vehicle ends within {at_most(certificate.distances[-1], 6)}"
    return Design(Verdict.PROVED, chosen, asked.residual, certificate, *peaks, tuple(asked.trials), detail, seconds)


def _asked(
    problem: Problem, residual: Any, limits: Limits | None, free: Sequence[str], radius: Any, gap: Any,
    time_limit: float, workers: int | None, progress: Advance | None,
) -> _Asked:  # fmt: skip
    if unknown := [name for name in free if name not in NAMES]:
        raise InputError(f"free: {unknown[0]!r} is not one of {', '.join(NAMES)}")
    if "nu_min" in free and problem.tuning.nu_min is None:
        raise InputError(
            "free: nu_min can be chosen where the problem has one; give seeker.nu_min a value to begin with"
        )
    limits, residual = limits or Limits(), positive(sp.sympify(residual, rational=True), "residual")
    if problem.tuning.nu_min is None and (limits.u1_max is not None or limits.u2_max is not None):
        raise InputError("u1_max, u2_max: the gain is not clipped, so that no input has a largest value; set nu_min")
    if radius is None:
        away = [(a - b) ** 2 for a, b in zip(problem.initial.x, problem.source, strict=True)]
        size = sp.sqrt(sum(away, sp.S.Zero))
    else:
        size = number(sp.sympify(radius, rational=True), "radius")
    if not 0 < time_limit < math.inf:
        raise InputError(f"time_limit: must be positive, got {time_limit}")
    gap = number(sp.sympify(gap, rational=True), "filter_gap")
    return _Asked(
        problem, residual, limits, tuple(dict.fromkeys(free)), size, gap,
        clock.monotonic() + time_limit, workers, progress or (lambda done, words: None),
    )  # fmt: skip


def rounded(value: float) -> sp.Rational:
    """An exact decimal of three digits."""
    return sp.Rational(f"{value:.3g}")


def with_numbers(problem: Problem, **numbers: sp.Expr) -> Problem:
    """The problem with other numbers in its tuning."""
    return replace(problem, tuning=replace(problem.tuning, **numbers))


def _choices(asked: _Asked) -> Iterator[Problem]:
    """The problem with other k, T and ν_min where these are free: one changed first, then two, the nearest first."""
    names = [name for name in asked.free if name in _LADDERS]
    ladders = [_LADDERS[name] for name in names]
    factors = sorted(
        itertools.product(*ladders), key=lambda row: (sum(f != 1 for f in row), sum(abs(math.log(f)) for f in row))
    )
    for factor in factors[:_CHOICES]:
        changes = {}
        for name, f in zip(names, factor, strict=True):
            given = getattr(asked.problem.tuning, name)
            changes[name] = given if f == 1 else rounded(float(given) * f)
        if not float(changes.get("nu_min", 0) or 0) > 1:
            yield with_numbers(asked.problem, **changes)


def _average_end(asked: _Asked, choice: Problem) -> float | None:
    """What the average's distance at t₀ + T certainly does not exceed."""
    if choice.tuning.nu_min is None:
        return 0.0  # the gain is infinite at T, and so is the dilated time
    curve = tight_bound(choice, asked.radius, time_limit=60)
    return curve.final if curve.evidence.verdict is Verdict.PROVED else None


def _with_frequency(asked: _Asked, choice: Problem) -> tuple[Problem, LoopCertificate] | None:
    """The choice with an ω (and μ) for which there is a certificate; None with the reasons in the trials."""
    average = _average_end(asked, choice)
    if average is None or average > float(asked.residual):
        end = (
            "no bound of the average was found"
            if average is None
            else f"the average itself ends within {average:.4g} only"
        )
        asked.trials.append(Trial(numbers_of(choice), average, None, f"{end}: another k, T or nu_min is needed"))
        asked.advance(1, "")
        return None
    failed, found = None, None
    for omega in _frequencies(asked, choice):
        if asked.late:
            break
        found = _certified(asked, _at(asked, choice, omega), average, _COARSE)
        if found is not None:
            break
        failed = omega
    if found is None:
        return None
    best = found
    for _ in range(_REFINED):
        if failed is None:
            break
        omega = rounded(math.sqrt(float(failed) * float(best[0].tuning.omega)))
        if asked.late or not failed < omega < best[0].tuning.omega:
            break
        nearer = _certified(asked, _at(asked, choice, omega), average, _COARSE)
        best, failed = (best, omega) if nearer is None else (nearer, failed)
    return _certified(asked, best[0], average, _FINE) or best


def _frequencies(asked: _Asked, choice: Problem) -> Iterator[sp.Expr]:
    """Rising values of ω, from where 1/√ω is within the residual to where the limits of the inputs end."""
    given = choice.tuning.omega
    if "omega" not in asked.free:
        yield given
        return
    most, gain = _OMEGA_MOST, largest_gain(choice)
    if gain is not sp.oo and asked.limits.u1_max is not None:
        most = min(most, (float(asked.limits.u1_max) / float(gain)) ** 2)
    if gain is not sp.oo and asked.limits.u2_max is not None:
        most = min(most, float(asked.limits.u2_max) / float(gain))
    least = 1.1 / float(asked.residual) ** 2
    if least > most:
        why = (
            f"1/sqrt(omega) is within the residual from omega = {least:.4g} on, but the limits of the inputs end at "
            f"{most:.4g}"
        )
        asked.trials.append(Trial(numbers_of(choice), None, None, why))
        return
    value = least
    while value < most:
        yield rounded(value)
        value *= _OMEGA_STEP
    yield sp.Rational(f"{math.floor(most * 1000) / 1000:.6g}") if most < 1000 else sp.Integer(math.floor(most))


def _at(asked: _Asked, choice: Problem, omega: sp.Expr) -> Problem:
    changes = {"omega": omega}
    if "mu" in asked.free:
        tuning = asked.problem.tuning
        product = float(tuning.mu * tuning.omega)
        changes["mu"] = min(tuning.mu, rounded(product / float(omega)))
    return with_numbers(choice, **changes)


def _certified(
    asked: _Asked, choice: Problem, average: float, tolerance: float
) -> tuple[Problem, LoopCertificate] | None:
    """The choice with its certificate, if it ends within the residual and keeps the limits."""
    asked.advance(1, f"omega = {float(choice.tuning.omega):.4g}, k = {float(choice.tuning.k):.3g}")
    certify = partial(certify_loop, choice, asked.radius, filter_gap=asked.gap, workers=asked.workers)
    certificate = certify(tolerance=tolerance)
    final, wanted = certificate.final, float(asked.residual)
    if tolerance > _FINE and final is not None and wanted < final < _NEAR * wanted and not asked.late:
        certificate = certify(tolerance=_FINE)
        final = certificate.final
    why: str | None
    if final is None:
        why = certificate.detail
    elif final > wanted:
        why = f"the vehicle is certain to end within {at_most(final)} only"
    else:
        peak = angular_peak(choice, max(certificate.distances), asked.gap)
        why = asked.limits.excess(forward_peak(choice), peak)
    asked.trials.append(Trial(numbers_of(choice), average, final, why or ""))
    return None if why else (choice, certificate)


def _why_none(asked: _Asked) -> str:
    """What kept the search from an answer, from the trial that came nearest."""
    fixed = [name for name in NAMES if name not in asked.free and getattr(asked.problem.tuning, name) is not None]
    hint = f"; free {', '.join(fixed)} with --free as well" if fixed else ""
    if not asked.trials:
        return f"nothing was tried within the time limit{hint}"
    ends = [trial for trial in asked.trials if trial.vehicle is not None]
    nearest = min(ends, key=lambda trial: trial.vehicle or math.inf) if ends else asked.trials[-1]
    numbers = ", ".join(f"{name} = {float(value):.4g}" for name, value in nearest.numbers.items())
    over = " when the time was over" if asked.late else ""
    return f"{len(asked.trials)} tried{over}; nearest ({numbers}): {nearest.why}{hint}"
