"""The options that several commands take, each in one wording, and JSON as all of them print it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import guard, streams
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.proof.load import Derivation
    from ptproof.proof.memory import Memory
    from ptproof.proof.run import Interrupted

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]
INTERRUPTED = "interrupted"
PICTURES = (".png", ".svg", ".pdf")

derivations = click.argument("paths", nargs=-1, metavar="[PATH]...")
as_json = click.option("--json", "as_json", is_flag=True, help="Print JSON on standard output, and nothing else there.")
jobs = click.option(
    "--jobs", type=click.IntRange(1), default=None, help="Worker processes (default: the number of processors)."
)


def timeout(of: str = "", default: float = 60.0) -> Decorator:
    """``--timeout``, the limit of the whole command or ``of`` one thing that it does."""
    limit = click.FloatRange(min=0, min_open=True, max=1e6)
    limit.name = "number of seconds"
    help = f"Time limit{of and f' of {of}'}, in seconds."
    return click.option("--timeout", type=limit, default=default, show_default=True, metavar="SECONDS", help=help)


def plot(what: str) -> Decorator:
    """``--plot FILE``, whose ending and folder are checked before anything is computed."""
    return click.option("--plot", metavar="FILE", callback=_picture, help=f"Write {what} to a .png, .svg or .pdf file.")


def _picture(context: click.Context, option: click.Parameter, name: str | None) -> str | None:
    if name is None:
        return None
    file = Path(name)
    if file.suffix.lower() not in PICTURES:
        raise InputError(f"--plot: {name} should end in .png, .svg or .pdf")
    if file.is_dir():
        raise InputError(f"--plot: {name} is a folder")
    if not file.resolve().parent.is_dir():
        raise InputError(f"--plot: there is no folder {file.resolve().parent}")
    return name


cluster = click.option("--cluster", metavar="ADDRESS", help="Use the Dask cluster whose scheduler is at ADDRESS.")


@contextmanager
def connected(address: str | None) -> Iterator[Any]:
    """A ``distributed.Client`` of the scheduler at ``address``, or None where there is no address."""
    if address is None:
        yield None
        return
    try:
        from distributed import Client
    except ImportError:
        raise InputError("--cluster: dask is not installed; install the extra 'cluster'") from None
    try:
        client = Client(address, timeout=10)
    except (OSError, ValueError) as error:
        raise InputError(f"--cluster: no scheduler answers at {address}: {error}") from None
    with client:
        yield client


@contextmanager
def loaded(paths: tuple[str, ...], memory: Memory | None = None, select: str = "") -> Iterator[Derivation]:
    """The derivation below the paths, or as much of it as a selection of claims needs.

    What its code prints, now and while it is used, goes to standard error.
    """
    from ptproof.proof.load import load
    from ptproof.reading.garbage import collecting

    with streams.aside():
        guard.doing("while the derivation was loaded; nothing is decided")
        folder = os.getcwd()
        guard.limit()
        try:
            with collecting(False):
                derivation = load(paths) if memory is None else memory.load(select)
        except KeyboardInterrupt:
            if guard.own_interrupt():
                raise InputError("the derivation raised KeyboardInterrupt while it was loaded") from None
            raise
        os.chdir(folder)
        guard.doing("before the command had come to its end")
        yield derivation


fresh = click.option("--fresh", is_flag=True, help="Decide every claim anew; ignore what is remembered.")


def memory_of(paths: tuple[str, ...], fresh: bool) -> Memory:
    """What earlier runs have decided about the derivations below the paths (the shipped ones where left out)."""
    from ptproof.proof.memory import Memory
    from ptproof.proof.shipped import shipped

    return Memory(
        paths or (shipped(),), fresh=fresh, say=lambda text: click.echo(f"ptproof: warning: {text}", err=True)
    )


def interrupted(run: Interrupted) -> int:
    """Say that the run was ended from outside, and with how much decided; gives the exit status."""
    results = run.verification.results
    left = sum(item.evidence[0].engine == INTERRUPTED for item in results)
    click.echo(f"ptproof: interrupted; {len(results) - left} of {len(results)} claims were decided", err=True)
    return guard.interrupt_status()


def print_json(data: Any) -> None:
    """The data on standard output, in one piece; what its encoding lacks is escaped."""
    encoding = (getattr(streams.out(), "encoding", None) or "utf-8").lower()
    text = json.dumps(data, indent=2, ensure_ascii=not encoding.startswith(("utf-", "utf8")))
    click.echo(text, file=streams.out())
