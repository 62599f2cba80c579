"""Hashes of files, of what is installed, and of what a derivation is made of."""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import re
import sys
import sysconfig
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.util import source_from_cache
from pathlib import Path
from typing import Any

# A verdict may depend on each of these; what else is installed does not matter.
LIBRARIES = (
    "sympy",
    "z3-solver",
    "python-flint",
    "mpmath",
    "numpy",
    "scipy",
    "casadi",
    "heyoka",
    "control",
    "networkx",
)
REPORT = ".ptproof-report.json"  # stands in the folder of a report
_SIZE, _FILES = 2**27, 2000
_PACKAGE = Path(__file__).resolve().parents[1]


def of_file(file: str | Path) -> str:
    """The hash of a file's content; empty if it cannot be read."""
    try:
        return hashlib.sha256(Path(file).read_bytes()).hexdigest()
    except OSError:
        return ""


def of_texts(texts: Iterable[str]) -> str:
    """The hash of texts in their order."""
    return hashlib.sha256("\0".join(texts).encode("utf-8", "surrogatepass")).hexdigest()


def files_below(folder: Path) -> Iterator[Path]:
    """The files below a folder that may belong to a derivation: none that are hidden, compiled, or part of a report."""
    for place, folders, names in os.walk(folder):
        if REPORT in names and Path(place) != folder:
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name != "__pycache__")
        for name in sorted(names):
            if not name.startswith(".") and not name.endswith((".pyc", ".pyo")):
                yield Path(place, name)


@cache
def environment() -> str:
    """The hash of all that decides a claim besides the claim: the files of ptproof, Python, and the libraries."""
    # The derivations that ship in the package count as what they are: derivations.
    files = (file for file in files_below(_PACKAGE) if file.relative_to(_PACKAGE).parts[0] != "_derivations")
    own = [f"{file.relative_to(_PACKAGE)}\0{of_file(file)}" for file in files]
    return of_texts([sys.version, platform.machine(), *sorted(_installed()), *own])


def _installed() -> Iterator[str]:
    wanted = {re.sub(r"[-_.]+", "_", name) for name in LIBRARIES}
    for place in dict.fromkeys(sys.path):
        with contextlib.suppress(OSError):
            for name in os.listdir(place or "."):
                library, _, version = name.removesuffix(".dist-info").partition("-")
                if name.endswith(".dist-info") and re.sub(r"[-_.]+", "_", library).lower() in wanted:
                    yield f"{library} {version}"


def of_derivation(paths: Iterable[Path]) -> dict[str, str]:
    """The files that the paths name or hold, each with the hash of its content; none if there are too many."""
    found: dict[str, str] = {}
    size = 0
    for path in paths:
        for file in files_below(path) if path.is_dir() else [path]:
            with contextlib.suppress(OSError):
                size += file.stat().st_size
            if size > _SIZE or len(found) >= _FILES:
                return {}
            found[str(file)] = of_file(file)
    return found


@cache
def _installation() -> tuple[str, ...]:
    """Where Python, the libraries and ptproof itself stand, which :func:`environment` speaks of."""
    places = {sys.prefix, sys.base_prefix, sys.exec_prefix, str(_PACKAGE), *sysconfig.get_paths().values()}
    places |= {place for place in sys.path if place.endswith(("site-packages", "dist-packages"))}
    system = ("/proc", "/sys", "/dev")
    return tuple(
        sorted({os.path.realpath(place) + os.sep for place in places if place} | {f"{s}{os.sep}" for s in system})
    )


def foreign(files: Iterable[str]) -> tuple[str, ...]:
    """Those of the files that are neither Python's, nor a library's, nor ptproof's; compiled files as their sources."""
    found = set()
    shipped = str(_PACKAGE / "_derivations") + os.sep
    for file in files:
        if file.endswith(".pyc"):
            with contextlib.suppress(ValueError):
                file = source_from_cache(file)
        real = os.path.realpath(file)
        if real.startswith(shipped) or not real.startswith(_installation()):
            found.add(real)
    return tuple(sorted(found))


_opened: list[set[str]] = []
_watching = False


@contextlib.contextmanager
def opened() -> Iterator[set[str]]:
    """The files that Python opens for reading in this process meanwhile, those of imported modules included."""
    global _watching
    if not _watching:
        sys.addaudithook(_note)
        _watching = True
    before, found = set(sys.modules), set[str]()
    _opened.append(found)
    try:
        yield found
    finally:
        _opened[:] = [other for other in _opened if other is not found]  # equal ones are others
        new = (getattr(sys.modules.get(name), "__file__", None) for name in set(sys.modules) - before)
        found.update(str(file) for file in new if file)


def also_opened(files: Iterable[str]) -> None:
    """Count files as opened in this process that another has opened for it."""
    for found in _opened:
        found.update(files)


def _note(event: str, arguments: tuple[Any, ...]) -> None:
    if event == "open" and _opened and isinstance(arguments[0], str | bytes):
        mode, flags = arguments[1:3]
        # ``os.open`` has no mode: Python writes compiled modules with it, under names that last for a moment.
        written = bool(set(mode) & set("wax")) if isinstance(mode, str) else bool(flags & os.O_WRONLY)
        if not written:
            for found in _opened:
                found.add(os.path.abspath(os.fsdecode(arguments[0])))
