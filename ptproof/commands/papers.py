"""The papers that a command is about: all of them are loaded before anything is decided of the first."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.commands import options

if TYPE_CHECKING:
    from ptproof.proof.load import Derivation
    from ptproof.proof.memory import Memory


@dataclass(frozen=True)
class Opened:
    """A paper's name and paths, its memory of earlier runs, and its derivation, or what is known without loading it."""

    name: str
    paths: tuple[Path, ...]
    memory: Memory
    derivation: Derivation | None
    known: Any = None


@contextmanager
def opened(
    paths: tuple[str, ...], fresh: bool = False, select: str = "", known: Callable[[Memory], Any] = lambda memory: None
) -> Iterator[tuple[Opened, ...]]:
    """The papers below the paths that hold a claim that contains ``select``.

    ``known`` says what an earlier run has left of a paper; where that is not None, nothing is loaded of it.

    Raises
    ------
    InputError
        If a paper cannot be loaded, or none of them holds such a claim.
    """
    from ptproof.proof.load import NoClaims
    from ptproof.proof.papers import papers_of
    from ptproof.proof.run import NothingSelected

    papers, found = papers_of(paths), []
    several = len(papers) > 1
    with ExitStack() as stack:
        for paper in papers:
            memory = options.memory_of(tuple(map(str, paper.paths)), fresh)
            if (kept := known(memory)) is not None:
                found.append(Opened(paper.name, paper.paths, memory, None, kept))
                continue
            if several and memory.lacks(select):
                continue
            try:
                derivation = stack.enter_context(options.loaded(tuple(map(str, paper.paths)), memory, select))
            except NoClaims:
                if several:  # a folder of helpers beside the papers
                    continue
                raise
            if not several or derivation.select(select):
                found.append(Opened(paper.name, paper.paths, memory, derivation))
        if not found:
            raise NothingSelected(f"no claim of {', '.join(paper.name for paper in papers)} contains {select!r}")
        yield tuple(found)


def shared(ids: Mapping[str, list[str]]) -> set[str]:
    """The ids that stand in more than one of the papers."""
    every = [id for found in ids.values() for id in set(found)]
    return {id for id in every if every.count(id) > 1}


def qualified(id: str, paper: str, shared: set[str]) -> str:
    """The id as it is shown beside those of other papers: with the name of its own where another has the same."""
    return f"{paper}:{id}" if id in shared else id
