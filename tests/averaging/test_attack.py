"""An average is attacked by quadrature and by exact derivatives; a wrong entry or coefficient is hit."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.averaging import Derived, derive
from ptproof.averaging.attack import attack_average
from ptproof.proof.attack import WrongPromise
from ptproof.system import DitherSystem

tau, theta, x, y = sp.symbols("tau theta x y", real=True)
omega, k = sp.symbols("omega k", positive=True)
F = sp.Function("F", real=True)(x, y)
FIELDS = ((sp.cos(k * F), -sp.sin(k * F)), (sp.sin(k * F), sp.cos(k * F)))
DITHERS = {
    "sines": (sp.cos(theta), sp.sin(theta)),
    "slow amplitude": (k * sp.cos(theta) / (1 + tau**2), sp.sin(theta)),
    "shifted": (sp.cos(2 * theta), sp.sin(2 * theta + k)),
}


def averaged(name: str) -> Derived:
    return derive(DitherSystem(tau, theta, omega, (x, y), (-x, 0), FIELDS, DITHERS[name]))


@pytest.mark.parametrize("name", DITHERS)
def test_an_average_holds(name: str) -> None:
    assert attack_average(averaged(name)) > 5


@pytest.mark.parametrize("name", DITHERS)
def test_a_wrong_coefficient_is_hit(name: str) -> None:
    true = averaged(name)
    wrong = {pair: value * sp.Rational(101, 100) for pair, value in true.v.items()}
    right = [
        start + (entry - start) * sp.Rational(101, 100)
        for start, entry in zip(true.dithered.drift, true.system.rhs, strict=True)
    ]
    with pytest.raises(WrongPromise, match="coefficient"):
        attack_average(replace(true, v=wrong, system=replace(true.system, rhs=tuple(right))))


@pytest.mark.parametrize("extra", [x / 1000, sp.Derivative(F, x), k])
def test_a_wrong_entry_is_hit(extra: sp.Expr) -> None:
    true = averaged("sines")
    rhs = (true.system.rhs[0], true.system.rhs[1] + extra)
    with pytest.raises(WrongPromise, match="Lie bracket"):
        attack_average(replace(true, system=replace(true.system, rhs=rhs)))
