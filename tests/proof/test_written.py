"""What is remembered of expressions, their text and their hash, is that of the very expression."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import eq
from ptproof.proof.content import digest
from ptproof.proof.written import written

x, y = sp.symbols("x y", real=True)
F = sp.Function("F", real=True)
SIDES = [
    x, -x, (x + y) ** 2 / (1 + x), sp.sqrt(x) * sp.exp(-x / 2), sp.Derivative(F(x, y), x, x), sp.Max(x, y, 0),
    sp.Piecewise((x, x > y), (y, True)), sp.Integral(F(x, y), (x, 0, y)), sp.Mul(2, x + y, evaluate=False), sp.pi,
    sp.Limit(1 / x, x, 0, "+"), sp.Matrix([x / 2, -y]), sp.true,
]  # fmt: skip


@pytest.mark.parametrize("side", SIDES, ids=str)
def test_the_text_is_that_of_sympy_also_the_second_time(side: sp.Basic) -> None:
    expected = str(list(side)) if isinstance(side, sp.MatrixBase) else str(side)
    assert [written(side), written(side)] == [expected, expected]


def test_numbers_in_floating_point_keep_their_digits() -> None:
    short, long = x + sp.Float(1, 3) / 3, x + sp.Float(1, 30) / 3
    assert [written(side) for side in (short, long, short)] == [str(short), str(long), str(short)]
    assert len({digest(side) for side in (short, long, sp.Float("0.5", 3), sp.Float("0.5", 30))}) == 4


def test_letters_without_a_name_count_by_their_place_in_the_whole() -> None:
    a, b = sp.Dummy(real=True), sp.Dummy(real=True)
    assert digest(eq(a + x, a * y)) == digest(eq(b + x, b * y))
    assert digest(eq(a + x, a * y)) != digest(eq(a + x, b * y))


def test_a_letter_is_not_the_text_of_a_part() -> None:
    part = digest(x + y)
    assert digest(sp.Symbol(part, real=True) + 1) != digest(x + y + 1)
    assert len({digest(F(x)), digest(sp.Function("F", positive=True)(x)), digest(sp.Symbol("F", real=True))}) == 3
