"""``ptproof simulate --certify``: what is certain of every such vehicle, beside the run of one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ptproof.commands.enclosing import check_absent
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.certify import LoopCertificate
    from ptproof.problem import Problem

_OTHER = ("sample_time", "noise", "motion", "until")


def check(ensemble: int | None, how: Mapping[str, Any]) -> None:
    """Refuse what a certificate does not speak of."""
    if ensemble is not None:
        raise InputError("--certify: stands beside one run; leave out --ensemble")
    if how["seeker"] != "pt" or how["model"] != "closed loop":
        raise InputError("--certify: a certificate is for the closed loop of the seeker pt")
    check_absent(how, _OTHER, "--certify: is about the closed loop itself, up to T")


def found(problem: Problem, _: bool, how: dict[str, Any]) -> LoopCertificate:
    """The certificate for every start that is as near as the problem's."""
    from ptproof.certify import certify_loop

    return certify_loop(problem)


def words(certificate: LoopCertificate) -> list[str]:
    """The lines for people."""
    from ptproof.balls.rounding import at_least, at_most

    starts = f"every vehicle that starts within {at_least(certificate.start_radius, 6)}, from every heading"
    if certificate.final is None:
        return [f"no certificate for {starts}: {certificate.detail}"]
    return [f"certified for {starts}: distance at most {at_most(certificate.final, 6)} at T"]


def draw(figure: Any, certificate: LoopCertificate) -> None:
    """The bound over the distance, in the picture of a run."""
    from ptproof.simulation.drawing import RED

    if certificate.final is None:
        return
    axes = figure.axes[2]
    grid = instants(certificate)
    axes.plot(grid, certificate.bound(grid), color=RED, lw=1.2, label="certified for every such vehicle")
    axes.legend(fontsize=7)


def instants(certificate: LoopCertificate) -> Any:
    """Times close enough to show the steps of the bound."""
    import numpy as np

    return np.unique(np.append(np.linspace(certificate.times[0], certificate.times[-1], 1001), certificate.times))


def problem_for_pt(command: str, name: str, seeker: str | None, otherwise: str) -> Problem:
    """The example or the problem file of that name, refused where it is meant for a seeker without certificates."""
    from ptproof.problem import EXAMPLES, example, load

    target = example(name) if name in EXAMPLES else load(name)
    if (meant := seeker or target.default_seeker) != "pt":
        why = f"a certificate is for the seeker pt, and {name} is meant for {meant}"
        raise InputError(f"{command}: {why}; with --seeker pt {otherwise}")
    return target
