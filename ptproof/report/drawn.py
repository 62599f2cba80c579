"""The figures and tables of derivations: drawn, as plain data to be remembered, and known again."""

from __future__ import annotations

import base64
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from ptproof.proof.load import files_named, modules_of
from ptproof.proof.memory import Memory
from ptproof.reading import system
from ptproof.reading.outcomes import in_words
from ptproof.report.content import Figure, Table, brought
from ptproof.report.versions import SETTING, versions

T = TypeVar("T")


@dataclass(frozen=True)
class Drawing:
    """What is to be drawn of one paper.

    Attributes
    ----------
    paths
        Where its derivation is.
    files
        Those of its files that bring figures.
    fresh
        Whether what is remembered is ignored.
    """

    paths: tuple[str, ...]
    files: tuple[str, ...]
    fresh: bool = False

    @classmethod
    def of(cls, paths: Sequence[Path], fresh: bool, files: Sequence[str] | None = None) -> Drawing:
        """What these files of the derivation bring; left out, those that say so before any is loaded."""
        found = files_named(paths, "figures") if files is None else files
        return cls(tuple(str(path.resolve()) for path in paths), tuple(found), fresh)

    def known(self) -> Drawn | None:
        """What was drawn in an earlier run, where every file that was read for it is as it was."""
        return Drawn.again(self._memory().run(self._asked()))

    def drawn(self) -> Drawn:
        """The figures and tables; remembered if nothing failed, with all that their code has read."""
        memory = self._memory()
        with memory.loading():
            made = self._now()
        made = replace(made, files=memory.files)
        if not made.failed and not made.interrupted:
            memory.keep_run(self._asked(), made.data, True)
        return made

    def _now(self) -> Drawn:
        def all_of_them() -> Drawn:
            modules = modules_of(self.files)
            return Drawn(tuple(brought(modules, "figures")), tuple(brought(modules, "tables")))

        try:
            found, failed = tried("figures", all_of_them)
        except KeyboardInterrupt:
            return Drawn(interrupted=True)
        return found or Drawn(failed=failed)

    def _memory(self) -> Memory:
        return Memory(self.paths, fresh=self.fresh)

    def _asked(self) -> str:
        return " ".join(map(str, ("figures", *self.files, versions(SETTING))))


@dataclass(frozen=True)
class Drawn:
    """Figures and tables, or what the report says instead of them.

    Attributes
    ----------
    figures, tables
        In the order in which they were brought.
    failed
        Why they could not be drawn, in words.
    interrupted
        Whether their code raised a KeyboardInterrupt.
    files
        Every file that was read for them.
    """

    figures: tuple[Figure, ...] = ()
    tables: tuple[Table, ...] = ()
    failed: str = ""
    interrupted: bool = False
    files: tuple[str, ...] = ()

    @classmethod
    def again(cls, data: Any) -> Drawn | None:
        """What was kept as ``data``; None if it is not in it."""
        try:
            figures = [Figure(name, caption, base64.b64decode(text)) for name, caption, text in data["figures"]]
            tables = [
                Table(item["title"], item["caption"], tuple(item["head"]), tuple(map(tuple, item["rows"])))
                for item in data["tables"]
            ]
            return cls(tuple(figures), tuple(tables), files=tuple(map(str, data["files"])))
        except (KeyError, TypeError, ValueError):
            return None

    @property
    def data(self) -> dict[str, Any]:
        """As :meth:`again` takes it."""
        figures = [(item.name, item.caption, base64.b64encode(item.content).decode()) for item in self.figures]
        return {"figures": figures, "tables": [asdict(item) for item in self.tables], "files": self.files}


def draw(drawings: Sequence[Drawing]) -> list[Drawn]:
    """Each of them, one after the other, in a process that loads nothing else; they are needed last."""
    system.yield_to_others()
    sys.dont_write_bytecode = True  # what is compiled is for the one that loads the derivation, which distrusts it
    return [item.drawn() for item in drawings]


def tried(what: str, make: Callable[[], T]) -> tuple[T | None, str]:
    """What is made, or what the report says instead: a part that fails is named in it and does not end it."""
    try:
        return make(), ""
    except KeyboardInterrupt:
        raise
    except Exception as error:
        return None, f"The {what} could not be drawn: {type(error).__name__}: {error}"
    except BaseException as error:
        return None, f"The {what} could not be drawn: their code {in_words(error)}"
