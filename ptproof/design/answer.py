"""What a design comes to: numbers with their certificate, or why there are none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.problem import Problem
from ptproof.proof.verdict import Verdict

NAMES = ("k", "T", "omega", "mu", "nu_min")


@dataclass(frozen=True)
class Trial:
    """Numbers that were tried, how far the average and the vehicle certainly end, and why they won't do (else empty).

    ``average`` and ``vehicle`` are distances at t₀ + T, None where none was proved or none was asked for.
    """

    numbers: Mapping[str, sp.Expr]
    average: float | None
    vehicle: float | None
    why: str

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        numbers = {name: decimal_text(value) for name, value in self.numbers.items()}
        return {"numbers": numbers, "average": self.average, "vehicle": self.vehicle, "why": self.why}


@dataclass(frozen=True)
class Design:
    """Numbers of a seeker whose vehicle certainly ends within a residual, or the reason why none were found.

    Attributes
    ----------
    verdict
        ``proved`` with numbers, or ``undecided``: that none were found does not say that there are none.
    problem
        With the numbers found; the problem as given where there are none.
    residual
        The distance that was wanted at t₀ + T.
    certificate
        Of the vehicle with these numbers.
    u1_peak, u2_peak
        What |u₁| and |u₂| certainly do not exceed.
    trials
        What was tried, in order.
    detail
        In words.
    """

    verdict: Verdict
    problem: Problem
    residual: sp.Expr
    certificate: LoopCertificate | None
    u1_peak: float | None
    u2_peak: float | None
    trials: tuple[Trial, ...]
    detail: str
    seconds: float

    @property
    def numbers(self) -> dict[str, sp.Expr]:
        """k, T, ω, μ and ν_min (where the gain is clipped) of the problem, exact."""
        return numbers_of(self.problem)

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        found = self.verdict is Verdict.PROVED
        exact = {name: {"exact": decimal_text(value), "value": float(value)} for name, value in self.numbers.items()}
        return {
            "verdict": str(self.verdict), "residual": {"exact": str(self.residual), "value": float(self.residual)},
            "numbers": exact if found else None, "final": self.certificate.final if self.certificate else None,
            "u1_peak": self.u1_peak, "u2_peak": self.u2_peak,
            "certificate": None if self.certificate is None else self.certificate.to_json(),
            "trials": [trial.to_json() for trial in self.trials], "detail": self.detail,
            "seconds": round(self.seconds, 3),
        }  # fmt: skip


def decimal_text(value: sp.Expr) -> str:
    """An exact number as a problem file takes it: as a decimal where it has one."""
    if isinstance(value, sp.Rational):
        decimal = f"{float(value):.15g}"
        return decimal if sp.Rational(decimal) == value else str(value)
    return str(value)


def numbers_of(problem: Problem) -> dict[str, sp.Expr]:
    """A problem's numbers by name."""
    found = {name: getattr(problem.tuning, name) for name in NAMES}
    return {name: value for name, value in found.items() if value is not None}
