"""Nothing on the cards of the papers is called by the name that the program has for it."""

from __future__ import annotations

import re
from functools import lru_cache

import pytest
import sympy as sp

from ptproof.proof.load import Derivation, load
from ptproof.proof.shipped import shipped
from ptproof.proof.statement import expressions_of, undefined_functions
from ptproof.report.formula import latex
from ptproof.report.letters import notation_of
from ptproof.report.prose import to_html, worded

PAPERS = ["pt_seeker", "newton_seeker"]
# A name with an underscore that nothing has set low, a word in italics, an index that is a word in italics.
RAW_TEXT = re.compile(r"(?<![\w./:-])[^\W\d_]{1,3}_[^\W_]")
RAW_LATEX = re.compile(r"(?<![\\a-zA-Z{])[a-z]{3,}|_\{(?![i-q]+\})[a-zA-Z]{3,}|(?:alpha|kappa|tau|mu|nu|omega)\d|\\_")
# Upright words are meant where the notation lists them, and as indices.
UPRIGHT = {
    True: r"\\(?:mathrm|text|operatorname)\{[^{}]*\}|\\[a-zA-Z]+",
    False: r"(?<=_\{)\\mathrm\{[^{}]*\}|\\(?:mathrm|operatorname)\{|\\[a-zA-Z]+",
}
WORDS = re.compile(r"\\(?:[a-zA-Z]+|[^_])|\{matrix\}|\b(?:array|cases|bmatrix|otherwise|for|and)\b")


@lru_cache
def opened(name: str) -> Derivation:
    return load([shipped() / name])


def raw_letters(name: str, extra: tuple[sp.Symbol, ...] = ()) -> set[str]:
    derivation = opened(name)
    glyphs = notation_of(derivation).glyphs
    said = [part for claim in derivation.claims for part in (claim.statement, *claim.assumptions)]
    said += [item.statement for item in derivation.definitions]
    symbols = {symbol for side in expressions_of(said) for symbol in side.atoms(sp.Symbol)}
    functions = {applied.func for applied in undefined_functions(said)}
    shown = [(latex(symbol, glyphs), symbol in glyphs) for symbol in (*symbols, *extra)]
    shown += [(latex(function(sp.Symbol("x")), glyphs), False) for function in functions]
    return {text for text, listed in shown if RAW_LATEX.search(re.sub(UPRIGHT[listed], " ", text))}


def texts(derivation: Derivation) -> list[str]:
    """What is set as plain text on the cards, without formulas and code."""
    found = [worded(item.title) for item in (*derivation.claims, *derivation.definitions)]
    found += [to_html(item.prose) for item in (*derivation.claims, *derivation.definitions)]
    found += [worded(text) for claim in derivation.claims if claim.erratum
              for text in (claim.erratum.wrong, claim.erratum.survives)]  # fmt: skip
    return [re.sub(r"<math.*?</math>|<code>.*?</code>|<[^>]*>", " ", str(text), flags=re.DOTALL) for text in found]


@pytest.mark.parametrize("name", PAPERS)
def test_letters_and_functions_are_set_as_letters(name: str) -> None:
    assert raw_letters(name) == set()


@pytest.mark.parametrize("raw", ["deficit_", "c_kappa1a", "some_thing_more"])
def test_a_raw_name_would_be_found(raw: str) -> None:
    assert raw_letters("newton_seeker", (sp.Symbol(raw),)) != set()


@pytest.mark.parametrize("name", PAPERS)
def test_indices_in_titles_and_prose_are_set_low(name: str) -> None:
    assert [text for text in texts(opened(name)) if RAW_TEXT.search(text)] == []


@pytest.mark.parametrize("raw", ["the period T_(f) and x_1_2", "μT_ff_x"])
def test_a_raw_index_would_be_found(raw: str) -> None:
    assert RAW_TEXT.search(raw.replace("(", ""))
