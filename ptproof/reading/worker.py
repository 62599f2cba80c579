"""A worker of :mod:`ptproof.reading.host` and the keeper that waits for it."""

from __future__ import annotations

import contextlib
import hashlib
import os
import pickle
import signal
import struct
from typing import Any, NoReturn

from ptproof.reading import system
from ptproof.reading.outcomes import Why, in_words, too_much
from ptproof.reading.state import State, seed

HEAD = struct.Struct("<q32s")
CLOSED = 113  # the status of a worker that cannot send its answer
_MOST = 2**30  # of an answer [bytes]


def whole(sent: bytearray) -> tuple[bytes, bool] | str | None:
    """What was sent and whether the worker ends with it; None while some is missing, words where it is no answer."""
    if len(sent) < HEAD.size:
        return None
    length, digest = HEAD.unpack_from(sent)
    fits, missing = 0 < abs(length) < _MOST, abs(length) - (len(sent) - HEAD.size)
    if fits and missing > 0:
        return None
    payload = bytes(sent[HEAD.size :])
    if not fits or missing < 0 or hashlib.sha256(payload).digest() != digest:
        return "the work wrote to the channel of its answer"
    return payload, length < 0


_HEARD = {signal.SIGCHLD, signal.SIGUSR1}
ALIVE = b"alive"


def keep(channel: Any, report: int, memory: int, failed: BaseException | None) -> NoReturn:
    """In a keeper: make the worker, wait for it, end all that it leaves behind, and say how it ended."""
    try:
        os.setsid()
        system.end_with_parent()
        system.adopt()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        usual = signal.pthread_sigmask(signal.SIG_BLOCK, _HEARD)
        pid = os.fork()
        if pid == 0:
            signal.pthread_sigmask(signal.SIG_SETMASK, usual)
            os.close(report)
            _work(channel, memory, failed)
        os.write(report, b"%d\n" % pid)
        channel.close()
        while not (ended := os.waitpid(pid, os.WNOHANG))[0]:
            if signal.sigwait(_HEARD) is signal.SIGUSR1:
                os.write(report, ALIVE + b"\n")
        system.kill(pid)  # what is left of its group
        system.bury_children()
        os.write(report, b"%d\n" % os.waitstatus_to_exitcode(ended[1]))
    finally:
        os._exit(0)


def _work(channel: Any, memory: int, failed: BaseException | None) -> NoReturn:
    """In a worker: one task after the other, until one has changed the state of the process."""
    status = 1
    try:
        os.setpgid(0, 0)
        system.end_with_parent()
        system.be_first_to_go()
        system.limit_memory(memory)
        signal.signal(signal.SIGINT, signal.default_int_handler)
        own, keeper, last = os.getpid(), os.getppid(), False
        while not last:
            payload = _exactly(channel, HEAD.unpack(_exactly(channel, HEAD.size))[0])
            seed()
            before = State.now()
            answer, last = _answer(payload, memory, failed)
            if os.getpid() != own:  # a copy that the work has made of its process
                os._exit(0)
            last = last or _changed(before)
            digest = hashlib.sha256(answer).digest()
            channel.sendall(HEAD.pack(-len(answer) if last else len(answer), digest) + answer)
            if not last:  # a keeper that the work has killed or stopped says nothing, and the worker gets no more
                os.kill(keeper, signal.SIGUSR1)
        status = 0
    except OSError:
        status = CLOSED
    finally:
        os._exit(status)


def _changed(before: State) -> bool:
    """Whether the state of the process is another one, after what can be set again is."""
    with contextlib.suppress(Exception):
        if not before.restore():
            return False
    return bool(before.changed())


def _exactly(channel: Any, size: int) -> bytes:
    parts = bytearray()
    while len(parts) < size:
        part = channel.recv(size - len(parts))
        if not part:
            os._exit(0)
        parts += part
    return bytes(parts)


def _answer(payload: bytes, memory: int, failed: BaseException | None) -> tuple[bytes, bool]:
    """What the work comes to, as it is sent (a kind, the answer or words, the error); whether it spoils the worker."""
    try:
        if failed is not None:
            raise failed
        work, arguments = pickle.loads(payload)
        return pickle.dumps(("answer", work(*arguments), None)), False
    except MemoryError:
        return pickle.dumps((Why.MEMORY.value, too_much(memory).reason, None)), True
    except BaseException as error:
        text = f"{type(error).__name__}: {error}" if isinstance(error, Exception) else f"the work {in_words(error)}"
        return pickle.dumps((Why.FAILED.value, text, _sendable(error))), False


def _sendable(error: BaseException) -> Exception | None:
    """The error, if it arrives as what it was."""
    if isinstance(error, Exception):
        with contextlib.suppress(BaseException):
            if type(pickle.loads(pickle.dumps(error))) is type(error):
                return error
    return None
