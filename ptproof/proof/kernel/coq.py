"""Coq as a process: the library that ships here is compiled, theorems are checked, what was printed is read."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

# The parts of the library, each after those that it builds upon. They are compiled as one file: most of the time that
# Coq takes for a short one goes into reading what it requires.
LIBRARY = ("Base", "Cases", "Comparison", "Smooth", "Powers", "Equations", "Lemmas")
_THEORY = "Theory"
# What a theorem may rest on, and what needs it. Nothing else may be assumed.
AXIOMS: Mapping[str, str] = {
    "ClassicalDedekindReals.sig_forall_dec": "Coq's real numbers",
    "ClassicalDedekindReals.sig_not_dec": "Coq's real numbers",
    "FunctionalExtensionality.functional_extensionality_dep": "Coq's real numbers and Coquelicot",
    "functional_extensionality_dep": "the same by its short name",
    "Classical_Prop.classic": "Coquelicot's limits and integrals, and Flocq below Interval",
    "Eqdep.Eq_rect_eq.eq_rect_eq": "Flocq below Interval",
    "ClassicalEpsilon.constructive_indefinite_description": "Coquelicot's integrals",
}
# The kernel's own machine integers and floats, with which Interval computes: nothing is assumed of the reals.
_MACHINE = re.compile(r"(PrimInt63|Uint63|Uint63Axioms|PrimFloat|FloatAxioms|FloatOps|Sint63)\.\w+|(int|float)")
_OPTIONS = ("-q", "-w", "none", "-Q", ".", "Ptproof")
_KEPT = "kept"  # what has been proved so far
_PACKAGES = "coq, libcoq-coquelicot and libcoq-interval (on Debian and Ubuntu: apt install them)"


@dataclass(frozen=True)
class Theorem:
    """A proposition by name, and the tactics that are to prove it."""

    name: str
    text: str
    script: str

    @property
    def proof(self) -> str:
        return f"proof_of_{self.name}"


@dataclass(frozen=True)
class Refusal:
    """Why Coq did not accept a theorem; ``late`` if for want of time: another run may come to something else."""

    reason: str
    late: bool = False


@dataclass(frozen=True)
class Printed:
    """What a run of Coq has printed, and whether it was ended at its time limit."""

    output: str
    error: str
    late: bool

    def stopped(self, theorem: Theorem) -> Refusal | None:
        """Why Coq did not accept the theorem; None if it was ended before it came to it."""
        prompts = re.split(r"^(\w+) < ", self.error, flags=re.MULTILINE)
        inside = [text for name, text in zip(prompts[1::2], prompts[2::2], strict=False) if name == theorem.proof]
        if not inside:
            # Its proposition was not taken, so that Coq does not know it when the theorem states it.
            before, missed, _ = self.error.partition(f"> Theorem {theorem.proof} ")
            said = before.rpartition("Toplevel input")[0].rpartition("Error:")[2]
            return Refusal(f"Coq does not take it: {_shortened(said)}") if missed else None
        error = "".join(inside).partition("Error:")[2].partition("\n\nToplevel input")[0]
        if "Timeout!" in error or (not error and self.late):
            return Refusal("time limit", late=True)
        if found := re.search(r"Tactic failure: +at (.*)", error, re.DOTALL):
            return Refusal(f"no tactic proved {_shortened(found[1]).removesuffix('.')}")
        if error and "actic" not in error and "incomplete proof" not in error:
            return Refusal(f"Coq does not take it: {_shortened(error)}")
        return Refusal("no tactic proved it")


def _shortened(text: str) -> str:
    return " ".join(text.split()).removesuffix("Coq <").strip()[:300]


def missing() -> str:
    """What has to be installed before Coq can be asked; empty if nothing."""
    coqc = shutil.which("coqc")
    if coqc is None:
        return f"coq is not installed; it takes {_PACKAGES}"
    where = subprocess.run([coqc, "-where"], capture_output=True, text=True, check=False).stdout.strip()
    for library in ("Coquelicot", "Interval"):
        if not (Path(where) / "user-contrib" / library).is_dir():
            return f"Coq's library {library} is not installed; it takes {_PACKAGES}"
    return ""


def prepare(folder: Path) -> None:
    """Put the library of definitions, lemmas and tactics into ``folder``, compiled.

    Raises
    ------
    RuntimeError
        If Coq refuses it: it is another version than the one that this was written for.
    """
    for file in Path(_compiled().name).iterdir():
        shutil.copy2(file, folder / file.name)


_made: list[tempfile.TemporaryDirectory[str]] = []


def forget() -> None:
    """Remove the compiled library; it is compiled again where it is needed."""
    while _made:
        _made.pop().cleanup()


def _compiled() -> tempfile.TemporaryDirectory[str]:
    """A folder with the compiled library, made once in a process."""
    if _made:
        return _made[0]
    made = tempfile.TemporaryDirectory(prefix="ptproof-coq-")
    folder = Path(made.name)
    parts = (Path(__file__).parent / "theory" / f"{name}.v" for name in LIBRARY)
    text = "".join(part.read_text(encoding="utf-8") for part in parts)
    (folder / f"{_THEORY}.v").write_text(text, encoding="utf-8")
    done = _run(["coqc", *_OPTIONS, f"{_THEORY}.v"], folder, None, 300)
    if done.error or done.late:
        said = done.error.strip() or "time limit"
        raise RuntimeError(f"Coq refuses the library of tactics ({', '.join(LIBRARY)}, as one file): {said}")
    _made.append(made)
    return made


@cache
def version() -> str:
    """What Coq says that it is."""
    return subprocess.run(["coqc", "--version"], capture_output=True, text=True, check=True).stdout


class Stop:
    """Whether Coq is to be stopped; once it is set, every process that was started with it is ended, and none more."""

    def __init__(self) -> None:
        self._lock, self._processes, self._set = threading.Lock(), set[int](), False

    def is_set(self) -> bool:
        """Whether it is set."""
        return self._set

    def set(self) -> None:
        """End the processes, at once: this one may end before it could wait for them."""
        with self._lock:
            self._set = True
            for process in self._processes:
                _kill(process)

    @contextlib.contextmanager
    def ending(self, process: int) -> Iterator[None]:
        """While the process runs."""
        with self._lock:
            self._processes.add(process)
            if self._set:
                _kill(process)
        try:
            yield
        finally:
            with self._lock:
                self._processes.discard(process)


def _kill(process: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)


def ask(folder: Path, file: str, seconds: float, stop: Stop | None = None) -> Printed:
    """Have Coq read the file as if it were typed, in the folder of the library: a failure costs one theorem.

    It is ended at its time limit, or once ``stop`` is set.
    """
    return _run(["coqtop", *_OPTIONS], folder, file, seconds, stop)


def _run(command: list[str], folder: Path, typed: str | None, seconds: float, stop: Stop | None = None) -> Printed:
    """The output of a process of Coq, which ends with every process of it at the time limit."""
    with (
        open(folder / typed if typed else os.devnull, "rb") as source,
        subprocess.Popen(
            command, cwd=folder, stdin=source, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            encoding="utf-8", errors="replace", start_new_session=True,
        ) as process,
        (stop or Stop()).ending(process.pid),
    ):  # fmt: skip
        late = False
        try:
            output, error = process.communicate(timeout=seconds)
        except BaseException as reason:
            _kill(process.pid)
            output, error = process.communicate()
            late = True
            if not isinstance(reason, subprocess.TimeoutExpired):
                raise
    late = late or (stop is not None and stop.is_set())
    return Printed(output, error if typed or process.returncode or late else "", late)


def source(theorems: Sequence[Theorem], seconds: float) -> str:
    """A file in which each theorem states its proposition, proves it and prints what it says.

    What is proved is kept in one conjunction, whose axioms are printed at the end: Coq takes a second or two to find
    those of a theorem, however short, and no longer for those of all.
    """
    lines = ["From Coq Require Import Reals Lra Psatz Nsatz.", "From Coquelicot Require Import Coquelicot.",
             f"From Ptproof Require Import {_THEORY}.", "Open Scope R_scope.",
             "Set Printing Depth 100000.",  # otherwise a long conjunction is printed without its beginning
             "", f"Definition {_KEPT}_0 := I."]  # fmt: skip
    for number, theorem in enumerate(theorems, start=1):
        lines += [
            f"Definition {theorem.name} : Prop :=\n  {theorem.text}.\n",
            f"Theorem {theorem.proof} : {theorem.name}.",
            f"Proof. unfold {theorem.name}. Timeout {max(1, round(seconds))} ({theorem.script}). Qed.",
            "Abort All.",  # after a proof that failed; otherwise an error that nobody reads
            f"Check {theorem.proof}.",
            f"Definition {_KEPT}_{number} := conj {_KEPT}_{number - 1} {theorem.proof}.",
            # Refused where the line above was taken, which it is if there is a proof.
            f"Definition {_KEPT}_{number} := {_KEPT}_{number - 1}.\n",
        ]
    last = f"{_KEPT}_{len(theorems)}"
    return "\n".join([*lines, f"Check {last}.", f"Print Assumptions {last}.\n"])


def proved(output: str, theorems: Sequence[Theorem]) -> dict[str, str]:
    """By the name of each theorem of which Coq has a proof: nothing, or that it is of something else."""
    asked = {theorem.proof: theorem for theorem in theorems}
    found: dict[str, str] = {}
    for stated, said, _ in _checked(output):
        if (theorem := asked.get(stated)) is not None:
            other = said != theorem.name or theorem.name in found
            found[theorem.name] = "what Coq proved is not what was asked" if other else ""
    return found


def heard(output: str, theorems: Sequence[Theorem]) -> dict[str, str]:
    """By the name of each theorem that the kernel has accepted: nothing, or what speaks against it.

    The kernel has printed the name and the proposition of each, the conjunction of those that it has kept, and the
    axioms of that; all are looked at. An axiom of one speaks against all that stand beside it.
    """
    kept = [(said, rest) for stated, said, rest in _checked(output) if stated == f"{_KEPT}_{len(theorems)}"]
    if len(kept) != 1 or (reason := _against(kept[0][1])) is None:
        return {}
    names = set(re.findall(r"\w+", kept[0][0]))
    return {name: found or reason for name, found in proved(output, theorems).items() if found or name in names}


def _checked(output: str) -> list[tuple[str, str, str]]:
    """What was checked: the name of each proof, the proposition that Coq printed, and what it printed after that."""
    text = re.sub(r"^Fetching opaque proofs .*\n", "", output, flags=re.MULTILINE)
    places = [match.start() for match in re.finditer(rf"^(proof_of_\w+|{_KEPT}_\d+)\s+:", text, re.MULTILINE)]
    parts = [text[start:end] for start, end in zip(places, [*places[1:], len(text)], strict=False)]
    found = []
    for stated, _, rest in (part.partition("\n     : ") for part in parts):
        said, *more = re.split(r"\n(?! )", rest, maxsplit=1)  # a long one goes on in lines that are indented
        found.append((stated.strip(), " ".join(said.split()), "".join(more)))
    return found


def _against(assumed: str) -> str | None:
    """What speaks against a theorem in the list of its axioms; None if the list was not printed."""
    if assumed.startswith("Closed under the global context"):
        return ""
    if not assumed.startswith("Axioms:"):
        return None
    names = re.findall(r"^([A-Za-z_][\w.']*)\s*:", assumed[len("Axioms:") :], re.MULTILINE)
    if foreign := [name for name in names if name not in AXIOMS and not _MACHINE.fullmatch(name)]:
        return f"it or another of its file rests on {', '.join(foreign)}"
    return "" if names else "its axioms cannot be read"
