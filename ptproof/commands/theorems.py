"""What is proved beside a run: its enclosure, and a bound for every such vehicle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from ptproof.commands import certified, enclosing

if TYPE_CHECKING:
    from ptproof.problem import Problem


_KINDS: Mapping[str, Any] = {"enclosure": enclosing, "certificate": certified}


@dataclass(frozen=True)
class Theorems:
    """What is asked to be proved beside a run, by kind, and then what was ``found``.

    The kinds are the enclosure of the run and a bound for every such vehicle; what belongs to each is a module.
    """

    wanted: Mapping[str, Any]
    found: dict[str, Any] = field(default_factory=dict)

    @staticmethod
    def asked(width: str | None, certifying: bool, ensemble: int | None, how: dict[str, Any]) -> Theorems:
        """What the options ask for, refused where it does not fit the run."""
        options = {"enclosure": width, "certificate": certifying or None}
        wanted = {kind: asked for kind, asked in options.items() if asked is not None}
        for kind in wanted:
            _KINDS[kind].check(ensemble, how)
        return Theorems(wanted)

    def about(self, target: Problem, how: dict[str, Any]) -> Theorems:
        """With what was found."""
        found = {kind: _KINDS[kind].found(target, asked, how) for kind, asked in self.wanted.items()}
        return replace(self, found=found)

    @property
    def proved(self) -> bool:
        """Whether all of it is."""
        return all(str(item.verdict) == "proved" for item in self.found.values())

    @property
    def data(self) -> dict[str, Any]:
        """As JSON."""
        return {kind: item.to_json() for kind, item in self.found.items()}

    @property
    def words(self) -> list[str]:
        """The lines for people, those about every vehicle first."""
        return [line for kind, item in reversed(self.found.items()) for line in _KINDS[kind].words(item)]

    def draw(self, figure: Any) -> None:
        """Into the picture of the run."""
        for kind, item in self.found.items():
            _KINDS[kind].draw(figure, item)
