"""Which words of dithers may count, against a count of all of them; comparisons of exponents."""

import itertools
from typing import Any

import pytest
import sympy as sp

from ptproof.averaging.exponents import Exponents
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.words import Word, Words
from ptproof.errors import InputError
from ptproof.proof.statement import Relation

p, q = sp.symbols("p q", positive=True)
R = sp.Rational
LONGEST = 4


def words(powers: Any, frequencies: Any, *conditions: Relation) -> Words:
    bounds = [bound for power in powers for bound in (Relation(0, "<", power), Relation(power, "<", 1))]
    return Words(tuple(map(sp.sympify, powers)), tuple(map(frozenset, frequencies)), Exponents((*conditions, *bounds)))


def resonates(word: Word, frequencies: Any) -> bool:
    letters = [frequencies[letter] for letter, count in enumerate(word) for _ in range(count)]
    choices = ([sign * rate for rate in rates for sign in (1, -1)] for rates in letters)
    return any(sum(choice) == 0 for choice in itertools.product(*choices))


def counted(powers: Any, frequencies: Any, grid: Any) -> set[Word]:
    """The same for the values on a grid of the parameters, by trying all of them."""
    found = set()
    for word in itertools.product(range(LONGEST + 1), repeat=len(powers)):
        if not 2 <= sum(word) <= LONGEST or sum(count > 0 for count in word) < 2 or not resonates(word, frequencies):
            continue
        for values in grid:
            at = [sp.sympify(power).subs(values) for power in powers]
            inside = all(0 < power < 1 for power in at)
            if inside and 1 - sum(count * (1 - power) for count, power in zip(word, at, strict=True)) >= 0:
                found.add(word)
                break
    return found


GRID = [{p: R(i, 24), q: R(j, 24)} for i in range(1, 24) for j in (3, 11, 20)]
LINE = [{p: R(i, 24)} for i in range(1, 24)]
CASES: list[tuple[str, Any, Any, Any, tuple[Relation, ...]]] = [
    ("newton seeker", (1 - p, p, 2 - 2 * p), ({1}, {1}, {2}), LINE, ()),
    ("gradient seeker", (1 - p, p), ({1}, {1}), LINE, ()),
    ("one parameter", (p, 2 - 2 * p), ({1}, {2}), LINE, ()),
    ("numbers", (R(3, 4), R(2, 3), R(1, 2)), ({1, 2}, {3}, {2}), [{}], ()),
    ("far below one", (p, q), ({1, 3}, {2}), GRID, (Relation(p, "<=", R(20, 24)), Relation(q, "<=", R(20, 24)))),
]


@pytest.mark.parametrize("case", CASES, ids=[case[0] for case in CASES])
def test_all_words_that_may_count_are_found(case: Any) -> None:
    _, powers, frequencies, grid, conditions = case
    if conditions:
        grid = [values for values in grid if values[p] <= R(20, 24) and values[q] <= R(20, 24)]
    found = {word for word in words(powers, frequencies, *conditions).counting() if sum(word) <= LONGEST}
    assert counted(powers, frequencies, grid) <= found
    assert all(resonates(word, frequencies) for word in found)
    if not conditions:
        assert found == counted(powers, frequencies, grid)


def test_a_family_without_end_that_never_resonates_is_left_out() -> None:
    """As p nears 1/2 any number of the third dither may count, beside one of the others, but odd is not even."""
    own = words((1 - p, p, 2 - 2 * p), ({1}, {1}, {2}))
    assert own.may_count((0, 1, 9))
    assert own.counting() == ((1, 1, 0), (0, 2, 1))
    with pytest.raises(AveragingUndecided, match="come near to 1"):
        words((1 - p, p, 2 - 2 * p), ({1}, {1}, {1})).counting()


def test_what_has_pieces_always_may_resonate() -> None:
    assert Words((p, q), (None, frozenset({2})), Exponents(())).resonates((1, 1))
    assert not words((p, q), ({1}, {2})).resonates((1, 1))


ALLOWED = Exponents((Relation(R(1, 2), "<", p), Relation(p, "<", 1)))


@pytest.mark.parametrize(
    ("exponent", "signs"),
    [
        (1 - 2 * p, {-1}), (2 * p - 1, {1}), (2 - 3 * p, {-1, 0, 1}), (sp.S.Zero, {0}), (p - p, {0}), (1 - p, {1}),
        (5 - 8 * p, {-1, 0, 1}), (R(1, 2) - p, {-1}), (p - q, {-1, 0, 1}), (-q, {-1}),
    ],
    ids=str,
)  # fmt: skip
def test_signs_of_exponents(exponent: sp.Expr, signs: set[int]) -> None:
    found = ALLOWED.signs(exponent)
    assert found.keys() == signs
    for sign, point in found.items():
        assert sp.sign(exponent.subs(point)) == sign
        assert all(bound.left.subs(point) < bound.right.subs(point) for bound in ALLOWED.relations)


def test_equality_on_what_is_allowed() -> None:
    line = Exponents((Relation(p + q, "=", 1),))
    assert line.equal(p, 1 - q)
    assert not line.equal(p, q)
    assert line.point(Relation(p, ">", 1)) is None


@pytest.mark.parametrize("exponent", [p * q, p**2, sp.sqrt(p), sp.sqrt(2) * p, sp.pi, p / q, sp.exp(p)], ids=str)
def test_what_is_not_linear(exponent: sp.Expr) -> None:
    with pytest.raises(InputError, match="not linear"):
        Exponents((Relation(exponent, "<", 1),))
