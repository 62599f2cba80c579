"""The guessed table of notation as TOML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_SECTIONS = {
    "letters": "a letter with its accents, index and star; a list is a column, a list of lists a matrix",
    "functions": "applied to what stands behind them in parentheses",
    "means": "what names stand for in both the paper and the claims",
}


def toml(table: Mapping[str, Any], head: str) -> str:
    """The table under the comment ``head``, in the order in which people read it."""
    lines = [f"# {line}".rstrip() for line in head.splitlines()]
    lines.append("")
    lines += [f"{key} = {_value(value)}" for key, value in table.items() if not isinstance(value, dict)]
    lines += [
        '# division = "product"         # what a/bc is divided by: product (bc) or factor (b); left out: not read'
    ]
    for name, entries in table.items():
        if isinstance(entries, dict) and entries:
            lines += ["", f"[{name}]".ljust(34) + f" # {_SECTIONS[name]}"]
            lines += [f"{_key(key)} = {_value(value)}" for key, value in entries.items()]
    return "\n".join(lines) + "\n"


def _key(key: str) -> str:
    return f"'{key}'" if "'" not in key and key.isprintable() else _value(key)


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    escaped = str(value).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
