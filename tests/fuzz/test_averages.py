"""The coefficients of averaging, against a double sum over the dithers themselves."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.averaging.coefficients import v_matrix
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided
from ptproof.system import DitherSystem
from tests.fuzz import oracle
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

TAU, THETA, X = sp.symbols("tau theta x", real=True)
OMEGA, A = sp.symbols("omega a", positive=True)
SECONDS = 10.0
STEPS = 360
VALUES = {A: sp.Rational(3, 4), TAU: sp.Rational(5, 3)}

rates = st.sampled_from([1, 2, 3, 5])
phases = st.sampled_from([sp.S.Zero, sp.pi / 3, sp.pi / 2, A, sp.Rational(1, 2)])
amplitudes = st.sampled_from([sp.S.One, sp.sqrt(2), A, sp.Rational(-1, 3), 1 / (1 + TAU**2)])
waves = st.builds(
    lambda c, r, f, head: c * head(r * THETA + f), amplitudes, rates, phases, st.sampled_from([sp.sin, sp.cos])
)
switches = st.builds(
    lambda c, at, v, w: c * sp.Piecewise((v, at > THETA), (w, True)),
    amplitudes, st.sampled_from([sp.pi, sp.pi / 2, 3 * sp.pi / 2, sp.Integer(2)]),
    st.sampled_from([sp.S.One, THETA - sp.pi / 2, sp.cos(THETA), THETA**2]),
    st.sampled_from([sp.Integer(-1), sp.Rational(-1, 3), sp.pi - THETA, sp.sin(2 * THETA)]),
)  # fmt: skip
kinked = st.builds(
    lambda c, r, f: c * (sp.Abs(sp.sin(r * THETA + f)) - 2 / sp.pi), amplitudes, rates, st.sampled_from([0, sp.pi / 4])
)
signs = st.builds(
    lambda c, r, f: c * sp.sign(sp.cos(r * THETA + f)),
    amplitudes,
    rates,
    st.sampled_from([0, sp.pi / 4, sp.Rational(1, 3)]),
)
saws = st.builds(lambda c, r: c * (sp.Mod(r * THETA, 2 * sp.pi) - sp.pi), amplitudes, rates)
dithers = st.one_of(
    waves, st.builds(lambda a, b: a + b, waves, waves), st.builds(lambda a, b: a * b, waves, waves),
    st.builds(lambda a: a**3, waves),
    switches, kinked, signs, saws, st.builds(lambda a, b: a + b, signs, waves),
)  # fmt: skip


@given(st.lists(dithers, min_size=2, max_size=3), st.booleans())
@fuzz(2)
def test_coefficients_are_the_double_integrals(chosen: list[Any], shifted: bool) -> None:
    if shifted:  # so that more have zero mean
        chosen = [u - _mean(u) if not u.free_symbols & {TAU, A} else u for u in chosen]
    system = DitherSystem(TAU, THETA, OMEGA, (X,), (0,), ((1,),) * len(chosen), tuple(chosen))
    try:
        found = or_nothing(SECONDS, v_matrix, system)
    except (AveragingRefused, AveragingUndecided):
        return
    if found is None:
        return
    event("answered")
    samples = [_samples(u) for u in chosen]
    for (j, i), value in found.items():
        numeric = _nested(samples[j - 1], samples[i - 1])
        exact = float(oracle.value(value, VALUES))
        assert abs(numeric - exact) < 0.1 * (1 + abs(exact)), f"v_{j},{i} of {chosen}: {numeric}, not {value}"


def _mean(dither: Any) -> Any:
    numeric = sum(_samples(dither)) / STEPS
    guesses = [sp.Rational(k, 24) for k in range(-120, 121)]
    return min(guesses, key=lambda guess: abs(float(guess) - numeric))


def _samples(dither: Any) -> list[float]:
    with MP.workdps(15):
        marks = [sp.Rational(2 * k + 1, STEPS) for k in range(STEPS)]
        return [float(oracle.value(dither, VALUES | {THETA: oracle.value(mark * sp.pi, {})})) for mark in marks]


def _nested(outer: list[float], inner: list[float]) -> float:
    step, total, running = float(2 * sp.pi) / STEPS, 0.0, 0.0
    for u, v in zip(outer, inner, strict=True):
        total += u * (running + v * step / 2)
        running += v * step
    return total / STEPS
