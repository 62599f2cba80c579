"""The claims of derivations as the pytest plugin needs them: by file, and decided in a process with a time limit."""

from __future__ import annotations

import sys
from pathlib import Path

from ptproof.errors import InputError
from ptproof.proof.answering import decided, import_apart, read, run_by_id
from ptproof.proof.claim import Claim
from ptproof.proof.load import NoClaims, load, twice, with_ancestors
from ptproof.proof.result import Result
from ptproof.proof.run import conclude
from ptproof.proof.verdict import Evidence
from ptproof.reading.limits import Unanswered, Workers
from ptproof.testing.wording import lines, witness_text

_LOADING = 600.0  # of one file [s]


class Claims:
    """Collects the claims file by file, and keeps the evidence of a test session."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self._files: dict[Path, set[str]] = {}
        self._homes: dict[int, Path] = {}
        self._ids: dict[tuple[Path, str], Claim] = {}
        self._evidence: dict[tuple[Path, str], Evidence] = {}
        self._workers: dict[Path, Workers] = {}
        self._vetting = Workers()

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
            If it cannot be imported, or ends the process that does, or an id stands twice in its folder.
        """
        outcome = self._vetting.run(_LOADING, import_apart, str(_loadable(file)))
        if isinstance(outcome, Unanswered):
            raise InputError(f"{file}: cannot be imported: {outcome.reason.replace('the work', 'the module', 1)}")
        try:
            derivation = load([_loadable(file)])
        except NoClaims:
            return ()
        found = []
        for item in derivation.claims:
            if _home(item, file) == file and self._homes.setdefault(id(item), file) == file:
                if self._ids.setdefault((file.parent, item.id), item) is not item:
                    raise twice(self._ids[file.parent, item.id], item)
                self._files.setdefault(file.parent, set()).add(derivation.homes.get(item.id, str(file)))
                found.append(item)
        return tuple(found)

    def result(self, file: Path, claim: Claim) -> Result:
        """The verdict of one claim after its ancestors, with their evidence taken from this session where known."""
        claims = with_ancestors([claim])
        return conclude(claims, {item.id: self._decided(file.parent, item) for item in claims})[-1]

    def close(self) -> None:
        """End the processes, the latest first: each holds copies of the connections to those before it."""
        for workers in (*reversed(self._workers.values()), self._vetting):
            workers.stop()
        self._workers.clear()

    def _decided(self, folder: Path, claim: Claim) -> Evidence:
        if (folder, claim.id) not in self._evidence:
            if folder not in self._workers:  # one process for each folder
                self._workers[folder] = Workers(start=read, arguments=(sorted(self._files[folder]),))
            outcome = self._workers[folder].run(self.seconds, run_by_id, claim.id)
            self._evidence[folder, claim.id] = decided(claim, outcome, self.seconds).evidence
        return self._evidence[folder, claim.id]


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


def explain(result: Result) -> str:
    """What a person needs to know about a claim that did not come out as expected."""
    claim = result.claim
    witness = next((item.witness for item in result.evidence if item.witness is not None), None)
    rows = [("title", claim.title), ("statement", str(claim.statement))]
    rows += [("given", str(item)) for item in claim.assumptions]
    rows.append(("witness", witness_text(witness)))
    rows += [(item.engine, f"{item.verdict}: {item.detail}") for item in result.evidence]
    return lines(f"{claim.id}: expected {claim.expected}, came out {result.verdict}", rows)
