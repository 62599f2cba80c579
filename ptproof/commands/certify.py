"""``ptproof certify``: prove how close a vehicle comes to the source, for every start within a radius."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import certified, options

if TYPE_CHECKING:
    from ptproof.certify import LoopCertificate
    from ptproof.problem import Problem
    from ptproof.simulation.attack import Attacked

_VEHICLES = 1000


@click.command()
@click.argument("problem", metavar="NAME|PROBLEM.toml")
@click.option(
    "--radius", metavar="R", help="The start is within this distance of the source; the problem's own if left out."
)
@click.option("--filter-gap", default="0", show_default=True, metavar="G", help="|F(x) - z| at the start, at most.")
@click.option("--omega", metavar="NUMBER", help="Another frequency than the problem's.")
@click.option("--mu", metavar="NUMBER", help="Another filter constant.")
@click.option("--k", metavar="NUMBER", help="Another gain.")
@click.option("--T", "horizon", metavar="NUMBER", help="Another prescribed time.")
@click.option("--nu-min", metavar="NUMBER", help="Another clip of the gain, in (0, 1].")
@click.option("--seeker", metavar="NAME", help="Only pt has a certificate; a problem meant for another one is refused.")
@click.option(
    "--tolerance", type=click.FloatRange(0.001, 10), default=0.12, show_default=True, help="Smaller: sharper, slower."
)
@click.option(
    "--attack", type=click.IntRange(1, 10_000_000), metavar="N", help="Hold N simulated vehicles against the bound."
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of the vehicles of --attack.")
@click.option(
    "--smallest-omega",
    "varied",
    flag_value="omega",
    help="Look for the smallest omega with a bound, by halves; mu*omega stays.",
)
@click.option(
    "--largest-start", "varied", flag_value="start_radius", help="Look for the largest start radius with a bound."
)
@options.jobs
@options.cluster
@options.plot("the bound over a thousand simulated vehicles")
@options.as_json
def certify(
    problem: str, radius: str | None, filter_gap: str, seeker: str | None, tolerance: float, attack: int | None,
    seed: int, jobs: int | None, cluster: str | None, plot: str | None, as_json: bool, varied: str | None,
    **numbers: str | None,
) -> int:  # fmt: skip
    """Prove a bound of the distance between the vehicle and the source, at every time up to the prescribed one.

    It holds for every start within the radius, every heading and every filter state within the gap, for the closed loop
    as it is integrated: this omega, this mu, clip and drift included. Nothing is sampled. The status is 0 if a bound is
    proved, 1 if not, 2 for bad input.
    """
    from ptproof.certify import certify_loop
    from ptproof.commands import frontier
    from ptproof.proof.verdict import Verdict
    from ptproof.reading.expressions import parse

    target = certified.problem_for_pt("certify", problem, seeker, "its loop without that is certified")
    target = retuned(target, numbers)
    start = None if radius is None else parse(radius, where="--radius")
    gap = parse(filter_gap, where="--filter-gap")
    with options.connected(cluster) as client:
        given: dict[str, Any] = {"filter_gap": gap, "tolerance": tolerance, "workers": jobs, "client": client}
        if varied is not None:
            return frontier.show(problem, target, varied, start, given, plot, as_json)
        found = certify_loop(target, start, explain=True, **given)
    proved = found.verdict is Verdict.PROVED
    attacked = _attack(target, found, attack, seed, jobs) if attack is not None and proved else None
    outside = _draw(target, found, plot, jobs) if plot is not None and proved else 0
    if as_json:
        options.print_json(found.to_json() | ({} if attacked is None else {"attack": attacked.to_json()}))
    else:
        click.echo("\n".join([_text(problem, found), *([] if attacked is None else [str(attacked)])]))
    broken = outside + (0 if attacked is None else attacked.outside)
    if broken:
        click.echo(f"ptproof: {broken} simulated vehicles are outside the bound: please report this", err=True)
    return 0 if proved and not broken else 1


def retuned(problem: Problem, numbers: dict[str, str | None]) -> Problem:
    """The problem with other numbers, given as text."""
    from dataclasses import replace

    from ptproof.reading.expressions import parse

    given = {name: parse(text, where=f"--{name}") for name, text in numbers.items() if text is not None}
    if "horizon" in given:
        given["T"] = given.pop("horizon")
    return replace(problem, tuning=replace(problem.tuning, **given)) if given else problem


def _text(name: str, found: LoopCertificate) -> str:
    from ptproof.balls.rounding import at_least, at_most

    head = f"{name}, the vehicle in closed loop, omega = {found.omega:.6g}, mu = {found.mu:.6g}"
    radius, gap = at_least(found.start_radius, 6), at_least(found.filter_gap, 6)
    starts = f"every start within {radius}, every heading, a filter within {gap} of F"
    if found.final is None:
        boxes = [f"fails at {box}" for box in found.failing]
        help = [] if found.help is None else [str(found.help)]
        return "\n".join([head, starts, f"undecided: {found.detail}", *boxes, *help])
    marks = sorted({round(i * (len(found.times) - 1) / 8) for i in range(9)})
    rows = [f"  t = {found.times[i]:<10.4g} distance at most {at_most(found.distances[i])}" for i in marks]
    rest = [] if found.hover is None else [f"in the long run at most {at_most(found.hover)}, if the last gain went on"]
    last = f"proved: within {at_most(found.final)} of the source at t = {found.times[-1]:.6g}"
    return "\n".join([head, starts, last, *rest, *rows, found.detail])


def _attack(problem: Problem, found: LoopCertificate, size: int, seed: int, jobs: int | None) -> Attacked:
    """Simulated vehicles, with their progress on standard error."""
    from ptproof.commands.terminal import progress
    from ptproof.simulation.attack import attack_loop

    with progress("vehicles", size) as advance:
        return attack_loop(problem, found, size, seed=seed, workers=jobs, progress=advance)


def _draw(problem: Problem, found: LoopCertificate, path: str, jobs: int | None) -> int:
    """The bound over simulated vehicles; gives how many are outside, which would be an error of our own."""
    import numpy as np

    from ptproof.simulation.attack import outside_of
    from ptproof.simulation.drawing import save
    from ptproof.simulation.fleet import fleet

    many = fleet(problem, _VEHICLES, radius=found.start_radius, filter_gap=found.filter_gap, workers=jobs)
    worst = many.distances.max(axis=0)
    outside = outside_of(found.bound(many.times), many.distances)
    save(_figure(found, many.times, np.asarray(worst), many.distances, outside), path)
    return outside


def _figure(found: LoopCertificate, times: Any, worst: Any, distances: Any, outside: int) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.2), layout="constrained")
    axes = figure.subplots()
    axes.plot(times, distances[:60].T, color="0.75", linewidth=0.4)
    axes.plot(
        times, worst, color="tab:blue", label=f"the farthest of {len(distances)} simulated vehicles, {outside} outside"
    )
    grid = certified.instants(found)
    axes.plot(grid, found.bound(grid), color="tab:red", label="proved bound for the vehicle")
    axes.set(xlabel="t", ylabel="distance from the source", title=f"ω = {found.omega:g}, μ = {found.mu:.4g}")
    axes.set_ylim(bottom=0)
    axes.legend()
    return figure
