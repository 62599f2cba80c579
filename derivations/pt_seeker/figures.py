"""The figures of Section 7, drawn from simulations of the examples when the report asks for them, and the benchmark."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.balls.rounding import at_least, at_most
from ptproof.report.content import Figure, Table

if TYPE_CHECKING:
    import numpy as np

    from ptproof.problem import Problem

CAPTIONS = {
    "trajectories": "paths of the seekers and of their averages over the field's level lines",
    "field": "field at the vehicle against time; dashed, the peak; dotted, the prescribed time",
    "distance": "distance from the source against time, with the certified bound of the average; dashed, the hover "
    "radius $1/\\sqrt{\\omega}$",
    "inputs": "forward and angular velocity of the seeker with clipped gain",
    "phase-portrait": "the averaged system at the initial time",
    "order": "largest gap between the closed loop and its average over a ladder of ω, with the slope of the theory",
    "saturated-trajectories": "paths with the time-varying and with the constant gain",
    "saturated-field": "field at the vehicle with the time-varying and with the constant gain",
    "saturated-acceleration": "saturated signal of the angular acceleration under both gains",
}
EXAMPLES = {
    "vanishing": "Section 7.1, vanishing drift",
    "nonvanishing": "Section 7.2, nonvanishing drift",
    "saturated": "Section 7.3, saturated angular acceleration",
}


def figures() -> Iterator[Figure]:
    """Every figure of the paper's examples, one after the other."""
    from ptproof.problem import example
    from ptproof.simulation.drawing import svg

    from .experiments import gallery

    for name, title in EXAMPLES.items():
        problem = example(name)
        bounds = _certified(problem) if problem.saturation is None else {}
        for kind, figure in gallery.figures(problem, bounds).items():
            how = (
                "Repeat: `ptproof report`"
                if kind in ("phase-portrait", "order")
                else (f"See also: `ptproof simulate {name} --plot run.png`")
            )
            yield Figure(f"{name}-{kind.removeprefix(f'{name}-')}", f"{title}: {CAPTIONS[kind]}. {how}.", svg(figure))


def _certified(problem: Problem) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """The certified bound of the averaged distance against time, where one is proved."""
    import numpy as np

    from ptproof.gains.tight import tight_bound
    from ptproof.proof import Verdict

    curve = tight_bound(problem)
    if curve.evidence.verdict is not Verdict.PROVED:
        return {}
    return {"certified bound of the average": (np.array(curve.times), np.array(curve.distances))}


def tables() -> Iterator[Table]:
    """What was stored: guarantees that take long to find, and speeds, which belong to a machine and a moment."""
    yield _guarantees()
    data = json.loads(Path(__file__).with_name("benchmark.json").read_text(encoding="utf-8"))
    machine = ", ".join(f"{name} {value}" for name, value in data["machine"].items())
    how = f"Measured once on: {machine}. Repeat: `{data['command']} --members {data['members']}`."
    yield Table(
        "Benchmark: seconds",
        f"The example `vanishing` to T, in τ and reduced coordinates; the best of several runs. One trajectory: a code "
        f"at the loosest tolerance at which its error is below the limit. Many: seconds a trajectory, to "
        f"{data['accuracy']:.0e}. Growth: whole calls, of ensembles to that and of one run to 1e-08. "
        f"{how}",
        ("item", "code", "seconds", "error", "rtol", "note"),
        tuple(
            (row["item"], row["code"], f"{row['seconds']:.3g}", _short(row["error"]), _short(row["rtol"]), row["note"])
            for row in data["rows"]
        ),
    )
    meant = {target["ratio"]: target for target in data["targets"]}
    yield Table(
        "Benchmark: ratios",
        f"How many times the one takes of the other's time, for the same rows. {how}",
        ("ratio", "value", "target"),
        tuple((name, f"{value:.3g}", meant.get(name, {}).get("goal", "")) for name, value in data["ratios"].items()),
    )


def _guarantees() -> Table:
    data = json.loads(Path(__file__).with_name("guarantees.json").read_text(encoding="utf-8"))

    def words(row: dict[str, Any]) -> tuple[str, ...]:
        known = row["verdict"] == "proved"
        hover = "" if row["hover"] is None else at_most(row["hover"], 3)
        said = at_most(row["final"], 3) if known else "no guarantee is known"
        numbers = (f"{row['omega']:g}", f"{row['mu']:.3g}", at_least(row["start_radius"]))
        spent = "" if row["seconds"] is None else f"{row['seconds']:.0f}"  # one was found by a search, not timed alone
        return (row["command"], *numbers, said, hover, spent, "" if known else row["detail"])

    return Table(
        "Guarantees for the vehicle",
        "Distances from the source that the vehicle in closed loop certainly does not exceed at the prescribed time, "
        "and in the long run: of every vehicle that starts within the radius, from every heading, with the filter at "
        "the field's value. This is about the vehicle, not about its average. Where no guarantee is known there may be "
        "one. "
        f"Found once, and proved again by the command of the row; all of them by: `{data['command']}`.",
        ("command", "ω", "μ", "start within", "at T within", "later within", "CPU seconds", "why not"),
        tuple(map(words, data["rows"])),
    )


def _short(number: float | None) -> str:
    return "" if number is None else f"{number:.1e}"
