"""The state of a process that work may change for all that comes after it: seen, and put back where possible."""

from __future__ import annotations

import decimal
import os
import random
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ptproof.reading.system import children

try:
    import resource
except ImportError:  # not on this system
    resource = None  # type: ignore[assignment]

SEED = 20251


def _folder() -> str:
    try:
        return os.getcwd()
    except OSError:  # it was removed
        return ""


def _environment(values: dict[str, str]) -> None:
    os.environ.clear()
    os.environ.update(values)


def _filters(values: list[Any]) -> None:
    warnings.filters[:] = values  # type: ignore[index]
    warnings._filters_mutated()  # type: ignore[attr-defined]


def _umask() -> int:
    mask = os.umask(0o077)
    os.umask(mask)
    return mask


def _streams() -> list[Any]:
    found: list[Any] = [id(sys.stdin), id(sys.stdout), id(sys.stderr)]
    for number in range(3):
        try:
            held = os.fstat(number)
            found.append((held.st_dev, held.st_ino))
        except OSError:
            found.append(None)
    return found


def _limits() -> list[Any]:
    if resource is None:
        return []
    return [resource.getrlimit(getattr(resource, name)) for name in dir(resource) if name.startswith("RLIMIT_")]


def _timers() -> list[bool]:
    return [
        signal.getitimer(kind) != (0.0, 0.0) for kind in (signal.ITIMER_REAL, signal.ITIMER_VIRTUAL, signal.ITIMER_PROF)
    ]


def _of(module: str, name: str) -> tuple[Callable[[], Any], Callable[[Any], None]]:
    """An attribute of what may be loaded: the module ``module`` or an object in it."""
    place, _, inner = module.partition(":")

    def holder() -> Any:
        found = sys.modules.get(place)
        return getattr(found, inner, None) if inner else found

    def write(value: Any) -> None:
        if value is not None:
            setattr(holder(), name, value)

    return (lambda: getattr(holder(), name, None)), write


_SEEN: Mapping[str, tuple[Callable[[], Any], Callable[[Any], Any] | None]] = {
    "the working folder": (_folder, lambda folder: os.chdir(folder or ".")),
    "the environment": (lambda: dict(os.environ), _environment),
    "the recursion limit": (sys.getrecursionlimit, sys.setrecursionlimit),
    "the filters of warnings": (lambda: list(warnings.filters), _filters),
    "the handlers of signals": (lambda: [signal.getsignal(n) for n in signal.valid_signals()], None),
    "the timers": (_timers if hasattr(signal, "getitimer") else list, None),
    "the limits": (_limits, None),
    "the mask of new files": (_umask, os.umask),
    "the standard streams": (_streams, None),
    "the child processes": (lambda: children(os.getpid()), None),
    "the threads": (threading.active_count, None),
    "the decimal precision": (lambda: decimal.getcontext().prec, lambda p: setattr(decimal.getcontext(), "prec", p)),
    "the precision of mpmath": _of("mpmath:mp", "prec"),
    "the precision of mpmath's intervals": _of("mpmath:iv", "prec"),
    "the precision of python-flint": _of("flint:ctx", "prec"),
    "SymPy's evaluation": _of("sympy.core.parameters:global_parameters", "evaluate"),
    "SymPy's distribution": _of("sympy.core.parameters:global_parameters", "distribute"),
}


@dataclass(frozen=True)
class State:
    """What the process was set to at one moment.

    Examples
    --------
    >>> before = State.now()
    >>> before.changed()
    ()
    """

    values: Mapping[str, Any]
    chance: Any

    @classmethod
    def now(cls) -> State:
        """The state at this moment."""
        return cls({name: read() for name, (read, _) in _SEEN.items()}, random.getstate())

    def changed(self) -> tuple[str, ...]:
        """What is set to something else by now; what was not loaded then is left out."""
        return tuple(
            name for name, (read, _) in _SEEN.items() if self.values[name] is not None and read() != self.values[name]
        )

    def restore(self) -> tuple[str, ...]:
        """Set again what can be set, and give what was changed; handlers of signals, streams and threads are left."""
        found = self.changed()
        for name in found:
            if (write := _SEEN[name][1]) is not None:
                write(self.values[name])
        random.setstate(self.chance)
        return found


def seed() -> None:
    """Start the generators of random numbers that are loaded where they always start, for the same run every time."""
    random.seed(SEED)
    for name in ("sympy.core.random", "numpy.random"):
        if (module := sys.modules.get(name)) is not None:
            module.seed(SEED)
