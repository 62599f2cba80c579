"""The pages of a small derivation with every kind of statement and verdict."""

import re
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

from ptproof.errors import InputError
from ptproof.report.compose import compose
from ptproof.report.content import Figure, Table
from ptproof.report.graph import graph_svg, layout
from ptproof.report.markdown import markdown_page
from ptproof.report.pages import report_files
from ptproof.report.site import single_page

VOID = {"meta", "input", "img", "br", "hr", "link"}


class Balance(HTMLParser):
    """Follows the tags: what is open, which ids and links there are."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.wrong = [], [], [], []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        self.links += [attributes[name] for name in ("href", "src") if name in attributes]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))


@pytest.fixture(scope="module")
def page(report):
    return single_page(report)


@pytest.fixture(scope="module")
def text(report):
    return markdown_page(report)


@pytest.fixture(scope="module")
def read(page):
    reader = Balance()
    reader.feed(page)
    return reader


def entry(page, id):
    """The article of one claim."""
    return re.search(rf'<article class="claim[^"]*" id="{id}".*?</article>', page, re.DOTALL).group()


def test_html_is_well_formed(read):
    assert (read.wrong, read.open) == ([], [])


def test_ids_are_unique(read):
    assert len(read.ids) == len(set(read.ids))


def test_every_link_stays_on_the_page_and_arrives(read):
    outside = [link for link in read.links if not link.startswith(("#", "data:"))]
    assert outside == []
    assert {link[1:] for link in read.links if link.startswith("#")} <= set(read.ids)


def test_nothing_is_loaded(page):
    assert not re.search(r"url\(|@import|<script src|<link", page)


def test_every_claim_and_definition_appears(derivation, page, text):
    for item in (*derivation.claims, *derivation.definitions):
        assert f">{item.id}</a>" in page
        assert f"`{item.id}`" in text


def test_titles_are_escaped(page, text):
    assert "<h1>A sample &lt;derivation&gt; &amp; its $x$</h1>" in page
    assert r"# A sample \<derivation\> & its \$x\$" in text


def test_a_refuted_claim_shows_its_witness(page, text):
    for content in (entry(page, "c-a-lonely"), page[page.index('id="errata"') : page.index('id="graph"')]):
        assert 'class="witness"' in content
    witness = re.search(r"^\*\*Witness\.\*\* .*$", text[text.index("### ✗ Wrong and not corrected") :], re.MULTILINE)
    assert r"\Vert \nabla F\Vert  = 1" in witness.group()


def test_the_witness_of_the_engine_is_set_in_the_letters_of_the_paper(report):
    printed = next(claim for claim in report.claims if claim.ref.id == "a/printed")
    assert any(value.latex.startswith(r"\bar x = ") for value in printed.witness.values)
    assert printed.witness.left.latex != printed.witness.right.latex


def test_errata_come_before_the_claims_and_name_the_correction(page, text):
    assert page.index('id="errata"') < page.index('id="s-1"')
    assert text.index("## Errata") < text.index('<a id="s-1">')
    row = next(line for line in text.split("\n") if line.startswith("| misprint | `eq:sum`"))
    assert "(#c-a-corrected)" in row
    assert "refuted" in row
    assert "fully proved" in row


def test_errata_say_how_grave_they_are_and_what_survives(page, text):
    errata = page[page.index('id="errata"') : page.index('id="graph"')]
    assert errata.count("Nothing uses it &amp; the &lt;theorem&gt; stands.") == 2
    assert errata.count("The mixed term 2kx | is left out.") == 2
    row = next(line for line in text.split("\n") if line.startswith("| misprint |"))
    assert r"The mixed term 2kx \| is left out." in row
    assert "**Misprint.** The mixed term" in text


def test_errata_are_ordered_by_weight_and_those_without_a_grade_come_last(report):
    assert [item.rank for item in report.errata] == sorted(item.rank for item in report.errata)
    assert [item.printed.erratum is None for item in report.errata] == [False, True]


def test_errata_mark_what_differs(page):
    errata = page[page.index('id="errata"') : page.index('id="graph"')]
    assert 'class="differs"' in errata
    assert 'class="differs"' not in page[page.index('id="graph"') :]


def test_errata_bring_the_correction_as_latex_and_what_hangs_on_it(page):
    errata = page[page.index('id="errata"') : page.index('id="graph"')]
    assert r"<pre><code>\left(k + \bar x\right)^{2} = " in errata
    assert "A theorem</a>" in errata[errata.index("What hangs on it") :]


def test_errata_state_the_assumptions(page, text):
    errata = page[page.index('id="errata"') : page.index('id="graph"')]
    assert errata.count("<dt>for all</dt>") == 4
    assert errata.count("<dt>given</dt>") == 1
    assert "- given" in text[text.index("## Errata") : text.index("## Graph")]


def test_errata_without_correction_are_listed(report, page):
    assert [(item.printed.ref.id, [c.ref.id for c in item.corrections]) for item in report.errata] == [
        ("a/printed", ["a/corrected"]),
        ("a/lonely", []),
    ]
    assert "no correction is recorded" in page


def test_what_the_paper_does_not_print_is_no_erratum(report, page, text):
    assert [item.printed.ref.id for item in report.besides] == ["a/own-mistake"]
    for content in (page, text):
        table, besides = content[: content.index("Refuted besides")], content[content.index("Refuted besides") :]
        assert "Wrong, and not in the paper" not in table[table.index("what survives") :]
        assert "Wrong, and not in the paper" in besides[: besides.index("Graph of the claims")]


def test_fully_proved_and_proved_modulo_are_told_apart(report):
    words = {claim.ref.id: claim.status.word for claim in report.claims}
    assert words["a/corrected"] == "fully proved"
    assert words["b/modulo"] == "proved, modulo citations"
    assert words["b/on-open"] == "proved, modulo open claims"


def test_a_conditional_claim_says_what_it_rests_on(page):
    assert re.search(r"rests on</dt><dd><a[^>]*#c-b-theorem", entry(page, "c-b-modulo"))


def test_what_is_cited_is_listed_with_source_and_hypotheses(page):
    cited = page[page.index('id="cited"') :]
    assert "A Book, Theorem 4.9" in cited
    assert "#c-a-corrected" in cited[: cited.index("</section>")]


def test_unexpected_claims_are_named_at_the_top(page, text):
    assert page.index("not as expected") < page.index('id="errata"')
    assert "Recorded wrongly: expected refuted, came out fully proved" in text


def test_evidence_is_shown_without_folders_and_addresses(page, text):
    for content in (page, text):
        assert "place.py" in content
        assert "/home/somebody" not in content
        assert "7f00deadbeef" not in content


def test_seconds_do_not_enter(derivation, verification, report):
    slower = replace(verification, seconds=99.0, results=tuple(
        replace(result, evidence=tuple(replace(item, seconds=77.7) for item in result.evidence))
        for result in verification.results
    ))  # fmt: skip
    assert "77.7" not in single_page(compose(slower, derivation))


def test_what_a_quantifier_binds_is_not_free(report):
    undecided = next(claim for claim in report.claims if claim.ref.id == "b/open")
    assert undecided.domain == ()


def test_a_reader_is_told_where_both_sides_are_one_expression(report):
    assert [claim.ref.id for claim in report.claims if claim.same] == ["b/wrong-expectation"]


def test_notation_is_listed(page, text):
    assert "gain | rate" in page
    assert r"gain \| rate" in text


def test_figures_are_inside_the_page_and_beside_the_markdown(page, text, report):
    assert 'src="data:image/svg+xml;base64,' in page
    assert "![path](figures/path.svg)" in text
    assert "figures/path.svg" in report_files(report)


def test_appendix_and_notes_and_versions(page, text):
    for content in (page, text):
        for words in ("Times", "1.5", "One thing could not be drawn.", "sympy 1.14.0"):
            assert words in content


def test_two_runs_give_the_same_bytes(derivation, verification, report):
    again = compose(
        verification, derivation, title=report.title, notation=None, versions=report.versions,
        figures=report.figures, appendix=report.appendix,
    )  # fmt: skip
    once = compose(
        verification, derivation, title=report.title, notation=None, versions=report.versions,
        figures=report.figures, appendix=report.appendix,
    )  # fmt: skip
    assert report_files(again) == report_files(once)


def test_markdown_math_is_balanced(text):
    outside = re.sub(r"```math\n.*?\n```", "", text, flags=re.DOTALL)
    assert "```" not in outside
    assert outside.count("$`") == outside.count("`$") > 10
    assert "$" not in re.sub(r"\$`[^`]*`\$|\\\$", "", outside)


def test_markdown_tables_have_one_width(text):
    from markdown_it import MarkdownIt

    tables = 0
    width = cells = 0
    for token in MarkdownIt("gfm-like", {"linkify": False}).parse(text):
        if token.type == "thead_open":
            tables += 1
            width = 0
        elif token.type == "tr_open":
            cells = 0
        elif token.type in ("th_open", "td_open"):
            cells += 1
        elif token.type == "tr_close":
            width = width or cells
            assert cells == width
    assert tables == text.count("\n| ---")


def test_every_markdown_link_arrives(text):
    targets = set(re.findall(r'<a id="([^"]+)"', text))
    headings = {
        re.sub(r"[^a-z ]", "", line.lower()).strip().replace(" ", "-")
        for line in text.split("\n")
        if line.startswith("## ")
    }
    assert set(re.findall(r"\]\(#([^)]+)\)", text)) <= targets | headings


def test_the_graph_has_every_claim_and_edge(report, derivation):
    plan = layout(report.nodes())
    assert {box.node.id for box in plan.boxes} == {claim.id for claim in derivation.claims}
    used = {(item.id, claim.id) for claim in derivation.claims for item in claim.uses}
    assert {(edge.source, edge.target) for edge in plan.edges if not edge.correction} == used
    assert [(edge.source, edge.target) for edge in plan.edges if edge.correction] == [("a/printed", "a/corrected")]


def test_no_boxes_overlap(report):
    places = [(box.x, box.y) for box in layout(report.nodes()).boxes]
    assert len(places) == len(set(places))


def test_within_a_section_a_claim_stands_below_what_it_uses(report):
    boxes = {box.node.id: box for box in layout(report.nodes()).boxes}
    for box in boxes.values():
        for used in box.node.uses:
            if boxes[used].node.section == box.node.section:
                assert boxes[used].y < box.y


def test_the_graph_is_xml_and_links_to_the_page(report):
    root = ElementTree.fromstring(graph_svg(report.nodes(), standalone=True, page="index.html"))
    links = [node.get("href") for node in root.iter("{http://www.w3.org/2000/svg}a")]
    assert len(links) == len(report.claims)
    assert all(link.startswith("index.html#c-") for link in links)


def test_the_graph_colours_verdicts_differently(report):
    svg = graph_svg(report.nodes(), standalone=True)
    for key in ("full", "modulo", "open", "refuted", "undecided", "cited", "observed"):
        assert f'class="node g-{key}"' in svg


def test_ids_that_become_one_anchor_are_told_apart(derivation, verification):
    first, second, *_ = verification.results
    same = replace(second, claim=replace(second.claim, id="a-printed"))
    anchors = [claim.ref.anchor for claim in compose(replace(verification, results=(first, same)), derivation).claims]
    assert len(set(anchors)) == 2


@pytest.mark.parametrize(("name", "content"), [("../up", b"<svg/>"), ("", b"<svg/>"), ("ok", b"text")])
def test_bad_figures(name, content):
    with pytest.raises(InputError):
        Figure(name, "", content)


def test_sections_stand_in_the_order_of_their_numbers_and_others_behind(derivation, verification):
    titles = ["Beyond", "10 Ten", "2.1 Part", "2 Two", "Again"]
    results = tuple(
        replace(result, claim=replace(result.claim, section=title))
        for result, title in zip(verification.results, titles, strict=False)
    )
    found = compose(replace(verification, results=results), replace(derivation, definitions=()))
    assert [section.title for section in found.sections] == ["2 Two", "2.1 Part", "10 Ten", "Beyond", "Again"]


def test_bad_tables():
    with pytest.raises(InputError, match="cells"):
        Table("t", "", ("a", "b"), (("1",),))
