"""Clocks: one that is accepted increases, and its inverse takes it back, at instants of its whole interval."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.errors import InputError
from ptproof.transforms.clocks.clock import Clock
from ptproof.transforms.clocks.made import clock_from_formula, clock_from_rate
from tests.fuzz import oracle
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

t, tau = sp.symbols("t tau", real=True)
T, A = sp.symbols("T a", positive=True)
SECONDS = 5.0
VALUES = {T: sp.Rational(3, 2), A: sp.Rational(2, 3)}
S = sp.Dummy("s")
shapes = st.sampled_from(
    [S, S**2, sp.sqrt(S), S / (1 + S), S / (T - S), -T * sp.log(1 - S / T), sp.exp(S) - 1,
    T * (1 - sp.exp(-S / T)), sp.log(1 + S),
     T * S / (T + S), T * S**2 / (1 + S**2), sp.sqrt(S / (T - S)), sp.tan(sp.pi * S / (2 * T)), sp.atan(S),
     sp.sin(S), S**3, -S,
     T * (sp.exp(S / (T - S)) - 1), sp.sinh(S), sp.asinh(S), S + S**2, (-1 + sp.sqrt(1 + 4 * S)) / 2, S - S**2,
     sp.Abs(S)]
)  # fmt: skip
factors = st.sampled_from([sp.S.One, A, sp.Integer(2), sp.Rational(1, 2), sp.S.NegativeOne, T])
horizons = st.sampled_from([T, sp.S.One, sp.oo, A])


def scaled(shape: Any, at: Any, c: Any, d: Any) -> Any:
    return c * shape.subs(S, d * at)


@given(shapes, shapes, factors, factors, factors, factors, horizons)
@fuzz(6)
def test_a_clock_that_is_accepted_is_one(forth: Any, back: Any, c: Any, d: Any, e: Any, f: Any, horizon: Any) -> None:
    to_tau, to_t = scaled(forth, t, c, d), scaled(back, tau, e, f)
    _check(lambda: Clock(t, tau, to_tau, to_t, sp.S.Zero, horizon))


@given(shapes, shapes, factors, factors, horizons, st.booleans(), st.booleans())
@fuzz(2)
def test_a_clock_that_is_made_is_one(
    first: Any, second: Any, c: Any, d: Any, horizon: Any, rate: bool, ends: bool
) -> None:
    formula = scaled(first, t, c, d) + (second.subs(S, t) if ends else 0)
    if not isinstance(formula, sp.Expr) or formula.has(sp.zoo, sp.nan):
        return
    if rate:
        formula = sp.diff(formula, t)
    make = clock_from_rate if rate else clock_from_formula
    _check(lambda: make(t, tau, formula, start=sp.S.Zero, horizon=horizon, prescribed_time=ends))


def _check(make: Any) -> None:
    try:
        clock = or_nothing(SECONDS, make)
    except InputError:
        return
    if clock is None:
        return
    event("answered")
    end = MP.mpf(20) if clock.horizon is sp.oo else oracle.value(clock.horizon, VALUES)
    before = None
    for k in range(20):
        instant = end * k / 20 if k else MP.mpf(0)
        try:
            there = oracle.value(clock.to_tau, VALUES | {t: instant})
            again = oracle.value(clock.to_t, VALUES | {tau: there})
        except oracle.Unsure:
            continue
        except oracle.NoValue as error:
            raise AssertionError(f"{clock.to_tau} or {clock.to_t} at t = {instant}: {error}") from None
        assert abs(again - instant) < MP.mpf(10) ** -20, f"{clock.to_t} does not undo {clock.to_tau} at {instant}"
        assert before is None or there > before, f"{clock.to_tau} does not increase at {instant}"
        before = there
