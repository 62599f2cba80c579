"""Every condition and bound that the data allow, as one value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ptproof.gains.data import GainData
from ptproof.gains.entries import ENTRIES
from ptproof.gains.numbers import NotApplicable, Quantity, Unlimited


@dataclass(frozen=True)
class Gains:
    """The answer: for each section and each of its keys a quantity, or the reason why there is none.

    Attributes
    ----------
    values
        Section to key to :class:`Quantity` or None.
    why
        ``"section.key"`` to the reason, for every None.
    unlimited
        Those of them that are thresholds above every value.
    """

    data: GainData
    values: Mapping[str, Mapping[str, Quantity | None]]
    why: Mapping[str, str]
    unlimited: frozenset[str] = frozenset()

    def __getitem__(self, key: str) -> Quantity | None:
        section, name = key.split(".")
        return self.values[section][name]

    def to_json(self) -> dict[str, Any]:
        """Sections of ``{"exact", "value"}`` or null, ``why``, and whose property each is (``about``)."""
        sections = {
            section: {key: None if value is None else value.to_json() for key, value in entries.items()}
            for section, entries in self.values.items()
        }
        about = {f"{section}.{key}": entry.about for section, table in ENTRIES.items() for key, entry in table.items()}
        return {**sections, "why": dict(self.why), "about": about}


def gains(data: GainData) -> Gains:
    """Every condition and bound of the paper for these data, exact, and the sharper ones beside them.

    A key without ``_printed`` holds the best that is proved here where the two differ; the printed formula stands
    beside it. Nothing is simulated. A key that does not apply is None, with the reason in ``why``.

    Raises
    ------
    InputError
        If a sign that decides between formulas cannot be decided.

    Examples
    --------
    >>> from ptproof.problem.field import FieldBounds
    >>> answer = gains(GainData(FieldBounds(1, 2, 1, 1, 2), k=1, T=1, drift_norm=1))
    >>> answer["asymptotic.k_min_printed"].exact, answer["asymptotic.k_min"].exact
    (16, 2)
    """
    why: dict[str, str] = {}
    unlimited: set[str] = set()
    values: dict[str, Mapping[str, Quantity | None]] = {}
    for section, entries in ENTRIES.items():
        found: dict[str, Quantity | None] = {}
        for key, entry in entries.items():
            try:
                found[key] = Quantity(entry.compute(data))
            except NotApplicable as reason:
                found[key] = None
                why[f"{section}.{key}"] = str(reason)
                if isinstance(reason, Unlimited):
                    unlimited.add(f"{section}.{key}")
        values[section] = MappingProxyType(found)
    return Gains(data, MappingProxyType(values), MappingProxyType(why), frozenset(unlimited))
