"""What a simulation gives back: a trajectory, or an ensemble of end states, also as files (CSV, or arrays as NPZ)."""

from __future__ import annotations

import dataclasses
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ptproof.errors import InputError
from ptproof.simulation.drawing import BLUE, RED, new_figure, png
from ptproof.simulation.plan import Array
from ptproof.simulation.settings import Limit, Outcome

ENDINGS = (".csv", ".npz")


def check_name(path: str | Path) -> Path:
    """The file's path, refused unless its ending is one of :data:`ENDINGS` and its folder exists."""
    file = Path(path)
    if file.suffix.lower() not in ENDINGS:
        raise InputError(f"save: {path} should end in {' or '.join(ENDINGS)}")
    if file.is_dir() or not file.resolve().parent.is_dir():
        raise InputError(f"save: {path} can't be written; its folder must exist, and it must not be one")
    return file


def save_columns(path: str | Path, columns: Mapping[str, Any], settings: Mapping[str, Any]) -> None:
    """Write columns (m each) to a CSV file, whose first row has their names, or to an NPZ file, which has the settings
    too, as JSON text under ``settings``.

    Numbers in a CSV file have as many digits as it takes to read them as they were.

    Raises
    ------
    InputError
        For another ending, or a file that can't be written.
    """
    file = check_name(path)
    try:
        if file.suffix.lower() == ".npz":
            arrays: dict[str, Any] = {name: np.asarray(values) for name, values in columns.items()}
            np.savez(file, **arrays, settings=np.array(json.dumps(dict(settings), default=str)))
            return
        with file.open("w", encoding="utf-8", newline="") as out:
            out.write(",".join(columns) + "\n")
            for row in zip(*columns.values(), strict=True):
                # A float of NumPy prints its type too.
                out.write(
                    ",".join(repr(float(v)) if isinstance(v, float | np.floating) else str(v) for v in row) + "\n"
                )
    except OSError as error:
        raise InputError(f"save: {path} can't be written: {error.strerror or error}") from None


def _table(rows: Mapping[str, Any], caption: str = "") -> str:
    return f"<table>{caption}{''.join(f'<tr><td>{k}</td><td>{v}</td></tr>' for k, v in rows.items())}</table>"


@dataclass(frozen=True)
class Trajectory:
    """One run.

    Attributes
    ----------
    t
        Times (m), increasing, in the original time t of a problem, or in the system's own time.
    x
        States (n × m), row i being ``states[i]``.
    states
        The states' names.
    outcome, message
        How it ended, and why if it did not reach T.
    limit
        The option that names the limit that was met, if it was one.
    final_distance
        ‖x − x*‖ at the end for a problem; for a system the norm of its last state.
    tau
        The dilated times (m) of a problem's run, else None.
    field
        F along the run (m) of a problem, else None.
    inputs
        By name: u1 and u2, and for a saturated seeker the angular acceleration a (m each).
    settings
        Everything that repeats the run: seeker, frame, engine, tolerances, parameters.
    seconds
        The wall time of the integration.
    source
        Where the source is along the run (2 × m), for a problem; it may move.

    Examples
    --------
    >>> import ptproof
    >>> run = ptproof.simulate("vanishing")
    >>> print(run.outcome, round(run.final_distance, 3), run["u1"].shape == run.t.shape)
    reached T 0.179 True
    """

    t: Array
    x: Array
    states: tuple[str, ...]
    outcome: Outcome
    final_distance: float
    message: str = ""
    tau: Array | None = None
    field: Array | None = None
    inputs: Mapping[str, Array] = dataclasses.field(default_factory=dict)
    settings: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    seconds: float = 0.0
    limit: Limit | None = None
    source: Array | None = None

    def __post_init__(self) -> None:
        if self.x.shape != (len(self.states), len(self.t)):
            raise ValueError(f"x is {self.x.shape}, expected {(len(self.states), len(self.t))}")

    def __getitem__(self, name: str) -> Array:
        """The samples (m) of the state, or input, ``name``; ``field``, ``distance``, ``t`` and ``tau`` work too."""
        found = self._columns().get(name)
        if found is None:
            known = ", ".join([*self.states, *self.inputs, "t"])
            raise InputError(f"{name!r} is not part of this trajectory (known: {known})")
        return found

    @property
    def distance(self) -> Array | None:
        """‖x − x*‖ along the run (m), for a problem."""
        return None if self.source is None else np.asarray(np.linalg.norm(self.x[:2] - self.source, axis=0))

    @property
    def final(self) -> Mapping[str, float]:
        """The last instant: t, each state, and field and distance where they are known."""
        last = {"t": float(self.t[-1])} | {name: float(self.x[i, -1]) for i, name in enumerate(self.states)}
        if self.field is not None:
            last["field"] = float(self.field[-1])
        return last | {"distance": self.final_distance}

    def save(self, path: str | Path) -> None:
        """Write the samples to a .csv file, a column for each of t, tau, the states, field, distance, the source's
        place and the inputs, or to an .npz file of these arrays; :class:`InputError` where that can't be done."""
        source = () if self.source is None else zip(self.states, self.source, strict=False)
        columns = self._columns({f"source_{name}": row for name, row in source})
        known = {name: values for name, values in columns.items() if values is not None}
        save_columns(path, known, dict(self.settings) | {"outcome": self.outcome, "message": self.message})

    def _columns(self, more: Mapping[str, Array] | None = None) -> dict[str, Array | None]:
        """All samples by name, in the order of a table."""
        times = {"t": self.t, "tau": self.tau} | dict(zip(self.states, self.x, strict=True))
        return times | {"field": self.field, "distance": self.distance} | dict(more or {}) | dict(self.inputs)

    def plot(self, ax: Any = None) -> Any:
        """Draw the path in the plane (two positions), or the states against time; the Matplotlib ``Axes``."""
        ax = new_figure()[1] if ax is None else ax
        if self.field is not None:
            first, second = self.states[:2]
            ax.plot(self.x[0], self.x[1], color=BLUE, lw=1)
            ax.plot(self.x[0, 0], self.x[1, 0], "o", color=BLUE, ms=4, label="start")
            ax.plot(self.x[0, -1], self.x[1, -1], "s", color=RED, ms=4, label=f"end: {self.outcome}")
            ax.set(xlabel=first, ylabel=second)
            ax.set_aspect("equal", adjustable="datalim")
        else:
            for name, samples in zip(self.states, self.x, strict=True):
                ax.plot(self.t, samples, lw=1, label=name)
            ax.set(xlabel="time", ylabel="state")
        ax.legend()
        return ax

    def _repr_png_(self) -> bytes:
        return png(self.plot().figure)

    def _repr_html_(self) -> str:
        caption = f"{self.settings.get('example', 'trajectory')}: {self.outcome}"
        caption += f" ({self.message})" if self.message else ""
        return _table({name: f"{value:.6g}" for name, value in self.final.items()}, f"<caption>{caption}</caption>")

    def __repr__(self) -> str:
        return (
            f"Trajectory({', '.join(self.states)}; {len(self.t)} samples to t = {self.t[-1]:.6g}, "
            f"{self.outcome}, final distance {self.final_distance:.6g})"
        )


@dataclass(frozen=True)
class Ensemble:
    """Many runs' ends.

    Attributes
    ----------
    t, x, outcomes, distances
        End times (N), end states (n × N), outcomes (N) and final distances (N), member by member.
    varied
        What differed, by name: N values each.
    states, settings, seconds
        As for :class:`Trajectory`.

    Examples
    --------
    >>> import ptproof
    >>> many = ptproof.ensemble("vanishing", 5, model="average")
    >>> many.size, dict(many.counts)
    (5, {'reached T': 5})
    """

    t: Array
    x: Array
    states: tuple[str, ...]
    outcomes: tuple[Outcome, ...]
    distances: Array
    varied: Mapping[str, Array]
    settings: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    seconds: float = 0.0

    @property
    def size(self) -> int:
        return len(self.outcomes)

    @property
    def counts(self) -> Mapping[str, int]:
        """How many members ended in each outcome; outcomes that did not occur are left out."""
        return dict(sorted(Counter(str(outcome) for outcome in self.outcomes).items()))

    @property
    def median(self) -> float:
        """The median final distance over all members, wherever they ended."""
        return float(np.median(self.distances))

    @property
    def q95(self) -> float:
        """The 95 % quantile of the final distance."""
        return float(np.quantile(self.distances, 0.95))

    @property
    def max(self) -> float:
        """The largest final distance."""
        return float(np.max(self.distances))

    def save(self, path: str | Path) -> None:
        """Write a row for each member to a .csv file (what differed, t, the states, distance, outcome), or the same as
        arrays to an .npz file; :class:`InputError` where that can't be done."""
        ends = {"t": self.t} | dict(zip(self.states, self.x, strict=True))
        columns = {f"start_{name}": values for name, values in self.varied.items()} | ends
        outcomes = np.array(list(map(str, self.outcomes)))
        save_columns(path, columns | {"distance": self.distances, "outcome": outcomes}, self.settings)

    def plot(self, ax: Any = None) -> Any:
        """A histogram of the final distances; the Matplotlib ``Axes``."""
        ax = new_figure()[1] if ax is None else ax
        finite = self.distances[np.isfinite(self.distances)]
        ax.hist(finite, bins=min(50, max(5, len(finite) // 10)), color=BLUE, alpha=0.7)
        for name, value, style in (("median", self.median, "-"), ("95 %", self.q95, "--")):
            ax.axvline(value, color=RED, ls=style, lw=1, label=f"{name}: {value:.3g}")
        ax.set(xlabel="final distance from the source", ylabel="members")
        ax.legend()
        return ax

    def _repr_png_(self) -> bytes:
        return png(self.plot().figure)

    def _repr_html_(self) -> str:
        distances = {f"distance, {name}": f"{getattr(self, name):.6g}" for name in ("median", "q95", "max")}
        rows: dict[str, Any] = {"members": self.size, **self.counts, **distances}
        return _table(rows)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {word}" for word, count in self.counts.items())
        return f"Ensemble({self.size}: {counts}; distance median {self.median:.4g}, max {self.max:.4g})"
