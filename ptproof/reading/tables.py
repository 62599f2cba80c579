"""What the readers of TOML files share: the shape of tables, exact decimals, errors that name the file and the key.

The shape of a table is a dataclass: its fields are the keys, those without a default have to be there. A field whose
type is a dataclass is a table in the table, ``list`` of one many of them, ``dict`` a table with any keys. Mostly it is
the very class that is made of the table, so that a key is declared where its meaning is.
"""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.expressions import CONSTANTS, FUNCTIONS, parse, quoted

RESERVED = frozenset({"Piecewise", "Derivative", *FUNCTIONS, *CONSTANTS})
_LARGEST_FILE = 1_000_000
_MOST = 512

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


def build_from(text: str, where: str, shape: type, build: Callable[[dict[str, Any]], Built]) -> Built:
    """``build`` of the tables in ``text``, which have this ``shape``; ``where`` opens every ``InputError``."""
    try:
        # Decimals stay text, so that 1.8 is 9/5.
        data = tomllib.loads(text, parse_float=str)
    except (ValueError, RecursionError) as error:  # a ValueError of another kind for an integer of 5000 digits
        raise InputError(f"{where}: not TOML ({error})") from None
    try:
        check_shape(data, shape)
        return build(data)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def check_shape(data: Any, shape: Any, where: str = "") -> None:
    """Refuse a key that is unknown or missing, and what should be a table or a list of tables and is none."""
    if not isinstance(data, dict):
        place = re.sub(r"(.*)\[\d+\]$", r"[\1]", where)
        raise InputError(f"{where}: expected a table [{place}]")
    if not is_dataclass(shape):
        return
    kinds = {name: _table_in(kind) for name, kind in get_type_hints(shape).items()}
    members = {member.name: member for member in fields(shape)}
    check_known(data, tuple(members), f"key in [{where}]" if where else "table")
    above = f"{where}." if where else ""
    for name, member in members.items():
        place, (kind, many) = above + name, kinds[name]
        if name not in data:
            if member.default is MISSING and member.default_factory is MISSING:
                raise InputError(f"{place} is missing" if kind is None or many else f"the table [{place}] is missing")
        elif many:
            for i, entry in enumerate(listed(data[name], place), start=1):
                check_shape(entry, kind, f"{place}[{i}]")
        elif kind is not None:
            check_shape(data[name], kind, place)


def _table_in(kind: Any) -> tuple[Any, bool]:
    """The shape of the table that a type asks for (None where it asks for none), and whether there may be many."""
    if is_dataclass(kind) or get_origin(kind) is dict:
        return kind, False
    inner = next(filter(is_dataclass, get_args(kind)), None)
    return inner, inner is not None and get_origin(kind) is list


def listed(value: Any, where: str, length: int | None = None, of: str = "") -> list[Any]:
    """``value``, if it is a list of not too many entries, ``length`` (``of`` what) where that is given."""
    if not isinstance(value, list):
        raise InputError(f"{where}: expected a list, got {quoted(value)}")
    if len(value) > _MOST:
        raise InputError(f"{where}: more than {_MOST} entries")
    if length is not None and len(value) != length:
        raise InputError(f"{where}: {len(value)} entries for {length} {of}; give one for each")
    return value


def split_list(text: str) -> list[str]:
    """The entries of a list, separated by the commas outside of parentheses, brackets and braces."""
    entries, depth = [""], 0
    for sign in text:
        depth += (sign in "{([") - (sign in "})]")
        if sign == "," and depth == 0:
            entries.append("")
        else:
            entries[-1] += sign
    return [entry.strip() for entry in entries]


def hint(word: str, known: Iterable[str]) -> str:
    """The known word that is nearest to ``word``, as a question to end a message with, or nothing.

    A word that differs in nothing but capitals is near, however short it is.
    """
    candidates = tuple(known)
    near = difflib.get_close_matches(word, candidates, n=1)
    near = near or [candidate for candidate in candidates if candidate.lower() == word.lower()]
    return f" (did you mean {near[0]!r}?)" if near else ""


def check_known(found: Mapping[str, Any], known: Sequence[str], what: str) -> None:
    """Refuse a key that is not known, with the nearest one that is."""
    for key in found:
        if key not in known:
            raise InputError(f"unknown {what}: {quoted(key)}{hint(key, known)}; known: {', '.join(known)}")


def check_choice(value: Any, known: Sequence[str], where: str) -> str:
    """``value``, if it is one of the known words."""
    if not isinstance(value, str) or value not in known:
        raise InputError(f"{where}: {quoted(value)} is not one of {', '.join(known)}{hint(str(value), known)}")
    return value


def declared(names: Any, where: str, reserved: Container[str], taken: Container[str] = ()) -> list[str]:
    """``names``, if each is a name that a symbol can have, none is ``reserved`` and none stands twice."""
    found: list[str] = []
    for name in names:
        if not isinstance(name, str) or not name.isidentifier() or not name.isascii():
            raise InputError(
                f"{where}: {quoted(name)} is not a name (letters, digits and _, not starting with a digit)"
            )
        if name in reserved:
            raise InputError(f"{where}: {name!r} has a meaning of its own here; choose another name")
        if name in taken or name in found:
            raise InputError(f"{where}: {name!r} is declared twice")
        found.append(name)
    return found


def finite(value: Any, where: str, names: Mapping[str, Any] | Sequence[sp.Symbol] = ()) -> sp.Expr:
    """The expression that ``value`` is, over ``names``; TOML's nan and inf, which are text here, are refused."""
    if isinstance(value, str) and value.strip().lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise InputError(f"{where}: {value} is not a finite number")
    return parse(value, names, where=where)
