"""Runs as files: a table as text (CSV), or arrays by name (NPZ)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ptproof.errors import InputError

ENDINGS = (".csv", ".npz")


def check_name(path: str | Path) -> Path:
    """The file's path, refused unless its ending is one of :data:`ENDINGS` and its folder exists."""
    file = Path(path)
    if file.suffix.lower() not in ENDINGS:
        raise InputError(f"save: {path} should end in {' or '.join(ENDINGS)}")
    if file.is_dir() or not file.resolve().parent.is_dir():
        raise InputError(f"save: {path} can't be written; its folder must exist, and it must not be one")
    return file


def save_columns(path: str | Path, columns: Mapping[str, Any], settings: Mapping[str, Any]) -> None:
    """Write columns (m each) to a CSV file, whose first row has their names, or to an NPZ file, which has the settings
    too, as JSON text under ``settings``.

    Numbers in a CSV file have as many digits as it takes to read them as they were.

    Raises
    ------
    InputError
        For another ending, or a file that can't be written.
    """
    file = check_name(path)
    try:
        if file.suffix.lower() == ".npz":
            arrays: dict[str, Any] = {name: np.asarray(values) for name, values in columns.items()}
            np.savez(file, **arrays, settings=np.array(json.dumps(dict(settings), default=str)))
            return
        with file.open("w", encoding="utf-8", newline="") as out:
            out.write(",".join(columns) + "\n")
            for row in zip(*columns.values(), strict=True):
                # A float of NumPy prints its type too.
                out.write(
                    ",".join(repr(float(v)) if isinstance(v, float | np.floating) else str(v) for v in row) + "\n"
                )
    except OSError as error:
        raise InputError(f"save: {path} can't be written: {error.strerror or error}") from None
