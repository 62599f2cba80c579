"""Many members: what varies, drawn once from a seed, and blocks of members on threads or on a cluster."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ptproof.errors import InputError
from ptproof.simulation.engines import engine_named
from ptproof.simulation.numbers import as_float, as_floats
from ptproof.simulation.plan import Array, Batch, Engine, Finals, Plan
from ptproof.simulation.sampled import SAMPLED

# A task of a cluster: a multiple of every engine's own group size, so that the numbers stay the same.
_TASK = 64
_LARGEST = 10_000_000
Progress = Callable[[int], None]


def members(size: Any, seed: Any, vary: Mapping[str, Any], known: Sequence[str]) -> dict[str, Array]:
    """The values of what varies, by name (N each).

    Parameters
    ----------
    size, seed
        N, and a non-negative integer. Member i's values depend on the seed, the names and i alone: not on N,
        and not on the number of workers.
    vary
        For each name of a state or parameter: a pair (low, high), drawn uniformly, or N values.
    """
    if isinstance(size, bool) or not isinstance(size, int) or not 1 <= size <= _LARGEST:
        raise InputError(f"size: an ensemble has from 1 to {_LARGEST} members, got {size!r}")
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise InputError(f"seed: expected an integer, 0 or more, got {seed!r}")
    for name in vary:
        if name not in known:
            raise InputError(f"vary: {name!r} is not one of {', '.join(known)}")
    drawn = [name for name, value in vary.items() if isinstance(value, tuple)]
    if not vary:
        return {}
    # One row a member: the first rows are the same for every N.
    uniform = np.random.default_rng(np.random.SeedSequence(seed)).random((size, len(drawn)))
    result: dict[str, Array] = {}
    for name, value in vary.items():
        if isinstance(value, tuple):
            if len(value) != 2:
                raise InputError(f"vary.{name}: expected (low, high) or {size} values")
            low, high = (as_float(bound, f"vary.{name}") for bound in value)
            if low > high:
                raise InputError(f"vary.{name}: low must not be above high, got {low:g} to {high:g}")
            result[name] = low + (high - low) * uniform[:, drawn.index(name)]
        else:
            result[name] = as_floats(value, size, f"vary.{name}")
    return result


def headings(size: int) -> Array:
    """N headings evenly around the circle: 2πi/N."""
    return np.asarray(np.arange(size) * (2 * math.pi / size), dtype=np.float64)


def run_block(engine: str, plan: Plan, batch: Batch, workers: int) -> Finals:
    """One block on one machine; a top-level function, so that a cluster can call it."""
    return engine_for(plan, engine).finals(plan, batch, workers)


def engine_for(plan: Plan, name: str) -> Engine:
    """What carries the plan out: the engine of that name, or what sampled loops are for."""
    return SAMPLED if plan.sampling is not None else engine_named(name)


def run_blocks(
    engine: str, plan: Plan, batch: Batch, workers: int = 1, client: Any = None, progress: Progress | None = None
) -> Finals:
    """All members, in blocks of a fixed size, so that the answer does not depend on who computes which.

    With ``client``, a ``distributed.Client``, each block is a task of that cluster; the scheduler repeats the
    blocks of a worker that is lost.
    """
    size = engine_for(plan, engine).block if client is None else _TASK
    blocks = [batch.slice(i, min(i + size, batch.size)) for i in range(0, batch.size, size)]
    done = progress or (lambda _: None)
    if client is None:
        parts = []
        for block in blocks:
            parts.append(run_block(engine, plan, block, workers))
            done(block.size)
        return Finals.join(parts)
    from distributed import as_completed

    futures = [client.submit(run_block, engine, plan, block, 1, pure=False) for block in blocks]
    sizes = {future.key: block.size for future, block in zip(futures, blocks, strict=True)}
    for future in as_completed(futures):
        done(sizes[future.key])
    return Finals.join(client.gather(futures))
