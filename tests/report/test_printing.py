"""The report as PDF, by a browser that stands in for the real one."""

import pytest

from ptproof.errors import InputError
from ptproof.report import printing

PRINTS = """#!/bin/sh
for part in "$@"; do
  case "$part" in --print-to-pdf=*) target="${part#*=}";; file://*) source="${part#file://}";; esac
done
"""


def stand_in(folder, body, name="chromium"):
    file = folder / name
    file.write_text(PRINTS + body)
    file.chmod(0o755)
    return str(file)


def test_the_page_is_printed(tmp_path):
    command = stand_in(tmp_path, '(printf "%%PDF "; cat "$source") > "$target"')
    assert printing.printed(b"<p>all</p>", command) == b"%PDF <p>all</p>"


@pytest.mark.parametrize(
    ("body", "said"),
    [("echo no display >&2; exit 3", r"\(status 3\): no display"), ('echo text > "$target"', "did not print")],
)
def test_what_is_not_printed_is_named(tmp_path, body, said):
    with pytest.raises(InputError, match=said):
        printing.printed(b"", stand_in(tmp_path, body))


def test_a_browser_is_found_by_its_name(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="install Chromium"):
        printing.browser()
    command = stand_in(tmp_path, "", "google-chrome")
    assert printing.browser() == command
