"""Names in Python for the letters of a paper."""

from __future__ import annotations

import keyword
import re
import unicodedata
from collections.abc import Iterable

from ptproof.reading.expressions import CONSTANTS, FUNCTIONS

_ACCENT = re.compile(r"\\(bar|tilde|hat|check|vec|dot|widetilde|overline|mathbf|boldsymbol|mathcal|mathfrak|text)\{")
_SIGNS = {"*": " star ", "+": " plus ", "-": " minus ", r"\star": " star ", r"\ast": " star ", r"\dagger": " dagger "}
_SILENT = ("vec", "mathbf", "boldsymbol", "text")
# What modules of a derivation call otherwise, and letters that are easily mistaken for digits.
RESERVED = frozenset([
    *FUNCTIONS, *CONSTANTS, *keyword.kwlist, *keyword.softkwlist, "sp", "letter", "alphabet", "rate", "slope", "put",
    "claim", "definition", "gap", "eq", "every", "exact", "ge", "gt", "integrals", "le", "limits", "lt", "reals",
    "Relation", "Derivative", "Piecewise", "l", "I", "O", "None", "True", "False",
])  # fmt: skip


def python_name(key: str, taken: Iterable[str] = ()) -> str:
    """A name for a letter that is spelled ``key`` in LaTeX, other than those that are ``taken``.

    >>> [python_name(key) for key in ("x_1", r"\\bar{x}_1", r"\\tilde{\\alpha}", "F^*", r"\\lambda_{\\text{min}}", "I")]
    ['x1', 'x_bar_1', 'alpha_tilde', 'F_star', 'lambda_min', 'I_']
    """
    text, accents = key, []
    while match := _ACCENT.search(text):
        if match[1] not in _SILENT:
            accents.append({"widetilde": "tilde", "overline": "bar", "mathcal": "cal", "mathfrak": "frak"}.get(
                match[1], match[1]))  # fmt: skip
        text = text[: match.start()] + text[match.end() :].replace("}", "", 1)
    stem, mark, rest = [*re.split(r"([_^])", text, maxsplit=1), "", ""][:3]
    base, scripts = _words(stem), _words(rest)
    if mark == "_" and not accents and len(base) == 1 and scripts.isdigit():
        name = base + scripts
    else:
        name = "_".join(part for part in (base, *reversed(accents), scripts) if part)
    name = re.sub(r"_+", "_", re.sub(r"\W", "_", name)).strip("_") or "letter"
    if name[0].isdigit():
        name = f"n_{name}"
    return unused(f"{name}_" if name in RESERVED else name, taken)


def unused(name: str, taken: Iterable[str]) -> str:
    """The name itself, or with the first number that makes it new."""
    known, number, wanted = set(taken), 1, name
    while name in known:
        number += 1
        name = f"{wanted.rstrip('_')}_{number}"
    return name


def _words(text: str) -> str:
    for sign, word in _SIGNS.items():
        text = text.replace(sign, word)
    text = re.sub(r"\\([a-zA-Z]+)", r" \1 ", text)
    text = "".join(_ascii(sign) for sign in text)
    return "_".join(re.findall(r"[A-Za-z0-9]+", text))


def _ascii(sign: str) -> str:
    if sign.isascii():
        return sign
    spelled = unicodedata.normalize("NFKD", sign).encode("ascii", "ignore").decode()
    if spelled:
        return spelled
    name = unicodedata.name(sign, f"u{ord(sign):x}")
    word = name.rsplit(" ", 1)[-1]
    return f" {word.capitalize() if 'CAPITAL' in name else word.lower()} "
