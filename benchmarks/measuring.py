"""Timing and tables for the benchmarks."""

from __future__ import annotations

import os
import platform
import time as clock
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from ptproof.simulation.engines import installed

ONE = "one trajectory "


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
    found = {name: version(name) for name in names if name not in ("casadi", "heyoka") or name in installed()}
    return {
        "processor": _processor(), "cores": os.cpu_count(), "system": platform.system(),
        "python": platform.python_version(), **found, "load at the start": _load(),
    }  # fmt: skip


def _load() -> float | None:
    """Processes that wanted a core in the last minute; other people's work, where it is measured at the start."""
    return round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def best(
    work: Callable[[], Any], repeats: int = 5, budget: float = 3.0, now: Callable[[], float] = clock.perf_counter
) -> float:
    """The shortest of several runs, in seconds of the clock ``now``; no more of them than fit into ``budget``."""
    times: list[float] = []
    while len(times) < repeats and sum(times) < budget:
        begin = now()
        work()
        times.append(now() - begin)
    return min(times)


def ratios(rows: Sequence[Row]) -> dict[str, float]:
    """How many times the one takes of the other's time, by name; what was not measured is left out."""
    seconds = {(row.item, row.code): row.seconds for row in rows}
    found: dict[str, float] = {}

    def compare(name: str, slow: tuple[str, str], fast: tuple[str, str]) -> None:
        if slow in seconds and fast in seconds:
            found[name] = seconds[slow] / seconds[fast]

    for item in dict.fromkeys(row.item for row in rows if row.item.startswith(ONE)):
        for code in ("casadi", "casadi, integration alone", "heyoka", "heyoka, integration alone"):
            for peer in ("lsoda", "radau"):
                compare(f"{peer} over {code}, {item.removeprefix(ONE)}", (item, peer), (item, code))
    for peer in ("lsoda", "radau"):
        compare(f"loop of {peer} over ensemble, a trajectory", ("many", f"{peer} loop"), ("many", "ptproof"))
    compare("ensemble over heyoka by hand", ("many", "ptproof"), ("many", "heyoka by hand"))
    return found


def targets(found: Mapping[str, float]) -> list[dict[str, Any]]:
    """What the ratios are meant to be, and whether they are; the last one is an upper limit."""
    wanted = [
        (f"{peer} over {code}, {how}", times)
        for how in ("to 1e-09", "to 1e-08", "with 1000 samples to 1e-08")
        for code, times in (("casadi", 10.0), ("heyoka", 200.0))
        for peer in ("lsoda", "radau")
    ]
    wanted += [(f"loop of {peer} over ensemble, a trajectory", 1000.0) for peer in ("lsoda", "radau")]
    made = [
        {"ratio": name, "at least": limit, "value": found[name], "met": found[name] >= limit}
        for name, limit in wanted
        if name in found
    ]
    if (last := "ensemble over heyoka by hand") in found:
        made.append({"ratio": last, "at most": 1.5, "value": found[last], "met": found[last] <= 1.5})
    return [{**item, "goal": goal(item)} for item in made]


def table(data: dict[str, Any]) -> str:
    """The numbers as a Markdown table with the machine below it."""
    lines = ["| item | code | seconds | error | rtol | note |", "| --- | --- | --- | --- | --- | --- |"]
    for row in data["rows"]:
        error, rtol = ("" if row[key] is None else f"{row[key]:.1e}" for key in ("error", "rtol"))
        lines.append(f"| {row['item']} | {row['code']} | {row['seconds']:.3g} | {error} | {rtol} | {row['note']} |")
    meant = {item["ratio"]: item for item in data.get("targets", ())}
    lines += ["", "| ratio | value | target |", "| --- | --- | --- |"]
    lines += [
        f"| {name} | {value:.3g} | {meant.get(name, {}).get('goal', '')} |" for name, value in data["ratios"].items()
    ]
    lines += ["", "; ".join(f"{name} {value}" for name, value in data["machine"].items())]
    return "\n".join(lines)


def goal(target: Mapping[str, Any]) -> str:
    """A target in words: its limit, and whether it is met."""
    limit = next(f"{word} {target[word]:g}" for word in ("at least", "at most") if word in target)
    return f"{limit}: {'met' if target['met'] else 'missed'}"
