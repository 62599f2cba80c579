"""The claims of derivations as the pytest plugin needs them: by file, and decided in a process with a time limit."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Result
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.testing.wording import lines, witness_text


class Claims:
    """Collects the claims file by file, and keeps the evidence of a test session."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self._paths: dict[Path, Path] = {}
        self._homes: dict[int, Path] = {}
        self._ids: dict[tuple[Path, str], Claim] = {}
        self._evidence: dict[tuple[Path, str], Evidence] = {}
        self._pools: dict[Path, Any] = {}

    def may_hold_claims(self, file: Path) -> bool:
        """Whether the text of a file speaks of claims; what does not is never imported."""
        if file.suffix != ".py" or file.name in ("__init__.py", "conftest.py") or file.name.startswith("test_"):
            return False
        # A module may take everything from a neighbour, so the folder speaks for its files.
        return "claim" in _text(file).lower() and any("ptproof" in _text(other) for other in file.parent.glob("*.py"))

    def of_file(self, file: Path) -> tuple[Claim, ...]:
        """The claims that are made in ``file``, in its order.

        Raises
        ------
        InputError
            If it cannot be imported, or an id stands twice in its folder.
        """
        from ptproof.proof.load import load

        path = self._paths.setdefault(file, _loadable(file))
        try:
            derivation = load([path])
        except InputError as error:
            if str(error) == f"{path}: no claims found":
                return ()
            raise
        found = []
        for item in derivation.claims:
            if _home(item, file) == file and self._homes.setdefault(id(item), file) == file:
                if self._ids.setdefault((file.parent, item.id), item) is not item:
                    other = self._ids[file.parent, item.id]
                    raise InputError(f"the id {item.id!r} stands twice: {other.title!r} and {item.title!r}")
                found.append(item)
        return tuple(found)

    def result(self, file: Path, claim: Claim) -> Result:
        """The verdict of one claim after its ancestors, with their evidence taken from this session where known."""
        from ptproof.proof.run import conclude

        evidence = {item.id: self._decided(file.parent, item) for item in _with_ancestors(claim)}
        return conclude([claim], evidence)[0]

    def close(self) -> None:
        """End the processes."""
        for pool in self._pools.values():
            pool.stop()
            pool.join()
        self._pools.clear()

    def _decided(self, folder: Path, claim: Claim) -> Evidence:
        if (folder, claim.id) not in self._evidence:
            self._evidence[folder, claim.id] = self._decide(folder, claim)
        return self._evidence[folder, claim.id]

    def _decide(self, folder: Path, claim: Claim) -> Evidence:
        from concurrent.futures import TimeoutError as FutureTimeout

        future = self._pool(folder).schedule(_decide_by_id, args=(claim.id,), timeout=self.seconds)
        try:
            found: Evidence = future.result()
        except FutureTimeout:
            return Evidence("time limit", Verdict.UNDECIDED, f"no answer in {self.seconds:g} s", self.seconds)
        except Exception as error:
            return Evidence("crash", Verdict.UNDECIDED, f"the process ended: {type(error).__name__}: {error}")
        return found

    def _pool(self, folder: Path) -> Any:
        """One process for each folder, started afresh: a copy of a process with threads can hang."""
        import multiprocessing

        from pebble import ProcessPool

        if folder not in self._pools:
            paths = sorted({str(path) for file, path in self._paths.items() if file.parent == folder})
            self._pools[folder] = ProcessPool(
                max_workers=1, context=multiprocessing.get_context("spawn"), initializer=_load_all, initargs=(paths,)
            )
        return self._pools[folder]


_claims: dict[str, Claim] = {}


def _load_all(paths: Sequence[str]) -> None:
    # The imports happen before the first claim, so that they do not count as its time.
    from ptproof.proof.load import load

    for path in paths:
        with contextlib.suppress(InputError):  # a file without claims
            _claims.update({item.id: item for item in load([path]).claims})


def _decide_by_id(id: str) -> Evidence:
    from ptproof.proof.run import run_one

    return run_one(_claims[id])


def _text(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except (OSError, ValueError):
        return ""


def _loadable(file: Path) -> Path:
    """What is loaded for a file: itself, or its folder where modules of a folder can only be loaded together."""
    return file if (file.parent / "__init__.py").exists() or "from ." not in _text(file) else file.parent


def _home(claim: Claim, file: Path) -> Path:
    """The file in which the proof was written; for a proof that was made elsewhere, the file that is asked about."""
    module = sys.modules.get(getattr(claim.prove, "__module__", None) or "")
    if module is None or not module.__name__.startswith("ptproof_derivation_"):
        return file
    return Path(module.__file__ or file)


def _with_ancestors(claim: Claim) -> tuple[Claim, ...]:
    found: dict[str, Claim] = {}

    def take(item: Claim) -> None:
        if item.id not in found:
            for used in item.uses:
                take(used)
            found[item.id] = item

    take(claim)
    return tuple(found.values())


def explain(result: Result) -> str:
    """What a person needs to know about a claim that did not come out as expected."""
    claim = result.claim
    witness = next((item.witness for item in result.evidence if item.witness is not None), None)
    rows = [("title", claim.title), ("statement", str(claim.statement))]
    rows += [("given", str(item)) for item in claim.assumptions]
    rows.append(("witness", witness_text(witness)))
    rows += [(item.engine, f"{item.verdict}: {item.detail}") for item in result.evidence]
    return lines(f"{claim.id}: expected {claim.expected}, came out {result.verdict}", rows)
