"""A clock is attacked when it is made; one whose maps or rates do not fit is hit."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
import sympy as sp

from ptproof.proof.attack import WrongPromise
from ptproof.transforms.clocks import capped, named_clock
from ptproof.transforms.clocks.attack import unshaken
from ptproof.transforms.clocks.named import CLOCKS

t, tau = sp.symbols("t tau", real=True)
T, k = sp.symbols("T k", positive=True)


@dataclass(frozen=True)
class Loose:
    """A clock that nobody has checked."""

    to_tau: sp.Expr
    to_t: sp.Expr
    t: sp.Symbol = t
    tau: sp.Symbol = tau
    start: sp.Expr = sp.S.Zero
    horizon: sp.Expr = T
    name: str = "loose"

    @property
    def rate(self) -> sp.Expr:
        return sp.diff(self.to_tau, self.t)

    @property
    def rate_back(self) -> sp.Expr:
        return sp.diff(self.to_t, self.tau)


WRONG = {
    "decreases": Loose(-sp.sqrt(t / (T - t)), T * tau**2 / (1 + tau**2)),
    "another inverse": Loose(t / (1 - t / T), tau / (1 + 2 * tau / T)),
    "another scale": Loose(t / (1 - t / T), tau * T / (1 + tau)),
    "starts elsewhere": Loose(1 + t / (1 - t / T), (tau - 1) / (1 + (tau - 1) / T)),
    "turns back": Loose(t * (1 - t / T), T / 2 - sp.sqrt(T**2 / 4 - T * tau)),
    "a root that is not real": Loose(sp.sqrt(t * (T - 2 * t)), tau),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_clock_is_hit(name: str) -> None:
    with pytest.raises(WrongPromise, match="is a change of time"):
        unshaken(WRONG[name])


@pytest.mark.parametrize("cap", [None, sp.Rational(3, 10), sp.Symbol("nu_min", positive=True)])
@pytest.mark.parametrize("name", CLOCKS)
def test_a_named_clock_holds(name: str, cap: sp.Expr | None) -> None:
    exponent = sp.Rational(3, 2) if name == "power" else None
    clock = named_clock(name, t, tau, start=sp.Integer(1), horizon=T, exponent=exponent)
    assert unshaken(clock if cap is None else capped(clock, cap), points=6) > 6
