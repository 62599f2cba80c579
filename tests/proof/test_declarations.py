"""What a symbol is declared to be does not depend on the words that were chosen for it."""

import pytest
import sympy as sp
from hypothesis import given, reject
from hypothesis import strategies as st
from sympy.core.facts import InconsistentAssumptions

from ptproof.proof.content import digest
from ptproof.proof.declarations import declared


@pytest.mark.parametrize(
    ("words", "fewest"),
    [
        ({"real": True, "positive": True}, {"positive": True}),
        ({"nonnegative": True, "zero": False}, {"positive": True}),
        ({"real": True, "finite": True}, {"real": True}),
        ({"integer": True, "positive": True, "real": True}, {"integer": True, "positive": True}),
        ({"real": True, "positive": False}, {"nonpositive": True}),
        ({"finite": True}, {"finite": True}),
        ({}, {}),
    ],
)
def test_a_symbol_is_declared_by_the_fewest_words_whatever_was_written(words, fewest):
    assert declared(sp.Symbol("x", **words)) == fewest


@given(st.dictionaries(st.sampled_from(["real", "positive", "nonnegative", "nonzero", "zero", "integer", "rational",
                                        "even", "odd", "prime", "irrational", "imaginary", "complex", "finite"]),
                       st.booleans(), max_size=4))  # fmt: skip
def test_the_fewest_words_say_the_same(words):
    try:
        symbol = sp.Symbol("x", **words)
    except InconsistentAssumptions:
        reject()
    assert sp.Symbol("x", **declared(symbol)) == symbol


def test_a_claim_says_the_same_whichever_of_two_equal_symbols_comes_back_from_a_cache():
    long, short = sp.Symbol("a", real=True, positive=True), sp.Symbol("a", positive=True)
    assert long == short
    assert digest(long + 1) == digest(short + 1)
