"""Certified distances and promised ones are attacked by integrations; a bound that is too small is hit."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ptproof.gains import gains, tight_bound
from ptproof.gains.attack import attack_answer, attack_curve
from ptproof.gains.data import GainData
from ptproof.gains.numbers import Quantity
from ptproof.problem import example
from ptproof.problem.field import FieldBounds
from ptproof.proof.attack import WrongPromise

DATA = {
    "no drift": GainData(FieldBounds(1, 2, 1, 2, 4), k=1, T=1, nu_min="1/5", x0_norm=1),
    "along the gradient": GainData(FieldBounds(1, 2, 1, 2, 4), k=2, T=1, nu_min="1/4", x0_norm=1, drift_norm=1),
    "bounded": GainData(FieldBounds(1, 1, 1, 2, 2), k=2, T=1, nu_min="1/4", x0_norm=2, drift_bound=1),
    "of order four": GainData(FieldBounds(2, 1, 1, 4, 4), k=1, T=1, nu_min="1/4", x0_norm=1),
}


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing", "saturated"])
def test_a_certified_curve_holds_and_a_smaller_one_is_hit(name: str) -> None:
    problem = example(name)
    curve = tight_bound(problem, steps=60)
    assert attack_curve(problem, curve, starts=3) > 100
    smaller = replace(curve, distances=(curve.distances[0], *(0.7 * d for d in curve.distances[1:])))
    with pytest.raises(WrongPromise, match="certified to be at most"):
        attack_curve(problem, smaller, starts=3)


@pytest.mark.parametrize("name", DATA)
def test_promised_distances_hold(name: str) -> None:
    assert attack_answer(gains(DATA[name]))


def test_a_promise_that_is_too_good_is_hit() -> None:
    answer = gains(DATA["bounded"])
    promised = answer["clip.residual_bound"]
    assert promised is not None
    clip = {**answer.values["clip"], "residual_bound": Quantity(promised.exact / 10)}
    with pytest.raises(WrongPromise, match="residual_bound"):
        attack_answer(replace(answer, values={**answer.values, "clip": clip}))
