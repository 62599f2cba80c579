"""Averages in readable form: where nothing can be taken out of a sum, it is not factored; elsewhere it is."""

from __future__ import annotations

import itertools

import pytest
import sympy as sp

from ptproof.averaging.brackets import _is_plain, tidy

a, b, c, d = LETTERS = sp.symbols("a b c d", real=True)
PLAIN = [a + b * c, a**2 + b * c**2, sp.Rational(1, 2) * a * b - c * d / 4, a * b * c + a**2 * d, a**3 * b - 6 * a * c]
OTHERS = [a * c + a * d + b * c + b * d, a**2 - b**2, a**2 + 2 * a * b + b**2, a + 1 / (b + c), sp.sin(a) + b * a]


@pytest.mark.parametrize("form", PLAIN, ids=str)
def test_nothing_is_left_to_factor(form: sp.Expr) -> None:
    assert _is_plain(form)
    assert sum(factor.is_Add for factor in sp.Mul.make_args(sp.factor(form))) == 1


@pytest.mark.parametrize("form", OTHERS, ids=str)
def test_it_is_not_said_of_others(form: sp.Expr) -> None:
    assert not _is_plain(form)


def test_no_product_of_two_sums_is_plain() -> None:
    sums = [sp.Add(*terms) for terms in itertools.combinations((a, -b, 2 * c, a * d, b**2, c * d, sp.S.One), 2)]
    assert not any(_is_plain(sp.expand(p * q)) for p, q in itertools.combinations_with_replacement(sums, 2)
                   if sp.expand(p * q).is_Add and p.is_Add and q.is_Add
                   and sum(e.is_Add for e in sp.Mul.make_args(sp.factor(p * q))) > 1)  # fmt: skip


def test_a_product_is_found_again() -> None:
    assert tidy(sp.expand((a + b) * (c + d))) == (a + b) * (c + d)
