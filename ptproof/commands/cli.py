"""The entry of the command line: finds a command's module when it is asked for, and turns bad input into status 2."""

from __future__ import annotations

import importlib
import sys
from difflib import get_close_matches
from functools import cache
from importlib import resources
from typing import Any

import click

from ptproof import __version__
from ptproof.commands import guard
from ptproof.errors import InputError


@cache
def commands() -> dict[str, str]:
    """Each command with what it does, read from the modules of this package without importing them.

    A command is a module whose docstring begins with its call: ````ptproof NAME``: what it does.``
    """
    found = {}
    for file in sorted(resources.files(__package__).iterdir(), key=lambda file: file.name):
        name, dot, ending = file.name.partition(".")
        if dot and ending == "py":
            opening = f'"""``ptproof {name}``: '
            words = file.read_text("utf-8").partition("\n")[0].removesuffix('"""')
            if words.startswith(opening):
                help = words.removeprefix(opening)
                found[name] = help[:1].upper() + help[1:]
    return found


class _Lazy(click.Group):
    """A group whose commands live in modules of their own."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(commands())

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        if cmd_name not in commands():
            near = get_close_matches(cmd_name, commands(), n=1)
            meant = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(commands())}"
            raise click.UsageError(f"No such command {cmd_name!r}; {meant}", ctx)
        command: click.Command = getattr(importlib.import_module(f"{__package__}.{cmd_name}"), cmd_name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(commands().items()))


@click.group(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="ptproof")
def group() -> None:
    """Derive, decide and simulate prescribed-time source seeking from one symbolic source."""


def run(arguments: list[str] | None = None) -> int:
    """Run the command line, and give its status; bad input ends with one sentence on standard error and status 2."""
    try:
        return int(group.main(arguments, standalone_mode=False) or 0)
    except InputError as error:
        _say(str(error))
        return 2
    except click.ClickException as error:
        error.show()
        return 2
    except (click.Abort, KeyboardInterrupt):
        _say("interrupted")
        return guard.interrupt_status()
    except MemoryError:
        _say("there is not enough memory for this")
        return 1
    except BrokenPipeError:
        return 1


def _say(text: str) -> None:
    click.echo(f"ptproof: {text}", err=True)


def main(arguments: list[str] | None = None) -> Any:
    """Run the command line and exit; without ``arguments`` those of the process, under guard."""
    if arguments is None and guard.possible():
        guard.guarded(run)
    sys.exit(run(arguments))


if __name__ == "__main__":
    main()
