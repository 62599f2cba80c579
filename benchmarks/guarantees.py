"""What is certified of the vehicle in the paper's examples: ``python -m benchmarks.guarantees [ROW …]``.

Each row is a call of ``ptproof certify``; ROW is its number in ``ROWS``, all of them where left out. What is found
replaces those rows of ``derivations/pt_seeker/guarantees.json``, from which the report takes its table. The rows at the
edge of what is found come from ``ptproof certify … --smallest-omega`` and ``--largest-start``.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FILE = Path(__file__).resolve().parents[1] / "derivations" / "pt_seeker" / "guarantees.json"


@dataclass(frozen=True)
class Row:
    """One certificate that is asked for; the problem's own ω, μ and start where they are left out."""

    example: str
    omega: str = ""
    mu: str = ""
    radius: str = ""
    tolerance: float = 0.12

    @property
    def command(self) -> str:
        """What repeats it."""
        options = {"seeker": "pt" if self.example == "saturated" else "", "omega": self.omega, "mu": self.mu}
        options |= {"radius": self.radius, "tolerance": "" if self.tolerance == 0.12 else str(self.tolerance)}
        return f"ptproof certify {self.example}" + "".join(
            f" --{key} {value}" for key, value in options.items() if value
        )

    def found(self) -> dict[str, Any]:
        """The certificate, or why there is none, with the processor's seconds that the command took."""
        begin = _spent()
        done = subprocess.run(
            [sys.executable, "-m", *self.command.split(), "--json"], capture_output=True, text=True, check=False
        )
        if done.returncode not in (0, 1):
            raise SystemExit(f"{self.command}: {done.stderr}")
        data = json.loads(done.stdout)
        kept = ("verdict", "omega", "mu", "start_radius", "final", "hover", "detail")
        return {"command": self.command, **{name: data[name] for name in kept}, "seconds": round(_spent() - begin, 1)}


def _spent() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


ROWS = (
    Row("saturated"),
    Row("saturated", omega="300"),
    Row("saturated", omega="63/5", mu="1/420", tolerance=0.3),
    Row("saturated", omega="121/10", mu="3/1210", tolerance=0.3),
    Row("saturated", radius="617/100", tolerance=0.3),
    Row("saturated", radius="161/25", tolerance=0.3),
    Row("vanishing", omega="3000", mu="1/99000", tolerance=0.05),
    Row("vanishing", omega="300", mu="1/9900", tolerance=0.06),
    Row("vanishing", omega="100", mu="1/3300", tolerance=0.06),
    Row("vanishing", omega="131/2", mu="3/6550", tolerance=0.1),
    Row("vanishing", omega="627/10", mu="1/2090", tolerance=0.1),
    Row("vanishing", radius="31/25", tolerance=0.3),
    Row("vanishing", radius="13/10", tolerance=0.3),
    Row("vanishing", tolerance=0.3),
    Row("nonvanishing", omega="3000", mu="1/99000", tolerance=0.25),
    Row("nonvanishing", omega="100", mu="1/2000", tolerance=0.25),
    Row("nonvanishing", omega="479/5", mu="1/1916", tolerance=0.25),
    Row("nonvanishing", radius="26/25", tolerance=0.3),
    Row("nonvanishing", radius="109/100", tolerance=0.3),
    Row("nonvanishing", tolerance=0.3),
)


def main(chosen: list[int]) -> None:
    """Ask for the rows, and keep each as soon as it is found."""
    for number in chosen or range(len(ROWS)):
        row = ROWS[number]
        found = row.found()
        print(f"{row.command}: {found['verdict']}, final {found['final']}, {found['seconds']} s", flush=True)
        rows = {item["command"]: item for item in json.loads(FILE.read_text("utf-8"))["rows"]} if FILE.exists() else {}
        rows[row.command] = found
        ordered = [rows[item.command] for item in ROWS if item.command in rows]
        FILE.write_text(
            json.dumps({"command": "python -m benchmarks.guarantees", "rows": ordered}, indent=1) + "\n", "utf-8"
        )


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]])
