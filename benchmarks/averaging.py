"""How averaging grows with the number of states: ``python -m benchmarks.averaging [LARGEST]``."""

from __future__ import annotations

import itertools
import sys
import time
from collections.abc import Callable, Iterator

import sympy as sp

from ptproof.averaging.average import derive
from ptproof.system import DitherSystem

Field = Callable[[tuple[sp.Symbol, ...]], sp.Expr]

FIELDS: dict[str, Field] = {
    "undefined F": lambda x: sp.Function("F", real=True)(*x),
    "polynomial": lambda x: -sum(s**2 for s in x) / 2 + sum(a * b for a, b in itertools.pairwise(x)) / 4,
    "transcendental": lambda x: sum(sp.cos(2 * sp.pi * s / 3) / 2 - s**2 / 2 for s in x) + sp.exp(-(x[0] ** 2)),
}


def seeker(n: int, field: Field) -> DitherSystem:
    """n states with 2n dithers: ẋ_i = √(mω) (cos(kF) cos(mθ) + sin(kF) sin(mθ)), m = i, each pair at a frequency."""
    tau, theta = sp.symbols("tau theta", real=True)
    omega, k = sp.symbols("omega k", positive=True)
    x = sp.symbols(f"x1:{n + 1}", real=True)
    measured = k * field(x)
    fields, dithers = [], []
    for i in range(n):
        for wave in (sp.cos, sp.sin):
            value = sp.sqrt(i + 1) * wave(measured)
            fields.append(tuple(value if row == i else sp.S.Zero for row in range(n)))
            dithers.append(wave((i + 1) * theta))
    return DitherSystem(tau, theta, omega, x, (0,) * n, tuple(fields), tuple(dithers))


def measure(sizes: tuple[int, ...]) -> Iterator[tuple[str, int, int, float]]:
    """(kind of field, n, brackets that enter, seconds) for each kind and size."""
    for kind, field in FIELDS.items():
        for n in sizes:
            system = seeker(n, field)
            start = time.perf_counter()
            derived = derive(system)
            yield kind, n, len(derived.brackets), time.perf_counter() - start


def main() -> None:
    """Print the table."""
    from rich.console import Console
    from rich.table import Table

    largest = int(sys.argv[1]) if len(sys.argv) > 1 else 64
    sizes = tuple(2**power for power in range(11) if 2**power <= largest)
    derive(seeker(1, FIELDS["undefined F"]))  # imports and first use are not what is measured
    table = Table(box=None, pad_edge=False)
    for column in ("field", "n", "dithers", "brackets", "seconds", "ms per bracket"):
        table.add_column(column, justify="right")
    for kind, n, brackets, seconds in measure(sizes):
        table.add_row(kind, str(n), str(2 * n), str(brackets), f"{seconds:.3f}", f"{1000 * seconds / brackets:.1f}")
    Console().print(table)


if __name__ == "__main__":
    main()
