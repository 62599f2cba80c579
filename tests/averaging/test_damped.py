"""Dithers with jumps before filters as fast as they are: exact responses, and what cannot be had."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp

from ptproof.averaging import average_to_order, derive
from ptproof.averaging.damped import Pieces
from ptproof.averaging.expansion import Expansion
from ptproof.averaging.orders import Orders
from ptproof.averaging.problem import PHASE, DitherProblem, FastStates
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.residual import put_back
from ptproof.averaging.ring import Ring
from ptproof.proof.verdict import Verdict
from tests.averaging.orders import SQUARE, dithered, left_over

x, z, w = sp.symbols("x z w", real=True)
k, m = sp.symbols("k m", positive=True)
F = sp.Function("F", real=True)(x)
AHEAD = SQUARE.subs(PHASE, PHASE + sp.pi / 2)
SAW = PHASE / sp.pi - 2 * sp.floor(PHASE / (2 * sp.pi)) - 1
UNEVEN = sp.sign(sp.cos(PHASE) - sp.Rational(1, 3)) - 2 * sp.acos(sp.Rational(1, 3)) / sp.pi + 1


def filtered(fields: Any, dithers: Any, rates: Any, mu_omega: Any, drift: Any = 0) -> DitherProblem:
    fast = FastStates((z, w)[: len(rates)], tuple(rates))
    return DitherProblem(dithered((x,), (drift,), fields, dithers), fast, mu_omega=mu_omega)


PROBLEMS = {
    "one filter": filtered([[1], [k * z]], [AHEAD, SQUARE], [F - z], m),
    "two in parallel": filtered([[1], [z * w]], [AHEAD, SQUARE], [x**2 - z, 2 * (x - w)], sp.Rational(1, 2)),
    "two in series": filtered([[1], [z]], [AHEAD, SQUARE], [w - z, x**2 - w], m),
    "saw": filtered([[1], [z]], [SAW, SQUARE], [x**2 - z], sp.Integer(1), drift=z),
    "uneven": filtered([[1], [z]], [UNEVEN, sp.sin(PHASE)], [x - z], sp.Integer(2)),
}


@cache
def averaged(name: str) -> Orders:
    return average_to_order(PROBLEMS[name], 1)


@cache
def expanded(name: str) -> Expansion:
    """Put back and found to cancel: corrupted twins are held against it."""
    found = averaged(name).expansion
    assert put_back(found).verdict is Verdict.PROVED
    return found


@pytest.mark.parametrize("name", PROBLEMS)
def test_what_is_left_along_the_system_itself_has_the_order(name: str) -> None:
    found = averaged(name)
    assert found.evidence.verdict is Verdict.PROVED
    assert left_over(found) == pytest.approx(-0.5, abs=0.02)


def test_a_second_order_with_jumps_and_a_filter() -> None:
    found = average_to_order(filtered([[1], [k * z]], [AHEAD, SQUARE], [F - z], sp.Rational(1, 2)), 2)
    assert found.evidence.verdict is Verdict.PROVED
    assert left_over(found) == pytest.approx(-1, abs=0.02)


def test_a_filter_that_is_fast_enough_leads_to_the_lie_bracket_average() -> None:
    (mean,) = averaged("one filter").averages[0]
    (limit,) = derive(PROBLEMS["one filter"].reduced((F,))).system.rhs
    # e^(−c/m) vanishes faster than every power of m.
    assert sp.simplify(mean.replace(sp.exp, lambda _: sp.S.Zero).subs(m, 0) - limit) == 0


def test_the_average_is_that_of_the_filtered_square_wave_in_numbers() -> None:
    """ẋ = √ω f(x, z), f = u + k z v, z the filter of x: A_1 = k ⟨v (y + ∫f)⟩ with y′ = −y/m − f, periodic."""
    size, step = 4000, math.pi / 2000
    phase = (np.arange(size) + 0.5) * step
    square, force = np.sign(np.sin(phase)), np.sign(np.cos(phase)) + 4 / 3 * 2 / 7 * np.sign(np.sin(phase))
    modes = 1j * np.fft.fftfreq(size, 1 / size)
    bent = np.fft.fft(force)
    integral = np.fft.ifft(np.divide(bent, modes, out=np.zeros_like(bent), where=modes != 0)).real
    response = np.fft.ifft(-bent / (modes + 2)).real
    expected = 4 / 3 * np.mean(square * (response + integral))
    found = average_to_order(filtered([[1], [k * z]], [AHEAD, SQUARE], [x - z], sp.Rational(1, 2)), 1)
    ours = found.averages[0][0].subs({k: sp.Rational(4, 3), x: sp.Rational(2, 7)}).evalf(20)
    assert float(ours) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("part", ["means", "correctors"])
@pytest.mark.parametrize("change", [x, x * sp.exp(-sp.pi / m), sp.exp(z / m)], ids=["x", "constant", "phase"])
def test_a_corrupted_expansion_does_not_cancel(part: str, change: sp.Expr) -> None:
    found = expanded("one filter")
    twin = replace(found)
    twin.__dict__.update({name: getattr(found, name) for name in ("means", "correctors", "rest")})
    first, *others = getattr(found, part)
    twin.__dict__[part] = (tuple(entry + change.subs(z, PHASE) / 10**9 for entry in first), *others)
    assert put_back(twin).verdict is Verdict.UNDECIDED


REFUSED = {
    "a filter that swings": (filtered([[1], [z]], [AHEAD, SQUARE], [w, x - z - w], m), "in a circle"),
    "filters that may resonate": (
        filtered([[1], [z * w]], [AHEAD, SQUARE], [x - z, k * (x - w)], m), "resonance of the fast states"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_had_names_the_reason(name: str) -> None:
    problem, reason = REFUSED[name]
    with pytest.raises(AveragingUndecided, match=reason):
        average_to_order(problem, 2)


@pytest.mark.parametrize("turns", [(0,), (1,), (2,)])
@pytest.mark.parametrize("power", [0, 2])
def test_a_response_solves_its_equation_and_is_periodic(turns: tuple[int, ...], power: int) -> None:
    """On [0, 1] and [1, 3], driven by φ^n e^(aφ) on the first."""
    ring, phase = Ring(64), sp.Symbol("s", real=True)
    basis = Pieces(ring, phase, sp.Integer(3), (sp.S.Zero, sp.S.One, sp.Integer(3)), [1 / m])
    driver = (0, power, sp.S.Zero, 0, turns)
    terms = basis.response(driver, (1,))
    rate = sp.Rational(3, 2)

    def on(piece: int) -> sp.Expr:
        end = (1, 3)[piece]
        parts = (
            ring.expression(value).subs(m, 1 / rate) * phase**n * sp.exp(sum(count) * rate * (phase - end))
            for (place, n, _, _, count), value in terms
            if place == piece
        )
        return sp.Add(*parts)

    force = phase**power * sp.exp(sum(turns) * rate * (phase - 1))
    for piece, drive in ((0, force), (1, sp.S.Zero)):
        assert sp.simplify(sp.diff(on(piece), phase) - rate * on(piece) + drive) == 0
    assert abs((on(0).subs(phase, 1) - on(1).subs(phase, 1)).evalf(30)) < sp.Float("1e-25")
    assert abs((on(0).subs(phase, 0) - on(1).subs(phase, 3)).evalf(30)) < sp.Float("1e-25")
