"""What the readers of TOML files share: exact decimals, and errors that name the file and the key."""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Callable, Container, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.expressions import CONSTANTS, FUNCTIONS, parse

RESERVED = frozenset({"Piecewise", "Derivative", *FUNCTIONS, *CONSTANTS})
_LARGEST_FILE = 1_000_000

Built = TypeVar("Built")


def read_file(path: str | Path, kind: str) -> str:
    """The text of a file; ``InputError`` where it can't be read or is too large to be what ``kind`` says."""
    file = Path(path)
    try:
        if file.is_file() and file.stat().st_size > _LARGEST_FILE:
            raise InputError(f"{path}: larger than {_LARGEST_FILE} bytes, not {kind}")
        return file.read_text("utf-8")
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or "is not UTF-8 text"
        raise InputError(f"{path}: cannot be read ({reason})") from None


def build_from(text: str, where: str, build: Callable[[dict[str, Any]], Built]) -> Built:
    """``build`` of the tables in ``text``; ``where`` opens the message of every ``InputError``."""
    try:
        # Decimals stay text, so that 1.8 is 9/5.
        data = tomllib.loads(text, parse_float=str)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(f"{where}: not TOML ({error})") from None
    try:
        return build(data)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def hint(word: str, known: Sequence[str], *, any_case: bool = False) -> str:
    """The known word that is nearest to ``word``, as a question to end a message with, or nothing.

    With ``any_case``, a word that differs in nothing but capitals is near, however short it is.
    """
    near = difflib.get_close_matches(word, known, n=1)
    if any_case and not near:
        near = [candidate for candidate in known if candidate.lower() == word.lower()]
    return f" (did you mean {near[0]!r}?)" if near else ""


def check_known(found: Mapping[str, Any], known: Sequence[str], what: str, *, any_case: bool = False) -> None:
    """Refuse a key that is not known, with the nearest one that is."""
    for key in found:
        if key not in known:
            near = hint(key, known, any_case=any_case)
            raise InputError(f"unknown {what}: {key!r}{near}; known: {', '.join(known)}")


def check_required(table: Mapping[str, Any], required: Sequence[str], where: str) -> None:
    """Refuse a table in which a required key is missing."""
    for key in required:
        if key not in table:
            raise InputError(f"{where}.{key} is missing")


def check_name(name: Any, where: str, reserved: Container[str]) -> str:
    """``name``, if a symbol can have it; ``reserved`` names have a meaning of their own."""
    if not isinstance(name, str) or not name.isidentifier() or not name.isascii():
        raise InputError(f"{where}: {name!r} is not a name (letters, digits and _, not starting with a digit)")
    if name in reserved:
        raise InputError(f"{where}: {name!r} has a meaning of its own here; choose another name")
    return name


def finite(value: Any, where: str, names: Mapping[str, Any] | Sequence[sp.Symbol] = ()) -> sp.Expr:
    """The expression that ``value`` is, over ``names``; TOML's nan and inf, which are text here, are refused."""
    if isinstance(value, str) and value.strip().lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise InputError(f"{where}: {value} is not a finite number")
    return parse(value, names, where=where)
