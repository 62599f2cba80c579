"""A time limit within this process."""

import gc
import mmap
import os
import sys
import threading
import time
import weakref
from contextlib import suppress

import pytest

from ptproof.errors import InputError
from ptproof.reading.limits import Answered, OutOfTime, Unanswered, Why, Workers, apart, unbroken, within


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
    _wait_until_all_have_ended()


def _wait_until_all_have_ended():
    for _ in range(1000):
        if all(thread.name != "ptproof time limit" for thread in threading.enumerate()):
            return
        time.sleep(0.01)
    pytest.fail("the thread still runs")


class _Swallows:
    """What is raised here is never heard of: Python only reports it."""

    def __del__(self):
        until = time.monotonic() + 0.2
        while time.monotonic() < until:
            pass


def _by_a_weak_reference():
    class Thing:
        pass

    thing = Thing()
    return thing, weakref.ref(thing, lambda reference: _Swallows.__del__(None))


def _by_the_collector():
    def spin(phase, info):
        if phase == "start":
            _Swallows.__del__(None)

    gc.callbacks.append(spin)
    try:
        gc.collect()
    finally:
        gc.callbacks.remove(spin)


def _slow_to_start(thread, start=threading.Thread.start):
    """As on a busy machine: who has others told is still at it when they are."""
    start(thread)
    if thread.name == "ptproof tells again":
        until = time.monotonic() + 0.05
        while time.monotonic() < until:
            pass


@pytest.mark.parametrize("busy", [False, True])
@pytest.mark.parametrize("swallow", [_Swallows, _by_a_weak_reference, _by_the_collector])
def test_who_is_told_where_nothing_can_be_raised_is_told_again(swallow, busy, monkeypatch):
    if busy:
        monkeypatch.setattr(threading.Thread, "start", _slow_to_start)
    entered = []

    def work():
        entered.append(swallow() is None)  # what comes back dies here
        while True:
            pass

    with pytest.raises(OutOfTime):
        within(0.05, work)
    _wait_until_all_have_ended()
    assert len(entered) <= 1


def test_what_else_is_swallowed_is_reported():
    heard, usual = [], sys.unraisablehook
    sys.unraisablehook = heard.append
    try:

        class Fails:
            def __del__(self):
                raise KeyError("lost")

        within(10, lambda: Fails() and None)
    finally:
        sys.unraisablehook = usual
    assert [type(entry.exc_value) for entry in heard] == [KeyError]


def test_what_must_not_be_broken_off_runs_to_its_end_and_nothing_after_it():
    begun, ended, after = [], [], []

    def steps():
        until = time.monotonic() + 0.3
        while time.monotonic() < until:
            begun.append(1)
            ended.append(1)

    def work():
        unbroken(steps)
        after.append(1)

    with pytest.raises(OutOfTime):
        within(0.05, work)
    _wait_until_all_have_ended()
    assert begun
    assert len(begun) == len(ended)
    assert not after


def test_what_has_been_told_to_stop_begins_nothing_that_must_not_be_broken_off():
    begun, told = [], threading.Event()

    def work():
        told.wait()  # the exception comes only after this step, which is not Python's
        unbroken(lambda: begun.append(1))

    with pytest.raises(OutOfTime):
        within(0.05, work)
    told.set()
    _wait_until_all_have_ended()
    assert not begun


def test_without_a_limit_it_is_an_ordinary_call():
    assert unbroken(lambda: 3) == 3
    with pytest.raises(KeyError, match="lost"):
        unbroken(lambda: {}["lost"])
    assert within(10, lambda: unbroken(lambda: unbroken(lambda: 3))) == 3


def test_a_limit_stops_nobody_else():
    """The numbers of threads are used again: a work that ends at its limit must not hand its exception to the next."""
    for _ in range(300):
        with suppress(OutOfTime):
            within(0.002, lambda: time.sleep(0.002))
        assert within(10, lambda: sum(range(100))) == 4950
    _wait_until_all_have_ended()


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf"), "1", True, None])
def test_a_limit_that_is_none_is_refused(seconds):
    with pytest.raises(InputError, match="seconds"):
        within(seconds, lambda: 3)


def test_work_in_another_process_answers():
    assert apart(60, pow, 2, 5) == Answered(32)


def _forever():
    while True:
        pass


def _fill(size):
    return len(bytearray(size))


def _share(size):
    """Memory that counts as shared, which the system's limit leaves out."""
    blocks = []
    for _ in range(size // 2**26):
        blocks.append(mmap.mmap(-1, 2**26))
        blocks[-1].write(b"x" * 2**26)
    time.sleep(60)


def _by_children(size):
    """The memory of all processes that the work makes counts together."""
    for _ in range(3):
        if os.fork() == 0:
            block = bytearray(b"x" * (size // 3))
            time.sleep(60)
            len(block)
    time.sleep(60)


def _refuse(text):
    raise InputError(text)


_NO_ANSWER = [
    (_forever, (), Why.TIME, "no answer in 0.3 s"),
    (_fill, (2**30,), Why.MEMORY, "more than 0.5 GiB of memory"),
    (_share, (3 * 2**28,), Why.MEMORY, "more than 0.5 GiB of memory"),
    (_by_children, (3 * 2**28,), Why.MEMORY, "more than 0.5 GiB of memory"),
    (os._exit, (3,), Why.DIED, "the process ended"),
    (_refuse, ("too long",), Why.FAILED, "InputError: too long"),
]


def test_every_way_of_not_answering_is_a_value_and_costs_only_its_own_work():
    with Workers(memory=2**29) as workers:
        for work, arguments, why, reason in _NO_ANSWER:
            outcome = workers.run(0.3 if why is Why.TIME else 60, work, *arguments)
            assert isinstance(outcome, Unanswered)
            assert outcome.why is why
            assert reason in outcome.reason
            assert isinstance(outcome.error, InputError) == (work is _refuse)
        assert workers.run(60, _fill, 10) == Answered(10)


def test_many_answer_each_under_its_key():
    with Workers(2) as workers:
        assert dict(workers.each(60, divmod, {"a": (7, 3), "b": (9, 2)})) == {
            "a": Answered((2, 1)),
            "b": Answered((4, 1)),
        }


def test_a_start_that_fails_fails_the_work():
    with Workers(start=_refuse, arguments=("no such file",)) as workers:
        outcome = workers.run(60, _fill, 10)
    assert isinstance(outcome, Unanswered)
    assert outcome.why is Why.FAILED
    assert str(outcome.error) == "no such file"


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf")])
def test_a_limit_that_is_none_is_refused_for_other_processes(seconds):
    with pytest.raises(InputError, match="seconds"):
        apart(seconds, _fill, 10)
