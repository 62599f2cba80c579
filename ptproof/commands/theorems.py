"""What is proved beside a run: its enclosure, and a bound for every such vehicle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ptproof.commands import certified, enclosing

if TYPE_CHECKING:
    from ptproof.certify import LoopCertificate
    from ptproof.certify.trajectory import Enclosure
    from ptproof.problem import Problem


@dataclass(frozen=True)
class Theorems:
    """What is asked to be proved beside a run, and then what was: its enclosure, and a bound for every such vehicle."""

    width: str | None = None
    certifying: bool = False
    enclosure: Enclosure | None = None
    certificate: LoopCertificate | None = None

    @staticmethod
    def asked(width: str | None, certifying: bool, ensemble: int | None, how: dict[str, Any]) -> Theorems:
        """What the options ask for, refused where it does not fit the run."""
        if width is not None:
            enclosing.check(ensemble, how)
        if certifying:
            certified.check(ensemble, how)
        return Theorems(width, certifying)

    def about(self, target: Problem, how: dict[str, Any]) -> Theorems:
        """With what was found."""
        return replace(
            self, enclosure=None if self.width is None else enclosing.enclosed(target, self.width, how),
            certificate=certified.certified(target) if self.certifying else None,
        )  # fmt: skip

    @property
    def proved(self) -> bool:
        """Whether all of it is."""
        found = (item for item in (self.enclosure, self.certificate) if item is not None)
        return all(str(item.verdict) == "proved" for item in found)

    @property
    def data(self) -> dict[str, Any]:
        """As JSON."""
        found = {"enclosure": self.enclosure, "certificate": self.certificate}
        return {name: item.to_json() for name, item in found.items() if item is not None}

    @property
    def words(self) -> list[str]:
        """The lines for people."""
        rows = [] if self.enclosure is None else enclosing.words(self.enclosure)
        return rows if self.certificate is None else [*certified.words(self.certificate), *rows]

    def draw(self, figure: Any) -> None:
        """Into the picture of the run."""
        if self.enclosure is not None:
            enclosing.draw(figure, self.enclosure)
        if self.certificate is not None:
            certified.draw(figure, self.certificate)
