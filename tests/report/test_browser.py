"""The pages in a real browser, where there is one: Chromium looks at all of them, at three widths, light and dark."""

import re
import shutil
from collections import defaultdict
from dataclasses import replace
from urllib.parse import unquote, urldefrag

import pytest
from axe_playwright_python.base import AXE_SCRIPT
from playwright.sync_api import sync_playwright

from ptproof.report.model import Section
from ptproof.report.pages import all_files
from ptproof.report.printing import BROWSERS

PHONE, DESK, WIDE = 390, 1280, 1920
PAPER = 718  # the width of A4 between Chromium's margins
LOOK = """() => {
  const all = (what) => [...document.querySelectorAll(what)].filter((item) => item.getClientRects().length);
  const box = (item) => item.getBoundingClientRect();
  const over = (one, two) => one.top < two.bottom - 1 && two.top < one.bottom - 1
    && one.left < two.right - 1 && two.left < one.right - 1;
  const root = document.documentElement;
  return {
    wide: root.scrollWidth - root.clientWidth,
    flat: all("math").filter((item) => box(item).height < 4).map((item) => item.textContent),
    cut: all("math, img, pre").filter((item) => box(item).right > innerWidth).map((item) => item.textContent),
    overlap: all("article, figure, main h1, main h2").flatMap((one, place, list) => list.slice(place + 1, place + 9)
      .filter((two) => !one.contains(two) && over(box(one), box(two))).map((two) => `${one.id} ${two.textContent}`)),
    ids: [...document.querySelectorAll("[id]")].map((item) => item.id),
    links: [...document.querySelectorAll("a[href]")].map((item) => new URL(item.getAttribute("href"), location).href),
  };
}"""
# A formula's letters by the hundred cost axe most of its time: their contrast is looked at by colour, in FAINT.
OPTIONS = '{preload: false, resultTypes: ["violations"], rules: {"target-size": {enabled: true}}}'
AXE = """() => axe.run({exclude: [["math"]]}, OPTIONS)
  .then((found) => found.violations.filter((item) => ["serious", "critical"].includes(item.impact))
    .flatMap((item) => item.nodes.map((node) => `${item.id}: ${node.html.slice(0, 200)}`)))""".replace(
    "OPTIONS", OPTIONS
)
FAINT = """() => {
  const numbers = (colour) => colour.match(/[0-9.]+/g).map(Number);
  const light = (colour) => numbers(colour).slice(0, 3).map((part) => part / 255)
    .map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)
    .reduce((sum, part, place) => sum + part * [0.2126, 0.7152, 0.0722][place], 0.05);
  const behind = (item) => {
    const colour = getComputedStyle(item).backgroundColor;
    return numbers(colour)[3] === 0 && item.parentElement ? behind(item.parentElement) : colour;
  };
  const pairs = [...document.querySelectorAll("math, math .differs")]
    .map((item) => [light(getComputedStyle(item).color), light(behind(item))].sort((one, two) => one - two));
  return pairs.filter(([low, high]) => high / low < 4.5).length;
}"""
FOCUS = """() => {
  const item = document.activeElement, style = getComputedStyle(item), box = item.getBoundingClientRect();
  item.dataset.reached = "";
  const inside = box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth;
  return { name: item.id || item.textContent.trim(), tag: item.tagName, seen: inside && style.outlineStyle !== "none" };
}"""

LEFT = """() => [...document.querySelectorAll("a[href], button, input, summary, [tabindex='0']")]
  .filter((item) => item.checkVisibility() && item.dataset.reached === undefined).map((item) => item.outerHTML)"""

# All that is looked at together takes half a minute; on a busy machine much more.
pytestmark = pytest.mark.timeout(900)


@pytest.fixture(scope="module")
def chromium():
    command = next(filter(None, map(shutil.which, BROWSERS)), None)
    if command is None:
        pytest.skip("no Chromium is installed; on Debian `apt install chromium` brings it")
    with sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=command, args=["--disable-gpu", "--disable-background-networking"], chromium_sandbox=False
        )
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def folder(report, tmp_path_factory):
    place = tmp_path_factory.mktemp("pages")
    first = report.sections[0]
    parts = replace(first, claims=first.claims[:4]), Section("2 Second", "s-2", (), first.claims[4:], ())
    for name, content in all_files({"one": replace(report, sections=parts), "two": report}, single=True).items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        (place / name).write_bytes(content)
    return place


@pytest.fixture(scope="module")
def tab(chromium):
    """One for all: a new one costs more than most of what is looked at in it."""
    tab = chromium.new_page(reduced_motion="reduce")
    yield tab
    tab.close()


def afresh(tab):
    """The tab as a new one, at a desk; what was open in it is left."""
    tab.goto("about:blank")
    tab.emulate_media(media="null", color_scheme="null", reduced_motion="reduce")
    tab.set_viewport_size({"width": DESK, "height": 900})
    tab.mouse.move(0, 0)
    return tab


@pytest.fixture
def page(tab):
    return afresh(tab)


def look_at(tab, file):
    """What is seen of a page: at three widths, on paper, and by axe on a phone in the dark and at a desk by day."""
    page, seen = afresh(tab), defaultdict(list)
    hears = {"pageerror": lambda error: seen["told"].append(str(error)),
             "console": lambda said: seen["told"].extend([said.text] if said.type == "error" else [])}  # fmt: skip
    for event, hear in hears.items():
        page.on(event, hear)
    page.goto(file.as_uri())
    page.evaluate(AXE_SCRIPT)
    for width in (PHONE, DESK, WIDE):
        page.set_viewport_size({"width": width, "height": 900})
        look = page.evaluate(LOOK)
        seen["wide"] += [width] if look["wide"] > 0 else []
        seen["flat"] += look["flat"]
        for scheme in ("light", "dark") if width != WIDE else ():
            page.emulate_media(color_scheme=scheme)
            if (width, scheme) in ((PHONE, "dark"), (DESK, "light")):
                seen["axe"] += [f"{width} {scheme} {said}" for said in page.evaluate(AXE)]
            seen["faint"] += [scheme] * page.evaluate(FAINT)
            seen["paper"].append(page.evaluate("getComputedStyle(document.body).backgroundColor"))
    seen["links"], seen["ids"] = look["links"], look["ids"]
    page.set_viewport_size({"width": PAPER, "height": 900})
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    look = page.evaluate(LOOK)
    seen["print"] = [*look["cut"], *look["overlap"]]
    for event, hear in hears.items():
        page.remove_listener(event, hear)
    return seen


@pytest.fixture(scope="module")
def seen(tab, folder):
    files = sorted(file for file in folder.rglob("*.html") if "two" not in file.parts)
    return {str(file.relative_to(folder)): look_at(tab, file) for file in files}


@pytest.mark.parametrize("fault", ["wide", "flat", "axe", "faint", "print", "told"])
def test_no_page_has_a_fault(seen, fault):
    """None is wider than the window, has formulas without height or too faint, or is cut on paper.

    Nor has one a script that fails, and axe finds nothing serious.
    """
    assert len(seen) >= 10
    assert {name: found[fault] for name, found in seen.items() if found[fault]} == {}


BAD = """<!doctype html><html><body style="margin:0"><div style="width:3000px">wide</div><button></button>
<p style="color:#999;background:#eee"><math><mi>x</mi></math></p>
<math style="display:block;height:1px"><mi>y</mi></math>
<article style="height:2rem"><pre style="width:900px">long</pre></article>
<article style="margin-top:-1rem">over</article>
<script src="missing.js"></script></body></html>"""


def test_every_fault_would_be_found(tab, tmp_path):
    (tmp_path / "bad.html").write_text(BAD)
    found = look_at(tab, tmp_path / "bad.html")
    assert [name for name in ("wide", "flat", "axe", "faint", "print", "told") if not found[name]] == []
    assert {said.split(" ")[2] for said in found["axe"]} >= {"button-name:", "html-has-lang:"}
    assert len(found["print"]) == 2


def test_every_link_lands(seen, folder):
    lost = []
    for name, found in seen.items():
        for link in found["links"]:
            target, anchor = urldefrag(unquote(link))
            file = folder / target.removeprefix(f"{folder.as_uri()}/")
            known = seen.get(str(file.relative_to(folder)))
            inside = known["ids"] if known else re.findall(r'id="([^"]+)"', file.read_text()) if file.is_file() else []
            if not file.is_file() or (anchor and anchor not in inside):
                lost.append((name, link))
    assert lost == []
    assert sum(len(found["links"]) for found in seen.values()) > 200


def test_dark_is_dark_and_print_is_light(seen, page, folder):
    assert {tuple(found["paper"]) for found in seen.values()} == {("rgb(255, 255, 255)", "rgb(14, 17, 22)") * 2}
    page.emulate_media(color_scheme="dark", media="print")
    page.goto((folder / "one/figures.html").as_uri())
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    # A drawing that is asked in the page's own scheme draws itself light too.
    assert page.evaluate("getComputedStyle(document.querySelector('figure img')).colorScheme") == "light"


def test_a_claim_is_searched_and_reached_by_the_keyboard_alone(page, folder):
    page.goto((folder / "one/index.html").as_uri())
    keys = page.keyboard
    keys.press("/")
    keys.type("SQUARE of a sum")
    page.wait_for_selector("#hits a")
    assert page.locator("#hits a").first.get_attribute("href") == "section-1-first-part.html#c-a-corrected"
    keys.press("ArrowDown")
    assert page.evaluate(FOCUS)["seen"]
    keys.press("Escape")
    assert page.locator("#hits").is_hidden()
    assert page.evaluate(FOCUS)["name"] == "find"
    keys.type("eq:sum")
    page.wait_for_selector("#hits a")
    keys.press("ArrowDown")
    keys.press("Enter")
    page.wait_for_url("**/section-1-first-part.html#c-a-*")


@pytest.mark.parametrize(("name", "file"), [("one/index.html", "figures.html"), ("one/report.html", "")])
def test_a_figure_is_searched_as_a_claim_is(page, folder, name, file):
    page.goto((folder / name).as_uri())
    page.locator("#find").fill("FIGURE path")
    page.wait_for_selector("#hits a")
    assert page.locator("#hits .title").all_inner_texts() == ["The path of x"]
    assert page.locator("#hits a").first.get_attribute("href") == f"{file}#figure-path"


@pytest.mark.parametrize(
    "name", ["one/index.html", "one/section-1-first-part.html", "one/graph.html", "one/errata.html"]
)
@pytest.mark.parametrize("width", [PHONE, DESK])
def test_what_can_be_used_is_reached_by_tab_in_order_and_is_seen_to_be(page, folder, name, width):
    page.set_viewport_size({"width": width, "height": 900})
    page.goto((folder / name).as_uri())
    page.wait_for_timeout(50)
    reached = []
    while not reached or reached[-1]["tag"] != "BODY":  # which comes after the last
        page.keyboard.press("Tab")
        reached.append(page.evaluate(FOCUS))
        assert len(reached) < 500
    assert reached[0]["name"] == "To the content"
    assert [item for item in reached[:-1] if not item["seen"]] == []
    assert page.evaluate(LEFT) == []


def test_a_step_is_opened_by_the_keyboard_and_its_claims_show_their_formulas(page, folder):
    page.goto((folder / "one/index.html").as_uri())
    page.evaluate("document.querySelectorAll('details.group').forEach((group) => { group.open = false; })")
    page.locator(".group summary").first.focus()
    page.keyboard.press("Enter")
    page.locator(".group[open] .inside li a").first.focus()
    page.wait_for_selector(".note math")
    page.keyboard.press("Escape")
    assert page.locator(".note").is_hidden()
    page.locator(".strip .m").first.hover()
    page.wait_for_selector(".note p")
    page.mouse.move(0, 0)
    assert page.locator(".note").is_hidden()


def test_what_uses_what_is_shown_by_arrows_and_on_a_phone_in_words(page, folder):
    page.goto((folder / "one/index.html").as_uri())
    assert page.locator("svg.arrows path").count() > 0
    assert page.locator(".uses").first.is_hidden()
    page.set_viewport_size({"width": PHONE, "height": 900})
    assert page.locator("svg.arrows").is_hidden()
    assert re.fullmatch(r"uses \S.*", page.locator(".uses").first.inner_text())


def test_a_count_leads_to_as_many_claims(page, folder):
    page.goto((folder / "one/index.html").as_uri())
    tile = page.locator(".tile").first
    number = int(tile.locator("b").inner_text())
    tile.click()
    anchor = urldefrag(page.url)[1]
    assert page.locator(f"#{anchor} li").count() == number


def test_a_claim_is_found_from_the_front_page(page, folder):
    page.goto((folder / "one/index.html").as_uri() + "#c-b-smooth")
    page.wait_for_url("**/one/section-2-second.html#c-b-smooth")


def test_nothing_moves_for_those_who_do_not_want_it(page, folder):
    page.goto((folder / "one/index.html").as_uri())
    how = "getComputedStyle(document.documentElement).scrollBehavior"
    assert page.evaluate(how) == "auto"
    assert page.evaluate("document.getAnimations().length") == 0
    page.emulate_media(reduced_motion="no-preference")
    assert page.evaluate(how) == "smooth"


@pytest.mark.parametrize("file", ["section-1-first-part.html", "report.html"])
def test_a_letter_says_what_it_stands_for(page, folder, file):
    """By the keyboard, pointed at and tapped; and nothing where it stands for something else in this claim."""
    page.goto((folder / "one" / file).as_uri())
    card, note = page.locator("#c-a-printed"), page.locator("#note")
    page.keyboard.press("Tab")
    card.locator(".formula").first.focus()
    note.wait_for()
    assert note.locator("p").count() == 2
    page.keyboard.press("Escape")
    assert note.is_hidden()
    letter, place = card.locator(".formula mi", has_text="k").first, card.locator(".formula mover mi").first
    for act in ("hover", "click"):
        for target, said in ((letter, "gain | rate [1/s]"), (place, "place [m]")):
            getattr(target, act)()
            note.get_by_text(said).wait_for()
        page.mouse.click(1, 1)
        assert note.is_hidden()
    card.evaluate("(item) => { item.dataset.unlike = 'k'; }")
    place.hover()
    note.wait_for()
    letter.hover()
    note.wait_for(state="hidden")
