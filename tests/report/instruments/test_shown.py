"""What the pages, the Markdown and the JSON say of instruments before anything is moved."""

import json
import re
from dataclasses import replace
from math import exp

import pytest

from ptproof.report.exported import exported, exported_json, schema
from ptproof.report.instruments.view import decided, evaluated, shown, superscript
from ptproof.report.markdown import markdown_page
from ptproof.report.site import single_page, site, site_files


@pytest.fixture(scope="module")
def files(tooled_report):
    return {name: content.decode() for name, content in site_files(site(tooled_report)).items()}


@pytest.fixture(scope="module")
def data(tooled_report):
    return json.loads(exported_json(site(tooled_report)))


def test_the_page_is_linked_from_the_bar_and_from_the_first_screen(files):
    assert files["index.html"].count('href="instruments.html#instruments"') == 2


def test_a_report_without_instruments_has_no_such_page(tooled_report):
    files = site_files(site(replace(tooled_report, instruments=())))
    assert not any("instruments" in name for name in files)
    assert b"#instruments" not in files["index.html"]


def test_the_page_has_the_values_at_the_first_positions(files):
    found = re.findall(r"<output[^>]*>([^<]*)</output>", files["instruments.html"])
    assert found == [shown(3.5 ** (1 / 2)), shown(exp(-1.5)), "2", "0.4", "holds"]


def test_each_number_leads_to_its_claim_and_says_its_verdict(files):
    assert 'href="section-1-all.html#c-bound"' in files["instruments.html"]
    assert files["instruments.html"].count("fully proved") > 4


def test_what_is_not_proved_is_said_loudly(files):
    loud = re.findall(r"What moves here is not proved: this claim is ([a-z]+)", files["instruments.html"])
    assert loud == ["undecided"]


def test_the_page_needs_no_network(files):
    assert re.findall(r'(?:src|href)="(?:https?:)?//[^"]*"', files["instruments.html"]) == []
    assert "import(" not in files["instruments.js"]


def test_text_is_escaped(files):
    assert "Bounds &lt;of&gt; V" in files["instruments.html"]
    assert "drift &lt;gain&gt; &amp; more, in m^(2κ)" in files["instruments.html"]


def test_sliders_are_labelled_and_native(files):
    page = files["instruments.html"]
    labelled = set(re.findall(r'<label for="([^"]+)"', page))
    assert labelled == set(re.findall(r'<input type="range" id="([^"]+)"', page))
    assert len(labelled) == 6


def test_the_command_has_the_first_positions(files):
    assert "<pre><code>echo 3.5 1 1 3</code></pre>" in files["instruments.html"]


def test_one_page_has_it_all(tooled_report):
    page = single_page(tooled_report)
    assert "const INSTRUMENTS" in page
    assert 'id="i-circle"' in page
    assert '<script src="instruments.js">' not in page


def test_the_markdown_has_a_line_for_each(tooled_report):
    lines = [line for line in markdown_page(tooled_report).split("\n") if '<a id="i-' in line]
    assert len(lines) == 2
    assert "The power: **1.87083** 1/s" in lines[0]
    assert "Undecided: **0.4** ([?" in lines[0]


def test_the_json_is_of_its_form(data):
    jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not installed; it comes with the extra 'dev'")
    assert [*jsonschema.Draft202012Validator(schema()).iter_errors(data)] == []
    data["instruments"][0]["sliders"][0]["start"] = "1"
    assert len([*jsonschema.Draft202012Validator(schema()).iter_errors(data)]) == 1


def test_the_json_has_expressions_and_values(tooled_report):
    first, second = exported(site(tooled_report))["instruments"]
    assert [item["expression"] for item in first["values"]] == [
        "k**(1/(kappa - 1))", "V0*exp(2*E - k)", "2*E", "1/(-E + k)", "k > 2*E",
    ]  # fmt: skip
    assert first["values"][4]["value"] is True
    assert second["pictures"][0]["expressions"] == ["-E*y - k*x", "E*x - k*y", "-k*z", "-k*w"]


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (float("nan"), "not defined"),
        (float("inf"), "∞"),
        (-float("inf"), "−∞"),
        (-1234567.0, "−1234570"),
        (0.1, "0.1"),
        (2.0, "2"),
        (0.00001, "0.00001"),
        (-1.5e-7, "−1.5·10^−7"),
        (3e30, "3·10^30"),
        (0.0, "0"),
    ],
)
def test_numbers_in_words(value, words):
    assert shown(value) == words


def test_what_has_no_real_value_is_not_defined(tools):
    condition, values = tools[0].parts[4], tools[0].start
    (quantity,) = (part for part in tools[0].parts if part.title == "Undecided")
    k, E = tools[0].symbols[:2]
    assert decided(condition.value, values) is True
    assert str(evaluated(quantity.value, {**values, E: values[k]})) == "nan"
    assert decided(quantity.value > 0, {**values, E: values[k]}) is None


@pytest.mark.parametrize(
    ("unit", "shown"),
    [
        ("m^2/s", "m²/s"),
        ("m^{2κ}", "m^(2κ)"),
        ("s^{-1}", "s⁻¹"),
        ("[F]^{1/2}", "[F]¹ᐟ²"),
        ("[F]^{1/2κ}/s", "[F]^(1/2κ)/s"),
    ],
)
def test_a_unit_is_raised_where_its_letters_can_be(unit, shown):
    assert superscript(unit) == shown
