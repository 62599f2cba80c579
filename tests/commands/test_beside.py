"""Work beside a command: begun at once or when it is waited for, and never left behind."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from ptproof.commands.beside import Beside
from ptproof.commands.parts import spread
from ptproof.reading.outcomes import Answered, Unanswered, Why
from ptproof.reading.system import yield_to_others


def touch(file: str) -> int:
    Path(file).touch()
    return os.getpid()


def hang(file: str) -> None:
    Path(file).write_text(str(os.getpid()))
    time.sleep(600)


def there(file: Path) -> bool:
    for _ in range(600):
        if file.exists():
            return True
        time.sleep(0.05)
    return False


def test_work_is_begun_before_anyone_waits_for_it(tmp_path: Path) -> None:
    with Beside(at_once=True) as beside:
        beside.begin("it", touch, str(tmp_path / "begun"))
        assert there(tmp_path / "begun")
        found = beside.outcome("it")
        assert isinstance(found, Answered)
        assert found.answer != os.getpid()
        assert beside.outcome("it") is found


def test_alone_it_is_begun_when_it_is_waited_for(tmp_path: Path) -> None:
    with Beside(at_once=False) as beside:
        beside.begin("it", touch, str(tmp_path / "begun"))
        time.sleep(0.5)
        assert not (tmp_path / "begun").exists()
        beside.rest()
        assert (tmp_path / "begun").exists()
        assert isinstance(beside.outcome("it"), Answered)


def test_a_process_that_ends_has_no_answer() -> None:
    with Beside(at_once=True) as beside:
        beside.begin("it", os._exit, 0)
        outcome = beside.outcome("it")
    assert isinstance(outcome, Unanswered)
    assert (outcome.why, outcome.reason) == (Why.DIED, "the process ended with status 0")


def test_what_nobody_waits_for_is_ended(tmp_path: Path) -> None:
    file = tmp_path / "number"
    with Beside(at_once=True) as beside:
        beside.begin("it", hang, str(file))
        assert there(file)
    for _ in range(100):
        if not Path(f"/proc/{file.read_text()}").exists():
            return
        time.sleep(0.05)
    pytest.fail("it goes on")


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_all_are_in_some_group(count: int) -> None:
    groups = spread(range(5), count)
    assert sorted(item for group in groups for item in group) == [*range(5)]
    assert len(groups) == min(count, 5)


def considerate() -> tuple[int, str]:
    yield_to_others()
    group = Path("/proc/self/autogroup")
    return os.getpriority(os.PRIO_PROCESS, 0), group.read_text() if group.exists() else ""


def test_work_that_yields_does_so_within_its_session_and_as_a_session() -> None:
    own = os.getpriority(os.PRIO_PROCESS, 0)
    with Beside(at_once=True) as beside:
        beside.begin("it", considerate)
        match beside.outcome("it"):
            case Answered((nice, group)):
                assert nice == min(own + 10, 19)
                assert not group or group.endswith("nice 10\n")
            case other:
                pytest.fail(str(other))
    assert os.getpriority(os.PRIO_PROCESS, 0) == own
