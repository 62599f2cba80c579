"""The options that several commands take, each in one wording, and JSON as all of them print it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from ptproof.errors import InputError

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]
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


def print_json(data: Any) -> None:
    """The data on standard output."""
    click.echo(json.dumps(data, indent=2, ensure_ascii=False))
