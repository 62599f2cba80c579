"""What the operating system offers to hold processes by; what one does not have is left out."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import sys
from pathlib import Path

MEMORY = 8 * 2**30  # of one piece of work, where nothing else is said [bytes]
_DEATH_SIGNAL, _SUBREAPER = 1, 36  # of Linux's prctl
_LATER = 10  # niceness


def _prctl(option: int, value: int) -> None:
    if sys.platform == "linux":
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def end_with_parent() -> None:
    """Have this process killed when the thread that made it ends."""
    _prctl(_DEATH_SIGNAL, signal.SIGKILL)


def adopt() -> None:
    """Become the parent of what is left behind by the processes below this one."""
    _prctl(_SUBREAPER, 1)


def be_first_to_go() -> None:
    """Where memory runs out, let the system choose this process and not another of the machine."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000")


def limit_memory(memory: int) -> None:
    """Let this process have no more private memory than that. [bytes]

    On Linux it holds for the heap and for private mappings (since 4.7), but not for memory that is shared with other
    processes: :func:`held` sees that.
    """
    with contextlib.suppress(ImportError, ValueError, OSError):  # a system that has no such limit, or a lower one
        import resource

        most = resource.getrlimit(resource.RLIMIT_DATA)[1]
        resource.setrlimit(resource.RLIMIT_DATA, (memory if most < 0 else min(memory, most), most))


def memory_here() -> int:
    """The memory of this machine, or a guess. [bytes]"""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return 8 * 2**30


def children(pid: int) -> list[int]:
    """The processes that ``pid`` has started and that have not been waited for; none where the system does not say."""
    found: list[int] = []
    with contextlib.suppress(OSError, ValueError):
        for thread in Path(f"/proc/{pid}/task").iterdir():
            found += map(int, (thread / "children").read_text().split())
    return found


def held(pid: int) -> int:
    """How much memory the process and all below it hold at this moment, shared memory included. [bytes]"""
    total, waiting, seen = 0, [pid], set[int]()
    while waiting:
        if (one := waiting.pop()) in seen:
            continue
        seen.add(one)
        with contextlib.suppress(OSError, ValueError, IndexError):
            total += int(Path(f"/proc/{one}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        waiting += children(one)
    return total


def kill(pid: int, group: bool = True) -> None:
    """End a process, and those of its group, at once."""
    with contextlib.suppress(OSError):
        os.kill(pid, signal.SIGKILL)
    if group:
        with contextlib.suppress(OSError):
            os.killpg(pid, signal.SIGKILL)


def bury_children() -> None:
    """End what this process has below it, until nothing is left, and wait for it."""
    for _ in range(1000):
        left = children(os.getpid())
        for pid in left:
            kill(pid)
        try:
            while os.waitpid(-1, 0 if left else os.WNOHANG)[0]:
                pass
        except OSError:  # there are none
            return
        if not left:
            return


def yield_to_others() -> None:
    """From now on this process gets a core after others that want it.

    Linux shares its cores among sessions first, each with a niceness of its own (autogroups), where that is on.
    """
    with contextlib.suppress(OSError, AttributeError):
        os.nice(_LATER)
        Path("/proc/self/autogroup").write_text(str(_LATER))
