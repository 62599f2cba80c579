"""The second opinion of Coq's kernel, for the commands that offer it: the options, the run and what is said of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ptproof.commands import guard

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim
    from ptproof.proof.kernel import Confirmation
    from ptproof.proof.memory import Memory
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


def confirmed(
    verification: Verification, jobs: int | None, keep: Path | None, memory: Memory
) -> tuple[Verification, int | None]:
    """The same with the evidence of Coq's kernel, and the exit status if the run was ended from outside.

    What it did not confirm, and why, is said on standard error; so is what it has confirmed by the end from outside.
    """
    from ptproof.commands.terminal import progress
    from ptproof.proof.kernel import check, coq
    from ptproof.proof.kernel.check import with_opinion
    from ptproof.proof.kernel.lemmas import settled
    from ptproof.proof.verdict import Verdict

    proved = [result.claim for result in verification.results if result.verdict is Verdict.PROVED]
    said: dict[str, Confirmation] = {}
    status = None
    with progress("asking Coq", len(proved)) as advance:

        def heard(claim: Claim, answer: Confirmation) -> None:
            advance(claim.id not in said)
            said[claim.id] = answer

        try:
            check(proved, workers=jobs, keep=keep, progress=heard, memory=memory)
        except KeyboardInterrupt:
            status = guard.interrupt_status()
        finally:  # this process may end without a chance for anybody to tidy up
            coq.forget()
    # Those that come in later are too late.
    known = settled({claim.id: said[claim.id] for claim in proved if claim.id in said})
    _say(known, len(proved), interrupted=status is not None)
    return replace(verification, results=with_opinion(verification.results, known)), status


def _say(known: Mapping[str, Confirmation], proved: int, interrupted: bool) -> None:
    left = {name: answer.reason for name, answer in known.items() if not answer.confirmed}
    used = sum(answer.confirmed and bool(answer.given) for answer in known.values())
    again = sum(answer.remembered for answer in known.values())
    words = f"Coq's kernel confirmed {len(known) - len(left)} of {proved} proved claims"
    if used:
        words += f", {used} of them by claims that they use"
    if again:
        words += f", {again} answers are remembered"
    if interrupted:
        words = f"interrupted; {words}, and has not answered about {proved - len(known)}"
    click.echo(f"ptproof: {words}", err=True)
    for name, reason in left.items():
        click.echo(f"  not {name}: {reason}", err=True)
