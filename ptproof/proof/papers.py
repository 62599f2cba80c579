"""The papers whose derivations some paths name: a folder each, loaded, decided and remembered apart from the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ptproof.proof.load import files_of
from ptproof.proof.shipped import shipped


@dataclass(frozen=True)
class Paper:
    """The derivation of one paper: the name of its folder, and that folder or those of its files that are meant."""

    name: str
    paths: tuple[Path, ...]


def papers_of(paths: Sequence[str | Path] = ()) -> tuple[Paper, ...]:
    """The papers below the paths (the shipped ones where left out), in their order; each has a name of its own.

    Files of one folder are one paper. A folder of folders is as many as it holds. The second of two folders of one
    name is called ``name-2``.

    Raises
    ------
    InputError
        If a path does not exist, or holds no Python file.

    Examples
    --------
    >>> [paper.name for paper in papers_of()]
    ['newton_seeker', 'pt_seeker']
    """
    found: dict[Path, list[Path]] = {}
    for path in map(Path, paths or (shipped(),)):
        for folder in dict.fromkeys(file.parent for file in files_of([path])):
            whole = path.is_dir()
            same = not whole or path.resolve() == folder
            found.setdefault(folder, []).append(path if same else folder)
    names: list[str] = []
    for folder in found:
        alike = [folder.name, *(f"{folder.name}-{number}" for number in range(2, len(found) + 1))]
        names.append(next(name for name in alike if name not in names))
    return tuple(Paper(name, tuple(chosen)) for name, chosen in zip(names, found.values(), strict=True))
