"""The engines: one file each, whose name is the engine's, holding an ``ENGINE``; imported when it is asked for.

A file added to this folder is an engine of ``simulate`` and of its command line; nothing else lists them.
"""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from typing import TYPE_CHECKING

from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.simulation.plan import Batch, Engine, Plan, Work

DEFAULT = "casadi"


@cache
def names() -> tuple[str, ...]:
    """The engines there are, the default first; found without importing any."""
    found = sorted(module.name for module in pkgutil.iter_modules(__path__))
    return (DEFAULT, *(name for name in found if name != DEFAULT))


@cache
def engine_named(name: str) -> Engine:
    """The engine of that name.

    Raises
    ------
    InputError
        For an unknown name, or for an engine that is not installed.
    """
    if name not in names():
        raise InputError(f"engine: {name!r} is not one of {', '.join(names())}")
    engine: Engine = importlib.import_module(f"{__name__}.{name}").ENGINE
    if engine.missing:
        raise InputError(f"engine: {name} is not installed; install {engine.missing}, or use {DEFAULT}")
    return engine


@cache
def installed() -> tuple[str, ...]:
    """The engines that can be used here."""
    return tuple(name for name in names() if not importlib.import_module(f"{__name__}.{name}").ENGINE.missing)


def fitting(plan: Plan, batch: Batch, work: Work) -> str:
    """The first engine that wants the work, or the default."""
    return next((name for name in installed() if engine_named(name).wants(plan, batch, work)), DEFAULT)
