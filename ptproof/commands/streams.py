"""Standard output for results alone, and streams that never end in a traceback.

What a derivation or a library prints goes to standard error; what a command has to say goes to :func:`out`.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

_results: TextIO | None = None
_settled = False


def out() -> TextIO:
    """The stream for results."""
    return sys.stdout if _results is None else _results


@contextmanager
def aside() -> Iterator[None]:
    """While the code of a derivation may run: what it prints goes to standard error, and :func:`out` stays.

    In a process of the program's own that is so to its end, since a derivation may have started threads that go on.
    """
    global _results
    usual, held = sys.stdout, _results
    _results, sys.stdout = out(), sys.stderr
    try:
        yield
    finally:
        if not _settled:
            sys.stdout, _results = usual, held


class Output(io.TextIOWrapper):
    """A text stream that keeps an error of writing for the end, and writes a mark for what its encoding lacks.

    A reader who has gone away, as ``head`` does, has what he wanted, and is no error.
    """

    def __init__(self, number: int, encoding: str, error: str = "") -> None:
        super().__init__(io.BufferedWriter(io.FileIO(number, "w", closefd=False)), encoding, "replace")
        self._gone, self.error, self._closed = False, "", error

    def write(self, text: str) -> int:
        self.error = self.error or self._closed
        if not self._gone:
            self._try(super().write, text)
        return len(text)

    def flush(self) -> None:
        if not self._gone:
            self._try(super().flush)

    def _try(self, action: Any, *arguments: Any) -> None:
        try:
            action(*arguments)
        except BrokenPipeError:
            self._gone = True
        except (OSError, ValueError) as error:
            self._gone, self.error = True, getattr(error, "strerror", None) or str(error)


class Warnings(io.TextIOWrapper):
    """Standard error: if it cannot be written to, nobody is told."""

    def __init__(self) -> None:
        buffer = io.BufferedWriter(io.FileIO(2, "w", closefd=False))
        encoding = getattr(sys.stderr, "encoding", None) or "utf-8"
        super().__init__(buffer, encoding, "backslashreplace", line_buffering=True)

    def write(self, text: str) -> int:
        with suppress(OSError, ValueError):
            super().write(text)
        return len(text)

    def flush(self) -> None:
        with suppress(OSError, ValueError):
            super().flush()


def take() -> set[int]:
    """Take the file numbers 0, 1 and 2, so that no other file can become one of them; gives those that were closed."""
    closed = {number for number in range(3) if not _is_open(number)}
    for number in sorted(closed):  # the lowest free number is taken
        os.open(os.devnull, os.O_RDWR)
        os.set_inheritable(number, True)
    return closed


def settle(closed: set[int]) -> Output:
    """Set up the streams of a process that is the program's own, and give the stream of its results.

    Standard output then is standard error for all but the results. ``closed`` is what :func:`take` gave.
    """
    if os.isatty(1) and not os.isatty(2):
        with suppress(OSError):  # libraries look at 0, 1 and 2 for the width
            os.environ.setdefault("COLUMNS", str(os.get_terminal_size(1).columns))
    global _settled
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    _settled = True
    results = Output(os.dup(1), encoding, "it is closed" if 1 in closed else "")
    private(results.fileno())
    os.dup2(2, 1)
    sys.stderr = Warnings()
    sys.stdout = results
    return results


def nothing_to_read() -> None:
    """From here on there is nothing on standard input: a derivation that asks for something does not wait for it."""
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    sys.stdin = open(0, closefd=False)  # noqa: SIM115


def _is_open(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return False
    return True


_private: set[int] = set()


def private(number: int) -> None:
    """Keep a file to this process: copies of it, which a derivation or a worker may be, don't have it."""
    if not _private:
        os.register_at_fork(after_in_child=_close_private)
    _private.add(number)


def _close_private() -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in _private:
        os.dup2(nothing, number, inheritable=False)
    os.close(nothing)
