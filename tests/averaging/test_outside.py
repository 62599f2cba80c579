"""Systems that the theorem does not cover are refused with the reason and the place; caveats are part of the result."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.averaging import AveragingRefused, DitherProblem, FastStates, average, study
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem

tau, theta = sp.symbols("tau theta", real=True)
x1, x2 = x = sp.symbols("x1:3", real=True)
z, w = sp.symbols("z w", real=True)
omega, k, T = sp.symbols("omega k T", positive=True)
F = sp.Function("F", real=True)(x1, x2)
f = sp.Function("f", real=True)(tau, x1)
s, c = sp.sin, sp.cos
GAIN = 1 / (1 + tau / T) ** 2


def seeker(factor: sp.Expr = sp.S.One, measured: sp.Expr = F, drift: sp.Expr = sp.S.Zero) -> DitherSystem:
    fields = ((factor * c(k * measured), -s(k * measured)), (s(k * measured), c(k * measured)))
    return DitherSystem(tau, theta, omega, x, (drift, 0), fields, (c(theta), s(theta)))


REFUSED = [
    ("form", seeker(sp.sqrt(omega)), "field 1"),
    ("form", seeker(drift=omega * x1), "drift"),
    ("form", replace(seeker(), dithers=(c(theta), omega * s(theta))), "dither 2"),
    ("form", seeker(drift=c(theta)), "drift"),
    ("A", seeker(sp.Abs(x1)), "field 1, entry 1"),
    ("A", seeker(measured=sp.sqrt(x1**2 + x2**2)), "field 1, entry 2"),
    ("A", seeker(measured=sp.Abs(x1) * x1), "field 1, entry 2"),
    ("A", seeker(1 / (1 - tau / T) ** 2), "dilate time first"),
    ("A", seeker(drift=1 / x2), "drift, entry 1"),
    ("B", seeker(sp.exp(tau)), "dilating time first"),
    ("B", seeker((1 + tau / T) ** 2), "dilating time first"),
    ("B", seeker(drift=tau * x1), "drift, entry 1"),
    ("C", replace(seeker(), dithers=(tau * c(theta), s(theta))), "dither 1"),
    ("D", replace(seeker(), dithers=(c(theta), s(theta) ** 2)), "dither 2"),
    ("D", replace(seeker(), period=sp.pi), "dither 1"),
    ("D", replace(seeker(), dithers=(c(theta), s(sp.sqrt(2) * theta))), "irrational"),
]


@pytest.mark.parametrize(("letter", "system", "place"), REFUSED, ids=lambda entry: str(entry)[:40])
def test_refused_with_the_place(letter: str, system: DitherSystem, place: str) -> None:
    found = study(system)
    assert found.ledger.entries[letter].verdict is Verdict.REFUTED
    assert found.system is None
    assert not found.as_expected
    assert any(refusal.startswith(f"{letter}: ") and place in refusal for refusal in found.refusals)


@pytest.mark.parametrize(
    "factor", [GAIN, c(tau), sp.exp(-tau), 1 / (2 + s(tau)), sp.tanh(tau), tau / (1 + tau**2)], ids=str
)
def test_bounded_in_time(factor: sp.Expr) -> None:
    found = study(seeker(factor))
    assert found.ledger.verdict is Verdict.PROVED
    assert found.system is not None


def test_for_all_real_times_the_gain_of_the_dilated_system_is_singular() -> None:
    found = study(DitherProblem(seeker(GAIN), start=None))
    assert found.ledger.entries["A"].verdict is Verdict.REFUTED


def test_the_start_may_be_a_symbol() -> None:
    t0 = sp.Symbol("t0", real=True)
    gain = 1 / (1 + (tau - t0) / T) ** 2
    assert study(DitherProblem(seeker(drift=x1 * gain), start=t0)).ledger.verdict is Verdict.PROVED
    assert study(DitherProblem(seeker(drift=x1 * gain))).ledger.verdict is not Verdict.PROVED


def test_a_drift_of_unknown_growth_is_a_caveat() -> None:
    found = study(seeker(drift=f))
    assert found.ledger.with_verdict(Verdict.UNDECIDED) == ("B",)
    assert found.system is not None
    assert "f(tau, x1)" in found.caveats[0]


def test_a_drift_assumed_bounded_is_none() -> None:
    assert study(DitherProblem(seeker(drift=f), bounded=(f,))).ledger.verdict is Verdict.PROVED


def test_smooth_where_it_matters() -> None:
    system = seeker(measured=sp.Abs(x1) + x2**2)
    assert study(system).system is None
    away = DitherProblem(system, region={x1: (sp.S.One, sp.S(2))})
    assert study(away).ledger.verdict is Verdict.PROVED
    across = DitherProblem(system, region={x1: (-sp.S.One, sp.S(2))})
    assert study(across).ledger.entries["A"].verdict is Verdict.REFUTED


def test_smooth_enough_is_enough() -> None:
    assert study(seeker(measured=sp.Abs(x1) ** 3)).ledger.verdict is Verdict.PROVED


def test_the_coefficients_are_given_where_only_the_fields_are_unsuitable() -> None:
    assert study(seeker(sp.Abs(x1))).v == {(2, 1): sp.Rational(1, 2)}
    assert study(replace(seeker(), period=sp.pi)).v == {}


def test_average_raises_where_a_study_refuses() -> None:
    with pytest.raises(AveragingRefused) as caught:
        average(replace(seeker(), dithers=(c(theta), s(theta) + 1)))
    assert caught.value.place == "dither 2"


def fast(*rates: sp.Expr, steady: tuple[sp.Expr, ...] | None = None) -> DitherProblem:
    measured = z
    fields = ((c(k * measured), -s(k * measured)), (s(k * measured), c(k * measured)))
    system = DitherSystem(tau, theta, omega, x, (0, 0), fields, (c(theta), s(theta)))
    return DitherProblem(system, FastStates((z, w)[: len(rates)], rates, steady))


GRADIENT = (k * sp.diff(F, x1) / 2, k * sp.diff(F, x2) / 2)
STABLE = [
    fast(F - z),
    fast(k * (F - z)),
    fast(-(z - F) - (z - F) ** 3),
    fast(-((z - F) ** 3)),
    fast(-(1 + x1**2) * (z - F)),
    fast(w - z, F - w),
    fast(w, -k * (z - F) - w),
    fast(w - z - z**3 + w**3, F - w, steady=(F, F)),
]


@pytest.mark.parametrize("problem", STABLE, ids=lambda problem: str(problem.fast.rate))
def test_fast_states_are_replaced_by_their_quasi_steady_state(problem: DitherProblem) -> None:
    found = study(problem)
    assert found.ledger.steady is not None
    assert found.ledger.steady[0] == F
    assert found.ledger.entries["F"].verdict is Verdict.PROVED
    assert found.system is not None
    assert found.system.rhs == GRADIENT


UNSTABLE = [
    ("boundary layer", fast(z - F)),
    ("boundary layer", fast(w, -k * (z - F) + w)),
    ("boundary layer", fast(w, F - z)),
    ("boundary layer", fast(x1 * (F - z))),
    ("F", fast(z**2 - 1)),
    ("F", fast(z * (1 - z**2))),
    ("F", fast(F - z**2)),
    ("F", fast(z**2 + 1 + x1**2)),
    ("F", fast(F - z, steady=(2 * F,))),
    ("form", fast(F - z + tau)),
]


@pytest.mark.parametrize(("letter", "problem"), UNSTABLE, ids=lambda entry: str(getattr(entry, "fast", entry)))
def test_unsuitable_fast_states_are_refused(letter: str, problem: DitherProblem) -> None:
    found = study(problem)
    assert found.ledger.entries[letter].verdict is Verdict.REFUTED
    assert found.system is None


def test_a_kink_in_the_fast_rate_is_still_lipschitz() -> None:
    found = study(fast(F - z + sp.Max(F - z, 0), steady=(F,)))
    assert found.ledger.entries["E"].verdict is Verdict.PROVED


def test_a_jump_in_the_fast_rate_is_not_lipschitz() -> None:
    found = study(fast(sp.sign(F - z), steady=(F,)))
    assert found.ledger.entries["E"].verdict is Verdict.REFUTED


def test_a_steady_state_that_is_not_smooth_is_refused() -> None:
    found = study(fast(sp.Abs(x1) - z))
    assert found.ledger.entries["F"].verdict is Verdict.REFUTED


def test_without_a_known_steady_state_nothing_is_claimed() -> None:
    found = study(fast(F - z - s(z) / 2))
    assert found.system is None
    assert found.ledger.entries["F"].verdict is Verdict.UNDECIDED


def test_what_fails_inside_one_hypothesis_decides_nothing_and_spares_the_others() -> None:
    # SymPy's solver meets imaginary candidates inside Max here and raises.
    found = study(fast(1 / z - sp.Max(-z, 0) + z))
    assert found.ledger.entries["F"].verdict is Verdict.UNDECIDED
    assert found.ledger.entries["D"].verdict is Verdict.PROVED
    assert found.system is None


def test_a_dither_that_vanishes_is_no_trouble() -> None:
    assert average(replace(seeker(), dithers=(c(theta), sp.S.Zero))).rhs == (0, 0)
