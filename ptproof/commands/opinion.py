"""The second opinion of Coq's kernel, for the commands that offer it: the options, the run and what is said of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ptproof.proof.result import Verification

kernel = click.option(
    "--kernel", is_flag=True, help="Have Coq's kernel check what is proved, restated for it from the claims themselves."
)
keep = click.option(
    "--keep", type=click.Path(file_okay=False, path_type=Path), metavar="DIR",
    help="With --kernel: leave the files for Coq in DIR.",
)  # fmt: skip


def available(kernel: bool, keep: Path | None) -> None:
    """Refuse what cannot be done, before anything is decided.

    Raises
    ------
    InputError
        If Coq or a library of it is not installed, or a folder is named without ``--kernel``.
    """
    from ptproof.errors import InputError

    if keep is not None and not kernel:
        raise InputError("--keep: names a folder for the files of --kernel, which is not asked for")
    if kernel:
        from ptproof.proof.kernel import missing

        if lacking := missing():
            raise InputError(f"--kernel: {lacking}")


def confirmed(verification: Verification, jobs: int | None, keep: Path | None) -> Verification:
    """The same with the evidence of Coq's kernel; what it did not confirm is said on standard error."""
    from ptproof.commands.terminal import progress
    from ptproof.proof.kernel.check import second_opinion
    from ptproof.proof.verdict import Verdict

    proved = sum(result.verdict is Verdict.PROVED for result in verification.results)
    with progress("asking Coq", proved) as advance:
        results, said = second_opinion(
            verification.results, workers=jobs, keep=keep, progress=lambda claim, answer: advance(1)
        )
    left = {name: answer.reason for name, answer in said.items() if not answer.confirmed}
    click.echo(f"ptproof: Coq's kernel confirmed {len(said) - len(left)} of {len(said)} proved claims", err=True)
    for name, reason in left.items():
        click.echo(f"  not {name}: {reason}", err=True)
    return replace(verification, results=results)
