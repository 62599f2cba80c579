"""The small derivation that ``ptproof new`` writes; its files end in ``.txt`` here, since they belong to no package."""

from __future__ import annotations

import importlib.machinery
import keyword
import os
import shutil
import sys
import tempfile
from collections.abc import Mapping
from importlib import resources
from pathlib import Path

from ptproof.errors import InputError

FILES = ("__init__.py", "notation.py", "claims.py", "test_derivation.py", "dither.toml", "seeker.toml")


def write_starter(folder: str | Path) -> tuple[Path, ...]:
    """Write the starter's files into ``folder``, as :func:`write_files` does, and name them."""
    name = Path(folder).resolve().name
    texts = {file: resources.files(__name__).joinpath(f"{file}.txt").read_text("utf-8") for file in FILES}
    return write_files(folder, {file: text.replace("@NAME@", name) for file, text in texts.items()})


def write_files(folder: str | Path, contents: Mapping[str, str]) -> tuple[Path, ...]:
    """Write the files of a derivation into ``folder``, which is made if it does not exist, and name them.

    All files are written beside the folder first and then moved into it, so that it never holds a part of them.

    Raises
    ------
    InputError
        If the folder is a file, is not empty, cannot be written to, or its name cannot be that of a Python package.
    """
    place = Path(folder)
    check(place)
    try:
        _move_into(place, contents)
    except OSError as error:
        raise InputError(f"{place}: cannot be written: {error.strerror or error}") from error
    return tuple(place / name for name in contents)


def check(place: Path) -> None:
    """Refuse a folder that is not new or empty, and a name that cannot be that of a package."""
    _check_place(place)
    _check_name(place.resolve())


def _check_place(place: Path) -> None:
    if place.is_symlink() and not place.exists():
        raise InputError(f"{place}: is a link to nothing; name a new or empty folder")
    if place.exists() and not place.is_dir():
        raise InputError(f"{place}: is a file; name a new or empty folder")
    try:
        content = sorted(place.iterdir()) if place.is_dir() else []
    except OSError as error:
        raise InputError(f"{place}: cannot be read: {error.strerror}") from None
    if content:
        raise InputError(f"{place}: is not empty (it holds {content[0].name}); name a new or empty folder")
    if not place.resolve().parent.is_dir():
        raise InputError(f"{place}: there is no folder {place.resolve().parent} to make it in")


def _check_name(place: Path) -> None:
    name = place.name
    if not (name.isidentifier() and name.isascii()) or keyword.iskeyword(name):
        raise InputError(f"{name!r} cannot be the name of a Python package; use letters, digits and _, as in my_seeker")
    if name.startswith("test"):
        raise InputError(f"{name!r} looks like a test to pytest; use another name, as in my_seeker")
    elsewhere = [entry for entry in sys.path if entry and Path(entry).resolve() != place.parent]
    if name in sys.stdlib_module_names or importlib.machinery.PathFinder.find_spec(name, elsewhere) is not None:
        raise InputError(f"{name!r} is the name of a module that Python already has; use another name")


def _move_into(place: Path, contents: Mapping[str, str]) -> None:
    target = place.resolve()
    beside = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    moved: list[Path] = []
    try:
        for name, content in contents.items():
            (beside / name).write_text(content, "utf-8")
        if not target.exists():
            beside.chmod(0o755)
            beside.rename(target)
            return
        for name in contents:
            os.replace(beside / name, target / name)
            moved.append(target / name)
    except OSError:
        for file in moved:
            file.unlink(missing_ok=True)
        raise
    finally:
        shutil.rmtree(beside, ignore_errors=True)
