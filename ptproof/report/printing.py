"""The report as PDF, printed by a browser that sets MathML: Chromium or one of its kin, without a window."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from ptproof.errors import InputError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
PATIENCE = 600.0  # [s]


def browser() -> str:
    """The command of a browser that prints.

    Raises
    ------
    InputError
        If there is none.
    """
    for name in BROWSERS:
        if found := shutil.which(name):
            return found
    raise InputError(f"--pdf: no browser prints it; install Chromium (looked for {', '.join(BROWSERS)})")


def printed(page: bytes, command: str) -> bytes:
    """A page that needs nothing else as the bytes of a PDF.

    Raises
    ------
    InputError
        If the browser does not print it, with what it said last.
    """
    with tempfile.TemporaryDirectory(prefix="ptproof-print-", ignore_cleanup_errors=True) as folder:
        source, target = Path(folder) / "report.html", Path(folder) / "report.pdf"
        source.write_bytes(page)
        arguments = [command, "--headless", "--disable-gpu", f"--user-data-dir={folder}/profile", "--no-first-run",
                     "--no-pdf-header-footer", f"--print-to-pdf={target}", source.as_uri()]  # fmt: skip
        if hasattr(os, "geteuid") and os.geteuid() == 0:  # its sandbox refuses the superuser
            arguments.insert(1, "--no-sandbox")
        try:
            done = subprocess.run(
                arguments, stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE, check=False
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise InputError(f"--pdf: {command} did not print the report: {error}") from None
        content = target.read_bytes() if target.is_file() else b""
        if not content.startswith(b"%PDF"):
            said = done.stderr.decode(errors="replace").strip().split("\n")[-1]
            raise InputError(f"--pdf: {command} did not print the report (status {done.returncode}): {said}")
        return content
