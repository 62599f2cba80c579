"""What engines say, with the letters of the paper in place of the names that the program has for them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.proof.statement import Assumption, Statement, free_symbols, undefined_functions
from ptproof.report.formula import latex

_NAME = r"(?<![\w.\\])[^\W\d]\w*"
_LOW = {**dict(zip("0123456789+-=()", "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎", strict=True)),
        **dict(zip("aehijklmnoprstuvx", "ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", strict=True))}  # fmt: skip
_HIGH = dict(zip("0123456789+-=()n", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿ", strict=True))
_PLACED = re.compile(r"([_^])(?:\{((?:[^{}]|\{[^{}]*\})*)\}|(\\[a-zA-Z]+|[^\s\\{}]))")
_SIGNS = (("!=", "≠"), ("<=", "≤"), (">=", "≥"))


class Letters:
    """How symbols and functions are written as plain text, with the glyphs of a notation; each is looked up once."""

    def __init__(self, names: Mapping[Any, str]) -> None:
        self._names = names
        self._known: dict[sp.Symbol, str] = {}
        self._notation = self._named(item for item in names if isinstance(item, sp.Symbol))

    def of(self, statements: Iterable[Statement | Assumption]) -> dict[str, str]:
        """By the names that the program has for them: those of the statements, and of the notation."""
        said = list(statements)
        functions = (sp.Symbol(applied.func.__name__) for applied in undefined_functions(said))
        return {**self._notation, **self._named(functions), **self._named(free_symbols(said))}

    def _named(self, symbols: Iterable[sp.Symbol]) -> dict[str, str]:
        found = {item.name: self._written(item) for item in symbols}
        return {name: text for name, text in found.items() if text not in ("", name)}

    def _written(self, symbol: sp.Symbol) -> str:
        if symbol not in self._known:
            self._known[symbol] = plain(latex(symbol, self._names))
        return self._known[symbol]


def spoken(text: str, letters: Mapping[str, str], kept: Iterable[str] = ()) -> str:
    """The text with ``letters`` for names, and signs and small powers as they are printed; what is ``kept`` stays.

    A name that is also a word, such as ``gap``, is taken for the letter only beside a sign or a parenthesis.
    """

    known = {*kept}

    def written(found: re.Match[str]) -> str:
        name = found[0]
        if name in known:
            return name
        if name[1:] in letters and name[0] == "_":  # the letter of another claim, for which something is put in
            return f"{letters[name[1:]]}′"
        if name not in letters:  # of another claim, or bound in this one
            return plain(latex(sp.Symbol(name), {})) if _GREEK_LETTER.fullmatch(name) else name
        before, after = text[: found.start()].rstrip(" ")[-1:], text[found.end() :].lstrip(" ")[:1]
        sure = bool(re.search(r"[\d_]", name)) or name.lower() in _GREEK
        return letters[name] if sure or before in _BEFORE or after in _AFTER else name

    ids = "|".join(re.escape(id) for id in sorted(known, key=len, reverse=True))
    said = re.sub(rf"{ids}|{_NAME}" if ids else _NAME, written, text)
    for sign, shown in _SIGNS:
        said = said.replace(sign, shown)
    said = re.sub(r"\*\*(\d+)(?![\d.])", lambda found: "".join(_HIGH[digit] for digit in found[1]), _derived(said))
    said = re.sub(r"(?<!\w)sqrt\((\w+)\)", r"√\1", said).replace("sqrt(", "√(").replace("**", "^")
    return re.sub(r"(?<=[\w)⁰-⁹²³¹₀-₉‖])\*(?=[\w(‖√])", "·", said)


def _derived(text: str) -> str:
    """Derivatives as they are printed, and what is put in behind a bar: ∂F(x)/∂x, F(x)|x=0."""
    for name in ("Derivative", "Subs"):
        while (start := text.find(f"{name}(")) >= 0:
            parts, end = _arguments(text, start + len(name) + 1)
            if not parts or end < 0:
                return text
            inner, *others = parts
            if name == "Subs":
                shown = f"[{inner}]|_{', '.join(others[: len(others) // 2])} = {', '.join(others[len(others) // 2 :])}"
            else:
                along = [re.sub(r"^\((.*), (\d+)\)$", lambda found: f"{found[1]}**{found[2]}", part) for part in others]
                count = sum(int(part.rpartition("**")[2]) if "**" in part else 1 for part in along)
                power = "" if count == 1 else f"**{count}"
                shown = f"∂{power}{inner}/{''.join(f'∂{part}' for part in along)}"
                shown = f"({shown})" if text[end : end + 2] == "**" else shown
            text = text[:start] + shown + text[end:]
    return text


def _arguments(text: str, start: int) -> tuple[list[str], int]:
    """The arguments from ``start`` to the parenthesis that closes them, and where the text goes on; -1 without one."""
    parts, depth, begin = [], 0, start
    for place in range(start, len(text)):
        sign = text[place]
        if (sign == "," or sign == ")") and depth == 0:
            parts.append(text[begin:place].strip())
            begin = place + 1
            if sign == ")":
                return parts, place + 1
        depth += (sign in "([") - (sign in ")]")
    return parts, -1


_GREEK = frozenset(
    ["alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
     "rho", "sigma", "tau", "phi", "chi", "pi", "psi", "omega"]
)  # fmt: skip
_GREEK_LETTER = re.compile(rf"(?:{'|'.join(sorted(_GREEK))})(?:_?\d+)?")
_BEFORE, _AFTER = frozenset("=+-*/<>^([|"), frozenset("=+-*/<>^()|]")


@lru_cache(maxsize=4096)
def plain(source: str) -> str:
    """LaTeX of a letter as plain text: x₁, τ̃, ‖E‖; what has no character of its own keeps its mark, as in T_f."""
    from pylatexenc.latex2text import LatexNodes2Text

    source = re.sub(r"\\(?:mathrm|mathit|operatorname)\s*(?=\{)", "", source.replace(r"\|", r"\Vert "))
    moved = _PLACED.sub(_moved, source)
    text = LatexNodes2Text(math_mode="text").latex_to_text(moved).strip()
    return re.sub(r"\s+", " ", text).replace("*", "∗")


def _moved(found: re.Match[str]) -> str:
    """What stands below or above, as small characters where there are such."""
    mark, group, single = found.groups()
    table = _LOW if mark == "_" else _HIGH
    inside = plain(group or single)
    if all(character in table for character in inside):
        return "{}" + "".join(table[character] for character in inside)
    return inside if inside == "∗" else rf"\{mark}{inside}" if mark == "_" else rf"\^{{}}{inside}"
