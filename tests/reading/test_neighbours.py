"""Which task a worker takes next: the neighbour of its last one, since it remembers what the two have in common."""

import os
import time
from itertools import pairwise

import pytest

from ptproof.reading.copies import possible
from ptproof.reading.limits import Workers

pytestmark = pytest.mark.skipif(not possible(), reason="the system cannot copy a process")


def who(_: int) -> int:
    time.sleep(0.02)
    return os.getpid()


def test_each_worker_takes_neighbouring_tasks():
    with Workers(2) as workers:
        found = {key: outcome.answer for key, outcome in workers.each(30, who, {i: (i,) for i in range(32)})}
    assert set(found) == set(range(32))
    changes = sum(found[i] != found[j] for i, j in pairwise(range(32)))
    assert len(set(found.values())) == 2
    assert changes <= 12  # one task each in turn would be 31


def test_one_worker_takes_the_tasks_in_their_order():
    with Workers(1) as workers:
        assert [key for key, _ in workers.each(30, who, {i: (i,) for i in range(6)})] == list(range(6))
