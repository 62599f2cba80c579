"""Remembering what is decided from one run to the next.

A claim is known again by all that its verdict depends on: what it says, what the claims that it uses say, every file of
its derivation and every other file that was read with it, every file of ptproof, and the versions of Python and the
libraries. What was left open for want of time or by a crash is not remembered; nor is what a proof says that has read
other files.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.reading import hashes
from ptproof.reading.cache import Cache, place

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim
    from ptproof.proof.load import Derivation
    from ptproof.proof.result import Verification
    from ptproof.proof.verdict import Evidence

_LOOK = 2.0  # between two looks at whether the files are still the same [s]
# Read with one derivation, and then in memory for the next: they belong to that as well.
_read_before: set[str] = set()
_derivations: set[str] = set()


class Memory:
    """What earlier runs have decided about the derivations below ``paths``.

    Parameters
    ----------
    paths
        Files or folders of derivations, as :func:`ptproof.proof.load.load` takes them; at least one.
    fresh
        Recall nothing, but keep what is decided now.
    say
        Told once, in words, if nothing can be kept.
    """

    def __init__(
        self, paths: Sequence[str | Path], *, fresh: bool = False, say: Callable[[str], None] = lambda text: None
    ) -> None:
        self._paths = [Path(path).resolve() for path in paths]
        self._fresh = fresh
        folder, self._environment = place(), hashes.environment()
        self._cache = Cache(folder and folder / self._environment[:16], say)
        self._before: dict[str, str] = {}
        self._files: dict[str, str] = {}
        self._recalled: dict[str, Evidence] = {}
        self._said: tuple[dict[str, str], str] = {}, ""  # the files, and what a claim's key says of them
        self._looked = 0.0
        self._open, self._whole = False, True

    @contextlib.contextmanager
    def loading(self) -> Iterator[None]:
        """While the derivation is loaded: what is read now belongs to it."""
        before = self._before = hashes.of_derivation(self._paths)
        with hashes.opened() as found:
            yield
        self._files = hashes.of_derivation(self._paths)
        self._open = bool(before) and before == self._files and all(self._files.values())
        _derivations.update(self._files)
        _read_before.update(hashes.foreign(found))
        self._files |= {file: hashes.of_file(file) for file in sorted(_read_before - _derivations)}
        self._looked = time.monotonic()

    def load(self, select: str = "") -> Derivation:
        """The derivation; where its contents are known, only the files that hold what is selected."""
        from ptproof.proof import contents
        from ptproof.proof.load import files_of, load

        key = self._key_of("contents")
        files, known = files_of(self._paths), None if self._fresh else self._cache.read(key)
        with self.loading():
            few = contents.holding(known, self._before, files, select) or None
            derivation = load(self._paths, few)
            if few is not None and known is not None and contents.doubtful(known, few, derivation):
                few, derivation = None, load(self._paths)
        if few is None and self._open:
            said = contents.said(derivation, self._files, files)
            if said != known:
                self._cache.write(key, said)
        return derivation

    def lacks(self, select: str) -> bool:
        """Whether no claim contains that text, as far as the contents are known without loading anything."""
        from ptproof.proof import contents
        from ptproof.proof.load import files_of

        known = None if self._fresh else self._cache.read(self._key_of("contents"))
        return contents.holding(known, hashes.of_derivation(self._paths), files_of(self._paths), select) == []

    def run(self, select: str) -> dict[str, Any] | None:
        """What :meth:`keep_run` kept of this very run, if every file is as it was; nothing has to be loaded for it."""
        if self._fresh:
            return None
        match self._cache.read(self._key_of("run", select)):
            case {"files": dict(files), "data": dict(data)} if files:
                same = all(hashes.of_file(file) == digest for file, digest in files.items())
                if same and set(hashes.of_derivation(self._paths)) <= set(files):
                    return data
        return None

    def keep_run(self, select: str, data: dict[str, Any], lasting: bool) -> None:
        """Keep the whole outcome, if it is ``lasting``: see :meth:`lasts`."""
        if lasting and self._unchanged():
            self._cache.write(self._key_of("run", select), {"files": self._files, "data": data})
        self._cache.tidy()

    def lasts(self, verification: Verification) -> bool:
        """Whether each part of the outcome is one that is remembered."""
        return self._whole and all(_lasting(item.claim, *item.evidence) for item in verification.results)

    def recall(self, claim: Claim) -> Evidence | None:
        """The evidence of a claim from an earlier run."""
        if self._fresh or not self._open:
            return None
        key = self._key(claim)
        if key not in self._recalled:
            evidence = read_evidence(self._cache.read(key))
            if evidence is None or not _lasting(claim, evidence):
                return None
            self._recalled[key] = evidence
        return self._recalled[key]

    def keep(self, claim: Claim, evidence: Evidence, read: Sequence[str] = ()) -> None:
        """Keep the evidence of a claim whose proof has read these files."""
        if _lasting(claim, evidence) and set(read) <= set(self._files) and self._unchanged():
            self._cache.write(self._key(claim), written_evidence(evidence))
        else:
            self._whole = False

    def recall_said(self, *about: str) -> Any:
        """What was kept of this by the same version of everything, as plain data; whatever became of the files."""
        return None if self._fresh else self._cache.read(hashes.of_texts(["said", self._environment, *about]))

    def keep_said(self, data: Any, *about: str) -> None:
        """Keep what depends on nothing but this and the version of everything."""
        self._cache.write(hashes.of_texts(["said", self._environment, *about]), data)

    def value(self, name: str, make: Callable[[], Any]) -> Any:
        """What ``make`` says of this state of every file, as plain data: from an earlier run where that is known."""
        known = self.known(name)
        if known is None:
            known = make()
            if self._unchanged():
                self._cache.write(self._value_key(name), known)
        return known

    def known(self, name: str) -> Any:
        """The value of that name, where :meth:`value` has it from an earlier run; None elsewhere."""
        return None if self._fresh or not self._open else self._cache.read(self._value_key(name))

    @property
    def files(self) -> tuple[str, ...]:
        """Every file that what was loaded depends on."""
        return tuple(self._files)

    def _unchanged(self) -> bool:
        """Whether the files are as they were when they were loaded; looked at from time to time."""
        if self._open and time.monotonic() > self._looked + _LOOK:
            self._open = all(hashes.of_file(file) == digest for file, digest in self._files.items())
            self._open = self._open and set(hashes.of_derivation(self._paths)) <= set(self._files)
            self._looked = time.monotonic()
        return self._open

    def _key(self, claim: Claim) -> str:
        if self._said[0] != self._files:
            files = (f"{Path(file).name} {digest}" for file, digest in sorted(self._files.items()))
            self._said = dict(self._files), "\0".join(files)
        return hashes.of_texts([self._environment, claim.id, claim.content, self._said[1]])

    def _value_key(self, name: str) -> str:
        files = (f"{file} {self._files[file]}" for file in sorted(self._files))
        return hashes.of_texts([name, self._environment, *files])

    def _key_of(self, *what: str) -> str:
        return hashes.of_texts([*what, self._environment, *map(str, self._paths)])


def _lasting(claim: Claim, evidence: Evidence, *others: Evidence) -> bool:
    """Whether another run would come to the same: what was left open may be for want of time, unless it is expected."""
    from ptproof.proof.answering import CRASH, INTERRUPTED, TIME
    from ptproof.proof.verdict import Verdict

    if any(item.engine in (CRASH, TIME, INTERRUPTED, "mismatch") for item in (evidence, *evidence.besides, *others)):
        return False
    return evidence.verdict is not Verdict.UNDECIDED or claim.expected is Verdict.UNDECIDED


def written_evidence(evidence: Evidence) -> dict[str, Any]:
    """Evidence as plain data, with nothing that only its proof needed."""
    from ptproof.proof.verdict import Verdict

    def kept(items: list[tuple[str, Any]]) -> dict[str, Any]:
        plain = {name: str(value) if isinstance(value, Verdict) else value for name, value in items}
        return {name: value for name, value in plain.items() if name not in ("found", "suspect", "certifies")}

    return asdict(evidence, dict_factory=kept)


def read_evidence(data: Any) -> Evidence | None:
    """The evidence that was written, or None for anything else."""
    from ptproof.proof.verdict import Evidence, Verdict, Witness

    try:
        values = dict(data)
        values["verdict"] = Verdict(values["verdict"])
        if values.get("witness") is not None:
            witness = values["witness"]
            values["witness"] = Witness(dict(witness["values"]), str(witness["left"]), str(witness["right"]))
        for name, value in values.items():
            if isinstance(value, list):
                items = [read_evidence(item) for item in value]
                if None in items:
                    return None
                values[name] = tuple(items)
        return Evidence(**values)
    except (TypeError, ValueError, KeyError, AttributeError):
        return None
