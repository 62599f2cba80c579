"""What the declarations of letters ask of exact values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any

import sympy as sp

_TESTS: Mapping[str, Callable[[Any], bool]] = {
    "positive": lambda value: value > 0,
    "negative": lambda value: value < 0,
    "nonnegative": lambda value: value >= 0,
    "nonpositive": lambda value: value <= 0,
    "zero": lambda value: value == 0,
    "nonzero": lambda value: value != 0,
    "integer": lambda value: value.denominator == 1,
    "noninteger": lambda value: value.denominator != 1,
    "even": lambda value: value.denominator == 1 and value.numerator % 2 == 0,
    "odd": lambda value: value.denominator == 1 and value.numerator % 2 == 1,
    "prime": lambda value: value.denominator == 1 and bool(sp.isprime(int(value.numerator))),
    "composite": lambda value: value.denominator == 1 and value > 1 and not sp.isprime(int(value.numerator)),
}
_SIGNS = ("positive", "negative", "nonnegative", "nonpositive", "zero", "nonzero")
_EVERY_RATIONAL = {
    "rational": True, "irrational": False, "algebraic": True, "transcendental": False, "real": True, "imaginary": False,
}  # fmt: skip

UNTESTED = (frozenset({-1, 0, 1}), ())
"""What :func:`tests` says of an atom that may be any rational."""


@lru_cache(maxsize=4096)
def tests(atom: Any) -> tuple[frozenset[int], tuple[tuple[Callable[[Any], bool], bool], ...]]:
    """What the declaration of an atom asks of a value: its sign, and what else every rational does not have."""
    known = {word: truth for word, truth in atom.assumptions0.items() if word in _TESTS or word in _EVERY_RATIONAL}
    if any(_EVERY_RATIONAL[word] is not known[word] for word in known if word in _EVERY_RATIONAL):
        return frozenset(), ()
    signs = {n for n in (-1, 0, 1) if all(_TESTS[w](Fraction(n)) is known[w] for w in known if w in _SIGNS)}
    rest = ((_TESTS[w], known[w]) for w in known if w not in _SIGNS and w not in _EVERY_RATIONAL)
    return frozenset(signs), tuple(rest)
