"""Docstrings as HTML and Markdown."""

import pytest

from ptproof.report.prose import code, display_math, escape, hosted, inline_math, to_html, to_markdown, worded


def test_paragraphs_and_items():
    assert (
        to_html("One\ntwo.\n\n- a\n- b\n\nEnd.") == "<p>One two.</p>\n<ul>\n<li>a</li>\n<li>b</li>\n</ul>\n<p>End.</p>"
    )


def test_html_is_escaped():
    assert to_html("a < b & `<i>`") == "<p>a &lt; b &amp; <code>&lt;i&gt;</code></p>"


def test_formulas_become_mathml():
    assert "<msup>" in to_html("the square $x^2$")


def test_roles_are_shown_as_code():
    assert to_html(":func:`~ptproof.transforms.clocks.clock.dilate`") == "<p><code>dilate</code></p>"


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("[F]/m^(2κ)", "[F]/m<sup>2κ</sup>"),
        ("e^(−kT(2/ν_min − 1))", "e<sup>−kT(2/ν<sub>min</sub> − 1)</sup>"),
        ("x^(a^(b + 1))", "x<sup>a<sup>b + 1</sup></sup>"),
        ("|e^d̂ − 1| < F^*", "|e<sup>d̂</sup> − 1| &lt; F<sup>*</sup>"),
        ("x_d^2", "x<sub>d</sub><sup>2</sup>"),
        ("e^, 2^(a and (a^ b)", "e^, 2^(a and (a^ b)"),
    ],
)
def test_exponents_stand_high_and_indices_low(text, shown):
    assert worded(text) == shown


@pytest.mark.parametrize("text", ["a*b*c", "x_1 and x_2", "[a](b)", "<b>", "# no", "a | b", "$5", "`", "~~x~~"])
def test_no_character_means_anything_to_markdown(text):
    from markdown_it import MarkdownIt

    tokens = MarkdownIt("gfm-like", {"linkify": False}).parse(escape(text))
    assert [token.type for token in tokens] == ["paragraph_open", "inline", "paragraph_close"]
    assert "".join(child.content for child in tokens[1].children) == text


def test_a_line_that_looks_like_a_list_is_none():
    assert escape("1. first") == "1\\. first"
    assert escape("- first") == "\\- first"


def test_markdown_items():
    assert to_markdown("One.\n\n- a\n- b") == "One.\n\n- a\n- b"


def test_code_with_backticks():
    assert code("a`b") == "`` a`b ``"
    assert code("a|b", cell=True) == "`a\\|b`"


def test_math_has_no_bars_and_no_refused_command():
    assert hosted(r"\operatorname{sign}|x| \|y\| \\|z|") == r"\mathrm{sign}\vert x\vert  \Vert y\Vert  \\\vert z\vert "


def test_inline_and_display_math():
    assert inline_math("x_1") == "$`x_1`$"
    assert display_math(["x"]) == "```math\nx\n```"
    assert display_math(["& x", "& y"]).count("\\\\") == 1


def test_what_stands_inside_a_line_keeps_its_spaces():
    assert to_markdown("Repeat: `ptproof report`, or take $x$ as given.") == (
        "Repeat: `ptproof report`, or take $`x`$ as given."
    )


@pytest.mark.parametrize(
    ("text", "html", "markdown"),
    [
        ("1. a\n2. b", "<ol>\n<li>a</li>\n<li>b</li>\n</ol>", "1. a\n2. b"),
        ("- a\n  goes on\n- b", "<ul>\n<li>a goes on</li>\n<li>b</li>\n</ul>", "- a goes on\n- b"),
        ("``a`b`` costs \\$5", "<p><code>a`b</code> costs $5</p>", "`` a`b `` costs \\$5"),
        ("F(x*) and a*b*c", "<p>F(x*) and a*b*c</p>", "F(x\\*) and a\\*b\\*c"),
    ],
)
def test_markdown_is_read_as_it_is_meant(text, html, markdown):
    assert to_html(text) == html
    assert to_markdown(text) == markdown


def test_a_formula_may_stand_in_lines_of_its_own():
    assert 'display="block"' in to_html("So\n\n$$\nx^2\n$$\n")
    assert to_markdown("So\n\n$$\nx^2\n$$\n") == "So\n\n```math\nx^2\n```"


def test_a_formula_may_be_broken_across_lines():
    assert to_markdown("the square $x +\n1$ of it") == "the square $`x + 1`$ of it"
