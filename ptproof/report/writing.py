"""Writing the files of a report as a whole: beside the place first, then moved into it."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from ptproof.errors import InputError
from ptproof.reading.hashes import REPORT as MANIFEST


def check_place(out: str | Path) -> Path:
    """Whether a report can be written to ``out``, before anything is computed.

    Raises
    ------
    InputError
        If ``out`` is a file, lies below one, or may not be written to.
    """
    place = Path(out)
    if place.exists() and not place.is_dir():
        raise InputError(f"{place}: is a file; --out takes a folder")
    nearest = place
    while not nearest.exists() and nearest != nearest.parent:
        nearest = nearest.parent
    if not nearest.is_dir():
        raise InputError(f"{place}: {nearest} is a file; --out takes a folder")
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise InputError(f"{place}: no permission to write in {nearest}")
    return place


def write_report(out: str | Path, files: Mapping[str, bytes]) -> None:
    """Write the files into the folder ``out``; an older report there is replaced, other files are left alone.

    Every file is written beside the folder first and then moved, so that a failure before the end leaves the
    older report as it was and no file is ever half written. What an older report had and this one has not is
    removed; a hidden list in the folder says which files are the report's.

    Raises
    ------
    InputError
        If the folder cannot be written to.
    """
    place = check_place(out)
    for name in files:
        _inside(name)
    beside: Path | None = None
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        beside = Path(tempfile.mkdtemp(prefix=f".{place.name}-", dir=place.parent))
        for name, content in files.items():
            target = beside / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
        old = _manifest(place)
        place.mkdir(exist_ok=True)
        # The list names old and new files while they are being exchanged: whatever happens, the next run knows.
        _list(beside, place, sorted({*old, *files}))
        for name in files:
            target = place / name
            target.parent.mkdir(parents=True, exist_ok=True)
            os.replace(beside / name, target)
        for name in sorted(set(old) - set(files)):
            _remove(place, name)
        _list(beside, place, sorted(files))
    except OSError as error:
        raise InputError(f"{place}: the report cannot be written: {error.strerror or error}") from error
    finally:
        if beside is not None:
            shutil.rmtree(beside, ignore_errors=True)


def _list(beside: Path, place: Path, names: list[str]) -> None:
    (beside / MANIFEST).write_text(json.dumps({"files": names}, indent=1) + "\n", encoding="utf-8")
    os.replace(beside / MANIFEST, place / MANIFEST)


def _manifest(place: Path) -> list[str]:
    """The files of the older report; a list that cannot be read, or names places outside, counts as none."""
    try:
        found = json.loads((place / MANIFEST).read_text(encoding="utf-8"))["files"]
        return [name for name in found if isinstance(name, str) and _inside(name)]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def _inside(name: str) -> bool:
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or name == MANIFEST or not path.parts:
        raise ValueError(f"not a file of a report: {name!r}")
    return True


def _remove(place: Path, name: str) -> None:
    (place / name).unlink(missing_ok=True)
    folder = (place / name).parent
    while folder != place and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent
