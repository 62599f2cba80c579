"""``ptproof simulate``: simulate a closed loop and its average."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options
from ptproof.commands.theorems import Theorems
from ptproof.errors import InputError
from ptproof.simulation.engines import names

if TYPE_CHECKING:
    from ptproof.problem import Problem
    from ptproof.simulation import Ensemble, Trajectory


def _seeker(context: click.Context, option: click.Parameter, name: str | None) -> str | None:
    # The seekers are looked up when one is chosen: their laws need SymPy, which would hold up the help.
    from ptproof.problem.seekers import seekers_of

    return name and click.Choice(seekers_of("simulate")).convert(name, option, context)


def _table(context: click.Context, option: click.Parameter, name: str | None) -> str | None:
    from ptproof.simulation.trajectory import check_name

    if name is not None:
        check_name(name)
    return name


@click.command()
@click.argument("problem", metavar="NAME|PROBLEM.toml")
@click.option(
    "--seeker", metavar="NAME", callback=_seeker,
    help="Left out: the one whose tables the problem has, such as saturated for [saturation]; pt where it has none. "
    "A name that is none is refused with those that there are.",
)  # fmt: skip
@click.option("--frame", type=click.Choice(["t", "tau"]), default="t", show_default=True, help="The time to run in.")
@click.option("--engine", type=click.Choice(names()), help="Left out: chosen to fit.")
@click.option(
    "--model",
    type=click.Choice(["closed loop", "reduced model", "average"]),
    default="closed loop",
    show_default=True,
    help="What is run.",
)
@click.option("--rtol", default="1e-8", show_default=True, metavar="NUMBER", help="The error asked for.")
@click.option("--until", metavar="TIME", help="Another end than the prescribed time.")
@click.option("--ensemble", type=click.IntRange(1, 10_000_000), metavar="N", help="N members with random headings.")
@click.option(
    "--vary", multiple=True, metavar="NAME=LOW:HIGH",
    help="What differs in an ensemble instead of theta; may be repeated.",
)  # fmt: skip
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of what differs in an ensemble.")
@click.option(
    "--sample-time", metavar="TIME",
    help="Measure the field at instants this far apart, and hold the inputs between them. [time]",
)  # fmt: skip
@click.option(
    "--noise", metavar="NUMBER",
    help="The standard deviation of noise on each measurement. [field]; without --sample-time, 20 samples in the "
    "filter's time constant at its shortest.",
)  # fmt: skip
@click.option("--noise-seed", type=click.IntRange(0), default=0, show_default=True, help="Of the noise that is drawn.")
@click.option(
    "--motion", nargs=2, metavar="D1 D2", default=None,
    help="A source that moves: how far from its place it is, two expressions in t, such as t/5 'sin(t)'.",
)  # fmt: skip
@click.option("--save", "save_as", metavar="FILE", callback=_table, help="Write the samples to a .csv or .npz file.")
@click.option("--c-code", metavar="FILE", help="Write the feedback law, with the problem's numbers, as C to a file.")
@click.option("--workers", type=click.IntRange(1, 1024), default=1, show_default=True, help="Threads for an ensemble.")
@options.cluster
@click.option("--time-limit", type=float, default=60.0, show_default=True, help="Seconds for each run.")
@click.option("--enclose", is_flag=True, help="Enclose the run as well: a theorem about this trajectory.")
@click.option(
    "--enclose-width", default="1e-6", show_default=True, metavar="NUMBER", help="How closely, in each state."
)
@click.option("--certify", "certifying", is_flag=True, help="Certify a bound for every such vehicle beside the run.")
@options.plot("the run, or the distances of an ensemble,")
@options.as_json
def simulate(
    problem: str, seeker: str | None, ensemble: int | None, vary: tuple[str, ...], seed: int, workers: int,
    cluster: str | None, plot: str | None, save_as: str | None, c_code: str | None, as_json: bool, enclose: bool,
    enclose_width: str, certifying: bool, **how: Any,
) -> int:  # fmt: skip
    """Integrate a seeker to its prescribed time: the vehicle, and its average beside it.

    NAME is vanishing, nonvanishing or saturated, the paper's examples; anything else is read as a problem file.
    The status is 0 if T was reached (by all members of an ensemble) and what is asked to be proved beside it is, 1
    if not or if the field was larger on the way than at the stated source, 2 for bad input, such as a stated source
    that certainly is no maximum of the field.
    """
    from ptproof.commands.terminal import progress
    from ptproof.problem import example, load
    from ptproof.problem.doubts import run_doubt, source_doubt
    from ptproof.simulation import Ensemble, run
    from ptproof.simulation.blocks import feedback_code

    target = load(problem) if _is_file(problem) else example(problem)
    how["seeker"] = seeker or target.default_seeker
    result: Trajectory | Ensemble
    theorems = Theorems.asked(enclose_width if enclose else None, certifying, ensemble, how)
    with _naming(problem):
        if (certain := source_doubt(target)) is not None:
            raise InputError(certain)
        if ensemble is not None:
            with options.connected(cluster) as client, progress("trajectories", ensemble) as advance:
                result = run.ensemble(
                    target, ensemble, seed=seed, vary=_ranges(vary), workers=workers, client=client,
                    progress=advance, **how,
                )  # fmt: skip
        elif vary or cluster:
            raise InputError("--vary, --cluster: need --ensemble N, the number of members")
        else:
            result = run.simulate(target, **how)
            theorems = theorems.about(target, how)
        beside = None if isinstance(result, Ensemble) else run.average_beside(target, result, **how)
        if c_code is not None:
            _write_code(c_code, feedback_code(target, how["seeker"]))
    if save_as is not None:
        result.save(save_as)
    if plot is not None:
        _draw(target, result, beside, theorems, plot)
    doubt = run_doubt(target, _measured(target, result))
    data = as_data(result, problem, beside) | {"doubt": doubt} | theorems.data
    if as_json:
        options.print_json(data)
    else:
        click.echo("\n".join([_text(data, result), *theorems.words]))
    outcomes = result.outcomes if isinstance(result, Ensemble) else (result.outcome,)
    return 0 if doubt is None and theorems.proved and all(outcome.complete for outcome in outcomes) else 1


def _draw(
    target: Problem, result: Trajectory | Ensemble, beside: Trajectory | None, theorems: Theorems, file: str
) -> None:
    from ptproof.simulation import Ensemble
    from ptproof.simulation.drawing import save
    from ptproof.simulation.figures import overview

    figure = result.plot().figure if isinstance(result, Ensemble) else overview(target, result, beside)
    theorems.draw(figure)
    save(figure, file)


def _measured(target: Problem, result: Trajectory | Ensemble) -> list[float]:
    """The field along a run, or where the members of an ensemble ended, if its source rests."""
    from ptproof.simulation import Ensemble
    from ptproof.simulation.quantities import field_function

    if not isinstance(result, Ensemble):
        return [] if result.field is None else result.field.tolist()
    return [] if "motion" in result.settings else field_function(target.field)(result.x[:2]).tolist()


def _write_code(name: str, code: str) -> None:
    try:
        Path(name).write_text(code, "utf-8")
    except OSError as error:
        raise InputError(f"--c-code: {name} can't be written: {error.strerror or error}") from None


def as_data(result: Trajectory | Ensemble, name: str, average: Trajectory | None = None) -> dict[str, Any]:
    """The JSON of a result, and of the ``average`` beside it; numbers that are not finite become null."""
    from ptproof.simulation import Ensemble

    settings = result.settings
    data: dict[str, Any] = {"example": name} | {key: settings[key] for key in ("seeker", "frame", "engine")}
    if isinstance(result, Ensemble):
        distance = {key: _finite(getattr(result, key)) for key in ("median", "q95", "max")}
        return data | {
            "N": result.size, "seed": settings["seed"], "outcomes": dict(result.counts), "distance": distance,
            "seconds": round(result.seconds, 6),
        }  # fmt: skip
    final = {key: _finite(value) for key, value in result.final.items()}
    wanted = {key: final.get(key) for key in ("theta", "z", "field", "distance")}
    position = [_finite(float(value)) for value in result.x[:2, -1]]
    return data | {
        "outcome": str(result.outcome), "limit": result.limit and str(result.limit), "message": result.message,
        "final": {"t": final["t"], "x": position, **wanted},
        "source": None if result.source is None else [_finite(float(value)) for value in result.source[:, -1]],
        "average": None if average is None else _beside(average), "seconds": round(result.seconds, 6),
    }  # fmt: skip


def _beside(average: Trajectory) -> dict[str, Any]:
    final = average.final
    return {
        "outcome": str(average.outcome), "t": _finite(final["t"]),
        "x": [_finite(float(value)) for value in average.x[:2, -1]], "distance": _finite(final["distance"]),
    }  # fmt: skip


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _is_file(name: str) -> bool:
    from ptproof.problem import EXAMPLES

    return name not in EXAMPLES and (name.endswith(".toml") or Path(name).exists())


@contextmanager
def _naming(name: str) -> Iterator[None]:
    """Errors of a run that a file asks for name the file."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{name}: {error}") if _is_file(name) else error from None


def _ranges(texts: tuple[str, ...]) -> dict[str, tuple[str, str]] | None:
    ranges = {}
    for text in texts:
        name, found, interval = text.partition("=")
        low, colon, high = interval.partition(":")
        if not (name and found and colon and low and high):
            raise InputError(f"--vary: expected NAME=LOW:HIGH, such as k=1:2, got {text!r}")
        ranges[name.strip()] = (low, high)
    return ranges or None


def _text(data: dict[str, Any], result: Any) -> str:
    head = f"{data['example']}, {data['seeker']} seeker, in {data['frame']}, by {data['engine']}"
    if data["doubt"]:
        head += f"\n{data['doubt']}"
    if "N" in data:
        counts = ", ".join(f"{count} {word}" for word, count in data["outcomes"].items())
        spread = ", ".join(f"{name} {value:.6g}" for name, value in data["distance"].items() if value is not None)
        return f"{head}\n{data['N']} trajectories: {counts}\nfinal distance from the source: {spread}"
    final = data["final"]
    ended = f"stopped by {limit}" if (limit := data["limit"]) else data["outcome"]
    rows = [head, f"{ended} at t = {_shown(final['t'])}"]
    if data["message"]:
        rows.append(data["message"])
    vehicle = "vehicle" if result.settings.get("model") == "closed loop" else result.settings.get("model")
    rows.append(f"x = ({', '.join(map(_shown, final['x']))})")
    if "motion" in result.settings:
        rows.append(f"the source has moved to ({', '.join(map(_shown, data['source']))})")
    rows.append(f"{vehicle}: field {_shown(final['field'])}, distance from the source {_shown(final['distance'])}")
    if (average := data["average"]) is not None:
        alike = average["outcome"] == str(result.outcome)
        at = "" if alike else f" ({average['outcome']} at t = {_shown(average['t'])})"
        rows.append(f"its average (not the vehicle): distance from the source {_shown(average['distance'])}{at}")
    elif vehicle == "vehicle":
        rows.append(f"no average stands beside it: the {data['seeker']} seeker's heading has dynamics of its own")
    return "\n".join(rows)


def _shown(value: float | None) -> str:
    return "not finite" if value is None else f"{value:.6g}"
