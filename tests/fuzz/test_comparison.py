"""Bounds of differential inequalities: their formulas solve what they are said to solve, by difference quotients."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.comparison import DampedBound, DilatedBound, LinearBound, fading_input, power_bound
from ptproof.errors import InputError
from ptproof.proof.claim import Goal
from ptproof.proof.engines.comparison import comparison
from ptproof.proof.statement import ForAll, Relation, ge, le
from ptproof.proof.verdict import Verdict
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

S, TAU = sp.symbols("s tau", real=True)
A, B = sp.symbols("a b", positive=True)
VALUES = {A: sp.Rational(3, 2), B: sp.Rational(1, 3)}
SECONDS = 4.0
STEP = MP.mpf(10) ** -20
positives = st.sampled_from([sp.S.One, sp.Rational(1, 2), sp.Integer(3), A, B, A / 2])
signed = st.sampled_from([sp.S.One, sp.Rational(-1, 2), sp.Integer(-2), A, -B, sp.S.Zero])
powers = st.sampled_from(
    [sp.S.One, sp.Integer(2), sp.Rational(3, 2), sp.Rational(1, 2), sp.Integer(3), 1 + A, 1 + 1 / (1 + B)]
)
rates = st.one_of(
    signed,
    st.builds(lambda a, b: a + b * S, signed, signed),
    st.builds(lambda a, b: a / (1 + S) ** 2 - b, signed, positives),
    st.builds(lambda a, b: a * sp.cos(b * S), signed, positives),
    st.builds(lambda a, b: a * sp.exp(-b * S), signed, positives),
    trees.expressions((S, A), functions=(sp.exp, sp.sin), powers=st.sampled_from([2, -1]), leaves=3),
)


def value(expression: Any, instant: Any, **more: Any) -> Any:
    return oracle.value(expression, VALUES | {S: instant})


def slope(expression: Any, instant: Any) -> Any:
    return (value(expression, instant + STEP) - value(expression, instant - STEP)) / (2 * STEP)


def near(left: Any, right: Any) -> bool:
    return bool(abs(left - right) <= MP.mpf(10) ** -12 * (1 + abs(left) + abs(right)))


def instants(first: Any) -> Any:
    return [oracle.value(first, VALUES) + MP.mpf(k) / 7 for k in (1, 3, 8, 20, 60)]


@given(rates, powers, positives, st.sampled_from([sp.S.Zero, sp.S.One, -B]))
@fuzz(6)
def test_a_power_bound_solves_its_equation(rate: Any, power: Any, initial: Any, start: Any) -> None:
    try:
        found = or_nothing(SECONDS, lambda: power_bound(time=S, rate=rate, power=power, initial=initial, start=start))
    except InputError:
        return
    if found is None:
        return
    try:
        assert near(value(found.bound, oracle.value(start, VALUES)), oracle.value(initial, VALUES))
    except oracle.Unsure:
        return
    for instant in instants(start):
        try:
            if value(found.denominator, instant) <= 0:
                return  # beyond its escape
            u = value(found.bound, instant)
            assert u > 0, f"{found.bound} at {instant}"
            assert near(slope(found.bound, instant), value(rate, instant) * u ** oracle.value(power, VALUES)), (
                f"{found.bound}"
            )
        except oracle.NoValue:
            return


@given(
    positives,
    st.sampled_from([1, 2, 3, sp.Rational(3, 2)]),
    positives,
    positives,
    st.sampled_from([sp.S.Zero, sp.S.One]),
)
@fuzz(6)
def test_a_damped_bound_rises_at_least_as_fast(
    damping: Any, power: Any, given_input: Any, initial: Any, start: Any
) -> None:
    try:
        found = DampedBound(S, start, initial, damping, power, given_input)
    except InputError:
        return
    h, r, zeta = (oracle.value(item, VALUES) for item in (found.damping, found.power, found.input))
    assert value(found.bound, oracle.value(start, VALUES)) >= oracle.value(initial, VALUES) - MP.mpf(10) ** -12
    for instant in instants(start):
        u = value(found.bound, instant)
        assert slope(found.bound, instant) >= -h * u**r + zeta - MP.mpf(10) ** -12 * (1 + u**r)


@given(
    positives,
    positives,
    positives,
    positives,
    st.sampled_from([sp.S.Zero, sp.S.One, sp.Rational(1, 2), sp.Rational(2, 3), A]),
)
@fuzz(6)
def test_a_dilated_bound_solves_its_equation_until_it_escapes(g: Any, h: Any, T: Any, initial: Any, sigma: Any) -> None:
    try:
        found = or_nothing(SECONDS, lambda: DilatedBound(S, sp.S.Zero, initial, T, g, h, sigma))
    except InputError:
        return
    if found is None:
        return
    G, H, horizon, s = (oracle.value(item, VALUES) for item in (g, h, T, sigma))
    escapes = sigma != 0 and G > H and oracle.value(found.excess, VALUES) >= 0
    end = oracle.value(found.escape_elapsed, VALUES) if escapes else MP.mpf(30)
    for k in (1, 5, 12, 19):
        instant = end * k / 20
        u = value(found.bound, instant)
        assert u > 0
        assert near(slope(found.bound, instant), (G / (1 + instant / horizon) ** 2 - H) * u ** (1 + s)), f"{found}"
    if escapes:
        assert near(value(found.result.denominator, end), MP.mpf(0))
    elif sigma != 0:
        assert value(found.result.denominator, MP.mpf(100)) > 0


@given(positives, positives, positives, positives)
@fuzz(3)
def test_a_fading_input_is_carried_exactly(initial: Any, damping: Any, horizon: Any, zeta: Any) -> None:
    found = fading_input(time=S, start=sp.S.Zero, initial=initial, damping=damping, horizon=horizon, input=zeta)
    assert isinstance(found, LinearBound)
    h = oracle.value(damping, VALUES)
    for instant in instants(sp.S.Zero)[:3]:
        u, forced = value(found.bound, instant), value(found.input, instant)
        assert near(slope(found.bound, instant), -h * u + forced)


V = sp.Function("V", nonnegative=True)
W = sp.Function("W", real=True)
growths = st.sampled_from(
    [lambda v: -v, lambda v: -2 * v + 1, lambda v: A * v, lambda v: -(v**2), lambda v: B - v, lambda v: sp.S.One,
    lambda v: S * v,
     lambda v: -v / (1 + S), lambda v: v ** sp.Rational(3, 2), lambda v: -sp.sqrt(v), lambda v: sp.sin(S) * v,
     lambda v: v**2,
     lambda v: -v + sp.exp(-S), lambda v: sp.Integer(-1)]
)  # fmt: skip
solutions = st.sampled_from(
    [lambda v: v * sp.exp(-S), lambda v: v * sp.exp(-2 * S) + sp.Rational(1, 2), lambda v: v * sp.exp(A * S),
    lambda v: v / (1 + v * S),
     lambda v: v + B, lambda v: v + S, lambda v: v * sp.exp(S**2 / 2), lambda v: v / (1 + S),
     lambda v: v / (1 - v * S), lambda v: v,
     lambda v: v * sp.exp(1 - sp.cos(S)), lambda v: (v + S) * sp.exp(-S), lambda v: v - S,
     lambda v: (sp.sqrt(v) - S / 2) ** 2,
     lambda v: sp.Rational(1, 2) + (v - sp.Rational(1, 2)) * sp.exp(-2 * S), lambda v: sp.S.One, lambda v: v + 1,
     lambda v: 2 * v]
)  # fmt: skip


@given(growths, solutions, st.sampled_from([V, W]), st.sampled_from([None, None, sp.S.One, A]), st.booleans())
@fuzz(6)
def test_a_bound_by_comparison_is_not_exceeded_by_the_worst_case(
    growth: Any, solution: Any, v: Any, end: Any, tight: bool
) -> None:
    first = v(sp.S.Zero)
    u = solution(first)
    domain = (ge(S, 0),) if end is None else (ge(S, 0), le(S, end))
    inequality = ForAll((S,), le(sp.Derivative(v(S), S), growth(v(S))), domain)
    known = (ge(TAU, 0),) if end is None else (ge(TAU, 0), le(TAU, end))
    bound = u.subs(S, TAU) + (0 if tight else 1)
    goal = Goal("fuzzed", Relation(v(TAU), "<=", bound), (inequality, *known))
    denominators = (1 + first * S,) if u == first / (1 + first * S) else ()
    found = or_nothing(10, lambda: comparison(goal, u, denominators=denominators))
    if found is None or found.verdict is not Verdict.PROVED:
        return
    event("answered")
    letter = sp.Dummy("v", real=True)
    rate = growth(letter)
    for begin in (MP.mpf(0), MP.mpf("0.3"), MP.mpf(2), *([] if v is V else [MP.mpf(-1)])):
        state, instant, step = begin, MP.mpf(0), MP.mpf("0.02")
        last = MP.mpf(1) if end is sp.S.One else MP.mpf("1.5")
        while instant < last - step / 2:
            try:
                state = _advanced(rate, letter, instant, state, step)
                instant += step
                limit = oracle.value(bound.subs(first, letter), VALUES | {TAU: instant, letter: begin})
            except oracle.NoValue:
                break
            if v is V and state < 0:
                break
            assert state <= limit + MP.mpf("1e-4") * (1 + abs(limit)), (
                f"{rate} from {begin} exceeds {bound} at {instant}"
            )


def _advanced(rate: Any, letter: Any, instant: Any, state: Any, step: Any) -> Any:
    """One step of the classical method of Runge and Kutta."""

    def at(dt: Any, dv: Any) -> Any:
        return oracle.value(rate, VALUES | {S: instant + dt, letter: state + dv})

    with MP.workdps(20):
        k1 = at(0, 0)
        k2 = at(step / 2, step * k1 / 2)
        k3 = at(step / 2, step * k2 / 2)
        k4 = at(step, step * k3)
        return state + step * (k1 + 2 * k2 + 2 * k3 + k4) / 6
