"""What the letters of a paper may mean, guessed from how they are written. Every guess is for the author to check.

- A letter is a real number. Accents, an index and a star are part of its name; another exponent is a power.
- A letter is a *function* if letters, numbers, or several things stand behind it in parentheses somewhere, as in F(x),
  V(0), f(t, 2x), or if it never stands alone, and before a product or a sum of times, as in u(k t), ν(t − t₀). Where it
  stands alone, it is the function at those letters with which it is written most often. A letter that never stands but
  before sums, or both alone and before a product, has two readings: a factor and a function. It is not read there.
- A letter *moves* if a dot stands over it, d/dt before it, or it stands both alone and at a time. If it is applied to
  nothing but times it is the same letter with and without its time: x(t) is x. Where it stands before a sum of other
  things it is a factor. A letter that stands alone, and otherwise has values only, as V(0), is read where it is alone.
- A letter is a *column* or a *matrix* if the paper says so: x = [x₁, x₂]ᵀ, x ∈ ℝ², A ∈ ℝ²ˣ², or an equation whose other
  side is one, or as P in xᵀ P x. A bar, a tilde, a hat, a star and the index 0 do not change that.
  A bold or a transposed letter of unknown size is not read.
- A *time* is t, and what a derivative d/d· is taken by.
- e with an exponent is the exponential. Where e stands alone elsewhere it is a letter with a whole number, and has two
  readings with another exponent.
- I beside a square matrix is the identity. A word that names what is not smooth (sat, sgn) is not guessed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ptproof.drafting.letters import Letters
from ptproof.drafting.names import python_name, unused
from ptproof.reading.latex.notation import flat


@dataclass(frozen=True)
class Declared:
    """One name of the derivation: its LaTeX, the line on which it occurs first, and whether it is a function."""

    name: str
    glyph: str
    line: int
    function: bool = False


class Guess:
    """A table of notation that is guessed by the rules of this module, and the names that it ``declared``.

    ``generic`` are the arguments at which functions stand most often, ``valued`` letters of which the paper has values
    only, such as V(0), and does not say of what they are functions.
    """

    def __init__(self, found: Letters) -> None:
        self.found = found
        self.declared: dict[str, Declared] = {}
        self.names: dict[tuple[str, bool], str] = {}
        self.letters: dict[str, Any] = {}
        self.functions: dict[str, Any] = {}
        self.means: dict[str, str] = {}
        self.states: set[str] = set()
        self.generic: dict[str, tuple[str, ...]] = {}
        self.valued: set[str] = set()
        self.times = tuple(self.name(key) for key in found.times)
        keys = dict.fromkeys([*found.keys, *found.times])
        for key in keys:
            if key in found.moving or key not in found.applied:
                self.letters[key] = self.value(key)
            if key in found.moving:
                self.move(key)
        for key in keys:
            if key in found.applied and key not in found.moving:
                self.apply(key)

    def table(self, rates: Mapping[str, str] | None = None) -> dict[str, Any]:
        """The table as TOML has it; ``rates`` says what the names of rates stand for."""
        table: dict[str, Any] = {"times": list(self.times)}
        if self.times:
            table["dot"] = self.times[0]
        means = {**self.means, **(rates or {})}
        return {**table, "letters": dict(self.letters), "functions": dict(self.functions), "means": means}

    def name(self, key: str, function: bool = False, column: str = "") -> str:
        """The name of a letter or function, declared with its first use, or that of its column."""
        if (key, function) not in self.names:
            name = self.names[key, function] = python_name(key, self.declared)
            lines = [self.found.keys[letter] for letter in (key, column) if letter in self.found.keys]
            self.declared[name] = Declared(name, key, min(lines, default=0), function)
        return self.names[key, function]

    def value(self, key: str, function: bool = False) -> Any:
        """The name of a letter, or the names of its entries, row by row."""
        shape = self.found.shape(key)
        if shape is None:
            return self.name(key, function)
        rows, columns = shape
        if key == "I" and rows == columns:
            return [["1" if i == j else "0" for j in range(columns)] for i in range(rows)]
        own = self.found.columns.get(key, ())
        if columns == 1:
            return [self.name(own[i] if own else _entry(key, str(i + 1)), function, key) for i in range(rows)]
        return [[self.name(_entry(key, f"{i + 1}{j + 1}"), function, key) for j in range(columns)] for i in range(rows)]

    def move(self, key: str) -> None:
        """A letter that moves is the same with and without its time."""
        names = list(flat(self.letters[key]))
        self.states.update(names)
        if key in self.found.applied and key not in self.found.factors:
            self.functions[key] = self.letters[key]
            self.means.update({f"{name}({time})": name for name in names for time in self.times})

    def apply(self, key: str) -> None:
        """A function, and what its letter alone stands for."""
        at = next((a for a, _ in self.found.applied[key].most_common() if all(x in self.letters for x in a)), None)
        if at is None and key in self.found.alone:
            self.letters[key] = self.value(key)
            self.valued.add(key)
        value = self.functions[key] = self.value(key, function=True)
        if at is None:
            return
        arguments = [name for x in at for name in flat(self.letters[x])]
        if len(set(arguments)) < len(arguments):
            return
        for name in flat(value):
            self.generic[name] = tuple(arguments)
        spoken = f"({', '.join(arguments)})"
        self.letters[key] = _mapped(value, lambda name: name + spoken)


def rate_name(moved: str, time: str, single: bool, taken: Iterable[str]) -> str:
    """A name for the rate of ``moved`` along ``time``, which needs no mention where there is only one."""
    if single and moved.endswith("_dot"):
        return unused(f"{moved.removesuffix('dot')}ddot", taken)
    return unused(f"{moved}_dot" if single else f"{moved}_by_{time}", taken)


def _entry(key: str, index: str) -> str:
    """The spelling of an entry of the column or matrix ``key``."""
    base, sign, low = key.partition("_")
    low, star, high = low.partition("^") if sign else ("", "", "")
    if not sign:
        base, star, high = base.partition("^")
    both = f"{low.strip('{}')},{index}" if low else index
    script = f"_{both}" if len(both) == 1 else f"_{{{both}}}"
    return base + script + star + high


def _mapped(value: Any, change: Any) -> Any:
    return [_mapped(entry, change) for entry in value] if isinstance(value, list) else change(value)
