"""The systems of the benchmark have the averages that they should have."""

import pytest
import sympy as sp

from benchmarks.averaging import FIELDS, measure, seeker
from ptproof.averaging import derive
from ptproof.proof.algebra import is_zero

k = sp.Symbol("k", positive=True)


@pytest.mark.parametrize("kind", FIELDS)
@pytest.mark.parametrize("n", [1, 3])
def test_the_average_climbs_the_gradient(kind: str, n: int) -> None:
    system = seeker(n, FIELDS[kind])
    derived = derive(system)
    assert len(derived.brackets) == n
    for entry, symbol in zip(derived.system.rhs, system.state, strict=True):
        assert is_zero(entry - k * sp.diff(FIELDS[kind](system.state), symbol) / 2)


def test_sixteen_states_with_an_undefined_field() -> None:
    system = seeker(16, FIELDS["undefined F"])
    field = FIELDS["undefined F"](system.state)
    assert derive(system).system.rhs == tuple(k * sp.diff(field, symbol) / 2 for symbol in system.state)


def test_the_table_has_a_row_for_each_kind_and_size() -> None:
    rows = list(measure((1, 2)))
    assert [(kind, n, brackets) for kind, n, brackets, _ in rows] == [(kind, n, n) for kind in FIELDS for n in (1, 2)]
