"""What the pages know of letters: how they are spelled in a formula, and what they stand for, or do not."""

import json
import re

import pytest

from ptproof.report.formula import element
from ptproof.report.letters import Letter, spelled
from ptproof.report.search import meanings
from ptproof.report.site import site, site_files


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (r"\bar x", r"\bar{x}", True), ("a_1", "a_{1}", True), (r"\|E\|", r"\left\lVert E\right\rVert", True),
        (r"\tilde\tau", r"\tilde{\tau}", True), ("x^*_1", "x_1^*", True),
        ("a_1", "a_2", False), ("a_1", "a^1", False), (r"\bar x", r"\hat x", False), ("a", "a_1", False),
    ],
)  # fmt: skip
def test_a_letter_has_one_spelling_however_it_is_written(one, other, same):
    assert (spelled(one) == spelled(other)) is same


def test_a_letter_stands_in_a_formula_by_its_spelling():
    inside = [node for node in element(r"\frac{\bar x_1}{2}").iter() if node.tag == "msub"]
    assert len(inside) == 1
    assert spelled(r"\bar{x}_1") == "msub(mover(x,¯),1)"


def table(report):
    return json.loads(meanings(report).removeprefix("window.PTPROOF_LETTERS = ").rstrip(";\n"))


def test_the_table_has_meaning_and_unit_of_each_letter(report):
    found = table(report)
    assert found["mover(x,¯)"][1:] == ["place [m]"]
    assert found["k"][1:] == ["gain | rate [1/s]"]
    assert "<math" in found["k"][0]


def test_two_letters_of_one_glyph_are_both_named(report):
    from dataclasses import replace

    found = table(replace(report, letters=(Letter("k", "s", "one"), Letter("k", "1", "two"))))
    assert found["k"][1:] == ["one [s]", "two"]


def test_a_page_and_the_single_page_have_them(report):
    assert b"PTPROOF_LETTERS" in site_files(site(report))["letters.js"]
    from ptproof.report.site import single_page

    assert "window.PTPROOF_LETTERS = {" in single_page(report)


def test_what_stands_for_something_else_in_a_claim_is_not_explained(report):
    from dataclasses import replace

    first = report.sections[0]
    claims = (replace(first.claims[0], unlike=("k", "msub(a,1)")), replace(first.claims[1], unlike=()))
    page = single(replace(report, sections=(replace(first, claims=claims),)))
    found = dict(
        re.findall(r'<article class="claim[^"]*" id="([^"]*)" data-status="[^"]*"( data-unlike="[^"]*")?>', page)
    )
    assert found[claims[0].ref.anchor] == ' data-unlike="k msub(a,1)"'
    assert found[claims[1].ref.anchor] == ""


def single(report):
    from ptproof.report.site import single_page

    return single_page(report)


def test_a_letter_that_is_bound_or_another_is_found(report):
    import sympy as sp

    from ptproof.proof.statement import Exists, ForAll, eq, ge
    from ptproof.report.typeset import Typeset
    from ptproof.report.views import _Composer

    k, other, free = sp.Symbol("k", positive=True), sp.Symbol("k", real=True), sp.Symbol("x", real=True)
    composer = _Composer({}, {}, Typeset({k: "k", free: "x"}))
    for statements, found in [
        ([eq(k, free)], ()), ([eq(other, free)], ("k",)), ([eq(sp.Integral(k, (k, 0, 1)), free)], ("k",)),
        ([eq(free, 1), ForAll((k,), ge(k, 0))], ("k",)), ([Exists((k,), (ge(k, free),))], ("k",)),
        ([eq(sp.Function("k")(free), 1)], ("k",)), ([eq(k, 1), ge(free, k)], ()),
    ]:  # fmt: skip
        assert composer.unlike(statements) == found
