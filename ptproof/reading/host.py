"""The host of :mod:`ptproof.reading.copies`: it reads what the work needs, then hands out tasks and watches workers."""

from __future__ import annotations

import contextlib
import gc
import io
import os
import pickle
import selectors
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any

from ptproof.reading import system
from ptproof.reading.outcomes import Unanswered, Why, end_in_words, too_much
from ptproof.reading.worker import ALIVE, CLOSED, HEAD, keep, whole

# Objects, after which circles are looked for among the new ones: expressions are many objects, and few circles.
_YOUNG = 20_000
_GLANCE = 0.2  # between two looks at the memory [s]
_CLOSED = "the work closed the channel of its answer"
_PATIENCE = 1.0  # for a keeper to say how its worker ended [s]


def serve(
    connection: Connection, other_end: Connection | None, held: bool, count: int, start: Callable[..., None] | None,
    arguments: tuple[Any, ...], memory: int,
) -> None:  # fmt: skip
    """In the host, which may be ``held`` by its parent: read, then serve until the connection is closed."""
    if other_end is not None:
        other_end.close()
    if held:
        system.end_with_parent()
    os.setsid()
    system.adopt()
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    _streams()
    system.limit_memory(memory)
    failed: BaseException | None = None
    try:
        if start is not None:
            start(*arguments)
    except BaseException as error:
        failed = error
    # What was read stays as it is: no collection in a worker looks at it, which would also copy its memory.
    gc.collect()
    gc.freeze()
    gc.set_threshold(_YOUNG)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    here = os.getpid()
    try:
        connection.send_bytes(pickle.dumps((None, None)))
        _Host(connection, count, memory, failed).run()
    finally:
        if os.getpid() == here:
            system.bury_children()
        os._exit(0)


def _streams() -> None:
    """Nothing to read, and what is printed goes to standard error: standard output is for the one that asked."""
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    try:
        os.fstat(2)
    except OSError:
        os.dup2(nothing, 2)
    os.dup2(2, 1)
    os.close(nothing)
    sys.stdin = open(0, closefd=False)  # noqa: SIM115
    sys.stdout = sys.stderr = io.TextIOWrapper(
        io.FileIO(2, "w", closefd=False), errors="backslashreplace", write_through=True
    )


@dataclass
class _Slot:
    """One worker with its keeper, and what it works on."""

    keeper: int
    channel: Any
    report: int
    worker: int = 0
    task: int | None = None
    last: int = -1
    until: float = 0.0
    killed: Unanswered | None = None
    retired: bool = False
    closed: bool = False
    resting: bool = False  # it has answered, and its keeper has not said yet that both are well
    answer: bytearray = field(default_factory=bytearray)
    said: bytearray = field(default_factory=bytearray)

    @property
    def free(self) -> bool:
        return self.task is None and not self.retired and not self.resting


class _Host:
    def __init__(self, connection: Connection, count: int, memory: int, failed: BaseException | None) -> None:
        self.connection, self.count, self.memory, self.failed = connection, count, memory, failed
        self.selector = selectors.DefaultSelector()
        self.selector.register(connection, selectors.EVENT_READ, None)
        self.tasks: dict[int, bytes] = {}
        self.slots: list[_Slot] = []
        self.seconds = 0.0

    def run(self) -> None:
        looked = 0.0
        while True:
            self._hand_out()
            busy = [slot for slot in self.slots if not slot.free]
            for key, _ in self.selector.select(_GLANCE if busy else None):
                if key.data is None:
                    try:
                        self.seconds, tasks = self.connection.recv()
                    except (EOFError, OSError):
                        return
                    self.tasks.update(tasks)
                elif key.data[0] in self.slots:
                    slot, what = key.data
                    self._hear(slot) if what == "channel" else self._report(slot)
            now = time.monotonic()
            if now - looked > _GLANCE:
                looked = now
                for slot in list(self.slots):
                    self._glance(slot, now)

    def _hand_out(self) -> None:
        """Give each task to a worker that waits, or to a new one where there may be more."""
        while self.tasks:
            slot = next((slot for slot in self.slots if slot.free), None)
            if slot is None:
                if sum(not slot.retired for slot in self.slots) >= self.count:
                    return
                slot = self._new()
            number = self._next(slot)
            payload = self.tasks.pop(number)
            slot.task = slot.last = number
            slot.until, slot.answer = time.monotonic() + self.seconds, bytearray()
            with contextlib.suppress(OSError):  # then its keeper says how it ended
                slot.channel.setblocking(True)
                slot.channel.sendall(HEAD.pack(len(payload), b"") + payload)
                slot.channel.setblocking(False)

    def _next(self, slot: _Slot) -> int:
        """The task after the worker's last one: neighbours have much in common, and a worker remembers what it found.

        Where that is taken, the worker begins in the longest row of tasks that nobody works towards: in its middle
        if somebody does, who then meets it at the end.
        """
        if slot.last + 1 in self.tasks:
            return slot.last + 1
        rows: list[list[int]] = []
        for number in self.tasks:
            if rows and rows[-1][-1] + 1 == number:
                rows[-1].append(number)
            else:
                rows.append([number])
        towards = {other.last + 1 for other in self.slots if other is not slot and not other.retired}
        most = max(rows, key=lambda row: len(row) // 2 if row[0] in towards else len(row))
        return most[len(most) // 2 if most[0] in towards else 0]

    def _new(self) -> _Slot:
        import socket

        here, there = socket.socketpair()
        said, say = os.pipe()
        pid = os.fork()
        if pid == 0:
            for slot in self.slots:
                slot.channel.close()
                os.close(slot.report)
            here.close()
            os.close(said)
            self.selector.close()
            self.connection.close()
            keep(there, say, self.memory, self.failed)
        there.close()
        os.close(say)
        slot = _Slot(pid, here, said)
        self.slots.append(slot)
        self.selector.register(here, selectors.EVENT_READ, (slot, "channel"))
        self.selector.register(said, selectors.EVENT_READ, (slot, "report"))
        return slot

    def _hear(self, slot: _Slot) -> None:
        """Take what a worker has sent."""
        try:
            slot.channel.setblocking(False)
            part = slot.channel.recv(2**20)
        except BlockingIOError:
            return
        except OSError:
            part = b""
        if not part:  # its keeper will say how it ended
            self.selector.unregister(slot.channel)
            slot.retired = slot.closed = True
            slot.until = time.monotonic() + _PATIENCE
            return
        slot.answer += part
        found = whole(slot.answer)
        if found is None or slot.task is None:
            return
        if isinstance(found, str):
            slot.killed = Unanswered(Why.DIED, found)
            system.kill(slot.worker)
            return
        payload, last = found
        self._say(slot.task, payload)
        slot.task, slot.retired, slot.resting, slot.until = None, last, not last, time.monotonic() + _PATIENCE

    def _report(self, slot: _Slot) -> None:
        """Take what a keeper says: its worker's number, then how that ended; or that the keeper itself is gone."""
        part = os.read(slot.report, 100)
        if not part:
            self._gone(slot, "the work ended the process that watched over it")
            return
        *lines, rest = (bytes(slot.said) + part).split(b"\n")
        slot.said[:] = rest
        for line in lines:
            if line == ALIVE:
                slot.resting = False
            elif not slot.worker:
                slot.worker = int(line)
            else:
                status = int(line)
                self._gone(slot, _CLOSED if status == CLOSED else f"the process {end_in_words(status)}")

    def _gone(self, slot: _Slot, how: str) -> None:
        """A worker is no more; if it had something to do, that has no answer."""
        if slot.worker:
            system.kill(slot.worker)
        system.kill(slot.keeper)
        with contextlib.suppress(OSError):
            os.waitpid(slot.keeper, 0)
        with contextlib.suppress(KeyError, ValueError):
            self.selector.unregister(slot.channel)
        self.selector.unregister(slot.report)
        slot.channel.close()
        os.close(slot.report)
        self.slots.remove(slot)
        if slot.task is not None:
            self._say(slot.task, slot.killed or Unanswered(Why.DIED, how))
        self._bury()

    def _bury(self) -> None:
        """End what was left behind by workers whose keepers are gone."""
        known = {slot.keeper for slot in self.slots}
        for pid in system.children(os.getpid()):
            if pid not in known:
                system.kill(pid)
                with contextlib.suppress(OSError):
                    os.waitpid(pid, 0)

    def _glance(self, slot: _Slot, now: float) -> None:
        """Kill a worker whose time or memory is over, and a keeper that doesn't say so in time."""
        if slot.killed is not None or (slot.task is None and not slot.free):
            if now > slot.until + _PATIENCE:
                self._gone(slot, "the process ended without a word")
        elif slot.task is not None and now > slot.until:
            slot.killed = (
                Unanswered(Why.DIED, _CLOSED) if slot.closed
                else Unanswered(Why.TIME, f"no answer in {self.seconds:g} s")
            )  # fmt: skip
            slot.until = now
            system.kill(slot.worker)
        elif slot.task is not None and system.held(slot.keeper) > self.memory:
            slot.killed, slot.until = too_much(self.memory), now
            system.kill(slot.worker)

    def _say(self, number: int, outcome: bytes | Unanswered) -> None:
        self.connection.send_bytes(pickle.dumps((number, outcome)))
