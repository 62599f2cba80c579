"""What a search for the smallest ω or the largest start says."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.certify.loop.frontier import Frontier
    from ptproof.problem import Problem

_HEADS = {
    "omega": "the smallest omega with a bound that is proved, mu*omega unchanged",
    "start_radius": "the largest start radius with a bound that is proved",
}


def show(
    name: str, problem: Problem, varied: str, radius: Any, given: Mapping[str, Any], plot: str | None, as_json: bool
) -> int:
    """Search and print; the exit status is 0 if a bound was proved anywhere, 1 if not."""
    from ptproof.certify.loop.frontier import OMEGA, largest_start, smallest_omega

    if plot is not None:
        raise InputError("--plot: a search has no picture; draw the certificate that it finds")
    found = (smallest_omega if varied == OMEGA else largest_start)(problem, radius, **given)
    if as_json:
        options.print_json(found.to_json())
    else:
        click.echo(text(name, found))
    return 0 if found.best is not None else 1


def text(name: str, found: Frontier) -> str:
    """What was tried, the farthest that is proved, and that nothing is said beyond it."""
    from ptproof.balls.rounding import at_least, at_most

    rows = [f"{name}, the vehicle in closed loop: {_HEADS[found.varied]}"]
    for item in found.tries:
        final = item.certificate.final
        said = "undecided" if final is None else f"proved, within {at_most(final)} at the end"
        rows.append(f"  {found.varied} = {float(item.value):<10.4g} {said}")
    best, beyond = found.best, found.beyond
    if best is None or best.certificate.final is None:
        rows.append("no guarantee was found at any of these values: nothing is said of vehicles there")
    else:
        end, radius = at_most(best.certificate.final), at_least(best.certificate.start_radius, 6)
        rows.append(
            f"proved at {found.varied} = {float(best.value):.6g}: within {end} of the source at "
            f"t = {best.certificate.times[-1]:.6g}, from every start within {radius}"
        )
    if beyond is not None:
        rows.append(
            f"no guarantee was found at {found.varied} = {float(beyond.value):.6g}, and nothing is said of vehicles "
            f"there: {beyond.certificate.detail}"
        )
    return "\n".join(rows)
