"""``ptproof simulate --enclose``: the enclosure of the run beside it, in words and in a picture."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.certify.trajectory import Enclosure
    from ptproof.problem import Problem


_NOT_SMOOTH = ("sample_time", "noise", "motion")


def check(ensemble: int | None, how: Mapping[str, Any]) -> None:
    """Refuse what is no single run of the closed loop itself."""
    if ensemble is not None:
        raise InputError("--enclose: is about one run; leave out --ensemble")
    check_absent(how, _NOT_SMOOTH, "--enclose: is about the closed loop itself, as the problem states it")


def check_absent(how: Mapping[str, Any], names: Iterable[str], why: str) -> None:
    """Refuse options of a run of which nothing is proved."""
    for name in names:
        if how.get(name) is not None:
            raise InputError(f"{why}; leave out --{name.replace('_', '-')}")


def found(problem: Problem, width: str, how: dict[str, Any]) -> Enclosure:
    """Enclose the run that the options describe, with a bar of what is done."""
    from ptproof.certify.trajectory import enclose
    from ptproof.commands.terminal import progress

    with progress("enclosing", 1000) as advance:
        done = 0

        def told(share: float) -> None:
            nonlocal done
            new = int(1000 * share) - done
            if new > 0:
                done += new
                advance(new)

        return enclose(
            problem, how["seeker"], how["frame"], until=how["until"], model=how["model"], width=width,
            seconds=how["time_limit"], progress=told,
        )  # fmt: skip


def words(enclosure: Enclosure) -> list[str]:
    """The lines for people."""
    time, end = enclosure.time, enclosure.times[-1]
    rows = [f"enclosure {enclosure.verdict}: {enclosure.detail}"]
    rows.append(
        f"in {enclosure.steps} steps to {time} = {end:.6g}, each state at each of them to {enclosure.width:.2g} "
        f"({enclosure.seconds:.1f} s)"
    )
    rows += [f"  {name:<6} in [{low!r}, {high!r}]" for name, (low, high) in enclosure.final.items()]
    if enclosure.switches:
        rows.append(f"  {len(enclosure.switches)} switches, each enclosed")
    return rows


def draw(figure: Any, enclosure: Enclosure) -> None:
    """The boxes of the enclosure over the path, in the picture of a run."""
    import numpy as np

    from ptproof.simulation.drawing import GREEN, PURPLE

    lower, upper = np.array(enclosure.lower)[:, :2], np.array(enclosure.upper)[:, :2]
    middle, half = (lower + upper) / 2, (upper - lower) / 2
    axes = figure.axes[0]
    style = {
        "fmt": "none",
        "ecolor": GREEN if str(enclosure.verdict) == "proved" else PURPLE,
        "elinewidth": 0.8,
        "capsize": 1.5,
    }
    axes.errorbar(
        middle[:, 0], middle[:, 1], xerr=half[:, 0], yerr=half[:, 1], **style,
        label=f"enclosure, {enclosure.verdict}: width {enclosure.width:.1g}",
    )  # fmt: skip
    axes.legend(fontsize=7)
