"""What the letters of a paper may mean, guessed from how they are written. Every guess is for the author to check.

- A letter is a real number. Accents, an index and a star are part of its name; another exponent is a power.
- A letter is a *function* if letters, numbers, or several things stand behind it in parentheses somewhere, as in F(x),
  V(0), f(t, 2x), or if it never stands alone, and before a product or a sum of times, as in u(k t), ν(t − t₀). Where it
  stands alone, it is the function at those letters with which it is written most often. A letter that never stands but
  before sums, or both alone and before a product, has two readings: a factor and a function. It is not read there.
- A letter *moves* if a dot stands over it, or d/dt before it. If it is applied to nothing but times it is the same
  letter with and without its time: x(t) is x. Where it stands before a sum of other things it is a factor.
- A letter is a *column* or a *matrix* if the paper says so: x = [x₁, x₂]ᵀ, x ∈ ℝ², A ∈ ℝ²ˣ², or an equation whose other
  side is one, or as P in xᵀ P x. A bar, a tilde, a hat, a star and the index 0 do not change that. A
  bold or a transposed letter of unknown size is not read.
- A *time* is t, and what a derivative d/d· is taken by.
- I beside a square matrix is the identity. A word that names what is not smooth (sat, sgn) is not guessed.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ptproof.drafting.names import python_name, unused
from ptproof.drafting.occurrences import Occurrence, Scanned

_ROOT = re.compile(r"^\\(?:bar|tilde|hat|check|widetilde|overline)\{(.*)\}$")
_PLACE_INDEX = re.compile(r"_(?:0|e|\{\s*0\s*\})$")
_BOLD = (r"\mathbf{", r"\boldsymbol{", r"\vec{")
Shape = tuple[int, int]


@dataclass
class Letters:
    """What is known so far of the letters of one paper.

    ``shapes`` are those of columns and matrices, which grow while formulas are read.
    """

    occurrences: Sequence[Occurrence]
    shapes: dict[str, Shape] = field(default_factory=dict)
    columns: dict[str, tuple[str, ...]] = field(default_factory=dict)
    transposed: set[str] = field(default_factory=set)
    forms: list[tuple[str, str, str]] = field(default_factory=list)

    @classmethod
    def of(cls, scanned: Iterable[Scanned]) -> Letters:
        """What the formulas tell, one after the other; what comes first counts."""
        found = cls([])
        every: list[Occurrence] = []
        for item in scanned:
            every += item.occurrences
            found.transposed |= item.transposed
            found.forms += item.forms
            for key, shape in item.members:
                found.shapes.setdefault(key, shape)
            for key, entries in item.columns:
                if key not in entries and found.columns.setdefault(key, entries) == entries:
                    found.shapes.setdefault(key, (len(entries), 1))
        found.occurrences = every
        return found

    @cached_property
    def keys(self) -> dict[str, int]:
        """Each letter in the order of the text, with the line on which it occurs first."""
        found: dict[str, int] = {}
        for item in self.occurrences:
            found.setdefault(item.key, item.line)
        return found

    @cached_property
    def times(self) -> tuple[str, ...]:
        """The letters along which something moves."""
        found = [item.along for item in self.occurrences if item.along]
        return tuple(dict.fromkeys(["t"] * ("t" in self.keys or "t" in found) + found))

    @cached_property
    def moving(self) -> frozenset[str]:
        """The letters of which a rate is taken, and that are applied to nothing but times."""
        moved = {item.key for item in self.occurrences if item.along}
        return frozenset(key for key in moved if all(map(self._is_time, set(self._lists.get(key, ())) - {("+",)})))

    @cached_property
    def _lists(self) -> dict[str, Counter[tuple[str, ...]]]:
        """For each letter that stands before parentheses what is in them, with how often."""
        found: dict[str, Counter[tuple[str, ...]]] = {}
        for item in self.occurrences:
            if item.arguments:
                found.setdefault(item.key, Counter())[item.arguments] += 1
        return found

    @cached_property
    def applied(self) -> dict[str, Counter[tuple[str, ...]]]:
        """For each function the lists of its arguments, with how often each occurs."""
        alone = {item.key for item in self.occurrences if item.arguments is None}
        return {key: lists for key, lists in self._lists.items() if self._is_function(key, key in alone)}

    def _is_function(self, key: str, alone: bool) -> bool:
        lists = set(self._lists[key])
        if any(len(found) > 1 or found[0] not in ("", "+") for found in lists):
            return True
        if alone:
            return False
        sums = {letter for item in self.occurrences if item.key == key for letter in item.sums}
        return ("",) in lists or all(self._is_time((letter,)) for letter in sums)

    @cached_property
    def two_readings(self) -> frozenset[str]:
        """The letters of which nothing tells whether they are factors or functions."""
        alone = {item.key for item in self.occurrences if item.arguments is None}
        return frozenset(
            key for key, lists in self._lists.items()
            if key not in self.applied and (key not in alone or ("",) in lists)
        )  # fmt: skip

    @cached_property
    def factors(self) -> frozenset[str]:
        """The letters that move and stand before sums of other things than times: factors, even with d(0) = d₀."""
        return frozenset(
            item.key for item in self.occurrences
            if item.key in self.moving and item.arguments == ("+",) and not all(self._is_time((x,)) for x in item.sums)
        )  # fmt: skip

    def _is_time(self, arguments: tuple[str, ...]) -> bool:
        """Whether these are a time, and at most where a run has begun behind it, as in x(t; t₀, x₀)."""
        bare = _PLACE_INDEX.sub("", arguments[0])
        known = bare in (*self.times, "s", "T") or bare[:1].isdigit()
        return known and all(argument.endswith("_0") for argument in arguments[1:])

    def forms_shaped(self) -> dict[str, Shape]:
        """The shapes of letters between a transposed column and a column."""
        found = {}
        for before, middle, after in self.forms:
            sizes = self.shape(before), self.shape(after)
            if self.shape(middle) is None and sizes[0] and sizes[1] and sizes[0][1] == sizes[1][1] == 1:
                found[middle] = (sizes[0][0], sizes[1][0])
        return found

    def is_sized(self, key: str) -> bool:
        """Whether a letter is no column or matrix, or it is known of what size."""
        return self.shape(key) is not None or not (key in self.transposed or key.startswith(_BOLD))

    def shape(self, key: str) -> Shape | None:
        """The shape of a letter, or of the letter without its accents, star and index 0."""
        while key not in self.shapes:
            shorter = _PLACE_INDEX.sub("", re.sub(r"\^\{?\*\}?$|\^\\star$", "", key))
            if shorter == key and (match := _ROOT.match(key)):
                shorter = match[1]
            if shorter == key:
                return None
            key = shorter
        return self.shapes[key]


@dataclass(frozen=True)
class Declared:
    """One name of the derivation: its LaTeX, the line on which it occurs first, and whether it is a function."""

    name: str
    glyph: str
    line: int
    function: bool = False


@dataclass(frozen=True)
class Guess:
    """A table of notation that is guessed, and the names that it declares."""

    declared: Mapping[str, Declared]
    letters: Mapping[str, Any]
    functions: Mapping[str, Any]
    means: Mapping[str, str]
    times: tuple[str, ...]
    states: frozenset[str]
    generic: Mapping[str, tuple[str, ...]]

    def table(self, rates: Mapping[str, str] | None = None) -> dict[str, Any]:
        """The table as TOML has it; ``rates`` says what the names of rates stand for."""
        table: dict[str, Any] = {"times": list(self.times)}
        if self.times:
            table["dot"] = self.times[0]
        return {
            **table,
            "letters": dict(self.letters),
            "functions": dict(self.functions),
            "means": {**self.means, **(rates or {})},
        }


def guess(letters: Letters) -> Guess:
    """What the letters mean by the rules of this module."""
    return _Guessing(letters).done()


class _Guessing:
    def __init__(self, found: Letters) -> None:
        self.found = found
        self.declared: dict[str, Declared] = {}
        self.names: dict[tuple[str, bool], str] = {}
        self.letters: dict[str, Any] = {}
        self.functions: dict[str, Any] = {}
        self.means: dict[str, str] = {}
        self.states: set[str] = set()
        self.generic: dict[str, tuple[str, ...]] = {}

    def done(self) -> Guess:
        keys = dict(self.found.keys)
        for key in self.found.times:
            keys.setdefault(key, 0)
        times = tuple(self.name(key) for key in self.found.times)
        for key in keys:
            if key in self.found.moving or key not in self.found.applied:
                self.letters[key] = self.value(key)
            if key in self.found.moving:
                self.move(key, times)
        for key in keys:
            if key in self.found.applied and key not in self.found.moving:
                self.apply(key)
        return Guess(
            self.declared, self.letters, self.functions, self.means, times, frozenset(self.states), self.generic
        )

    def name(self, key: str, function: bool = False) -> str:
        """The name of a letter or function, declared with its first use."""
        if (key, function) not in self.names:
            name = self.names[key, function] = python_name(key, self.declared)
            self.declared[name] = Declared(name, key, self.found.keys.get(key, 0), function)
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
            return [self.name(own[i] if own else _entry(key, str(i + 1)), function) for i in range(rows)]
        return [[self.name(_entry(key, f"{i + 1}{j + 1}"), function) for j in range(columns)] for i in range(rows)]

    def move(self, key: str, times: Sequence[str]) -> None:
        """A letter that moves is the same with and without its time."""
        flat = list(_flat(self.letters[key]))
        self.states.update(flat)
        if key in self.found.applied and key not in self.found.factors:
            self.functions[key] = self.letters[key]
            self.means.update({f"{name}({time})": name for name in flat for time in times})

    def apply(self, key: str) -> None:
        """A function, and what its letter alone stands for."""
        value = self.functions[key] = self.value(key, function=True)
        at = next((a for a, _ in self.found.applied[key].most_common() if all(x in self.letters for x in a)), None)
        if at is None:
            return
        arguments = [name for x in at for name in _flat(self.letters[x])]
        if len(set(arguments)) < len(arguments):
            return
        for name in _flat(value):
            self.generic[name] = tuple(arguments)
        spoken = f"({', '.join(arguments)})"
        self.letters[key] = _mapped(value, lambda name: name + spoken)


def rate_name(moved: str, time: str, single: bool, taken: Iterable[str]) -> str:
    """A name for the rate of ``moved`` along ``time``, which needs no mention where there is only one."""
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


def _flat(value: Any) -> Iterable[str]:
    if isinstance(value, list):
        for entry in value:
            yield from _flat(entry)
    else:
        yield str(value)


def _mapped(value: Any, change: Any) -> Any:
    return [_mapped(entry, change) for entry in value] if isinstance(value, list) else change(value)
