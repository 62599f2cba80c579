"""What is left of a closed expansion, beside the plain way to write it down."""

from typing import Any

import pytest
import sympy as sp

from ptproof.averaging.orders import Orders, average_to_order
from ptproof.averaging.oscillation import DELTA
from ptproof.averaging.problem import OMEGA, PHASE, TIME
from tests.averaging.orders import dithered, finite_seeker

x = sp.Symbol("x", real=True)
F = sp.Function("F", real=True)(x)
WAVES = (sp.cos(PHASE), sp.sin(PHASE))


def _plainly(found: Orders) -> Any:
    """dX/dσ along the system less the means at X, as it is defined."""
    own, series = found.expansion.oscillation, found.expansion
    moved = {
        symbol: symbol + sp.Add(*(DELTA**n * row[i] for n, row in enumerate(series.correctors, start=1)))
        for i, symbol in enumerate(own.slow)
    }
    for place, symbol in enumerate(found.problem.system.state):
        rates = zip(own.states, own.right_hand_side, strict=True)
        along = sp.Add(*(sp.diff(moved[symbol], s) * rate for s, rate in rates))
        rows = enumerate(series.means, start=1)
        means = sp.Add(*(DELTA**j * row[place].subs(moved, simultaneous=True) for j, row in rows))
        yield ((along - means) / DELTA ** (found.order + 2)).subs(DELTA, 1 / sp.sqrt(OMEGA))


PROBLEMS = {
    "unknown field": (dithered((x,), (-x,), [[1], [F]], WAVES), 3),
    "slow amplitude": (dithered((x,), (TIME * x,), [[1], [F]], (sp.cos(TIME) * WAVES[0], WAVES[1])), 2),
    "finite filter": (finite_seeker(sp.Rational(1, 2)), 1),
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_it_is_what_its_definition_says(name: str) -> None:
    problem, order = PROBLEMS[name]
    found = average_to_order(problem, order)
    assert found.remainder == tuple(_plainly(found))
