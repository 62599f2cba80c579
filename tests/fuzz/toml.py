"""Strategies: TOML files that are nearly right, from good ones by dropping, doubling, misspelling and replacing."""

from __future__ import annotations

import copy
import json
import tomllib
from typing import Any

import hypothesis.strategies as st

ODD: list[Any] = [
    True, False, 0, -1, 10**30, 3.5, "", " ", "0", "-1", "1", "1/3", "pi", "nan", "inf", "-inf", "1e400",
    "1e-400", "10**400",
    "10**4000", "1e308", "1e-300", "1/0", "0**-1", "sqrt(-1)", "log(-1)", "acos(2)", "x1", "x2", "x9", "theta",
    "tau", "omega", "t",
    "x1 < 1", "F(x1, x2)", "F(x1)", "k", "sin(x1)", "exp(1000)", "exp(-1000)", "x1/0", "1/x1", "log(x1)",
    "Abs(x1)", "x1**400",
    "sqrt(2)", "E", "lambda: 1", "__import__('os')", "9" * 5000, "(" * 200, "é", "\u202ex", "ｘ1", "0x10", "1_000",
    "1e-30", "1e30",
    [], [[]], {}, [10**400], ["0"], ["0", "0"], ["x1", "x2"], ["x1", "x1"], ["pi", "1"], ["0", "0", "0"], [["1",
    "0"], ["0", "1"]], ["0"] * 600,
    {"a": "1"}, [{}], "paper", "power", "none", "gradient", "bounded", "Piecewise((1, theta < pi), (-1, True))",
    "theta",
    "Mod(theta, 2*pi)", "sign(sin(theta))", "floor(x1)", "Derivative(F(x1, x2), x1)", "tanh(x1)", "x1*x2",
    "-(x1**2 + x2**2)**2",
    "Piecewise((x1, x1 < 0), (x1**2, True))", "2*pi", "cos(2*theta)", "cos(sqrt(2)*theta)", "1 + cos(theta)",
    "tau*cos(theta)",
]  # fmt: skip
Path = tuple[Any, ...]


def paths_of(data: Any, here: Path = ()) -> list[Path]:
    """Every place in the tables."""
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    return [here] * bool(here) + [path for key, value in inner for path in paths_of(value, (*here, key))]


def written(data: dict[str, Any]) -> str:
    """The tables as TOML: inline, so that any nesting can be written."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in data.items())


def _key(key: str) -> str:
    return key if key.isidentifier() and key.isascii() else json.dumps(key)


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(key)} = {_value(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


@st.composite
def changed(draw: Any, good: str) -> tuple[str, tuple[Path, ...]]:
    """The text of ``good`` with one or two changes, and the places that were changed."""
    data = copy.deepcopy(tomllib.loads(good, parse_float=str))
    places = []
    for _ in range(draw(st.sampled_from([1, 1, 2]))):
        paths = paths_of(data)
        if not paths:
            break
        path = draw(st.sampled_from(paths))
        places.append(path)
        _change(draw, data, path)
    text = written(data)
    if draw(st.integers(0, 9)) == 0:
        at = draw(st.integers(0, len(text)))
        text = (
            text[:at]
            + draw(
                st.sampled_from(["\0", '"', "=", "[", "\n", "#", "é", "'", "nan", ",", "9" * 5000, "2026-01-01", text])
            )
            + text[at:]
        )
        places.append(())
    return text, tuple(places)


def _change(draw: Any, data: Any, path: Path) -> None:
    *above, last = path
    for key in above:
        data = data[key]
    what = draw(st.sampled_from(["drop", "misspell", "double", "replace", "replace", "replace", "replace"]))
    if what == "drop":
        del data[last]
    elif what == "misspell" and isinstance(data, dict):
        data[draw(st.sampled_from([f"{last}x", str(last).upper() + "_", str(last)[:-1], "", "é"]))] = data.pop(last)
    elif what == "double" and isinstance(data, list):
        data.insert(last, copy.deepcopy(data[last]))
    else:
        data[last] = copy.deepcopy(draw(st.sampled_from(ODD)))
