"""Work in processes beside the one of a command: begun when it is known, and waited for when it is needed."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from contextlib import ExitStack
from typing import Any

from ptproof.reading.limits import Answered, Unanswered, Workers

_SECONDS = 1e6  # what is drawn may take as long as it takes


class Beside:
    """Pieces of work by their keys, each in a process of its own, which does not outlive the block.

    Parameters
    ----------
    at_once
        Whether they are done while this process goes on, and not only when it waits for them.
    """

    def __init__(self, at_once: bool) -> None:
        self._at_once = at_once
        self._processes = ExitStack()
        self._waiting: dict[Hashable, Callable[[], Answered[Any] | Unanswered]] = {}
        self._outcomes: dict[Hashable, Answered[Any] | Unanswered] = {}

    def __enter__(self) -> Beside:
        return self

    def __exit__(self, *_: object) -> None:
        self._processes.close()

    def begin(self, key: Hashable, work: Callable[..., Any], *arguments: Any) -> None:
        """Have ``work(*arguments)`` done, a top-level function as for :class:`Workers`."""
        workers = self._processes.enter_context(Workers())
        if self._at_once:
            outcomes = workers.each(_SECONDS, work, {key: arguments})
            self._waiting[key] = lambda: next(outcomes)[1]
        else:
            self._waiting[key] = lambda: workers.run(_SECONDS, work, *arguments)

    def outcome(self, key: Hashable) -> Answered[Any] | Unanswered:
        """What came of the work that was begun under this key; waits for it."""
        if key not in self._outcomes:
            self._outcomes[key] = self._waiting.pop(key)()
        return self._outcomes[key]

    def rest(self) -> None:
        """Wait until nothing is being done any more."""
        for key in [*self._waiting]:
            self.outcome(key)
