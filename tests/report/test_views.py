"""What is said of claims before it is known what became of printed sides, and after."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ptproof.report.compose import compose
from ptproof.report.letters import notation_of, spelled
from ptproof.report.read import ReadSide
from ptproof.report.site import cards_of, site
from ptproof.report.typeset import Typeset
from ptproof.report.views import views_of


@pytest.fixture(scope="module")
def views(derivation, verification):
    return views_of(verification, derivation, Typeset(notation_of(derivation).glyphs))


def test_what_was_begun_before_comes_to_the_same(derivation, verification, views):
    notation = notation_of(derivation)
    id = next(iter(views.claims))
    read = {id: ReadSide("different", ("1",), "another sign")}
    begun = compose(verification, derivation, notation=notation, read=read, views=views)
    assert begun == compose(verification, derivation, notation=notation, read=read)
    assert [claim.ref.id for claim in begun.claims if claim.read is not None] == [id]
    assert all(view.read is None for view in views.claims.values())


def test_letters_that_stand_for_something_else_where_it_is_printed_are_named(derivation, views):
    glyph = next(iter(notation_of(derivation).glyphs.values()))
    view = next(iter(views.claims.values()))
    side = ReadSide("equal", ("1",), "", apart=(glyph, "of no letter"))
    assert views.beside(view, side).unlike == tuple(sorted({*view.unlike, spelled(glyph)}))
    assert views.beside(view, None) is view


def test_cards_that_are_set_before_there_are_figures_are_those_of_the_pages(report):
    cards = cards_of(replace(report, figures=(), appendix=()))
    assert site(report, cards) == site(report)
    assert cards == cards_of(report)
