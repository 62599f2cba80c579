"""What symbols and undefined functions are declared to be: the one place that reads SymPy's assumptions as a promise.

A symbol stands for every value that its declaration allows. An undefined function stands for every smooth function
of real arguments whose values are of its declared kind, whatever letters it is written with.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.assumptions import StdFactKB
from sympy.core.function import AppliedUndef

from ptproof.proof.relation import RelationSign

Letter: TypeAlias = sp.Symbol | AppliedUndef
# Only a sign may be shown otherwise than by SymPy, of what SymPy knows to be real.
SIGNS = ("positive", "nonnegative", "negative", "nonpositive", "nonzero")
SAYS: Mapping[str, RelationSign] = dict(zip(SIGNS, (">", ">=", "<", "<=", "!="), strict=True))
"""The relation of a value to 0 that each of these words says."""
# From what says little to what says much.
_WORDS = (
    "real", "nonnegative", "nonpositive", "nonzero", "rational", "integer", "noninteger", "irrational", "positive",
    "negative", "zero", "even", "odd", "prime", "composite", "imaginary",
)  # fmt: skip


def declared(letter: Letter) -> dict[str, bool]:
    """What a symbol, or the values of an undefined function, are declared to be; of a symbol the fewest words for it.

    For SymPy symbols are equal whose declarations say the same, so that any of them may come back from its cache: in
    whatever words, they are one here.

    >>> declared(sp.Symbol("n", integer=True, positive=True)), declared(sp.Function("g", negative=True)(1))["negative"]
    ({'integer': True, 'positive': True}, True)
    >>> declared(sp.Symbol("x", real=True, nonnegative=True, zero=False))
    {'positive': True}
    """
    if isinstance(letter, sp.Symbol):
        return dict(_fewest(tuple(letter.assumptions0.items())))
    known: dict[str, bool] = letter.func._kwargs  # SymPy keeps with it all that follows
    true = {name: True for name in _WORDS if known.get(name)}
    implied = StdFactKB(true)
    return true | {name: False for name in _WORDS if known.get(name) is False and implied.get(name) is not False}


@lru_cache(maxsize=4096)
def _fewest(known: tuple[tuple[str, bool], ...]) -> tuple[tuple[str, bool], ...]:
    """Of all that is known of a symbol what the rest follows from; what says least is left out first."""
    left = {name: truth for name, truth in known if name != "commutative"}
    for name, truth in sorted(left.items(), key=lambda item: (_strength(*item), item)):
        others = {other: value for other, value in left.items() if other != name}
        if StdFactKB(others).get(name) is truth:
            left = others
    return tuple(sorted(left.items()))


def _strength(word: str, truth: bool) -> int:
    return truth and (2 + _WORDS.index(word) if word in _WORDS else 1)


def is_plainly_real(symbol: sp.Symbol) -> bool:
    """Whether the symbol stands for every real number: declared real and nothing more."""
    return declared(symbol) == {"real": True}


def is_continuum(letter: Letter) -> bool:
    """Whether the letter ranges over the reals, or over those of one sign: a derivative by it says something."""
    return bool(letter.is_real) and all(word in ("real", *SIGNS) for word in declared(letter))


def like(symbol: sp.Symbol) -> sp.Symbol:
    """A fresh symbol of the same kind: nothing that is known of another symbol is known of it."""
    return sp.Dummy(symbol.name, **symbol.assumptions0)


def admissible(letter: Letter, value: Any) -> bool:
    """Whether SymPy knows ``value`` to be what ``letter`` may stand for.

    For a function it is an expression in the letter's arguments, and the answer holds for all their real values.
    """
    return not missing(letter, value)


def missing(letter: Letter, value: Any) -> dict[str, bool]:
    """What ``letter`` is declared to be and SymPy does not know of ``value``, as in :func:`admissible`."""
    return dict(_missing(letter, sp.sympify(value)))


@lru_cache(maxsize=4096, typed=True)
def _missing(letter: Letter, value: Any) -> tuple[tuple[str, bool], ...]:
    there = everywhere(letter, value)
    known = declared(letter).items()
    return tuple((name, truth) for name, truth in known if getattr(there, f"is_{name}", None) is not truth)


@lru_cache(maxsize=4096, typed=True)
def everywhere(letter: Letter, value: sp.Expr) -> sp.Expr:
    """The value of a function at arbitrary real arguments, whatever its letters were declared to be."""
    if isinstance(letter, sp.Symbol):
        return value
    free: Mapping[Any, Any] = {argument: sp.Dummy(str(argument), real=True) for argument in letter.args}
    return value.xreplace(free)


def is_kind(
    letter: Letter, value: Any, has_sign: Callable[[sp.Expr, str], bool], is_real: Callable[[sp.Expr], bool]
) -> bool:
    """Whether ``value`` is what ``letter`` may stand for.

    ``has_sign`` and ``is_real`` may show what SymPy does not know: a sign of a real value, and that a value is real.
    """
    value = sp.sympify(value)
    lacking = missing(letter, value)
    if not lacking:
        return True
    there = everywhere(letter, value)
    if lacking.pop("real", False) and not (there.is_real or is_real(there)):
        return False
    if not all(name in SIGNS and truth for name, truth in lacking.items()):
        return False
    return not lacking or ((there.is_real or is_real(there)) and all(has_sign(there, name) for name in lacking))
