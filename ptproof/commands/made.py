"""A report as plain data: its files and what is said of it, to be kept for a run in which nothing has changed."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Made:
    """The files of a report by their paths, the papers that have folders of their own in it, what is said of it on
    standard output and on standard error, and the exit status."""

    files: Mapping[str, bytes]
    folders: tuple[str, ...]
    sums: tuple[str, ...]
    notes: tuple[str, ...]
    status: int

    @classmethod
    def again(cls, data: Any) -> Made | None:
        """What was kept as ``data``; None if it is not in it."""
        try:
            files = {str(name): zlib.decompress(base64.b64decode(text)) for name, text in data["files"].items()}
            folders, sums, notes = (tuple(map(str, data[name])) for name in ("folders", "sums", "notes"))
            return cls(files, folders, sums, notes, int(data["status"]))
        except (KeyError, TypeError, ValueError, AttributeError, zlib.error):
            return None

    @property
    def data(self) -> dict[str, Any]:
        """As :meth:`again` takes it."""
        files = {name: base64.b64encode(zlib.compress(content)).decode() for name, content in self.files.items()}
        return {
            "files": files, "folders": self.folders, "sums": self.sums, "notes": self.notes, "status": self.status,
        }  # fmt: skip
