"""Coq as a process: the library that ships here compiled once a run, files of theorems checked, what was printed read."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

# What the theorems may rest on, and what needs it. Nothing else may be assumed.
AXIOMS: Mapping[str, str] = {
    "ClassicalDedekindReals.sig_forall_dec": "Coq's real numbers",
    "ClassicalDedekindReals.sig_not_dec": "Coq's real numbers",
    "FunctionalExtensionality.functional_extensionality_dep": "Coq's real numbers, as functions, and Coquelicot",
    "Classical_Prop.classic": "Coquelicot's limits and derivatives",
    "Eqdep.Eq_rect_eq.eq_rect_eq": "Interval, through Flocq",
}
_PACKAGES = "coq, libcoq-coquelicot and libcoq-interval (Debian and Ubuntu: apt install them)"


@dataclass(frozen=True)
class Theorem:
    """A proposition by name, the propositions that it may use, and the tactics that are to prove it."""

    name: str
    text: str
    script: str
    uses: tuple[str, ...] = ()

    @property
    def proof(self) -> str:
        return f"proof_of_{self.name}"


@dataclass(frozen=True)
class Said:
    """What Coq said of one theorem: nothing against it, or why not."""

    reason: str = ""


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
    """Write the library of definitions, lemmas and tactics into ``folder`` and compile it."""
    source = Path(__file__).with_name("theory.v").read_text(encoding="utf-8")
    (folder / "Theory.v").write_text(source, encoding="utf-8")
    done = subprocess.run(command("Theory.v"), cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"Coq refuses the library of tactics: {done.stderr.strip()}")


def command(file: str) -> list[str]:
    """How a file is checked, in the folder of the library."""
    return ["coqc", "-q", "-w", "none", "-Q", ".", "Ptproof", file]


def source(propositions: Mapping[str, str], theorems: Sequence[Theorem], seconds: int) -> str:
    """A file in which each theorem states its proposition, proves it and prints what it says and what it rests on."""
    lines = ["From Coq Require Import Reals Lra Psatz Nsatz.", "From Coquelicot Require Import Coquelicot.",
             "From Ptproof Require Import Theory.", "Open Scope R_scope.", ""]  # fmt: skip
    wanted = dict.fromkeys(name for theorem in theorems for name in (*theorem.uses, theorem.name))
    lines += [f"Definition {name} : Prop :=\n  {propositions[name]}.\n" for name in wanted]
    for theorem in theorems:
        lines += [
            f"Theorem {theorem.proof} : {' -> '.join((*theorem.uses, theorem.name))}.",
            f"Proof. Timeout {seconds} ({theorem.script}). Qed.",
            f"Check {theorem.proof}.",
            f"Print Assumptions {theorem.proof}.",
            "",
        ]
    return "\n".join(lines)


def heard(output: str, theorems: Sequence[Theorem]) -> Iterator[tuple[Theorem, Said]]:
    """What the printed text says of each theorem that it speaks of, in their order."""
    places = [match.start() for match in re.finditer(r"^proof_of_\w+\s*\n?\s*: ", output, re.MULTILINE)]
    chunks = [output[start:end] for start, end in zip(places, [*places[1:], len(output)], strict=False)]
    for theorem, chunk in zip(theorems, chunks, strict=False):
        said = re.match(r"(proof_of_\w+)\s*:\s*((?:\w+(?:\s*->\s*)?)+)\n", chunk)
        stated = tuple(re.split(r"\s*->\s*", said[2].strip())) if said else ()
        if said is None or said[1] != theorem.proof or stated != (*theorem.uses, theorem.name):
            yield theorem, Said("what Coq proved is not what was asked")
            continue
        rest = chunk[said.end() :]
        if "Closed under the global context" in rest:
            yield theorem, Said()
            continue
        if not rest.startswith("Axioms:"):
            return
        assumed = re.findall(r"^([A-Za-z_][\w.']*)\s*:", rest[len("Axioms:") :], re.MULTILINE)
        foreign = [name for name in assumed if name not in AXIOMS]
        yield theorem, Said(f"rests on {', '.join(foreign)}" if foreign or not assumed else "")
