"""The process that a person starts: it waits for the one that works, and says how that ended where it does not itself.

A derivation is a program, and may end its process in any way, with any status. So the work is done in a process of its
own, and counts as done only when that says so. The first Ctrl-C (or SIGTERM) is handed on, and the work has a moment
to show what it has; the second, or the end of that moment, ends it at once.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn

from ptproof.commands import streams
from ptproof.reading.outcomes import end_in_words
from ptproof.reading.system import MEMORY, end_with_parent, kill, limit_memory

PATIENCE = 1.5  # after the first Ctrl-C [s]
_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_state: dict[str, int] = {"guarded": False, "signal": 0, "pipe": -1}


def possible() -> bool:
    """Whether the system can do this."""
    return hasattr(os, "fork")


def doing(what: str) -> None:
    """Tell the guard what is being done, for the sentence about an unexpected end."""
    if _state["guarded"]:
        with suppress(OSError):
            os.write(_state["pipe"], f"{what}\n".encode())


def limit() -> None:
    """From here on this process, if it is one of its own, reads nothing, and has no more memory than one for a claim."""
    if _state["guarded"]:
        streams.nothing_to_read()
        limit_memory(MEMORY)


def own_interrupt() -> bool:
    """Whether a KeyboardInterrupt that was raised comes from the work itself and not from a person."""
    return bool(_state["guarded"]) and not _state["signal"]


def interrupt_status() -> int:
    """The exit status of a run that was ended from outside."""
    return 128 + (_state["signal"] or int(signal.SIGINT))


def guarded(work: Callable[[], int]) -> NoReturn:
    """Do the work in a process of its own, and end with its status."""
    closed = streams.take()
    heard, say = os.pipe()
    wake, woken = os.pipe()
    for end in (wake, woken):
        os.set_blocking(end, False)
    signal.set_wakeup_fd(woken, warn_on_full_buffer=False)
    for number in (*_SIGNALS, signal.SIGHUP, signal.SIGCHLD):
        signal.signal(number, lambda *_: None)
    pid = os.fork()
    if pid == 0:
        signal.set_wakeup_fd(-1)
        for end in (heard, wake, woken):
            os.close(end)
        _work(work, say, closed)
    os.close(say)
    os._exit(_watch(pid, heard, wake))


def _work(work: Callable[[], int], say: int, closed: set[int]) -> NoReturn:
    """In the process that works.

    Linear algebra starts no threads in it: of a process with one thread a copy can be made, each worker has one
    processor anyway, and small matrices cost several times as much where threads wait for each other.
    """
    status = 1
    try:
        os.setsid()
        end_with_parent()
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        for number in _SIGNALS:
            signal.signal(number, _interrupt)
        _state.update(guarded=True, pipe=say)
        for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
            os.environ.setdefault(name, "1")
        streams.private(say)
        results, own = streams.settle(closed), os.getpid()
        try:
            status = work()
        except BaseException:
            traceback.print_exc()
        if os.getpid() != own:  # a copy that the work has made of its process
            os._exit(1)
        results.flush()
        if results.error:
            print(f"ptproof: standard output: cannot be written ({results.error})", file=sys.stderr)
            status = 2
        doing(f"done {status}")
    finally:
        os._exit(status)


def _interrupt(number: int, _: object) -> None:
    if not _state["signal"]:
        _state["signal"] = number
        raise KeyboardInterrupt


def _watch(pid: int, heard: int, wake: int) -> int:
    """Wait for the process that works; its status, or what its end means."""
    until: float | None = None
    interrupted, ended = 0, None
    said = b""
    while ended is None:
        left = None if until is None else max(0.0, until - time.monotonic())
        ready = select.select([wake, heard] if heard >= 0 else [wake], [], [], left)[0]
        if heard in ready:
            part = os.read(heard, 4096)
            said += part
            heard = heard if part else -1
        signals = {*_read(wake)} if wake in ready else set()
        if stop := signals & {*_SIGNALS, signal.SIGHUP}:
            if interrupted:
                until = 0.0
            else:
                interrupted, until = min(stop), time.monotonic() + PATIENCE
                with suppress(OSError):
                    os.kill(pid, signal.SIGINT if interrupted == signal.SIGINT else signal.SIGTERM)
        if until is not None and time.monotonic() >= until:
            kill(pid)
        found, status = os.waitpid(pid, os.WNOHANG)
        if found:
            ended = os.waitstatus_to_exitcode(status)
    while heard >= 0 and select.select([heard], [], [], 0)[0] and (part := os.read(heard, 4096)):
        said += part
    kill(pid)  # what is left of its group
    last = said.decode(errors="replace").split("\n")[-2:][0]
    if last.startswith("done "):
        return int(last[5:])
    if interrupted:
        _tell("interrupted")
        return 128 + int(interrupted)
    _tell(f"the process {end_in_words(ended)} {last or 'before anything was done'}")
    return 2


def _read(wake: int) -> bytes:
    try:
        return os.read(wake, 1000)
    except BlockingIOError:
        return b""


def _tell(text: str) -> None:
    with suppress(OSError):
        os.write(2, f"ptproof: {text}\n".encode())
