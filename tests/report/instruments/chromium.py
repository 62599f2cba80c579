"""Pages in a real browser, where there is one: what a script of theirs found, as data."""

import json
import os
import re
import shutil
import subprocess
from html import unescape

import pytest

from ptproof.report.printing import BROWSERS


def looked(folder, look):
    """What the page ``look`` in a folder puts as JSON into its element ``said``."""
    command = next(filter(None, map(shutil.which, BROWSERS)), None)
    if command is None:
        pytest.skip("no Chromium is installed; on Debian `apt install chromium` brings it")
    (folder / "look.html").write_text(look, encoding="utf-8")
    arguments = [command, "--headless", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files",
                 f"--user-data-dir={folder}/profile", "--virtual-time-budget=60000", "--dump-dom"]  # fmt: skip
    if os.geteuid() == 0:
        arguments.append("--no-sandbox")
    done = subprocess.run([*arguments, (folder / "look.html").as_uri()], capture_output=True, text=True, timeout=240,
                          check=False)  # fmt: skip
    if done.returncode or "<pre" not in done.stdout:
        pytest.skip(f"Chromium shows nothing here: {done.stderr.strip()[-200:]}")
    found = re.search(r'<pre id="said">(.+?)</pre>', done.stdout, re.DOTALL)
    assert found is not None, "the page was not looked at to the end"
    return json.loads(unescape(found[1]))
