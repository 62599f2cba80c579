"""A problem as a value: equal problems are one key, also after a trip through pickle."""

import pickle
from dataclasses import replace

import pytest

from ptproof.errors import InputError
from ptproof.problem import example


def test_equal_problems_are_one_key():
    one = example("vanishing")
    other = replace(one)
    assert one == other
    assert len({one, other}) == 1
    assert replace(one, name="another") != one


def test_a_problem_survives_pickling():
    one = example("nonvanishing")
    assert hash(one) == hash(pickle.loads(pickle.dumps(one)))
    assert pickle.loads(pickle.dumps(one)) == one
    assert b"_hash" not in pickle.dumps(one)


def test_data_that_do_not_fit_are_refused_in_python_too():
    one = example("vanishing")
    with pytest.raises(InputError, match=r"seeker\.k: must be positive"):
        replace(one.tuning, k=-1)
    with pytest.raises(InputError, match="kappa"):
        replace(one.field, kappa=0)
    with pytest.raises(InputError, match=r"field\.source: 1 coordinates"):
        replace(one.field, source=(0,))
