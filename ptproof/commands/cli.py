"""The ``ptproof`` command: finds the command's module when it is asked for, and turns bad input into status 2."""

from __future__ import annotations

import importlib
import sys
from typing import Any

import click

from ptproof import __version__
from ptproof.errors import InputError

# Named here, imported when used: `ptproof --help` has to answer at once.
COMMANDS = {
    "verify": "Verify the claims of a derivation.",
    "coverage": "Show which labels of a paper the claims cover.",
    "report": "Verify, simulate, and write the pages and figures.",
    "average": "Average a dither system and check its assumptions.",
    "bounds": "Certify the constants of a field.",
    "gains": "Compute gain conditions and bounds.",
    "simulate": "Simulate a closed loop and its average.",
    "new": "Write a small derivation to start from.",
}


class _Lazy(click.Group):
    """A group whose commands live in modules of their own."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"ptproof.commands.{cmd_name}")
        command: click.Command = getattr(module, cmd_name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="ptproof")
def cli() -> None:
    """Derive, decide and simulate prescribed-time source seeking from one symbolic source."""


def main(arguments: list[str] | None = None) -> Any:
    """Run the command line; bad input ends with one sentence on standard error and status 2."""
    try:
        sys.exit(cli.main(arguments, standalone_mode=False) or 0)
    except InputError as error:
        click.echo(f"ptproof: {error}", err=True)
        sys.exit(2)
    except click.ClickException as error:
        error.show()
        sys.exit(2)
    except (click.Abort, KeyboardInterrupt):
        click.echo("ptproof: interrupted", err=True)
        sys.exit(130)
    except BrokenPipeError:
        sys.exit(1)


if __name__ == "__main__":
    main()
