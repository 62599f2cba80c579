"""All seekers by name: every file of this folder that has a SEEKER."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping
from pathlib import Path

from ptproof.errors import InputError
from ptproof.problem.seekers.seeker import Seeker


def _found() -> dict[str, Seeker]:
    package = __name__.rpartition(".")[0]
    names = [module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)])]
    modules = [importlib.import_module(f"{package}.{name}") for name in names if f"{package}.{name}" != __name__]
    found = [module.SEEKER for module in modules if hasattr(module, "SEEKER")]
    return {seeker.name: seeker for seeker in sorted(found, key=lambda seeker: (seeker.rank, seeker.name))}


SEEKERS: Mapping[str, Seeker] = _found()


def seeker_named(name: str) -> Seeker:
    """The seeker with this name; refused with those that there are."""
    if name not in SEEKERS:
        raise InputError(f"seeker: {name!r} is not one of {', '.join(SEEKERS)}")
    return SEEKERS[name]


def seekers_of(command: str) -> tuple[str, ...]:
    """The names of the seekers that a command offers."""
    return tuple(name for name, seeker in SEEKERS.items() if command in seeker.commands)
