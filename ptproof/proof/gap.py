"""Gaps: displayed formulas of a paper of which nothing is stated yet."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ptproof.proof.claim import labels_of


@dataclass(frozen=True)
class Gap:
    """A displayed formula of a paper of which nothing is stated yet, and why.

    It covers no label and decides nothing: it is there to be counted, and to be replaced by a claim.
    """

    id: str
    place: str
    line: int
    latex: str
    why: str
    labels: tuple[str, ...] = ()


def gap(id: str, place: str, line: int, latex: str, why: str, *, labels: Iterable[str] = ()) -> Gap:
    """A formula of which nothing is stated yet: where it stands, its LaTeX, and why it was not read.

    >>> gap("3/rates", "Section 3 (2)", 41, r"\\ddot{x} = -x", r"\\ddot is not known").place
    'Section 3 (2)'
    """
    return Gap(id, place, line, latex, why, labels_of(id, labels))
