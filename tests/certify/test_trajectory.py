"""Enclosed runs against exact solutions, independent integrators and saboteurs; what can't be enclosed is not."""

import dataclasses
import functools
import math

import flint
import numpy as np
import pytest
import sympy as sp
from flint import arb

import ptproof
from ptproof.balls import flow as flows
from ptproof.balls.ball import ball_from
from ptproof.balls.flow import across, flow
from ptproof.balls.matrices import grown, identity, matrix
from ptproof.balls.pieces import Proposal, Region, VectorField
from ptproof.balls.polynomials import not_below
from ptproof.balls.tape import compile_tape
from ptproof.certify.trajectory import Enclosure, collocation, enclose
from ptproof.errors import InputError
from ptproof.system import System

t, x, y, z = sp.symbols("t x y z", real=True)
R = sp.Rational
TURNS = 50


def within(run: Enclosure, name: str, exact) -> bool:
    low, high = run.final[name]
    return bool(sp.N(low, 40) <= sp.N(exact, 40) <= sp.N(high, 40))


# right-hand side, initial values, span, and the exact solution at the end
EXACT = {
    "decay": ((-x,), (1,), (0, 3), (sp.exp(-3),)),
    "stiff": ((-1000 * (x - sp.cos(t)) - sp.sin(t),), (1,), (0, 1), (sp.cos(1),)),
    "stiff, with a layer": ((-1000 * (x - sp.cos(t)) - sp.sin(t),), (2,), (0, 1), (sp.cos(1) + sp.exp(-1000),)),
    "turns": ((-y, x), (1, 0), (0, 2 * sp.pi * TURNS), (1, 0)),
    "logistic": ((x * (1 - x),), (R(1, 10),), (0, 5), (1 / (1 + 9 * sp.exp(-5)),)),
    "towards a pole": ((x**2,), (1,), (0, R(9, 10)), (10,)),
    "a choice in time": (
        (sp.Piecewise((1, t < sp.pi), (-2, True)),), (0,), (0, 4), (sp.pi - 2 * (4 - sp.pi),),
    ),
    "a kink": ((sp.Max(y, 0) - 1, sp.Integer(1)), (0, -1), (0, 2), (-R(3, 2), 1)),
    "a kink at the start": ((sp.Abs(y), sp.Integer(1)), (0, 0), (0, 2), (2, 2)),
    "a saturation": ((sp.Min(1, sp.Max(-1, 3 * sp.cos(y))), sp.Integer(1)), (0, 0), (0, 6 * sp.pi), (0, 6 * sp.pi)),
    "both sides of a kink": ((-sp.Min(x, y), sp.Integer(0)), (2, 1), (0, 2), (sp.exp(-1), 1)),
}  # fmt: skip


@functools.cache
def enclosed(name):
    rates, initial, span, _ = EXACT[name]
    return enclose(System(t, (x, y)[: len(rates)], rates), initial=initial, span=span, width="1e-8", seconds=600)


@pytest.mark.parametrize("name", EXACT)
def test_the_exact_solution_is_enclosed(name):
    run, exact = enclosed(name), EXACT[name][-1]
    assert str(run.verdict) == "proved", run.detail
    assert all(within(run, symbol, value) for symbol, value in zip(run.final, exact, strict=True))


@pytest.mark.parametrize("name", ["turns", "stiff", "towards a pole", "a kink"])
def test_another_value_is_not_enclosed(name):
    rates, initial, span, exact = EXACT[name]
    wrong = (initial[0] + R(1, 10**6), *initial[1:])
    system = System(t, (x, y)[: len(rates)], rates)
    run = enclose(system, initial=wrong, span=span, width="1e-8", seconds=600)
    moved = name != "stiff"  # where the start is forgotten
    assert within(run, "x", exact[0]) is not moved


def test_each_switch_of_a_saturation_is_enclosed():
    run = enclosed("a saturation")
    instants = sorted(
        float(turn * 2 * sp.pi + sign * sp.acos(level)) % (6 * math.pi)
        for turn in (0, 1, 2) for sign in (1, -1) for level in (R(1, 3), -R(1, 3))
    )  # fmt: skip
    assert len(run.switches) == len(instants)
    for switch, instant in zip(run.switches, instants, strict=True):
        assert float(switch.start) <= instant + 1e-14
        assert instant - 1e-14 <= float(switch.end) <= float(switch.start) + 1e-8


def test_lorenz_at_the_value_of_an_independent_run():
    """Lorenz' classical system from (15, 15, 36) at t = 1, by Taylor's method with 20 digits (mpmath)."""
    import mpmath

    lorenz = (10 * (y - x), x * (28 - z) - y, x * y - R(8, 3) * z)
    run = enclose(System(t, (x, y, z), lorenz), initial=(15, 15, 36), span=(0, 1), width="1e-8", seconds=600)
    with mpmath.workdps(20):
        solution = mpmath.odefun(
            lambda _, v: [10 * (v[1] - v[0]), v[0] * (28 - v[2]) - v[1], v[0] * v[1] - mpmath.mpf(8) / 3 * v[2]],
            0, [15, 15, 36],
        )  # fmt: skip
        values = solution(1)
        bounds = list(run.final.values())
        assert all(mpmath.mpf(low) <= v <= mpmath.mpf(high) for (low, high), v in zip(bounds, values, strict=True))


def test_no_solution_is_claimed_at_an_escape():
    """Nor beyond it, which the engine of statements about runs is asked for."""
    run = enclose(System(t, (x,), (x**2,)), initial=(1,), span=(0, 1), seconds=20)
    assert str(run.verdict) == "undecided"
    assert run.times[-1] < 1


def test_a_wish_for_more_is_met_with_smaller_widths():
    turning = System(t, (x, y), (-y, x))
    runs = [enclose(turning, initial=(1, 0), span=(0, 20), width=w, seconds=600) for w in ("1e-4", "1e-8", "1e-12")]
    assert [str(run.verdict) for run in runs] == ["proved"] * 3
    assert all(run.width <= float(w) for run, w in zip(runs, ("1e-4", "1e-8", "1e-12"), strict=True))


def test_an_interval_of_starts_holds_its_ends():
    run = enclose(System(t, (x,), (-x,)), initial=((1, R(1001, 1000)),), span=(0, 1), width="0.01")
    assert within(run, "x", sp.exp(-1))
    assert within(run, "x", R(1001, 1000) * sp.exp(-1))


def test_an_instant_and_a_span():
    run = enclose(System(t, (x,), (-x,)), initial=(1,), span=(0, 1))
    low, high = run.at("1/3")["x"]
    assert low <= float(sp.exp(-R(1, 3))) <= high
    assert high - low < 1e-6
    low, high = run.over("1/3", "2/3")["x"]
    assert low <= float(sp.exp(-R(2, 3)))
    assert float(sp.exp(-R(1, 3))) <= high
    with pytest.raises(InputError, match="is enclosed, not all of"):
        run.at(2)


@pytest.mark.parametrize(("name", "seeker"), [("vanishing", "asymptotic"), ("nonvanishing", "asymptotic")])
def test_the_papers_runs_hold_those_of_an_independent_integrator(name, seeker):
    run = enclose(name, seeker, seconds=600)
    assert str(run.verdict) == "proved"
    assert run.width <= 1e-6
    system = ptproof.example(name).closed_loop(seeker)
    from scipy.integrate import solve_ivp

    function = sp.lambdify([system.time, *system.state], list(system.rhs), "math")
    start = [row[0] for row in np.array(run.lower).T]
    other = solve_ivp(
        lambda time, state: function(time, *state), (run.times[0], run.times[-1]), start, method="LSODA",
        rtol=1e-11, atol=1e-12, t_eval=run.times,
    )  # fmt: skip
    slack = 1e-6  # of the other one, which proves nothing
    assert np.all(np.array(run.lower) - slack <= other.y.T)
    assert np.all(np.array(run.upper) + slack >= other.y.T)


REFUSED = {
    "a jump": (System(t, (x,), (sp.sign(x),)), {"initial": (1,), "span": (0, 1)}, "may jump"),
    "a condition on the state": (
        System(t, (x,), (sp.Piecewise((1, x > 0), (0, True)),)), {"initial": (1,), "span": (0, 1)}, "about the state",
    ),
    "an unknown instant": (
        System(t, (x,), (sp.Piecewise((1, sp.sin(t) > 0), (0, True)),)), {"initial": (1,), "span": (0, 1)},
        "is not known",
    ),
    "a float": (System(t, (x,), (-x,)), {"initial": (0.1,), "span": (0, 1)}, "is not exact"),
    "a parameter": (System(t, (x,), (-y * x,)), {"initial": (1,), "span": (0, 1)}, "no value for y"),
    "no span": (System(t, (x,), (-x,)), {"initial": (1,)}, "needs initial"),
    "backwards": (System(t, (x,), (-x,)), {"initial": (1,), "span": (1, 0)}, "must end after"),
    "a state with a sign": (
        System(t, (sp.Symbol("p", positive=True),), (sp.Integer(-1),)), {"initial": (1,), "span": (0, 2)}, "as real",
    ),
    "a name": ("nowhere", {}, "nowhere"),
    "an infinite width": ("vanishing", {"width": "0"}, "must be positive"),
    "another state": ("vanishing", {"initial": {"phi": 1}}, "is not one of"),
    "an end before the start": ("vanishing", {"until": "-1"}, "must be after"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_with_a_sentence(name):
    target, options, sentence = REFUSED[name]
    with pytest.raises(InputError, match=sentence):
        enclose(target, **options)


@pytest.fixture
def step():
    """x' = −x from 1 over [0, 1/2] with the Taylor polynomial of degree 9, all of it in 96 bits."""
    with flint.ctx.workprec(96):
        field = VectorField.of(t, (x,), (-x,))
        # exp(−1/4 − s/4) in powers of s
        path = [ball_from(sp.exp(-R(1, 4)) * (-R(1, 4)) ** k / sp.factorial(k)).mid() for k in range(10)]
        spread = tuple(matrix([[float(c)]]) for c in path)
        proposal = Proposal(flint.arb_mat(1, 10, path), spread, identity(1), identity(1))
        yield field, Region.around([arb(1)]), proposal


def test_a_step_holds_the_exact_value(step):
    field, region, proposal = step
    _, after = flow(field, region, arb(0), arb("0.5"), proposal)
    assert after.box[0].contains(arb("-0.5").exp())
    assert after.box[0].rad() < 1e-10


@pytest.mark.parametrize("index", [0, 1, 3, 9])
def test_a_corrupted_polynomial_still_encloses(step, index):
    """A saboteur's proposal costs width, never truth."""
    field, region, proposal = step
    rows = proposal.path.entries()
    rows[index] += arb("0.001")
    corrupted = dataclasses.replace(proposal, path=flint.arb_mat(1, 10, rows))
    _, after = flow(field, region, arb(0), arb("0.5"), corrupted)
    assert after.box[0].contains(arb("-0.5").exp())
    assert after.box[0].rad() > 1e-5


def test_a_corrupted_spread_still_encloses(step):
    field, _, proposal = step
    region = Region.around([arb(1, arb("1e-3"))])
    corrupted = dataclasses.replace(proposal, spread=tuple(0 * part for part in proposal.spread))
    _, after = flow(field, region, arb(0), arb("0.5"), corrupted)
    low, high = arb("0.999") * arb("-0.5").exp(), arb("1.001") * arb("-0.5").exp()
    assert after.box[0].contains(low)
    assert after.box[0].contains(high)


@pytest.mark.parametrize("term", ["defect", "spreading"])
def test_without_a_term_of_the_theorem_the_value_is_missed(step, monkeypatch, term):
    """What the tests above show is not shown by chance: each term is needed."""
    field, region, proposal = step
    if term == "defect":
        rows = proposal.path.entries()
        rows[1] += arb("0.001")
        corrupted = dataclasses.replace(proposal, path=flint.arb_mat(1, 10, rows))
        exact = arb("-0.5").exp()
    else:  # a spread that forgets the start by the end
        region = Region.around([arb(1, arb("1e-3"))])
        corrupted = dataclasses.replace(proposal, spread=(matrix([[0.5]]), matrix([[-0.5]])))
        exact = arb("1.001") * arb("-0.5").exp()
    honest = getattr(flows._Step, term)
    _, right = flow(field, region, arb(0), arb("0.5"), corrupted)
    assert right.box[0].contains(exact)
    nothing = (lambda self: [arb(0)]) if term == "defect" else (lambda self: 0 * honest(self))
    monkeypatch.setattr(flows._Step, term, nothing)
    _, wrong = flow(field, region, arb(0), arb("0.5"), corrupted)
    assert not wrong.box[0].overlaps(exact)


def test_a_guard_that_is_crossed_is_seen():
    with flint.ctx.workprec(96):
        field = VectorField.of(t, (x,), (sp.Integer(-1),), (x,))
        path = flint.arb_mat(1, 2, [arb("0.5"), arb("-0.75")])
        proposal = Proposal(path, (identity(1),), identity(1), identity(1))
        with pytest.raises(flows.GuardCrossed):
            flow(field, Region.around([arb("1.25")]), arb(0), arb("1.5"), proposal)
        higher = Proposal(flint.arb_mat(1, 2, [arb(1), arb("-0.75")]), (identity(1),), identity(1), identity(1))
        assert flow(field, Region.around([arb("1.75")]), arb(0), arb("1.5"), higher)


def test_a_step_across_a_kink_holds_the_exact_value():
    with flint.ctx.workprec(96):
        tape = compile_tape([sp.Abs(x - R(1, 2)) + 1], (t, x))
        # x' = 3/2 − x until x = 1/2 and x' = 1/2 + x from then on, from 0.49 to a little beyond
        _, after = across(tape, Region.around([ball_from(R(49, 100))]), arb(0), ball_from(R(1, 50)))
        before = sp.log(R(101, 100))
        exact = R(-1, 2) + sp.exp(R(1, 50) - before)
        assert after.box[0].contains(ball_from(exact))
        assert after.box[0].rad() < 1e-3


def test_growth_holds_the_exact_solution():
    with flint.ctx.workprec(96):
        found = grown(matrix([[-10.0, 2.0], [1.0, -0.5]]), [arb(0), arb(1)], [arb(1), arb(0)], 1)
        A = sp.Matrix([[-10, 2], [1, -R(1, 2)]])
        exact = sp.N((A.exp() * sp.Matrix([1, 0]) + A.inv() * (A.exp() - sp.eye(2)) * sp.Matrix([0, 1])), 30)
        assert all(
            sp.Float(str(float(end)), 30) >= value - R(1, 10**12) for end, value in zip(found.end, exact, strict=True)
        )
        assert all(over >= end for over, end in zip(found.over, found.end, strict=True))
        with pytest.raises(ValueError, match="negative"):
            grown(matrix([[0.0, -1.0], [0.0, 0.0]]), [arb(0)] * 2, [arb(1)] * 2, 1)


@pytest.mark.parametrize(("bound", "shown"), [("-0.0001", True), ("0.0001", False)])
def test_a_polynomial_is_not_below_its_smallest_value(bound, shown):
    """(s − 1/3)² touches 0."""
    assert not_below([arb(1) / 9, arb(-2) / 3, arb(1)], arb(bound)) is shown


def test_collocation_is_of_high_order():
    rates = collocation.Rates.compiled(t, (x,), (-x,), ())
    trial = collocation.attempt(rates, 0.0, 1.0, np.array([1.0]), np.ones((16, 1)))
    assert trial is not None
    assert abs(trial.stages[-1, 0] - np.exp(-1)) < 1e-14
