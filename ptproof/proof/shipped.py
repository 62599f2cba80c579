"""Where the derivations that ship with the package stand."""

from __future__ import annotations

from pathlib import Path

from ptproof.errors import InputError


def shipped() -> Path:
    """The folder of the derivations that ship with the package, or that stand beside it in a checkout."""
    here = Path(__file__).resolve().parents[1]  # the package
    for folder in (here / "_derivations", here.parent / "derivations"):
        if folder.is_dir():
            return folder
    raise InputError("the derivations that ship with ptproof are missing; name a folder of derivations")
