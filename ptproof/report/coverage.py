"""Which equations of a paper the claims and definitions of a derivation cover."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol


class Labelled(Protocol):
    """A claim or a definition."""

    @property
    def id(self) -> str: ...

    @property
    def labels(self) -> tuple[str, ...]: ...


@dataclass(frozen=True)
class Coverage:
    """The labels of a paper's equations against the labels that claims and definitions name.

    Attributes
    ----------
    covered
        For each covered label, in the order of the paper, the ids that cover it.
    missing
        The labels that nothing covers.
    stale
        The labels that the derivation names and the paper does not have, with the ids that name them.
    """

    covered: tuple[tuple[str, tuple[str, ...]], ...]
    missing: tuple[str, ...]
    stale: tuple[tuple[str, tuple[str, ...]], ...]

    @property
    def complete(self) -> bool:
        """Whether every equation is covered and every reference exists."""
        return not self.missing and not self.stale

    def to_json(self) -> dict[str, Any]:
        return {"covered": {label: list(ids) for label, ids in self.covered}, "missing": list(self.missing)}


def coverage(labels: Sequence[str], items: Iterable[Labelled], others: Iterable[str] = ()) -> Coverage:
    """Match the equation ``labels`` of a paper with the claims and definitions that name them.

    ``others`` are the paper's labels of figures, theorems and the like: to name them is no mistake.
    """
    named: dict[str, list[str]] = {}
    for item in items:
        for label in item.labels:
            ids = named.setdefault(label, [])
            if item.id not in ids:
                ids.append(item.id)
    printed = tuple(dict.fromkeys(labels))
    known = {*printed, *others}
    return Coverage(
        tuple((label, tuple(named[label])) for label in printed if label in named),
        tuple(label for label in printed if label not in named),
        tuple((label, tuple(ids)) for label, ids in named.items() if label not in known),
    )
