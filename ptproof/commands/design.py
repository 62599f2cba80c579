"""``ptproof design``: numbers that are certified to end within a residual."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ptproof.commands import certified, options
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.design import Design


@click.command()
@click.argument("problem", metavar="NAME|PROBLEM.toml")
@click.option("--residual", required=True, metavar="R", help="The distance from the source wanted at t0 + T. [length]")
@click.option("--u1-max", metavar="X", help="The largest forward velocity that the vehicle can do. [length/time]")
@click.option("--u2-max", metavar="X", help="The largest angular velocity that it can do. [rad/time]")
@click.option(
    "--free", default="omega,mu", show_default=True, metavar="NAMES",
    help="Which of k, T, omega, mu and nu_min may be chosen; the others stay as the problem has them.",
)  # fmt: skip
@click.option("--radius", metavar="R", help="Of the ball of starts; left out, the problem's start is on its rim.")
@click.option("--filter-gap", default="0", show_default=True, metavar="G", help="|F - z| at the start is at most this.")
@click.option("--seeker", metavar="NAME", help="Only pt has a certificate; a problem meant for another one is refused.")
@click.option("--over", metavar="NAMES", help="The two numbers of the map (default: omega and another that is free).")
@click.option("--time-limit", type=float, default=600.0, show_default=True, help="Seconds for the search.")
@options.jobs
@options.plot("a map of what is feasible over two of the numbers")
@options.as_json
def design(
    problem: str, residual: str, u1_max: str | None, u2_max: str | None, free: str, radius: str | None,
    filter_gap: str, seeker: str | None, over: str | None, time_limit: float, jobs: int | None, plot: str | None,
    as_json: bool,
) -> int:  # fmt: skip
    """Find numbers with which the vehicle itself is certified to end within a residual.

    For every heading and every start within the radius, with the clip and the drift, and with inputs that certainly
    stay below their limits. What the average's bound rules out is not tried. The status is 0 if numbers were found, 1
    if none were, which does not say that there are none.

    \b
    Example:  ptproof design saturated --seeker pt --residual 0.3 --u1-max 400 --free omega,mu
    """
    from ptproof.commands.terminal import progress
    from ptproof.design import Limits
    from ptproof.design import design as search
    from ptproof.reading.expressions import parse

    def exact(text: str | None, where: str) -> object:
        return None if text is None else parse(text, where=f"--{where}")

    otherwise = "numbers for its loop without that are looked for"
    target = certified.problem_for_pt("design", problem, seeker, otherwise)
    names = [name.strip() for name in free.split(",") if name.strip()]
    limits = Limits(exact(u1_max, "u1-max"), exact(u2_max, "u2-max"))
    start, gap = exact(radius, "radius"), exact(filter_gap, "filter-gap")
    try:
        with progress("certificates", 100) as advance:
            found = search(
                target, exact(residual, "residual"), limits=limits, free=names, radius=start, filter_gap=gap,
                time_limit=time_limit, workers=jobs, progress=advance,
            )  # fmt: skip
    except InputError as error:
        raise InputError(f"{problem}: {error}") from None
    if plot is not None:
        _map(found, _axes(over, names), limits, start, gap, jobs, plot)
    if as_json:
        options.print_json({"problem": problem, **found.to_json()})
    else:
        click.echo(_text(found))
    return 0 if found.certificate is not None else 1


def _axes(over: str | None, free: list[str]) -> tuple[str, str]:
    if over is not None:
        names = [name.strip() for name in over.split(",")]
        if len(names) != 2:
            raise InputError(f"--over: expected two names, such as omega,k, got {over!r}")
        return names[0], names[1]
    return "omega", next((name for name in free if name not in ("omega", "mu")), "k")


def _map(
    found: Design, names: tuple[str, str], limits: object, radius: object, gap: object, jobs: int | None, path: str
) -> None:
    from typing import Any

    from ptproof.commands.terminal import progress
    from ptproof.design import feasible_map
    from ptproof.simulation.drawing import save

    size = 7
    known: Any = {"limits": limits, "radius": radius, "filter_gap": gap, "workers": jobs}
    with progress("map", size * size) as advance:
        figure, _ = feasible_map(found, names, size=size, progress=advance, **known)
    save(figure, path)


def _text(found: Design) -> str:
    certificate = found.certificate
    if certificate is None:
        return f"no numbers found: {found.detail}"
    from ptproof.balls.rounding import at_least, at_most
    from ptproof.design.answer import decimal_text

    rows = [
        f"the vehicle itself is certified to be within {at_most(certificate.distances[-1], 6)} of the source",
        f"at t0 + T, for every heading and every start within {at_least(certificate.start_radius, 6)}",
        "",
        "[seeker]",
        *(f'{name} = "{decimal_text(value)}"' for name, value in found.numbers.items()),
        "",
    ]
    for name, value in (("u1", found.u1_peak), ("|u2|", found.u2_peak)):
        if value is not None and value < float("inf"):
            rows.append(f"{name} certainly stays below {at_most(value, 6)}")
    rows.append(
        f"on the way at most {at_most(max(certificate.distances), 6)} from the source; {len(found.trials)} tried"
    )
    if found.problem.saturation is not None:
        rows.append(
            "all this is about the seeker pt: what a saturated angular acceleration makes of it is not certified"
        )
    return "\n".join(rows)
