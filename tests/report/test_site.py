"""The report as many pages: their size, the links between them, what is found by searching, and the picture."""

import json
import re
from collections import Counter
from dataclasses import replace
from urllib.parse import unquote

import pytest

from ptproof.report import status
from ptproof.report.headline import headline, plain
from ptproof.report.model import Ref, Section
from ptproof.report.pages import all_files
from ptproof.report.picture import heading, picture
from ptproof.report.read import ReadSide
from ptproof.report.site import packed, site, site_files, slug

HOSTILE = """</script><script>alert(1)</script> "quoted" 'single' & <b> ${x}` \u2028"""
LEAD = re.compile(r'<p class="lead">(.*?)</p>', re.DOTALL)


def ids(page):
    return set(re.findall(r'<[a-zA-Z][^<>]*? id="([^"]+)"', page))


def links(page):
    return re.findall(r'(?:href|src)="([^"]+)"', page)


def texts(files):
    return {name: content.decode() for name, content in files.items() if name.endswith((".html", ".svg"))}


def lost(files):
    """The links of all pages that lead nowhere."""
    pages = texts(files)
    known = {name: ids(page) for name, page in pages.items()}
    found = []
    for name, page in pages.items():
        folder = name.rpartition("/")[0]
        for link in links(page):
            if link.startswith("data:"):
                continue
            file, _, anchor = link.partition("#")
            parts = [*folder.split("/")] if folder else []
            for part in unquote(file).split("/"):
                if part == "..":
                    parts.pop()
                elif part:
                    parts.append(part)
            target = "/".join(parts) if file else name
            if target not in files or (anchor and anchor not in known[target]):
                found.append((name, link))
    return found


def index(files, folder=""):
    script = files[f"{folder}search.js"].decode()
    return json.loads(script.removeprefix("window.PTPROOF = ").rstrip(";\n"))


@pytest.fixture(scope="module")
def files(report):
    return all_files({"sample": report}, single=True)


@pytest.fixture(scope="module")
def large(report):
    """700 claims in 40 sections, of which one has a third of all."""
    kinds, sections, number = report.claims, [], 0
    for place in range(40):
        inside = []
        for _ in range(232 if place == 3 else 12):
            model = kinds[number % len(kinds)]
            ref = Ref(f"s{place}/c{number}", f"c-s{place}-c{number}", f"Claim {number}", model.ref.status)
            lines = model.lines * 2 if model.lines else kinds[0].lines
            uses = (inside[-1].ref,) if inside else ((sections[-1].claims[0].ref,) if sections else ())
            inside.append(replace(model, ref=ref, lines=lines, uses=uses, used_by=(), rests_on=(), corrects=None,
                                  corrected_by=()))  # fmt: skip
            number += 1
        sections.append(Section(f"{place + 1} Step {place + 1}", f"s-{place + 1}", (), tuple(inside), ()))
    return replace(report, sections=tuple(sections), errata=(), besides=(), cited=(), unexpected=(), labels=(),
                   figures=(), total=number)  # fmt: skip


@pytest.fixture(scope="module")
def many(large):
    return site_files(site(large))


def test_every_link_lands(files):
    assert lost(files) == []


def test_every_link_of_many_pages_lands(many):
    assert lost(many) == []


def test_a_link_that_leads_nowhere_is_found(files):
    page = files["index.html"].replace(b"#claims-full", b"#claims-none")
    assert ("index.html", "statements.html#claims-none") in lost({**files, "index.html": page})


def test_no_page_is_long(many):
    assert {name: len(content) for name, content in many.items() if len(content) > 500_000} == {}


def test_a_long_section_has_several_pages(many, large):
    places = {entry[1]: index(many)["pages"][entry[0]] for entry in index(many)["entries"]}
    assert len({places[claim.ref.anchor] for claim in large.sections[3].claims}) > 1
    assert len({places[claim.ref.anchor] for claim in large.sections[4].claims}) == 1


def test_parts_of_a_section_say_so_lead_to_one_another_and_the_first_lists_what_is_in_it(many, large):
    pages = [many[f"section-4-step-4{part}.html"].decode() for part in ("", "-2")]
    count = sum(name.startswith("section-4-step-4") for name in many)
    assert [f"<h1>4 Step 4 ({part} of {count})</h1>" in page for part, page in enumerate(pages, 1)] == [True] * 2
    assert '<a href="section-4-step-4-2.html">4 Step 4 (2 of' in pages[0]
    assert '<a href="section-4-step-4.html">← 4 Step 4 (1 of' in pages[1]
    links = re.findall(r'href="[^"#]*#([^"]+)"', pages[0])
    assert {*links} >= {claim.ref.anchor for claim in large.sections[3].claims}
    assert " of 1)" not in "".join(page.decode() for page in many.values())


@pytest.mark.parametrize("name", ["files", "many"])
def test_everything_is_found_where_the_index_says(name, request, report, large):
    found, content = request.getfixturevalue(name), report if name == "files" else large
    listed = index(found)
    shown = {"instrument": len(content.instruments), "figure": len(content.figures)}
    assert Counter(entry[4] for entry in listed["entries"] if entry[4] in shown) == +Counter(shown)
    assert {entry[2] for entry in listed["entries"] if entry[4] not in shown} == {
        item.ref.id for section in content.sections for item in (*section.claims, *section.definitions)
    }
    for page, anchor, *_ in listed["entries"]:
        assert f' id="{anchor}"' in found[listed["pages"][page]].decode()


def test_the_address_of_a_claim_is_its_id_on_the_page_of_its_section(report, derivation, files):
    fewer = replace(report, sections=(report.sections[0],))
    again = site_files(site(fewer))
    assert all(
        f' id="{claim.ref.anchor}"' in content["section-1-first-part.html"].decode()
        for content in (files, again)
        for claim in report.sections[0].claims
    )


def test_short_statements_are_beside_the_pages_to_be_shown(files, report):
    script = files["formulas.js"].decode()
    found = json.loads(script.removeprefix("window.PTPROOF_FORMULAS = ").rstrip(";\n"))
    assert {*found} == {claim.ref.anchor for claim in report.claims}
    assert "<math" in found["c-a-printed"]
    assert "Every field with a &lt; b" in found["c-b-theorem"]


def test_pages_load_nothing_from_elsewhere_and_fetch_nothing(files):
    for name, page in texts(files).items():
        assert not re.search(r"https?://(?!www\.w3\.org/)|fetch\(|@import|url\(", page), name
    assert not re.search(r"\bfetch\(|XMLHttpRequest", files["page.js"].decode())


def test_one_file_has_everything(files, report):
    page = files["report.html"].decode()
    assert not re.search(r'<script src|<link|src="figures', page)
    assert all(f'id="{claim.ref.anchor}"' in page for claim in report.claims)


def test_pages_stand_in_the_folder_of_their_paper(report):
    found = all_files({"one": report, "two": replace(report, title="Another")})
    assert {"index.html", "report.md", "one/index.html", "one/report.md", "two/graph.svg", "two/figures/path.svg"} <= {
        *found
    }
    assert lost(found) == []


def test_the_page_above_says_what_came_out_of_each(report):
    found = all_files({"one": report, "two": replace(report, title="Another")})
    for name in ("index.html", "report.md"):
        page = found[name].decode()
        assert all(words in page for words in ("Another", "The mixed term", "one/report.md", "two/report.md"))


def test_a_mark_says_what_was_read_from_the_source(report):
    def strip(word):
        first, *rest = report.sections[0].claims
        claims = (replace(first, read=ReadSide(word, ("eq:sum",))), *rest)
        found = replace(report, sections=(replace(report.sections[0], claims=claims),))
        return re.search(r'<span class="strip".*?</span>', site_files(site(found))["index.html"].decode()).group()

    assert [strip(word).count(" read ") for word in ("equal", "different", "not read")] == [1, 0, 0]


def test_an_erratum_shows_what_the_paper_prints_also_where_that_was_not_read(report):
    first, *rest = report.errata
    side = ReadSide("not read", ("eq:sum",), "why", unread=("q &= 1 \\\\ w &= 2",))
    unread = replace(report, errata=(replace(first, printed=replace(first.printed, read=side)), *rest))
    pages = {name: site_files(site(found))["errata.html"].decode() for name, found in
             (("not given", report), ("unread", unread))}  # fmt: skip
    assert "The paper prints" not in pages["not given"]
    shown = pages["unread"][pages["unread"].index("The paper prints") :]
    assert shown.index("<mi>q</mi>") < shown.index("<mi>w</mi>") < shown.index("<summary>What is claimed</summary>")


def test_a_hostile_title_stays_text(report):
    first = report.sections[0]
    claims = tuple(replace(claim, ref=replace(claim.ref, title=HOSTILE, id=HOSTILE)) for claim in first.claims)
    hostile = replace(report, title=HOSTILE, sections=(replace(first, title=HOSTILE, claims=claims),))
    found = all_files({"one": hostile, "two": hostile}, single=True)
    for name, content in found.items():
        if name.endswith((".html", ".svg")):
            assert "<script>alert" not in content.decode()
    for script in (found["one/search.js"].decode(), found["one/formulas.js"].decode()):
        assert not re.search("</|<!|\u2028", script)
    assert HOSTILE in {entry[3] for entry in index(found, "one/")["entries"]}
    assert lost(found) == []


def test_the_sentence_of_result_counts(report):
    said = plain(headline(report))
    assert said.startswith("4 of 10 statements are proved (1 given what is cited, 1 given what is still open)")
    assert "2 printed ones are false, and for 1 of them what holds instead is proved" in said
    assert said.endswith("1 undecided; 1 observed.")


@pytest.mark.parametrize(
    ("mark", "said"),
    [
        (status.FULLY, "Theorem 2 stands."),
        (status.MODULO_CITATIONS, "Theorem 2 stands, given “A theorem”."),
        (status.MODULO_OPEN, "Theorem 2 stands if what is open holds."),
        (status.UNDECIDED, "Theorem 2 is open."),
        (status.REFUTED, "1 observed."),
        (status.CITED, "Theorem 2 rests on what is cited."),
    ],
)
def test_a_result_stands_as_its_claim_does(report, mark, said):
    theorem = next(claim.ref for claim in report.claims if claim.ref.id == "b/theorem")
    model = next(claim for claim in report.claims if claim.ref.id == "a/corrected")
    result = replace(model, ref=replace(model.ref, title="Theorem 2: it works", anchor="c-t"), status=mark,
                     rests_on=(theorem,) if mark is status.MODULO_CITATIONS else ())  # fmt: skip
    last = report.sections[-1]
    grown = replace(report, sections=(*report.sections[:-1], replace(last, claims=(*last.claims, result))))
    assert plain(headline(grown)).endswith(f"; {said}")


@pytest.mark.parametrize(
    ("claims", "said"),
    [
        ([("Every run ends", "", ("proposition",))], "the Proposition stands"),
        ([("Every run ends", "Lemma 3", ("lem:end",))], "Lemma 3 stands"),
        ([("A step", "Step 6", ("thm:main",)), ("It works", "Theorem 2", ("thm:main",))], "Theorem 2 stands"),
        ([("Corollary 1, second part", "", ())], "Corollary 1 stands"),
        ([("Theorems of others", "", ())], ""),
        ([("Theorem 1 for the seeker: it is met", "Step 5", ())], ""),
        ([("A property", "", ("property",)), ("A step", "Proof of Theorem 2", ("eq:thm",))], ""),
    ],
)
def test_a_result_is_told_by_its_title_or_by_its_label(report, claims, said):
    model = report.claims[1]
    told = tuple(
        replace(model, ref=replace(model.ref, title=title), place=place, labels=labels)
        for title, place, labels in claims
    )
    shown = plain(headline(replace(report, sections=(replace(report.sections[0], claims=told),))))
    assert re.findall(r"(?:the )?(?:Theorem|Proposition|Lemma|Corollary)[^;.]*", shown) == ([said] if said else [])


@pytest.mark.parametrize(
    ("title", "parts"),
    [
        ("5.2 Theorem, Step 4: stability", ("5.2", "Theorem, Step 4")),
        ("V-B Analysis", ("V-B", "Analysis")),
        ("Beyond the paper", ("", "Beyond the paper")),
        ("I. Introduction", ("I", "Introduction")),
        ("", ("", "")),
    ],
)
def test_headings_are_steps_with_numbers(title, parts):
    assert heading(title) == parts


def test_in_the_picture_a_step_stands_below_those_that_it_uses(large):
    rows = [[group.number for group in row] for row in picture(large.sections)]
    assert rows == [[str(place + 1)] for place in range(40)]


def test_sections_of_one_number_are_one_step_and_circles_stand_in_one_row(report):
    first, second, *_ = report.claims
    one = replace(first, uses=(second.ref,), corrects=None)
    two = replace(second, uses=(first.ref,), corrects=None)
    sections = [
        Section(title, anchor, (), claims, ())
        for title, anchor, claims in (
            ("1 A: a", "s-1", (one,)), ("2 B: b", "s-2", (two,)), ("2 B: c", "s-3", ()), ("C", "s-4", ()),
        )
    ]  # fmt: skip
    (row,) = picture(sections)
    assert [(group.number, group.title, len(group.sections)) for group in row] == [
        ("1", "A: a", 1), ("2", "B", 2), ("", "C", 1),
    ]  # fmt: skip


def test_every_claim_is_a_mark_of_the_picture(report, files):
    page = files["index.html"].decode()
    strips = "".join(re.findall(r'<span class="strip".*?</span>', page))
    assert strips.count("<i ") == len(report.claims)


def test_parts_are_packed_in_order_and_none_is_lost():
    items = ["a" * 30, "b" * 80, "c" * 10, "d" * 200, "e"]
    parts = packed(items, 100)
    assert [item for part in parts for item in part] == items
    assert [sum(map(len, part)) for part in parts] == [30, 90, 200, 1]


@pytest.mark.parametrize(("title", "name"), [("5.2 Step: é, κ", "5-2-step"), ("κ", "part"), ("a" * 99, "a" * 60)])
def test_addresses_are_plain(title, name):
    assert slug(title) == name
