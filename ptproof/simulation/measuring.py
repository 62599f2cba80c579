"""Timing and tables for the benchmarks."""

from __future__ import annotations

import os
import platform
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from ptproof.simulation.engines import has_heyoka


@dataclass(frozen=True)
class Row:
    """One measurement: seconds per trajectory, the error against the reference, and the tolerance that gave it."""

    item: str
    code: str
    seconds: float
    error: float | None = None
    rtol: float | None = None
    note: str = ""


def machine() -> dict[str, Any]:
    """What the numbers were measured on."""
    names = ("casadi", "heyoka", "scipy", "numpy", "sympy")
    found = {name: version(name) for name in names if name != "heyoka" or has_heyoka()}
    return {
        "processor": _processor(), "cores": os.cpu_count(), "system": platform.system(),
        "python": platform.python_version(), **found,
    }  # fmt: skip


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def best(work: Callable[[], Any], repeats: int = 5, budget: float = 3.0) -> float:
    """The shortest of several runs, in seconds; no more of them than fit into ``budget`` seconds."""
    times: list[float] = []
    while len(times) < repeats and sum(times) < budget:
        begin = clock.perf_counter()
        work()
        times.append(clock.perf_counter() - begin)
    return min(times)


def table(data: dict[str, Any]) -> str:
    """The numbers as a Markdown table with the machine below it."""
    lines = ["| item | code | seconds | error | rtol | note |", "| --- | --- | --- | --- | --- | --- |"]
    for row in data["rows"]:
        error, rtol = ("" if row[key] is None else f"{row[key]:.1e}" for key in ("error", "rtol"))
        lines.append(f"| {row['item']} | {row['code']} | {row['seconds']:.3g} | {error} | {rtol} | {row['note']} |")
    lines += ["", "| ratio | value |", "| --- | --- |"]
    lines += [f"| {name} | {value:.3g} |" for name, value in data["ratios"].items()]
    lines += ["", "; ".join(f"{name} {value}" for name, value in data["machine"].items())]
    return "\n".join(lines)
