"""Averages to any order: other routes to the same averages, published ones, and expansions that are corrupted."""

import itertools
import random
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
import sympy as sp

from ptproof.averaging import derive, first_correction
from ptproof.averaging.expansion import Expansion, along, normal_form
from ptproof.averaging.orders import Orders, average_to_order
from ptproof.averaging.oscillation import DELTA, Oscillation
from ptproof.averaging.problem import OMEGA, PHASE, TIME, DitherProblem, FastStates
from ptproof.averaging.residual import put_back
from ptproof.averaging.scaled import of_turning
from ptproof.proof.algebra import is_zero
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem
from tests.averaging.orders import SQUARE, TRIANGLE, dithered, finite_seeker, left_over

x, y, z = sp.symbols("x y z", real=True)
s, a, r = sp.symbols("s a r", real=True)
k, m = sp.symbols("k m", positive=True)
F = sp.Function("F", real=True)
sin, cos = sp.sin, sp.cos


def system(fields: Any, dithers: Any, drift: Any = (0, 0), period: Any = 2 * sp.pi) -> DitherSystem:
    return dithered((x, y)[: len(drift)], drift, fields, dithers, period)


F1 = F(x)
SYSTEMS = {
    "scalar seeker": system([[1], [F1]], [cos(PHASE), sin(PHASE)], [-x]),
    "three harmonics": system([[1], [F1], [x**2]], [cos(PHASE), sin(PHASE), cos(2 * PHASE)], [0]),
    "unicycle": system([[cos(y), 1], [sin(x), x * y]], [sin(PHASE), cos(PHASE + 1)], [y, -x]),
    "unknown field": system([[F(x, y), 0], [0, 1]], [cos(PHASE), sin(PHASE) + sin(2 * PHASE)], [0, -y]),
    "square waves": system([[1, y], [x, 1]], [SQUARE, SQUARE.subs(PHASE, PHASE - sp.pi / 2)]),
    "triangle": system([[1], [x**2]], [TRIANGLE, cos(2 * sp.pi * PHASE)], [0], period=1),
    "slow amplitude": system([[1], [F1]], [cos(TIME) * cos(PHASE), sin(PHASE)], [TIME]),
    "turning": system([[cos(F1), 0], [sin(F1), 1]], [cos(PHASE), sin(PHASE)]),
    "resonant thirds": system(
        [[1], [x], [F1]], [cos(PHASE / 2), sin(PHASE / 3), cos(5 * PHASE / 6) + sin(PHASE / 6)], [-x], 12 * sp.pi
    ),
    "half sine": system([[1], [x**2]], [sp.Abs(sin(PHASE / 2)) - 2 / sp.pi, SQUARE], [0]),
    "saw": system([[1], [F1]], [PHASE / sp.pi - 2 * sp.floor(PHASE / (2 * sp.pi)) - 1, sin(PHASE)], [0]),
    "quotient": system([[1 / (1 + x**2)], [x]], [cos(PHASE), sin(PHASE)], [sp.sqrt(1 + x**2)]),
}


@cache
def averaged(name: str, order: int) -> Orders:
    return average_to_order(SYSTEMS[name], order)


@cache
def sought(order: int) -> Orders:
    return average_to_order(finite_seeker(m), order)


@cache
def expanded(name: str) -> Expansion:
    """To order 2, put back and found to cancel: corrupted twins are held against it."""
    found = averaged(name, 2).expansion
    assert put_back(found).verdict is Verdict.PROVED
    return found


@pytest.mark.parametrize("name", SYSTEMS)
def test_everything_cancels_up_to_the_order(name: str) -> None:
    assert averaged(name, 2).evidence.verdict is Verdict.PROVED


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_first_order_is_the_lie_bracket_average(name: str) -> None:
    ours = averaged(name, 2).averages[0]
    brackets = derive(SYSTEMS[name]).system.rhs
    assert all(is_zero(left - right) for left, right in zip(ours, brackets, strict=True))


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_second_order_is_the_drift_of_the_first_correction(name: str) -> None:
    found = averaged(name, 2)
    drift = first_correction(SYSTEMS[name]).drift
    assert all(is_zero(left - right) for left, right in zip(found.averages[1], drift, strict=True))


def test_a_second_order_that_does_not_vanish() -> None:
    """With cos and sin alone it does, so that the comparison above would not see a sign."""
    assert averaged("three harmonics", 2).averages[1] != (0,)


@pytest.mark.parametrize("name", ["three harmonics", "square waves", "triangle", "slow amplitude", "turning"])
@pytest.mark.parametrize("order", [1, 3])
def test_what_is_left_along_the_system_itself_has_the_order(name: str, order: int) -> None:
    """By high precision numbers in the letters of the system, apart from the exact check."""
    assert left_over(averaged(name, order)) == pytest.approx(-order / 2, abs=0.02)


@pytest.mark.parametrize("order", [1, 2])
def test_what_is_left_with_a_filter_has_the_order(order: int) -> None:
    assert left_over(sought(order)) == pytest.approx(-order / 2, abs=0.02)


def test_the_finite_filter_turns_the_gradient() -> None:
    found = sought(1)
    slope = [sp.diff(F(x, y), symbol) for symbol in (x, y)]
    wanted = [
        sp.Function("d1", real=True)(TIME, x, y) + k * (slope[0] - m * slope[1]) / (2 * (1 + m**2)),
        sp.Function("d2", real=True)(TIME, x, y) + k * (slope[1] + m * slope[0]) / (2 * (1 + m**2)),
    ]
    assert all(is_zero(left - right) for left, right in zip(found.averages[0], wanted, strict=True))


FILTERS = {
    "first order": (FastStates((z,), (F(x, y) - z,)), (z,)),
    "two poles": (FastStates((z, a), (a - z, F(x, y) - a)), (z,)),
    "oscillating": (FastStates((z, a), (a, F(x, y) - z - a)), (z,)),
    "two filters": (FastStates((z, a), (F(x, y) - z, k * (x * y - a))), (z, a)),
}


@pytest.mark.parametrize("name", FILTERS)
def test_a_fast_filter_leads_to_the_lie_bracket_average(name: str) -> None:
    """The limit m → 0 for other filters and other fields than the seeker's."""
    fast, outputs = FILTERS[name]
    first, second = outputs[0], outputs[-1]
    seeker = system([[cos(first), second], [sin(first), x]], [cos(PHASE), sin(PHASE) + cos(2 * PHASE)], [y, first])
    found = average_to_order(DitherProblem(seeker, fast, mu_omega=m), 1)
    assert found.evidence.verdict is Verdict.PROVED
    brackets = derive(DitherProblem(seeker, fast).reduced(_steady(fast))).system.rhs
    for ours, limit in zip(found.averages[0], brackets, strict=True):
        assert ours.has(m)
        assert is_zero(sp.cancel(sp.together(ours)).subs(m, 0) - limit)


def _steady(fast: FastStates) -> tuple[sp.Expr, ...]:
    solution = sp.solve(fast.rate, fast.state, dict=True)[0]
    return tuple(solution[symbol] for symbol in fast.state)


@pytest.mark.parametrize("name", FILTERS)
def test_filters_leave_what_the_order_says(name: str) -> None:
    fast, outputs = FILTERS[name]
    seeker = system([[cos(outputs[0]), outputs[-1]], [sin(outputs[0]), x]], [cos(PHASE), sin(PHASE)], [y, outputs[0]])
    found = average_to_order(DitherProblem(seeker, fast, mu_omega=sp.Rational(1, 2)), 2)
    assert found.evidence.verdict is Verdict.PROVED
    assert left_over(found) == pytest.approx(-1, abs=0.02)


def test_van_der_pol_has_the_published_frequency() -> None:
    """ẍ + x = ε (1 − x²) ẋ: the limit cycle has amplitude 2 and frequency 1 − ε²/16 (Bogoliubov, Mitropolsky)."""
    wave = s + a
    force = (1 - r**2 * cos(wave) ** 2) * -r * sin(wave)
    found = normal_form(Oscillation(s, 2 * sp.pi, (r, a), ((-sin(wave) * force, -cos(wave) * force / r),)), 2)
    assert put_back(found).verdict is Verdict.PROVED
    (first_r, first_a), (second_r, second_a) = found.means
    assert is_zero(first_r - r / 2 * (1 - r**2 / 4))
    assert (first_a, second_r) == (0, 0)
    assert is_zero(second_a.subs(r, 2) + sp.Rational(1, 16))


def test_the_tongue_of_mathieu_has_the_published_border() -> None:
    """ẍ + (1/4 + d₁ε + d₂ε² + ε cos t) x = 0 has periodic solutions for d₁ = 1/2, d₂ = −1/8 (Verhulst)."""
    d = sp.Symbol("d", real=True)
    u, v = sp.symbols("u v", real=True)
    own, half = u * cos(s / 2) + v * sin(s / 2), sp.Rational(1, 2)
    kicks = [(half + cos(s)) * own, d * own]
    rates = tuple((2 * sin(s / 2) * kick, -2 * cos(s / 2) * kick) for kick in kicks)
    found = normal_form(Oscillation(s, 4 * sp.pi, (u, v), rates), 2)
    first, second = (sp.Matrix(row).jacobian([u, v]) for row in found.means)
    assert (first[0, 1] == 0) != (first[1, 0] == 0)
    place = (0, 1) if first[0, 1] == 0 else (1, 0)
    assert sp.solve(second[place], d) == [-sp.Rational(1, 8)]


def test_the_pendulum_on_a_shaking_pivot_stands_upright() -> None:
    """Kapitza: with the fast part of the momentum taken out, the potential −g cos q + (c²/4) sin² q comes out."""
    q, p, g, c = sp.symbols("q p g c", real=True)
    speed = p - c * sin(q) * sin(s)
    pendulum = Oscillation(s, 2 * sp.pi, (q, p), ((speed, -g * sin(q) + speed * c * cos(q) * sin(s)),))
    found = normal_form(pendulum, 2)
    potential = -g * cos(q) + c**2 / 4 * sin(q) ** 2
    assert all(is_zero(sp.sympify(e)) for e in (found.means[0][0] - p, found.means[0][1] + sp.diff(potential, q)))


def test_a_vibrated_mechanical_system_moves_by_the_symmetric_product() -> None:
    """q̈ = f(q) + b(q) v̇(t), fast v: the average has −⟨v²⟩/2 ⟨b : b⟩, in one dimension ⟨b : b⟩ = 2 b′ b (Bullo)."""
    q, p = sp.symbols("q p", real=True)
    b, f = sp.Function("b", real=True)(q), sp.Function("f", real=True)(q)
    v = cos(s) + sin(2 * s) / 3
    speed = p + b * v
    rates = ((speed, f - sp.diff(b, q) * speed * v),)
    found = normal_form(Oscillation(s, 2 * sp.pi, (q, p), rates), 1)
    mean = sp.Rational(1, 2) * (1 + sp.Rational(1, 9))
    symmetric = 2 * sp.diff(b, q) * b
    assert is_zero(found.means[0][1] - (f - mean / 2 * symmetric))


@pytest.mark.parametrize("seed", range(4))
def test_a_random_polynomial_system_is_averaged_to_order_three(seed: int) -> None:
    """Fields, drift, signals and a filter at random; what is left along it is of order ω^(−3/2)."""
    rng = random.Random(seed)

    def number() -> sp.Rational:
        return sp.Rational(rng.choice([-3, -2, -1, 1, 2, 3]), rng.choice([1, 2, 3]))

    def polynomial(*letters: sp.Symbol) -> sp.Expr:
        return number() + sp.Add(*(number() * letter ** rng.choice([1, 2]) for letter in rng.sample(letters, 2)))

    def signal() -> sp.Expr:
        return number() * cos(rng.choice([1, 2]) * PHASE) + number() * sin(rng.choice([1, 2, 3]) * PHASE)

    fields = [[polynomial(x, y), number()], [number(), polynomial(x, z)]]
    own = system(fields, [signal(), signal()], [polynomial(x, y), -y])
    filtered = FastStates((z,), (number() ** 2 * (x * y + number() - z),))
    problem = DitherProblem(own, filtered, mu_omega=number() ** 2 if seed % 2 else None)
    found = average_to_order(problem, 3)
    assert found.evidence.verdict is Verdict.PROVED
    if problem.mu_omega is not None:
        assert left_over(found) == pytest.approx(-1.5, abs=0.02)


POLYNOMIAL = {
    "scalar": Oscillation(s, 2 * sp.pi, (x,), ((x**2 * cos(s) + sin(2 * s),), (x,))),
    "plane": Oscillation(s, 2 * sp.pi, (x, y), ((cos(s) + y * sin(2 * s), x * sin(s)), (y, -x))),
    "mean at once": Oscillation(s, 2 * sp.pi, (x,), ((x + x**2 * cos(s),),)),
}


@pytest.mark.parametrize("name", POLYNOMIAL)
def test_the_period_map_is_that_of_the_average(name: str) -> None:
    """The iterated integrals of Picard's series over one period: X ∘ P = (flow of the average over a period) ∘ X."""
    own, order = POLYNOMIAL[name], 3
    found = normal_form(own, order)
    change = [
        symbol + sum(DELTA**n * row[i].subs(s, 0) for n, row in enumerate(found.correctors, start=1))
        for i, symbol in enumerate(own.slow)
    ]
    mean = [sum(DELTA**n * row[i] for n, row in enumerate(found.means, start=1)) for i in range(len(own.slow))]
    there = _cut_vector([entry.subs(dict(zip(own.slow, _picard(own, own.right_hand_side, order), strict=True)),
                                    simultaneous=True) for entry in change], order)  # fmt: skip
    flow = _picard(own, mean, order)
    back = _cut_vector(
        [entry.subs(dict(zip(own.slow, change, strict=True)), simultaneous=True) for entry in flow], order
    )
    assert [sp.expand(left - right) for left, right in zip(there, back, strict=True)] == [0] * len(own.slow)


def _picard(own: Oscillation, rates: Any, order: int) -> list[sp.Expr]:
    """The solution after one period as a series in δ, by Picard's iterated integrals, with E = exp(is)."""
    turns = {s_function(n * s): _in_turns(s_function, n) for s_function in (sin, cos) for n in (1, 2)}
    rates = [sp.sympify(rate).subs(turns) for rate in rates[: len(own.slow)]]
    now = list(own.slow)
    for _ in range(order):
        moved = [rate.subs(dict(zip(own.slow, now, strict=True)), simultaneous=True) for rate in rates]
        now = [symbol + _integral(rate, order) for symbol, rate in zip(own.slow, moved, strict=True)]
    return [entry.subs({s: 2 * sp.pi, TURN: 1}) for entry in now]


TURN = sp.Symbol("E")


def _in_turns(function: Any, n: int) -> sp.Expr:
    return (TURN**n + TURN**-n) / 2 if function is cos else (TURN**n - TURN**-n) / (2 * sp.I)


def _integral(rate: sp.Expr, order: int) -> sp.Expr:
    """∫₀^s of a sum of s^n E^r with powers of δ up to the order, each by parts."""
    total = []
    for term in sp.Add.make_args(sp.expand(rate)):
        powers = term.as_powers_dict()
        n, turns = int(powers.get(s, 0)), int(powers.get(TURN, 0))
        if powers.get(DELTA, 0) > order:
            continue
        factor = term / s**n / TURN**turns
        if turns == 0:
            total.append(factor * s ** (n + 1) / (n + 1))
        else:
            part, coefficient = sp.S.Zero, 1 / (sp.I * turns)
            for power in range(n, -1, -1):
                part += coefficient * s**power * TURN**turns
                coefficient *= sp.I * power / turns
            total.append(factor * (part - part.subs({s: 0, TURN: 1}, simultaneous=True)))
    return sp.expand(sp.Add(*total))


def _cut_vector(entries: list[sp.Expr], order: int) -> list[sp.Expr]:
    result = []
    for entry in entries:
        polynomial = sp.Poly(sp.expand(entry), DELTA)
        result.append(sp.Add(*(polynomial.coeff_monomial(DELTA**n) * DELTA**n for n in range(order + 1))))
    return result


def test_a_lyapunov_function_is_expanded_with_all_that_is_left() -> None:
    from derivations.pt_seeker import chain
    from derivations.pt_seeker.notation import mu, omega, theta
    from derivations.pt_seeker.notation import z as filtered

    vehicle = of_turning(chain.closed_loop_tau, theta, [filtered], omega=omega, mu=mu, mu_omega=m, order=2)
    assert vehicle.whole == ()
    found = along(vehicle, [chain.F], 2)
    assert sorted(found.rest) == [3, 4]
    assert put_back(found).verdict is Verdict.PROVED


def _corrupted(found: Expansion) -> dict[str, Expansion]:
    """One coefficient changed in a mean, in a corrector and in what is left."""

    def spoilt(rows: Any, place: int) -> Any:
        return tuple(
            tuple(entry + sp.Rational(1, 10**9) * (x if place == n else 0) for entry in row)
            for n, row in enumerate(rows)
        )

    twins = {}
    for place in range(found.order):
        for part in ("means", "correctors"):
            twin = replace(found)
            for name in ("means", "correctors", "rest"):
                twin.__dict__[name] = getattr(found, name)
            twin.__dict__[part] = spoilt(getattr(found, part), place)
            twins[f"{part} {place + 1}"] = twin
    return twins


@pytest.mark.parametrize("part", [f"{a} {b}" for a, b in itertools.product(("means", "correctors"), (1, 2, 3))])
@pytest.mark.parametrize("name", ["unicycle", "triangle"])
def test_a_corrupted_expansion_does_not_cancel(name: str, part: str) -> None:
    verdict = put_back(_corrupted(expanded(name))[part]).verdict
    # A function of x alone in the last corrector is left over at the next order only.
    assert verdict is (Verdict.PROVED if part == "correctors 3" else Verdict.UNDECIDED)


def test_a_jump_in_a_corrector_is_seen() -> None:
    found = averaged("square waves", 1).expansion
    twin = replace(found)
    jump = sp.Piecewise((0, sp.pi > PHASE), (1, True)).subs(PHASE, PHASE - 2 * sp.pi * sp.floor(PHASE / (2 * sp.pi)))
    twin.__dict__["means"], twin.__dict__["rest"] = found.means, found.rest
    twin.__dict__["correctors"] = (*found.correctors[:-1], tuple(entry + jump for entry in found.correctors[-1]))
    assert "continuous" in put_back(twin).detail


def test_the_remainder_is_what_is_left() -> None:
    values = {TIME: sp.Rational(1, 3), PHASE: sp.Rational(1, 2), x: sp.Rational(2, 5)}
    concrete = average_to_order(system([[1], [x**2]], [cos(PHASE), sin(PHASE)], [-x]), 1)
    limit = concrete.leading[0].subs(values).evalf(30)
    near = concrete.remainder[0].subs(values).subs(OMEGA, sp.Integer(10) ** 16).evalf(30)
    assert abs(near - limit) < sp.Float("1e-6")
    assert abs(limit) > sp.Float("1e-3")
