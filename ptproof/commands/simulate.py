"""``ptproof simulate``: simulate a closed loop and its average."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.problem import Problem
    from ptproof.simulation.trajectory import Ensemble, Trajectory


@click.command()
@click.argument("problem", metavar="NAME|PROBLEM.toml")
@click.option(
    "--seeker", type=click.Choice(["pt", "asymptotic", "saturated", "saturated-constant"]),
    help="Left out: pt, or saturated for a problem with a [saturation] table named saturated.",
)  # fmt: skip
@click.option("--frame", type=click.Choice(["t", "tau"]), default="t", show_default=True)
@click.option(
    "--engine", type=click.Choice(["casadi", "lsoda", "radau", "dop853", "heyoka"]), help="Left out: chosen to fit."
)
@click.option("--model", type=click.Choice(["closed loop", "reduced model", "average"]), default="closed loop")
@click.option("--rtol", type=float, default=1e-8, show_default=True, help="The error asked for.")
@click.option("--until", metavar="TIME", help="Another end than the prescribed time.")
@click.option("--ensemble", type=click.IntRange(1, 10_000_000), metavar="N", help="N members with random headings.")
@click.option(
    "--vary",
    multiple=True,
    metavar="NAME=LOW:HIGH",
    help="What differs in an ensemble instead of theta; may be repeated.",
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True)
@click.option("--workers", type=click.IntRange(1, 1024), default=1, show_default=True, help="Threads for an ensemble.")
@click.option("--time-limit", type=float, default=60.0, show_default=True, help="Seconds for each run.")
@click.option("--plot", type=click.Path(dir_okay=False), metavar="FILE", help="Draw to a .png, .svg or .pdf file.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON on standard output, and nothing else there.")
def simulate(
    problem: str, seeker: str | None, frame: str, engine: str | None, model: str, rtol: float, until: str | None,
    ensemble: int | None, vary: tuple[str, ...], seed: int, workers: int, time_limit: float, plot: str | None,
    as_json: bool,
) -> None:  # fmt: skip
    """Integrate a seeker to its prescribed time.

    NAME is vanishing, nonvanishing or saturated, the paper's examples; anything else is read as a problem file.
    The status is 0 if T was reached (by all members of an ensemble), 1 if not, 2 for bad input.
    """
    from ptproof.simulation.ensembles import Progress
    from ptproof.simulation.run import simulate as run

    try:
        target = _target(problem)
        _check_plot(plot)
        if seeker is None:
            seeker = "saturated" if target.name == "saturated" and target.saturation is not None else "pt"
        options: dict[str, Any] = {
            "model": model, "rtol": rtol, "engine": engine, "until": until, "seed": seed, "workers": workers,
            "time_limit": time_limit, "ensemble": ensemble, "vary": _ranges(vary),
        }  # fmt: skip
        result: Trajectory | Ensemble
        if ensemble is None:
            result = run(target, seeker, frame, **options)
        else:
            with _progress(ensemble) as advance:
                step: Progress = advance
                result = run(target, seeker, frame, progress=step, **options)
        if plot is not None:
            _draw(target, result, seeker, plot)
    except InputError as error:
        click.echo(f"ptproof simulate: {error}", err=True)
        sys.exit(2)
    data = as_data(result, problem)
    click.echo(json.dumps(data) if as_json else _text(data, result))
    sys.exit(0 if _reached(result) else 1)


def as_data(result: Trajectory | Ensemble, name: str) -> dict[str, Any]:
    """The JSON of a result; numbers that are not finite become null."""
    settings = result.settings
    data: dict[str, Any] = {"example": name, "seeker": settings["seeker"], "frame": settings["frame"]}
    data["engine"] = settings["engine"]
    from ptproof.simulation.trajectory import Ensemble

    if isinstance(result, Ensemble):
        distance = {key: _finite(getattr(result, key)) for key in ("median", "q95", "max")}
        return data | {
            "N": result.size, "seed": settings["seed"], "outcomes": dict(result.counts), "distance": distance,
            "seconds": round(result.seconds, 6),
        }  # fmt: skip
    final = result.final
    position = [_finite(float(result.x[i, -1])) for i in range(2)]
    heading = _finite(final["theta"]) if "theta" in final else None
    return data | {
        "outcome": str(result.outcome),
        "message": result.message,
        "final": {
            "t": _finite(final["t"]), "x": position, "theta": heading,
            "z": _finite(final["z"]) if "z" in final else None,
            "field": _finite(final["field"]), "distance": _finite(final["distance"]),
        },
        "seconds": round(result.seconds, 6),
    }  # fmt: skip


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _reached(result: Any) -> bool:
    from ptproof.simulation.plan import Outcome

    outcomes = getattr(result, "outcomes", None) or (result.outcome,)
    return all(outcome is Outcome.REACHED for outcome in outcomes)


def _target(name: str) -> Problem:
    from ptproof.problem import EXAMPLES, example, load

    if name in EXAMPLES or not (name.endswith(".toml") or Path(name).exists()):
        return example(name)
    return load(name)


def _ranges(texts: tuple[str, ...]) -> dict[str, tuple[str, str]] | None:
    ranges = {}
    for text in texts:
        name, found, interval = text.partition("=")
        low, colon, high = interval.partition(":")
        if not (name and found and colon and low and high):
            raise InputError(f"--vary: expected NAME=LOW:HIGH, such as k=1:2, got {text!r}")
        ranges[name.strip()] = (low, high)
    return ranges or None


def _check_plot(plot: str | None) -> None:
    if plot is None:
        return
    if Path(plot).suffix.lower() not in (".png", ".svg", ".pdf"):
        raise InputError(f"--plot: {plot} should end in .png, .svg or .pdf")
    if not Path(plot).resolve().parent.is_dir():
        raise InputError(f"--plot: there is no folder {Path(plot).resolve().parent}")


def _progress(total: int) -> Any:
    """A progress bar on standard error; a context that gives the function to call with newly finished members."""
    from contextlib import contextmanager

    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    @contextmanager
    def bar() -> Any:
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
            task = progress.add_task("trajectories", total=total)
            yield lambda done: progress.advance(task, done)

    return bar()


def _draw(target: Problem, result: Any, seeker: str, plot: str) -> None:
    from ptproof.simulation.figures import overview, save

    save(result.plot().figure if hasattr(result, "outcomes") else overview(target, result), plot)


def _text(data: dict[str, Any], result: Any) -> str:
    head = f"{data['example']}, {data['seeker']} seeker, in {data['frame']}, by {data['engine']}"
    if "N" in data:
        counts = ", ".join(f"{count} {word}" for word, count in data["outcomes"].items())
        spread = ", ".join(f"{name} {value:.6g}" for name, value in data["distance"].items() if value is not None)
        return f"{head}\n{data['N']} trajectories: {counts}\nfinal distance from the source: {spread}"
    final = data["final"]
    rows = [head, f"{data['outcome']} at t = {final['t']:.6g}"]
    if data["message"]:
        rows.append(data["message"])
    rows.append("x = (" + ", ".join(f"{value:.6g}" for value in final["x"]) + ")")
    rows.append(f"field {final['field']:.6g}, distance from the source {final['distance']:.6g}")
    return "\n".join(rows)
