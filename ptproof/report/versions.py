"""The versions of what was used, for the report."""

from __future__ import annotations

import platform
from collections.abc import Iterable
from functools import cache
from importlib import metadata

LIBRARIES = ("ptproof", "sympy", "z3-solver", "python-flint", "networkx", "numpy", "scipy", "casadi", "control",
             "heyoka", "matplotlib", "latex2mathml", "jinja2")  # fmt: skip
# What the look of a page depends on.
SETTING = (*LIBRARIES, "markupsafe", "markdown-it-py", "mdit-py-plugins", "pylatexenc", "pillow", "contourpy")


def versions(names: Iterable[str] = LIBRARIES) -> tuple[tuple[str, str], ...]:
    """Python and the libraries that are installed, with their versions."""
    found = [("python", platform.python_version())]
    found += [(name, version) for name in names if (version := _version(name))]
    return tuple(found)


@cache
def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""
