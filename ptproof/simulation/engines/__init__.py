"""The engines, by name; each is imported when it is asked for."""

from __future__ import annotations

import importlib
import importlib.util

from ptproof.errors import InputError
from ptproof.simulation.plan import Engine

ENGINES = ("casadi", "lsoda", "radau", "dop853", "heyoka")


def engine_named(name: str) -> Engine:
    """``casadi`` (CVODES, the default), ``lsoda``, ``radau`` and ``dop853`` (SciPy), or ``heyoka`` (an extra).

    Raises
    ------
    InputError
        For an unknown name, or for heyoka where it is not installed.
    """
    if name not in ENGINES:
        raise InputError(f"engine: {name!r} is not one of {', '.join(ENGINES)}")
    if name == "heyoka" and not has_heyoka():
        raise InputError("engine: heyoka is not installed; install the extra 'fast', or use casadi")
    if name == "casadi":
        from ptproof.simulation.engines.cvodes import CVODES

        return CVODES
    if name == "heyoka":
        from ptproof.simulation.engines.taylor import TAYLOR

        return TAYLOR
    from ptproof.simulation.engines.peers import SciPy

    return SciPy(name)


def has_heyoka() -> bool:
    """Whether the fast engine is installed."""
    return importlib.util.find_spec("heyoka") is not None
