"""Dormand and Prince's method of order 8 as a CasADi function: short work of smooth systems that are not too stiff.

Error estimate and step control are part of the function, as in Hairer's DOP853: a call makes some trial steps one
after the other, each of which goes on or is repeated shorter, without a way through Python.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np

from ptproof.errors import InputError
from ptproof.simulation.plan import Array, Batch, Plan
from ptproof.simulation.settings import Budget
from ptproof.simulation.smooth import pieces
from ptproof.simulation.translate import casadi_expressions
from ptproof.system import System

# The coefficients of Dormand and Prince's method of order 8 with Hairer's two error estimates of orders 5 and 3: from
# E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, and its code DOP853.
# SciPy has them too, but it takes a fifth of a second to import; a test compares them.
# From the number of a stage to the weight of its slope; what is left out is 0.
Weights: TypeAlias = Mapping[int, float]

STAGES: tuple[Weights, ...] = (
    {},
    {0: 0.05260015195876773},
    {0: 0.0197250569845379, 1: 0.0591751709536137},
    {0: 0.02958758547680685, 2: 0.08876275643042054},
    {0: 0.2413651341592667, 2: -0.8845494793282861, 3: 0.924834003261792},
    {0: 0.037037037037037035, 3: 0.17082860872947386, 4: 0.12546768756682242},
    {0: 0.037109375, 3: 0.17025221101954405, 4: 0.06021653898045596, 5: -0.017578125},
    {
        0: 0.03709200011850479, 3: 0.17038392571223998, 4: 0.10726203044637328, 5: -0.015319437748624402,
        6: 0.008273789163814023,
    },
    {
        0: 0.6241109587160757, 3: -3.3608926294469414, 4: -0.868219346841726, 5: 27.59209969944671,
        6: 20.154067550477894, 7: -43.48988418106996,
    },
    {
        0: 0.47766253643826434, 3: -2.4881146199716677, 4: -0.590290826836843, 5: 21.230051448181193,
        6: 15.279233632882423, 7: -33.28821096898486, 8: -0.020331201708508627,
    },
    {
        0: -0.9371424300859873, 3: 5.186372428844064, 4: 1.0914373489967295, 5: -8.149787010746927,
        6: -18.52006565999696, 7: 22.739487099350505, 8: 2.4936055526796523, 9: -3.0467644718982196,
    },
    {
        0: 2.273310147516538, 3: -10.53449546673725, 4: -2.0008720582248625, 5: -17.9589318631188,
        6: 27.94888452941996, 7: -2.8589982771350235, 8: -8.87285693353063, 9: 12.360567175794303,
        10: 0.6433927460157636,
    },
)  # fmt: skip
STEP: Weights = {
    0: 0.054293734116568765, 5: 4.450312892752409, 6: 1.8915178993145003, 7: -5.801203960010585,
    8: 0.3111643669578199, 9: -0.1521609496625161, 10: 0.20136540080403034, 11: 0.04471061572777259,
}  # fmt: skip
FIFTH: Weights = {
    0: 0.01312004499419488, 5: -1.2251564463762044, 6: -0.4957589496572502, 7: 1.6643771824549864,
    8: -0.35032884874997366, 9: 0.3341791187130175, 10: 0.08192320648511571, 11: -0.022355307863886294,
}  # fmt: skip
THIRD: Weights = {
    j: weight - {0: 0.244094488188976378, 8: 0.733846688281611857, 11: 0.0220588235294117653}.get(j, 0.0)
    for j, weight in STEP.items()
}


_TRIALS = 16
# As parts of the way from sample to sample: the first step, which soon grows, and where steps are too short to go on.
_FIRST, _SMALLEST = 1e-6, 1e-12
# Measured: the end's error is below a half of the one asked for where steps are limited by it, and far below where
# they are limited by stability.
_LOCAL = 3.0
# How much the error of the step before counts. By the last one alone, every other step fails where stability limits
# them.
_DAMPING = 0.08
# Pieces that take more trials are looked at, and left to CVODES where its steps would be longer: where the fastest
# decay, times the step, is so large that stability limits the step. Where accuracy does, CVODES' lower order takes ten
# steps for one. A plan's tightening is a hundred over its radians, rounded down to a power of ten.
_MOST, _SAMPLED = 100, 1
_STIFF, _AGAIN = 3.0, 1.25


def through(plan: Plan, member: Batch, counts: Sequence[int], budget: Budget) -> list[Array]:
    """The states (n × count) at the samples of a single member's pieces, from the first one on.

    Parameters
    ----------
    counts
        The number of samples, evenly spaced, in each piece that is not empty; the last one is at the piece's end.
    budget
        The trials of what is found are taken from it.

    What is left out is for another method, from the last sample on, which may be inside a piece: the rates have kinks
    at unknown instants, the run leaves the ball or does not come to the end, or it is so stiff that the steps of an
    explicit method are too short.
    """
    found: list[Array] = []
    try:
        parts = pieces(plan, member)
    except InputError:
        return found
    x = member.initial[:, 0]
    for (row, system), count in zip(parts, counts, strict=True):
        given = [*member.parameters[:, 0], member.edges[row, 0], member.edges[row + 1, 0] - member.edges[row, 0]]
        carries = _piece(plan, system, x, np.array(given), count, budget)
        steps = int(np.count_nonzero(carries[:, 1] < count)) + 1
        states = carries[np.diff(carries[:, 1], prepend=0.0) > 0, 4:].T
        states = states[:, : plan.inside(states)] if states.size else states
        if steps > budget.steps or not states.size:
            break
        budget.steps -= steps
        found.append(states)
        if states.shape[1] < count:
            break
        x = states[:, -1]
    return found


def _piece(plan: Plan, system: System, x: Array, given: Array, count: int, budget: Budget) -> Array:
    """What is carried on after each trial of one piece, as far as this method goes."""
    settings = plan.settings
    tolerances = max(_LOCAL * settings.rtol * plan.tightening, 3e-14), max(_LOCAL * settings.absolute, 1e-18)
    carry, all_given = np.array([0.0, 0.0, _FIRST / count, 1e-4, *x]), np.array([*given, count, *tolerances])
    made, found = np.empty((_TRIALS, len(carry))), []
    buffer, evaluate = trials(system).buffer()
    for i, array in enumerate((carry, all_given)):
        buffer.set_arg(i, array.data)
    buffer.set_res(0, made.data)
    most, looked = _MOST / plan.tightening + _SAMPLED * count, 0.0
    while carry[1] < count:
        evaluate()
        found.append(made.copy())
        carry[:] = made[-1]
        number = len(found) * _TRIALS
        if carry[2] * count < _SMALLEST or number > budget.steps or budget.spent or plan.away(carry[4:]) > plan.radius:
            break
        too_long = number > 4 * _TRIALS + most * carry[0]  # as far as can be foreseen, once steps have grown
        if too_long and number > _AGAIN * looked:
            looked = number
            if _decay(system, carry, given) * carry[2] > _STIFF:
                break
    return np.concatenate(found)


def _decay(system: System, carry: Array, given: Array) -> float:
    """The fastest rate at which a small difference dies out, in the time of the piece; 0 where that is no number."""
    start, length = given[-2:]
    slopes = np.array(jacobian(system)(start + length * carry[0], carry[4:], given[:-2]))
    return float(max(-length * np.linalg.eigvals(slopes).real.min(), 0.0)) if np.isfinite(slopes).all() else 0.0


@lru_cache(maxsize=64)
def jacobian(system: System) -> Any:
    """The derivatives of the rates by the states (n × n), of time, states and parameters."""
    import casadi as ca

    time, x, p, rhs = casadi_expressions(system)
    return ca.Function("jacobian", [time, x, p], [ca.densify(ca.jacobian(rhs, x))])


@lru_cache(maxsize=64)
def trials(system: System) -> Any:
    """Some trial steps, from what is carried on and what is given to what is carried on after each of them."""
    import casadi as ca

    step = trial(system)
    carry, given = ca.MX.sym("carry", step.size1_in(0)), ca.MX.sym("given", step.size1_in(1))
    found: list[Any] = []
    for _ in range(_TRIALS):
        found.append(step(found[-1] if found else carry, given))
    return ca.Function("trials", [carry, given], [ca.horzcat(*found)])


@lru_cache(maxsize=64)
def trial(system: System) -> Any:
    """One trial step, in a time that goes from 0 to 1 in a piece.

    What is carried on: the time, the number of samples arrived at, the length of the next step, the error of the last
    one, and the states. What is given: the parameters, the piece's start and length, the number of its samples, and
    the two tolerances. Steps end at samples.
    """
    import casadi as ca

    time, x, p, rhs = casadi_expressions(system)
    rate = ca.Function("rate", [time, x, p], [rhs])
    carry, given = ca.SX.sym("carry", 4 + x.numel()), ca.SX.sym("given", p.numel() + 5)
    place, arrived, wanted, before = ca.vertsplit(carry[:4])
    old, values = carry[4:], given[: p.numel()]
    start, length, count, rtol, atol = ca.vertsplit(given[p.numel() :])
    target, going = (arrived + 1) / count, arrived < count
    left = target - place
    last = wanted >= left * (1 - 1e-9)
    step = ca.if_else(last, left, ca.fmin(wanted, left / 2))
    now, ahead = start + length * place, length * step
    slopes: list[Any] = []

    def combined(weights: Weights) -> Any:
        return sum((weight * slopes[stage] for stage, weight in weights.items()), ca.SX.zeros(x.numel()))

    for weights in STAGES:
        slopes.append(rate(now + sum(weights.values()) * ahead, old + ahead * combined(weights), values))
    new = old + ahead * combined(STEP)
    scale = atol + rtol * ca.fmax(ca.fabs(old), ca.fabs(new))
    fifth, third = (ca.sumsqr(combined(weights) / scale) for weights in (FIFTH, THIRD))
    error = ahead * fifth / ca.sqrt((fifth + 0.01 * third) * x.numel() + 1e-300)
    taken = ca.logic_and(going, error <= 1)
    growth = 0.9 * error ** (0.2 * _DAMPING - 0.125) * before**_DAMPING
    growth = ca.fmin(ca.if_else(taken, 6, 1), ca.fmax(0.2, growth))  # a fifth also where the error is no number
    ended = ca.logic_and(taken, last)
    made = ca.vertcat(
        ca.if_else(ended, target, ca.if_else(taken, place + step, place)), arrived + ended,
        ca.if_else(going, step * growth, wanted), ca.if_else(taken, ca.fmax(error, 1e-4), before),
        ca.if_else(taken, new, old),
    )  # fmt: skip
    return ca.Function("trial", [carry, given], [made], {"cse": True})
