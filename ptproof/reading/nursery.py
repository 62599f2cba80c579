"""Hosts for a process with threads, of which no copy can be made: they are copies of a fresh one that is started once.

::

    this process ── nursery ── attendant ── host        an attendant waits for its host, and says how it ended

The nursery has one thread, and imports what its parent has imported of the rooms that the work stands in, which takes
seconds: every host but the first finds it there. A host gets the environment, the working folder, the path of imports
and the standard error of the moment at which it is asked for.
"""

from __future__ import annotations

import contextlib
import importlib
import multiprocessing
import os
import pickle
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from multiprocessing import reduction
from multiprocessing.connection import Connection
from typing import Any, NoReturn

from ptproof.reading import system
from ptproof.reading.host import serve

_OWN = __name__.partition(".")[0]
# Of the environment: what a program, its libraries or its loader look at when they start.
_AT_START = ("PYTHON", "LC_", "LANG", "LD_", "TZ", "MALLOC_", "OMP_", "OPENBLAS_", "MKL_")
_nurseries: dict[tuple[tuple[str, str], ...], _Nursery] = {}
_one_at_a_time = threading.Lock()


class Host:
    """A process that came from the nursery; it has what is used here of ``multiprocessing.Process``."""

    def __init__(self, said: Connection) -> None:
        self._said = said
        self._pid: int | None = None
        self.exitcode: int | None = None

    def join(self, seconds: float | None = None) -> None:
        """Wait for its end."""
        try:
            if self._pid is None and self._said.poll(seconds):
                self._pid = self._said.recv()
            if self.exitcode is None and self._said.poll(seconds):
                self.exitcode = self._said.recv()
        except (EOFError, OSError):  # its attendant is gone, and the host with it
            self._pid = None

    def is_alive(self) -> bool:
        """Whether it is still there."""
        self.join(0)
        return self._pid is not None and self.exitcode is None

    def kill(self) -> None:
        """End it at once."""
        if self.is_alive() and self._pid is not None:
            system.kill(self._pid, group=False)


def host(
    connection: Connection, work: Callable[..., Any], count: int, start: Callable[..., None] | None,
    arguments: tuple[Any, ...], memory: int,
) -> Host:  # fmt: skip
    """A new host that serves ``work`` at the other end of the connection; raises OSError where none can be made."""
    given = pickle.dumps((dict(os.environ), os.getcwd(), sys.path, pickle.dumps((count, start, arguments, memory))))
    with _one_at_a_time:
        return _nursery().host(_imported(work, start), given, connection)


def _imported(*functions: Callable[..., Any] | None) -> list[str]:
    """What this process has imported of ptproof's own rooms in which the functions stand."""
    rooms = {".".join(function.__module__.split(".")[:2]) for function in functions if function is not None}
    return [name for name in sys.modules if name.startswith(f"{_OWN}.") and ".".join(name.split(".")[:2]) in rooms]


def _nursery() -> _Nursery:
    fixed = tuple(sorted(item for item in os.environ.items() if item[0].startswith(_AT_START)))
    if fixed not in _nurseries or not _nurseries[fixed].process.is_alive():
        _nurseries[fixed] = _Nursery()
    return _nurseries[fixed]


class _Nursery:
    """The process, as its parent knows it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._link, theirs = context.Pipe()
        held = threading.current_thread() is threading.main_thread()
        self.process = context.Process(target=_wait, args=(theirs, held), daemon=True)
        self.process.start()
        theirs.close()

    def host(self, imported: list[str], given: bytes, connection: Connection) -> Host:
        """Ask for a host; three files go along: its connection, where its attendant speaks, and standard error."""
        hear, say = multiprocessing.Pipe(duplex=False)
        error = _standard_error()
        try:
            self._link.send((imported, given))
            for file in (connection.fileno(), say.fileno(), error):
                reduction.send_handle(self._link, file, self.process.pid)
        finally:
            say.close()
            os.close(error)
        return Host(hear)

    def forget(self) -> None:
        """In a copy of the parent: it is not this process's."""
        self._link.close()


def _standard_error() -> int:
    try:
        return os.dup(2)
    except OSError:  # it is closed
        return os.open(os.devnull, os.O_WRONLY)


def _forget() -> None:
    global _one_at_a_time
    _one_at_a_time = threading.Lock()
    for nursery in _nurseries.values():
        nursery.forget()
    _nurseries.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def _wait(link: Connection, held: bool) -> NoReturn:
    """In the nursery: import, then make a host whenever one is asked for, until nobody can ask any more."""
    if held:
        system.end_with_parent()
    os.setsid()
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGCHLD):
        signal.signal(number, signal.SIG_IGN)
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):  # it stays with one thread
        os.environ[name] = "1"
    while True:
        try:
            names, given = link.recv()
            files = [reduction.recv_handle(link) for _ in range(3)]
        except (EOFError, OSError):
            os._exit(0)
        for name in names:
            with contextlib.suppress(Exception):  # then the host says so, if it needs it
                importlib.import_module(name)
        with contextlib.suppress(OSError):  # then the one that asks finds its connection closed
            if os.fork() == 0:
                link.close()
                _attend(given, *files)
        for file in files:
            os.close(file)


def _attend(given: bytes, connection: int, said: int, error: int) -> NoReturn:
    """In an attendant: make the host, wait for it, and say its number and how it ended."""
    try:
        system.end_with_parent()
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        pid = os.fork()
        if pid == 0:
            os.close(said)
            _serve(given, connection, error)
        os.close(connection)
        os.close(error)
        with Connection(said, readable=False) as say:
            say.send(pid)
            say.send(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
    finally:
        os._exit(0)


def _serve(given: bytes, connection: int, error: int) -> NoReturn:
    """In a host: take over what the one that asked has, and serve it."""
    try:
        os.dup2(error, 2)
        os.close(error)
        environment, folder, sys.path[:], arguments = pickle.loads(given)
        os.environ.clear()
        os.environ.update(environment)
        os.chdir(folder)
        serve(Connection(connection), None, True, *pickle.loads(arguments))
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(1)
