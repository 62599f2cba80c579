"""Facts that follow from a claim's assumptions in one step, with the line by which Coq takes that step."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence

import sympy as sp

from ptproof.proof.kernel.hints.bernoulli import decaying, rated, rooted
from ptproof.proof.kernel.hints.comparisons import compared
from ptproof.proof.kernel.hints.supersolutions import never_above, weakened
from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.statement import Relation

Derived = tuple[Relation, str]


def derived(known: Sequence[Relation], said: Proposition) -> list[Derived]:
    """The facts, each with its line."""
    found: list[Derived] = []
    for item in known:
        with contextlib.suppress(NoTranslation):
            found += _raised(item.standard(), said.names)
    bounds = list(compared(said.claim, known, said.names, (decaying, rated, rooted)))
    found += [*bounds, *(more for bound in bounds for more in weakened(said, bound, list(known)))]
    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        found += never_above(said, list(known))
    return found


def _raised(item: Relation, names: Names) -> Iterator[Derived]:
    """From x^(1/q) <= r: x <= r^q, also where x or r may be 0."""
    power, bound = item.left, item.right
    if not (isinstance(power, sp.Pow) and item.sign == "<=" and bound.is_nonnegative and power.base.is_nonnegative):
        return
    if power.base.is_positive or power.exp.is_Rational:
        return
    inverse = 1 / power.exp
    words = " ".join(f"({term(part, names)})" for part in (power.base, power.exp, inverse, bound))
    yield Relation(power.base, "<=", bound**inverse), f"raised_bound{'' if bound.is_positive else '_from_0'} {words}"
