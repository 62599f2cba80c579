"""The pages in a real browser, where there is one: one run of Chromium looks at all of them at three widths."""

import json
import os
import re
import shutil
import subprocess
from dataclasses import replace

import pytest

from ptproof.report.model import Section
from ptproof.report.pages import all_files
from ptproof.report.printing import BROWSERS

WIDTHS = (390, 1280, 1920)
HEARD = (
    b"<script>var errors = []; addEventListener('error', (e) => errors.push(e.message || e.target.src), true);</script>"
)
LOOK = """<!doctype html><meta charset="utf-8"><pre id="said"></pre><script>
const pages = PAGES, said = { pages: {}, search: [], landed: "", opened: 0 };
const pause = (time) => new Promise((done) => setTimeout(done, time));
const open = async (address, width) => {
  const frame = document.createElement("iframe");
  frame.width = width;
  frame.height = 900;
  frame.src = address;
  await new Promise((done) => { frame.onload = done; document.body.append(frame); });
  await pause(20);
  return frame;
};
const until = async (met) => { for (let n = 0; n < 100 && !met(); n++) await pause(20); };
(async () => {
  for (const page of pages) for (const width of WIDTHS) {
    const frame = await open(page, width), view = frame.contentDocument;
    const formulas = [...view.querySelectorAll("math")].filter((item) => item.getClientRects().length);
    said.pages[`${page} ${width}`] = {
      wide: view.documentElement.scrollWidth - frame.clientWidth,
      flat: formulas.filter((item) => item.getBoundingClientRect().height < 4).length,
      errors: frame.contentWindow.errors,
      arrows: view.querySelectorAll("svg.arrows path").length,
    };
    frame.remove();
  }
  const frame = await open("one/index.html", 1280), view = frame.contentDocument;
  const find = view.getElementById("find"), hits = view.getElementById("hits");
  find.value = "SQUARE of a sum";
  find.dispatchEvent(new Event("input"));
  await until(() => !hits.hidden);
  said.search = [...hits.querySelectorAll("a")].map((link) => link.getAttribute("href"));
  const other = await open("one/index.html#c-b-smooth", 1280);
  await until(() => other.contentWindow.location.pathname.includes("section-"));
  said.landed = other.contentWindow.location.href;
  document.getElementById("said").textContent = JSON.stringify(said);
})();
</script>"""


@pytest.fixture(scope="module")
def said(report, tmp_path_factory):
    command = next(filter(None, map(shutil.which, BROWSERS)), None)
    if command is None:
        pytest.skip("no Chromium is installed; on Debian `apt install chromium` brings it")
    folder = tmp_path_factory.mktemp("pages")
    first = report.sections[0]
    parts = replace(first, claims=first.claims[:4]), Section("2 Second", "s-2", (), first.claims[4:], ())
    files = all_files({"one": replace(report, sections=parts), "two": report}, single=True)
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content.replace(b"<head>", b"<head>" + HEARD, 1))
    pages = sorted(name for name in files if name.endswith(".html") and not name.startswith("two/"))
    look = LOOK.replace("PAGES", json.dumps(pages)).replace("WIDTHS", json.dumps(WIDTHS))
    (folder / "look.html").write_text(look)
    arguments = [command, "--headless", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files",
                 f"--user-data-dir={folder}/profile", "--virtual-time-budget=60000", "--dump-dom"]  # fmt: skip
    if os.geteuid() == 0:
        arguments.append("--no-sandbox")
    done = subprocess.run([*arguments, (folder / "look.html").as_uri()], capture_output=True, text=True, timeout=240,
                          check=False)  # fmt: skip
    if done.returncode or "<pre" not in done.stdout:
        pytest.skip(f"Chromium shows nothing here: {done.stderr.strip()[-200:]}")
    found = re.search(r'<pre id="said">(\{.*?\})</pre>', done.stdout, re.DOTALL)
    assert found is not None, "the pages were not looked at to the end"
    return json.loads(found[1].replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))


def test_no_page_is_wider_than_the_window(said):
    assert len(said["pages"]) > 8 * len(WIDTHS)
    assert {page: found["wide"] for page, found in said["pages"].items() if found["wide"] > 0} == {}


def test_every_formula_has_a_height(said):
    assert {page: found["flat"] for page, found in said["pages"].items() if found["flat"]} == {}


def test_no_script_fails_and_nothing_is_missing(said):
    errors = {page: found["errors"] for page, found in said["pages"].items() if found["errors"]}
    assert errors == {}


def test_the_picture_has_arrows(said):
    assert said["pages"]["one/index.html 1280"]["arrows"] > 0


def test_searching_finds_what_stands_on_another_page(said):
    assert said["search"][0] == "section-1-first-part.html#c-a-corrected"


def test_a_claim_is_found_from_the_front_page(said):
    assert said["landed"].endswith("one/section-2-second.html#c-b-smooth")
