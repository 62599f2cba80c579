"""Each lemma against enclosures over its whole domain: no box contradicts it, and at exact points it holds."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import pytest
import sympy as sp

from ptproof.balls.ball import Undefined, enclose, interval
from ptproof.proof import Fact, lemmas
from ptproof.proof.signs import holds
from ptproof.proof.statement import Implication, Relation, free_symbols
from ptproof.proof.substitution import Substitution

u, v = sp.symbols("u v", real=True)
a, b = sp.symbols("a b", nonnegative=True)
p = sp.Symbol("p", nonnegative=True)
r = sp.Symbol("r", positive=True)
POINTS = [sp.S.Zero, *(sign * sp.Rational(value) for sign in (1, -1) for value in
          ("1/1000000", "1/100", "1/3", "1/2", "1", "3/2", "2", "22/7", "7", "100", "12345"))]  # fmt: skip
EDGES = ["-1000000", "-100", "-7", "-3", "-3/2", "-1/2", "-1/50", "0", "1/50", "1/2", "3/2", "3", "7", "100", "1000000"]
LEMMAS: dict[str, tuple[Fact, tuple[sp.Symbol, ...]]] = {
    "power_monotone": (lemmas.power_monotone(a, b, p), (a, b, p)),
    "power_strict": (lemmas.power_strict(a, b, p), (a, b, p)),
    "power_positive": (lemmas.power_positive(r, u), (r, u)),
    "power_nonnegative": (lemmas.power_nonnegative(a, r), (a, r)),
    "superadditive": (lemmas.superadditive(a, b, 1 + p), (a, b, p)),
    "exp_monotone": (lemmas.exp_monotone(u, v), (u, v)),
    "exp_line": (lemmas.exp_line(u), (u,)),
    "exp_line_strict": (lemmas.exp_line_strict(u), (u,)),
    "cosine_parabola": (lemmas.cosine_parabola(u), (u,)),
    "cosine_quartic": (lemmas.cosine_quartic(u), (u,)),
    "sine_line": (lemmas.sine_line(u), (u,)),
    "sine_cubic": (lemmas.sine_cubic(u), (u,)),
    "sine_square": (lemmas.sine_square(u), (u,)),
    "norm_below": (lemmas.norm_below([u, v], p, [u / 2, 2 * v]), (u, v, p)),
    "power_of_root": (lemmas.power_of_root(r ** (1 / (1 + p)), r, 1 + p), (r, p)),
}
SMALL = 12  # values larger than this make powers of powers too large for any enclosure


def boxes(symbols: tuple[sp.Symbol, ...]) -> Iterator[dict[sp.Symbol, Any]]:
    """Boxes that cover all values that the symbols may have, up to a million in size."""
    edges = [sp.Rational(edge) for edge in EDGES] if len(symbols) < 3 else [sp.Rational(e) for e in EDGES[5:-2]]
    pools = []
    for symbol in symbols:
        own = [edge for edge in edges if edge >= 0] if symbol.is_nonnegative else edges
        pools.append(list(itertools.pairwise(own)))
    for choice in itertools.product(*pools):
        yield dict(zip(symbols, choice, strict=True))


def ball(ends: tuple[sp.Rational, sp.Rational]) -> Any:
    from flint import arb, fmpq

    return interval(*(arb(fmpq(int(end.p), int(end.q))) for end in ends))


def certainly(relation: Relation, values: dict[sp.Symbol, Any]) -> bool | None:
    """Whether the relation holds, or fails, in the whole box; None where that is not clear."""
    try:
        left, right = (enclose(side, values) for side in (relation.standard().left, relation.standard().right))
    except (Undefined, ValueError, OverflowError):
        return None
    sign = relation.standard().sign
    if sign in ("<", "<="):
        return True if left < right else False if left > right else None
    apart = bool(left < right or left > right)
    return (apart if sign == "!=" else not apart) if apart else None


@pytest.mark.parametrize("name", LEMMAS)
def test_no_box_contradicts_it(name: str) -> None:
    fact, symbols = LEMMAS[name]
    looked_at = 0
    for box in boxes(symbols):
        values = {symbol: ball(ends) for symbol, ends in box.items()}
        if all(certainly(part, values) for part in fact.says.hypotheses):
            looked_at += 1
            assert certainly(fact.says.conclusion, values) is not False, box
    assert looked_at or fact.says.hypotheses


@pytest.mark.parametrize("name", LEMMAS)
def test_it_holds_at_exact_points(name: str) -> None:
    fact, symbols = LEMMAS[name]
    looked_at = 0
    for choice in itertools.product(POINTS, repeat=len(symbols)):
        values = dict(zip(symbols, choice, strict=True))
        if any(symbol.is_nonnegative and value < 0 for symbol, value in values.items()):
            continue
        if any(symbol.is_positive and value == 0 for symbol, value in values.items()) or looked_at > 150:
            continue
        if len(symbols) > 1 and max(map(abs, choice)) > SMALL:
            continue
        there = Substitution(values)
        if all(holds(there.relation(part)) for part in fact.says.hypotheses):
            looked_at += 1
            fails = there.relation(fact.says.conclusion).negation()
            assert not holds(fails), values
    assert looked_at > 5


def test_every_lemma_is_looked_at() -> None:
    public = {name for name, value in vars(lemmas).items() if hasattr(value, "__wrapped__")}
    assert public == set(LEMMAS)


@pytest.mark.parametrize(
    "name", ["power_monotone", "superadditive", "exp_line", "cosine_parabola", "sine_cubic", "norm_below"]
)
def test_a_corrupted_lemma_is_contradicted(name: str) -> None:
    fact, symbols = LEMMAS[name]
    conclusion = fact.says.conclusion.standard()
    corrupted = Implication(fact.says.hypotheses, Relation(conclusion.right, conclusion.sign, conclusion.left - 1))
    assert free_symbols([corrupted.conclusion])
    found = False
    for choice in itertools.product(POINTS[:7], repeat=len(symbols)):
        values = dict(zip(symbols, choice, strict=True))
        there = Substitution(values)
        met = all(holds(there.relation(part)) for part in corrupted.hypotheses)
        found = found or (met and holds(there.relation(corrupted.conclusion).negation()))
    assert found
