"""What differs between a printed formula and its correction is marked, and nothing else."""

import re

import pytest

from ptproof.report.difference import marked
from ptproof.report.formula import Line


def differing(text):
    return re.findall(r'class="differs"[^>]*>([^<]*)<', text)


@pytest.mark.parametrize(
    ("printed", "corrected", "first", "second"),
    [
        (r"x + 2 y = z", r"x + 3 y = z", ["2"], ["3"]),
        (r"x + y = z", r"x - y = z", ["+"], ["−"]),
        (r"\lambda \approx 4.19", r"\lambda \approx 4.39", ["4.19"], ["4.39"]),
        (r"a x + b = c", r"a x + b = c", [], []),
        (r"a x + b = c", r"a x + b + d = c", [], ["+", "d"]),
        (r"\frac{f}{1 + s} + a b c", r"\frac{f}{1 + s} + a b", ["c"], []),
    ],
)  # fmt: skip
def test_what_differs_is_marked_on_both_sides(printed, corrected, first, second):
    ours, theirs = marked([Line(printed)], [Line(corrected)])
    assert differing(ours[0]) == first
    assert [sign.replace("-", "−") for sign in differing(theirs[0])] == second


def test_the_same_letter_in_another_place_differs():
    ours, theirs = marked([Line("a + b + c + x^{q} = y")], [Line("a + b + c + x q = y")])
    assert differing(ours[0]) == ["x", "q"]
    assert differing(theirs[0]) == ["x", "q"]


def test_lines_are_compared_across_a_break():
    ours, theirs = marked([Line("a + b"), Line("= c + d", 1)], [Line("a + b = c + e")])
    assert [differing(line) for line in ours] == [[], ["d"]]
    assert differing(theirs[0]) == ["e"]


def test_formulas_that_have_little_in_common_are_left_as_they_are():
    ours, theirs = marked([Line("a = b")], [Line(r"\int_0^1 f(s) ds < 4 \cdot \pi")])
    assert not differing(ours[0]) + differing(theirs[0])


def test_a_long_formula_with_many_differences_is_left_as_it_is():
    """Two in five symbols differ: marked in a short formula, and not in one of many lines."""
    assert differing(marked([Line("a_{1} a x + c")], [Line("b_{1} b x + c")])[0][0]) == ["a", "a"]
    first, second = (" + ".join(f"{letter}_{{{i}}} {letter} x" for i in range(40)) for letter in "ab")
    assert not differing(marked([Line(first)], [Line(second)])[0][0])


def test_a_formula_that_cannot_be_converted_is_shown_as_its_latex():
    ours, theirs = marked([Line(r"x^a^b")], [Line("b")])
    assert ours == ("<code>x^a^b</code>",)
    assert theirs[0].startswith("<math")
