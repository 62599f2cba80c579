"""Work for a process with threads: its host is a copy of a fresh process, and has what the one that asks has."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from ptproof.reading import system
from ptproof.reading.copies import possible
from ptproof.reading.limits import Answered, Unanswered, Why, Workers, apart

pytestmark = pytest.mark.skipif(not possible(), reason="the system cannot copy a process")


@pytest.fixture(autouse=True)
def _another_thread() -> Iterator[None]:
    """This process has threads, so that no copy of it is made."""
    over = threading.Event()
    thread = threading.Thread(target=over.wait)
    thread.start()
    yield
    over.set()
    thread.join()


def _seen() -> tuple[str | None, str, list[str], int]:
    tasks = Path(f"/proc/{os.getppid()}/task")
    return os.environ.get("PTPROOF_SEEN"), os.getcwd(), sys.path, len(list(tasks.iterdir())) if tasks.exists() else 1


def test_it_has_the_environment_the_folder_and_the_path_of_this_moment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        monkeypatch.chdir(tmp_path / name)
        monkeypatch.setenv("PTPROOF_SEEN", name)
        monkeypatch.syspath_prepend(tmp_path / name)
        assert apart(60, _seen) == Answered((name, str(tmp_path / name), sys.path, 1))
    monkeypatch.delenv("PTPROOF_SEEN")
    outcome = apart(60, _seen)
    assert isinstance(outcome, Answered)
    assert outcome.answer[0] is None


def _hash() -> tuple[int, str]:
    return hash("a text"), sys.flags.hash_randomization and os.environ["PYTHONHASHSEED"]


def test_what_python_reads_when_it_starts_is_that_of_this_moment_too(monkeypatch: pytest.MonkeyPatch) -> None:
    found = []
    for seed in ("1", "2", "1"):
        monkeypatch.setenv("PYTHONHASHSEED", seed)
        found.append(apart(60, _hash))
    assert found[0] == found[2] != found[1]


def _say(text: str) -> None:
    os.write(2, text.encode())


def test_what_it_says_comes_out_where_this_process_speaks(capfd: pytest.CaptureFixture[str]) -> None:
    for text in ("first", "second"):
        assert apart(60, _say, text) == Answered(None)
        assert capfd.readouterr().err == text


def _end() -> None:
    os._exit(3)


def _refused() -> None:
    raise KeyError("lost")


def test_a_host_that_ends_while_it_reads_is_an_answer_and_the_next_one_works() -> None:
    with Workers(start=_end) as workers:
        outcome = workers.run(60, _seen)
    assert outcome == Unanswered(Why.DIED, "the process that reads what is to be decided ended with status 3")
    assert isinstance(apart(60, _seen), Answered)


class _Broken:
    """What cannot be read where it arrives."""

    def __reduce__(self) -> tuple[object, ...]:
        return _refused, ()


def test_what_cannot_be_read_there_is_no_answer(capfd: pytest.CaptureFixture[str]) -> None:
    with Workers(start=print, arguments=(_Broken(),)) as workers:
        outcome = workers.run(60, _seen)
    assert outcome == Unanswered(Why.DIED, "the process that reads what is to be decided ended with status 1")
    assert "KeyError: 'lost'" in capfd.readouterr().err


def test_hosts_of_several_threads_at_a_time_do_not_get_in_each_others_way() -> None:
    found: dict[int, object] = {}
    threads = [
        threading.Thread(target=lambda n=n: found.update({n: apart(60, pow, 2, n)}))  # type: ignore[misc]
        for n in range(6)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {n: Answered(2**n) for n in range(6)}


PARENT = """
import sys, threading, time
from ptproof.reading.limits import Workers

def main():
    threading.Thread(target=time.sleep, args=(60,), daemon=True).start()
    with Workers(start=print, arguments=("read", )) as workers:
        for _ in workers.each(60, time.sleep, {n: (60 if n else 0.01,) for n in range(2)}):
            print("begun", flush=True)

if __name__ == "__main__":
    main()
"""


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="the system does not say who is whose child")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_nothing_is_left_of_it_when_its_parent_is_killed(number: int, tmp_path: Path) -> None:
    file = tmp_path / "parent.py"
    file.write_text(PARENT)
    process = subprocess.Popen([sys.executable, str(file)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert process.stdout is not None
    assert process.stdout.readline() == b"begun\n"
    below, waiting = [], [process.pid]
    while waiting:
        waiting += (found := system.children(waiting.pop()))
        below += found
    assert len(below) >= 5  # a nursery, an attendant, a host, a keeper and a worker
    process.send_signal(number)
    process.communicate(timeout=60)
    for _ in range(500):
        if not any(Path(f"/proc/{pid}/cmdline").exists() and Path(f"/proc/{pid}/cmdline").read_text() for pid in below):
            return
        time.sleep(0.02)
    pytest.fail("something still runs")
