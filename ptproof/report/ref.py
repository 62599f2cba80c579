"""A link to a claim or definition."""

from __future__ import annotations

from dataclasses import dataclass

from ptproof.report.status import Status


@dataclass(frozen=True)
class Ref:
    """A link to a claim or definition."""

    id: str
    anchor: str
    title: str
    status: Status | None
