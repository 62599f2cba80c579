"""A time limit within this process."""

import threading
import time

import pytest

from ptproof.errors import InputError
from ptproof.reading.limits import OutOfTime, within


def test_the_answer_comes_back():
    assert within(10, lambda: 3) == 3


def test_an_error_comes_back():
    with pytest.raises(KeyError, match="lost"):
        within(10, lambda: {}["lost"])


def test_work_without_end_is_stopped_and_does_not_go_on():
    def forever():
        while True:
            pass

    with pytest.raises(OutOfTime):
        within(0.05, forever)
    for _ in range(1000):
        if all(thread.name != "ptproof time limit" for thread in threading.enumerate()):
            return
        time.sleep(0.01)
    pytest.fail("the thread still runs")


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf"), "1", True, None])
def test_a_limit_that_is_none_is_refused(seconds):
    with pytest.raises(InputError, match="seconds"):
        within(seconds, lambda: 3)
