"""Entries that are kept on disk from one run to the next, each checked when it is read."""

from __future__ import annotations

import contextlib
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ptproof.reading.hashes import of_texts

VARIABLE = "PTPROOF_CACHE"
_DAYS = 60


def place() -> Path | None:
    """The folder for what is kept: ``PTPROOF_CACHE``, or the user's cache folder; None if the variable is empty."""
    if (chosen := os.environ.get(VARIABLE)) is not None:
        return Path(chosen).expanduser().absolute() if chosen else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or "~/AppData/Local"
    elif sys.platform == "darwin":
        base = "~/Library/Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return Path(base).expanduser().absolute() / "ptproof"
    except RuntimeError:  # no home
        return None


class Cache:
    """Entries under keys, in one folder for each state of the program.

    Two programs may read and write it at the same time: an entry is written beside its place and then moved there, and
    one that is not whole, or stands under another key, counts as not there.

    Parameters
    ----------
    folder
        Where the entries are, or None to keep nothing.
    say
        Told once, in words, if nothing can be kept.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     cache = Cache(Path(folder))
    ...     cache.write("one", {"verdict": "proved"})
    ...     cache.read("one"), cache.read("other")
    ({'verdict': 'proved'}, None)
    """

    def __init__(self, folder: Path | None, say: Callable[[str], None] = lambda text: None) -> None:
        self._folder, self._say = folder, say

    def read(self, key: str) -> Any:
        """What was written under this key, or None."""
        if self._folder is None:
            return None
        try:
            entry = json.loads((self._folder / self._name(key)).read_text("utf-8"))
            text = entry["value"]
            return json.loads(text) if entry["check"] == of_texts([key, text]) else None
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None

    def write(self, key: str, value: Any) -> None:
        """Keep a value that JSON can hold."""
        if self._folder is None:
            return
        text = json.dumps(value)
        beside: str | None = None
        try:
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            number, beside = tempfile.mkstemp(prefix=".", dir=self._folder)
            with open(number, "w", encoding="utf-8") as file:
                json.dump({"check": of_texts([key, text]), "value": text}, file)
            os.replace(beside, self._folder / self._name(key))
        except OSError as error:
            if beside is not None:
                with contextlib.suppress(OSError):
                    os.unlink(beside)
            self._say(f"nothing is remembered for the next run: {self._folder}: {error.strerror or error}")
            self._folder = None

    def tidy(self) -> None:
        """Remove the entries of other states of the program that nobody has written to for two months."""
        if self._folder is None:
            return
        with contextlib.suppress(OSError):
            os.utime(self._folder)
            for other in self._folder.parent.iterdir():
                if other.is_dir() and other.stat().st_mtime < time.time() - _DAYS * 86400:
                    for file in other.iterdir():
                        file.unlink()
                    other.rmdir()

    @staticmethod
    def _name(key: str) -> str:
        return f"{of_texts([key])[:40]}.json"
