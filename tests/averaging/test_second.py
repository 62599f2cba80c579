"""Second-order averages: coefficients, brackets and limits, against printed values and against other routes."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp

import ptproof
from ptproof.averaging import AveragingRefused, AveragingUndecided, average_to_order, derive_powered, with_powers
from ptproof.averaging.attack import attack_powered
from ptproof.averaging.problem import OMEGA, PHASE, TIME
from ptproof.averaging.words import long_words
from ptproof.errors import InputError
from ptproof.proof.attack import WrongPromise
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import Relation
from ptproof.system import DitherSystem, lie_bracket
from tests.averaging.flows import displacement, of_cosine, of_sine
from tests.averaging.test_seekers import SEEKERS as PUBLISHED

x, z1, z2, d, nu = sp.symbols("x z1 z2 d nu", real=True)
alpha, H, h, w0, wd, p, q = sp.symbols("alpha H h omega_0 omega_d p q", positive=True)
peak = sp.Symbol("peak", real=True)
F = peak - H * (z1**2 + z2**2) / 2
s, c = sp.sin(PHASE), sp.cos(PHASE)
HALF, THIRDS = sp.Rational(1, 2), sp.Rational(2, 3)


def system(state: Any, drift: Any, fields: Any, dithers: Any) -> DitherSystem:
    return DitherSystem(TIME, PHASE, OMEGA, tuple(state), tuple(drift), tuple(map(tuple, fields)), tuple(dithers))


def gradient_seeker() -> Any:
    """Todorovski and Krstic, arXiv 2307.11923, the gradient seeker in the rotating frame."""
    plain = system((z1, z2, nu), (w0 * z2, -w0 * z1, h * (F - nu)), [(0, F - nu, 0), (0, alpha, 0)], (s, c))
    return with_powers(plain, (1 - p, p))


def newton_seeker(factor: Any = d) -> Any:
    """The Newton seeker there, in d, or in ln d with ``factor`` = exp(d)."""
    fields = [(0, factor * (F - nu), 0, 0), (0, alpha, 0, 0)]
    fields.append((0, 0, (d * factor if factor == d else factor) * 8 * wd / alpha**2 * (nu - F), 0))
    drift = (w0 * z2, -w0 * z1, wd * d if factor == d else wd, h * (F - nu))
    return with_powers(system((z1, z2, d, nu), drift, fields, (s, c, c)), (1 - p, p, 2 - 2 * p), (1, 1, 2))


def unknown(count: int = 2) -> list[tuple[sp.Expr, ...]]:
    return [(sp.Function(name, real=True)(x),) for name in "fgk"[:count]]


SEEKERS: list[tuple[Any, tuple[sp.Expr, ...]]] = [
    (gradient_seeker(), (w0 * z2, -w0 * z1 - alpha * H / 2 * z2, h * (F - nu))),
    (newton_seeker(), (w0 * z2, -w0 * z1 - alpha * H / 2 * d * z2, wd * d * (1 - H * d), h * (F - nu))),
    (
        newton_seeker(sp.exp(d)),
        (w0 * z2, -w0 * z1 - alpha * H / 2 * sp.exp(d) * z2, wd * (1 - H * sp.exp(d)), h * (F - nu)),
    ),
]


@pytest.mark.parametrize(("seeker", "printed"), SEEKERS, ids=["gradient", "newton", "newton, logarithm"])
def test_printed_averages(seeker: Any, printed: tuple[sp.Expr, ...]) -> None:
    found = ptproof.average(seeker)
    assert [sp.expand(a - b) for a, b in zip(found.rhs, printed, strict=True)] == [0] * len(printed)


PRINTED = [
    ((1, 2), -HALF, 0), ((1, 3), 0, 2 - 3 * p), ((2, 3), 0, 1 - p),
    ((1, 2, 1), HALF, -p), ((1, 2, 2), 0, p - 1), ((1, 2, 3), 0, 1 - 2 * p),
    ((1, 3, 1), -sp.Rational(1, 8), 2 - 4 * p), ((1, 3, 2), 0, 1 - 2 * p), ((1, 3, 3), 0, 3 - 5 * p),
    ((2, 3, 1), 0, 1 - 2 * p), ((2, 3, 2), sp.Rational(1, 8), 0), ((2, 3, 3), 0, 2 - 3 * p),
]  # fmt: skip


def test_coefficients_and_their_powers() -> None:
    found = derive_powered(newton_seeker()).gammas
    assert found.keys() == {letters for letters, _, _ in PRINTED}
    for letters, mean, exponent in PRINTED:
        assert found[letters].mean == mean, letters
        assert sp.expand(found[letters].exponent - exponent) == 0, letters


def test_the_brackets_that_count() -> None:
    found = derive_powered(newton_seeker())
    assert found.brackets.keys() == {(1, 2), (2, 3, 2)}
    assert found.brackets[2, 3, 2] == (0, 0, -8 * H * d**2 * wd, 0)


ITERATED: dict[str, tuple[list[Any], list[Any]]] = {
    "sin, cos, cos 2": ([of_sine(1), of_cosine(1), of_cosine(2)], [s, c, sp.cos(2 * PHASE)]),
    "sin, cos 2": ([of_sine(1), of_cosine(2)], [s, sp.cos(2 * PHASE)]),
    "cos, cos 3/2, cos 5/2": (
        [of_cosine(1), of_cosine(sp.Rational(3, 2)), of_cosine(sp.Rational(5, 2))],
        [c, sp.cos(3 * PHASE / 2), sp.cos(5 * PHASE / 2)],
    ),
}


@pytest.mark.parametrize(
    ("name", "length"), [("sin, cos, cos 2", 2), *((name, 3) for name in ITERATED)], ids=lambda entry: str(entry)
)
def test_the_flow_over_a_period(name: str, length: int) -> None:
    """Σ γ [..] over all brackets of one length is what the flow does in a period at that length."""
    integrals, dithers = ITERATED[name]
    fields = unknown(len(dithers))
    period = 4 * sp.pi if "/2" in name else 2 * sp.pi
    plain = DitherSystem(TIME, PHASE, OMEGA, (x,), (0,), tuple(fields), tuple(dithers), period)
    gammas = derive_powered(with_powers(plain, [sp.Rational(1, 4)] * len(fields))).gammas
    (moved,) = displacement(fields, integrals, (x,), period, length)

    def left_over(factor: Any) -> sp.Expr:
        total = sp.S.Zero
        for letters, gamma in gammas.items():
            if len(letters) == length:
                value = lie_bracket(fields[letters[0] - 1], fields[letters[1] - 1], (x,))
                value = lie_bracket(value, fields[letters[2] - 1], (x,)) if length == 3 else value
                total += factor * gamma.mean * value[0]
        return sp.expand(moved - period * total)

    assert left_over(1) == 0
    assert left_over(3) != 0


@pytest.mark.parametrize("dithers", [(c, sp.cos(2 * PHASE)), (s, sp.cos(2 * PHASE))], ids=str)
def test_the_averages_to_any_order(dithers: Any) -> None:
    """With the power 1/2 the same brackets stand at ω^(−1/2); with 2/3 they count."""
    plain = system((x,), (0,), unknown(), dithers)
    assert average_to_order(plain, 2).averages[0] == (0,)
    second, ours = average_to_order(plain, 2).averages[1], ptproof.average(with_powers(plain, [THIRDS] * 2)).rhs
    assert second[0] != 0
    assert sp.expand(ours[0] - second[0]) == 0


def test_word_by_word() -> None:
    plain, fields = newton_seeker().plain, newton_seeker().plain.fields
    words = long_words(plain, [(1, 1, 0), (0, 2, 1), (1, 1, 1)])
    first = lie_bracket(fields[0], fields[1], plain.state)
    second = lie_bracket(lie_bracket(fields[1], fields[2], plain.state), fields[1], plain.state)
    for found, expected in ((words[1, 1, 0], [-HALF * e for e in first]), (words[0, 2, 1], [e / 8 for e in second])):
        assert [sp.expand(a - b) for a, b in zip(found, expected, strict=True)] == [0] * 4
    assert any(entry != 0 for entry in words[0, 2, 1])


def _gap(omega: float, average: Callable[[float], float]) -> float:
    """How far the solution of dx/dt = ω^(2/3) (cos ωt + (4/3) x³ cos 2ωt) and that of the average are on 0 ≤ t ≤ 1."""
    steps = int(omega * 4)
    amplitude, step, state, gap = omega ** (2 / 3), 1 / steps, 1.0, 0.0
    half = np.arange(2 * steps + 1) * (omega * step / 2)
    first, second = amplitude * np.cos(half), amplitude * 4 / 3 * np.cos(2 * half)
    for i in range(steps):
        k = 2 * i
        a = first[k] + second[k] * state**3
        b = first[k + 1] + second[k + 1] * (state + step / 2 * a) ** 3
        e = first[k + 1] + second[k + 1] * (state + step / 2 * b) ** 3
        g = first[k + 2] + second[k + 2] * (state + step * e) ** 3
        state += step / 6 * (a + 2 * b + 2 * e + g)
        gap = max(gap, abs(state - average((i + 1) * step)))
    return float(gap)


def test_the_order_of_the_gap() -> None:
    """[[1, 4x³/3], 1] = −8x, and γ = 1/8: the average is dx/dt = −x, and the gap falls as ω^(2/3 − 1)."""
    plain = system((x,), (0,), [(1,), (4 * x**3 / 3,)], (c, c))
    assert ptproof.average(with_powers(plain, [THIRDS] * 2, (1, 2))).rhs == (-x,)
    omegas = [2e2, 2e3, 2e4]
    slopes = np.polyfit(np.log(omegas), np.log([_gap(omega, lambda t: math.exp(-t)) for omega in omegas]), 1)
    assert slopes[0] == pytest.approx(-1 / 3, abs=0.04)
    assert _gap(2e3, lambda t: math.exp(-3 * t)) > 0.3  # what 1/T in place of 1/(3T) would give


REFUSED: list[tuple[str, Any, str]] = [
    ("equal frequencies", ((c, s), (THIRDS, THIRDS), (1, 1), ()), "dithers 1, 2: the average has omega**(1/3)"),
    ("some powers", ((c, s), (p, q), (1, 1), ()), "grows without bound"),
    ("depends on the power", ((c, s), (p, p), (1, 1), (Relation(p, "<=", HALF),)), "add the condition 2*p - 1 < 0"),
    ("triples grow", ((c, c), (sp.Rational(3, 4),) * 2, (1, 2), ()), "dithers 1, 1, 2: the average has omega**(1/4)"),
    ("four fields", ((c, s), (sp.Rational(3, 4),) * 2, (1, 3), ()), "brackets of 4 fields count"),
    ("mean", ((1 + c, s), (p, 1 - p), (1, 1), ()), "it has the mean 1 over a period"),
    ("time in a dither", ((TIME * c, s), (p, 1 - p), (1, 1), ()), "it depends on the time"),
    ("frequency in a dither", ((OMEGA * c, s), (p, 1 - p), (1, 1), ()), "it contains the frequency omega"),
]


@pytest.mark.parametrize(("case", "message"), [entry[1:] for entry in REFUSED], ids=[entry[0] for entry in REFUSED])
def test_refused(case: Any, message: str) -> None:
    dithers, powers, frequencies, conditions = case
    more = (*conditions, Relation(sp.S.Zero, "<", p)) if conditions else ()
    with pytest.raises(AveragingRefused) as caught:
        derive_powered(with_powers(system((x,), (0,), unknown(), dithers), powers, frequencies, more))
    assert message in str(caught.value)


def test_the_first_order_has_no_brackets_of_three() -> None:
    powered = with_powers(system((x,), (0,), unknown(), (c, c)), (THIRDS, THIRDS), (1, 2))
    with pytest.raises(AveragingRefused, match="set order = 2"):
        derive_powered(powered, 1)
    first = with_powers(system((x,), (0,), unknown(), (c, s)), (THIRDS, 1 - THIRDS))
    assert derive_powered(first, 1).system.rhs == derive_powered(first, 2).system.rhs


def test_powers_without_end_are_undecided() -> None:
    """Each word of these dithers is harmless, but as q comes near to 1 there are more and more of them."""
    square = sp.Piecewise((1, sp.pi - PHASE > 0), (-1, True))
    fields = [(1, 0), (0, sp.Function("f", real=True)(z2))]
    powered = with_powers(system((z1, z2), (0, 0), fields, (square, square)), (sp.Rational(1, 10), q))
    assert derive_powered(with_powers(powered.plain, (sp.Rational(1, 10), sp.Rational(3, 4)))).system.rhs == (0, 0)
    with pytest.raises(AveragingUndecided, match="come near to 1"):
        derive_powered(powered)


def test_commuting_fields_may_have_any_powers() -> None:
    fields = [(1, 0), (0, sp.Function("f", real=True)(z2))]
    powered = with_powers(system((z1, z2), (0, 0), fields, (c, s)), (sp.Rational(3, 4),) * 2)
    found = derive_powered(powered)
    assert found.system.rhs == (0, 0)
    assert found.gammas[1, 2].limit is None
    assert "add up to 0" in found.account[0]


@pytest.mark.parametrize(
    "powers", [(sp.S.Zero, HALF), (HALF, sp.S.One), (1 + p, HALF), (p**2, HALF), (x, HALF), (sp.sqrt(2) / 2, HALF)],
    ids=str,
)  # fmt: skip
def test_powers_that_are_none(powers: Any) -> None:
    with pytest.raises(InputError):
        with_powers(system((x,), (0,), unknown(), (c, s)), powers)


def test_dithers_with_jumps_at_another_frequency() -> None:
    square = sp.Piecewise((1, sp.pi - PHASE > 0), (-1, True))
    plain = system((x,), (0,), unknown(), (square, sp.Piecewise((-1, sp.Abs(PHASE - sp.pi) > HALF * sp.pi), (1, True))))
    one, two = (ptproof.average(with_powers(plain, (p, 1 - p), (k, k))).rhs[0] for k in (1, 2))
    assert one != 0
    assert sp.expand(one - 2 * two) == 0


def test_the_average_in_the_fixed_frame() -> None:
    """The gradient seeker as it drives, with fields that turn in time: its average, put into the turning frame."""
    turn = w0 * TIME
    ahead = (sp.cos(turn), sp.sin(turn), 0)
    fields = [tuple((F - nu) * entry for entry in ahead), tuple(alpha * entry for entry in ahead)]
    plain = system((z1, z2, nu), (0, 0, h * (F - nu)), fields, (s, c))
    rates = sp.Matrix(ptproof.average(with_powers(plain, (1 - p, p))).rhs[:2])
    frame = sp.Matrix([[sp.sin(turn), sp.cos(turn)], [-sp.cos(turn), sp.sin(turn)]])
    there = dict(zip((z1, z2), frame * sp.Matrix([z1, z2]), strict=True))
    moved = (sp.diff(frame.T, TIME) * sp.Matrix([z1, z2]) + frame.T * rates).subs(there, simultaneous=True)
    assert [vanishes(a - b) for a, b in zip(moved, SEEKERS[0][1], strict=False)] == [True, True]
    assert not vanishes(moved[1] + alpha * H / 2 * z2)


@pytest.mark.parametrize("published", PUBLISHED[:4], ids=lambda seeker: seeker.name)
def test_published_averages_of_first_order(published: Any) -> None:
    """With each power 1/2 the second order has what the first has."""
    found = ptproof.average(with_powers(published.system, [HALF] * len(published.dithers)))
    assert all(vanishes(a - b) for a, b in zip(found.rhs, published.average, strict=True))
    assert not all(vanishes(a + b) for a, b in zip(found.rhs, published.average, strict=True))


def test_the_average_is_attacked() -> None:
    true = derive_powered(newton_seeker())
    assert attack_powered(true) > 3
    wrong = [entry * sp.Rational(101, 100) for entry in true.system.rhs]
    with pytest.raises(WrongPromise):
        attack_powered(replace(true, system=replace(true.system, rhs=tuple(wrong))))
