"""Work in processes that each start afresh, for systems that cannot copy a process."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

from ptproof.reading.outcomes import Answered, Unanswered, Why, too_much
from ptproof.reading.system import limit_memory

Key = TypeVar("Key")


class Spawned:
    """Processes for work as :class:`ptproof.reading.limits.Workers` describes them."""

    def __init__(self, count: int, start: Callable[..., None] | None, arguments: tuple[Any, ...], memory: int) -> None:
        import multiprocessing

        from pebble import ProcessPool

        self._memory = memory
        self._pool = ProcessPool(
            max_workers=count,
            context=multiprocessing.get_context("spawn"),
            initializer=_start,
            initargs=(memory, start, arguments),
        )

    def stop(self) -> None:
        """End the processes, and what still runs in them."""
        self._pool.stop()
        self._pool.join()

    def each(
        self, seconds: float, work: Callable[..., Any], tasks: Mapping[Key, tuple[Any, ...]]
    ) -> Iterator[tuple[Key, Answered[Any] | Unanswered]]:
        """The key of each task with what came of it, as they end; the work begins at once."""
        from concurrent.futures import as_completed

        waiting = {
            self._pool.schedule(_call, args=(work, arguments), timeout=seconds): key for key, arguments in tasks.items()
        }
        return ((waiting[future], self._outcome(future, seconds)) for future in as_completed(waiting))

    def _outcome(self, future: Any, seconds: float) -> Answered[Any] | Unanswered:
        from pebble import ProcessExpired

        try:
            return Answered(future.result())
        except TimeoutError:
            return Unanswered(Why.TIME, f"no answer in {seconds:g} s")
        except ProcessExpired as error:
            return Unanswered(Why.DIED, f"the process ended: {type(error).__name__}: {error}", error)
        except MemoryError:
            return too_much(self._memory)
        except Exception as error:
            return Unanswered(Why.FAILED, f"{type(error).__name__}: {error}", error)


_not_started: list[BaseException] = []


def _start(memory: int, start: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    """In a new process; an error is kept for the work, as the pool would start the process again and again."""
    limit_memory(memory)
    try:
        if start is not None:
            start(*arguments)
    except BaseException as error:
        _not_started.append(error)


def _call(work: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    if _not_started:
        raise _not_started[0]
    return work(*arguments)
