"""Statements that are set once, and in parts by several processes."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest
import sympy as sp

from ptproof.proof import load
from ptproof.proof.statement import eq
from ptproof.report.formula import _conversion, element, knows, markup, statement_lines, width
from ptproof.report.letters import notation_of
from ptproof.report.printer import latex
from ptproof.report.typeset import Typeset, set_part

x, y = sp.symbols("x y", positive=True)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_the_parts_together_are_the_whole(count: int, sample: Path) -> None:
    derivation = load([sample])
    glyphs = notation_of(derivation).glyphs
    joined = Typeset(glyphs)
    for place in range(count):
        (found,), formulas = set_part([[str(sample)]], place, count)
        joined.take(derivation, place, count, found)
        shown = {line.latex for lines in found for line in lines}
        assert {source: markup(formulas[source], source) for source in shown} == {
            source: markup(_conversion(source), source) for source in shown
        }
    for item in (*derivation.claims, *derivation.definitions):
        for statement in (item.statement, *getattr(item, "assumptions", ())):
            assert statement in joined._set
            assert joined.lines(statement) == statement_lines(statement, glyphs)


def test_a_formula_that_another_process_has_converted_is_taken_from_it() -> None:
    there = ElementTree.Element("math")
    knows({r"\mystery": there, r"\unknown": None})
    found = element(r"\mystery")
    assert found is not None
    assert found is not there
    assert found.get("display") == "inline"
    assert element(r"\unknown") is None
    assert there.attrib == {}


def test_a_part_of_another_length_is_not_taken(sample: Path) -> None:
    derivation = load([sample])
    with pytest.raises(ValueError, match="argument"):
        Typeset({}).take(derivation, 0, 2, [])


def test_what_is_set_in_other_letters_or_with_dots_is_another_thing() -> None:
    assert latex(x * y, {x: "a", y: "b"}) == "a b"
    assert latex(x * y, {x: "c", y: "b"}) == "c b"
    assert latex(x * y, {x: "a", y: "b"}, dots=True) == r"a \cdot b"
    assert latex(x * y, {x: "a", y: "b"}) == "a b"
    assert latex(sp.Symbol("x"), {x: "a"}) == "x"


def test_a_broken_sum_fills_its_lines() -> None:
    total = sp.Add(*(sp.sin(n * x) ** n / (y + n) for n in range(1, 30)))
    lines = statement_lines(eq(x, total), {})
    rest = [line.latex for line in lines[1:]]
    assert len(rest) > 3
    assert all(width(line) <= 86 for line in rest)  # the first of them begins with the sign
    for line, following in pairwise(rest):
        first = following.split(" + ")[0].removeprefix("+ ")
        assert width(line) + width(f"+ {first}") > 80
