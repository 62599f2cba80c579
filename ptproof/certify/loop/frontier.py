"""How far guarantees reach: the smallest ω, or the largest start, for which one is found.

What is found is a certificate, with all that it says. What is not found is nothing: neither that there is no guarantee
beyond, nor anything about vehicles there. Whether something is proved need not change just once along the way, so the
search shows all that it tried.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.certify.loop.certify import certify_loop, start_distance
from ptproof.problem import Problem
from ptproof.proof.verdict import Verdict

_STEP = 2.0
_STEPS = 12
_DIGITS = 3
OMEGA, START = "omega", "start_radius"


@dataclass(frozen=True)
class Try:
    """A certificate that was tried at a value of what is varied."""

    value: sp.Rational
    certificate: LoopCertificate

    @property
    def proved(self) -> bool:
        """Whether it is one."""
        return self.certificate.verdict is Verdict.PROVED


@dataclass(frozen=True)
class Frontier:
    """The values that were tried, in the order in which they were.

    Attributes
    ----------
    varied
        ``OMEGA``, of which the smallest value is looked for, or ``START``, of which it is the largest.
    tries
        What was found at each value.
    """

    varied: str
    tries: tuple[Try, ...]

    @property
    def best(self) -> Try | None:
        """The farthest value at which a bound was proved; None where none was."""
        proved = [item for item in self.tries if item.proved]
        return max(proved, key=self._far, default=None)

    @property
    def beyond(self) -> Try | None:
        """The nearest value beyond the best one at which none was found."""
        best = self.best
        failed = [
            item for item in self.tries if not item.proved and (best is None or self._far(item) > self._far(best))
        ]
        return min(failed, key=self._far, default=None)

    def _far(self, item: Try) -> float:
        return -float(item.value) if self.varied == OMEGA else float(item.value)

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        best, beyond = self.best, self.beyond
        return {
            "varied": self.varied,
            "proved_at": None if best is None else float(best.value),
            "nothing_found_at": None if beyond is None else float(beyond.value),
            "certificate": None if best is None else best.certificate.to_json(),
            "tries": [
                {"value": float(item.value), "verdict": str(item.certificate.verdict), "final": item.certificate.final,
                 "detail": item.certificate.detail}
                for item in self.tries
            ],
        }  # fmt: skip


def smallest_omega(problem: Problem, radius: Any = None, *, closeness: float = 1.05, **options: Any) -> Frontier:
    """The smallest ω for which a bound is proved, with μω as in the problem, so that μ goes along.

    ``radius`` and ``options`` are those of :func:`certify_loop`; neighbouring values, one proved and one not, are at
    most a factor ``closeness`` apart (or three digits).
    """
    turns = problem.tuning.mu * problem.tuning.omega

    def attempt(value: sp.Rational) -> LoopCertificate:
        tuning = replace(problem.tuning, omega=value, mu=turns / value)
        return certify_loop(replace(problem, tuning=tuning), radius, **options)

    return Frontier(OMEGA, _searched(attempt, problem.tuning.omega, 1 / _STEP, closeness))


def largest_start(problem: Problem, radius: Any = None, *, closeness: float = 1.05, **options: Any) -> Frontier:
    """The largest |x(t₀) − x*| for which a bound is proved, looked for from ``radius`` on; the rest as above."""
    first = start_distance(problem) if radius is None else sp.sympify(radius)
    return Frontier(START, _searched(partial(certify_loop, problem, **options), first, _STEP, closeness))


def _searched(
    attempt: Callable[[Any], LoopCertificate], first: Any, harder: float, closeness: float
) -> tuple[Try, ...]:
    """By steps of a factor away from the first value until the verdict changes, then by halves of what is between."""
    tries = [Try(first, attempt(first))]
    factor = harder if tries[0].proved else 1 / harder
    while len(tries) <= _STEPS and tries[-1].proved == tries[0].proved:
        tries.append(_tried(attempt, float(tries[-1].value) * factor))
    if tries[-1].proved == tries[0].proved:
        return tuple(tries)
    ends = {item.proved: item for item in tries[-2:]}
    while abs(math.log(float(ends[True].value) / float(ends[False].value))) > math.log(closeness):
        new = _tried(attempt, math.sqrt(float(ends[True].value) * float(ends[False].value)))
        if new.value in (ends[True].value, ends[False].value):
            break
        tries.append(new)
        ends[new.proved] = new
    return tuple(tries)


def _tried(attempt: Callable[[Any], LoopCertificate], value: float) -> Try:
    exact = sp.Rational(f"{value:.{_DIGITS}g}")
    return Try(exact, attempt(exact))
