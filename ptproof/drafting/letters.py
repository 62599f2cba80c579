"""What all formulas of a paper tell of its letters, put together: what they are applied to, which move, their sizes."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

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
        """The letters that have a rate, or stand both alone and at a time, and that are applied to times only."""
        moved = {item.key for item in self.occurrences if item.along}
        for key in self.alone & self._lists.keys():
            if any(_PLACE_INDEX.sub("", found[0]) in self.times for found in self._lists[key]):
                moved.add(key)
        return frozenset(key for key in moved if all(map(self._is_time, set(self._lists.get(key, ())) - {("+",)})))

    @cached_property
    def alone(self) -> frozenset[str]:
        """The letters that stand somewhere without parentheses behind them."""
        return frozenset(item.key for item in self.occurrences if item.arguments is None)

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
        return {key: lists for key, lists in self._lists.items() if self._is_function(key, key in self.alone)}

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
        return frozenset(
            key for key, lists in self._lists.items()
            if key not in self.applied and (key not in self.alone or ("",) in lists)
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
