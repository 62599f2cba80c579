"""The order of convergence of a system to its average, as an assertion."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.system import DitherSystem, System
from ptproof.testing.failure import SECONDS, assertion
from ptproof.testing.wording import lines

if TYPE_CHECKING:
    from ptproof.simulation.order import GapOrder

__unittest = True


@assertion
def assert_converges_to_average(
    system: DitherSystem | System, average: Any, *, initial: Mapping[Any, Any] | Sequence[Any], end: Any,
    start: Any = 0, omega: sp.Symbol | None = None, values: Mapping[Any, Any] | None = None,
    omegas: Sequence[float] | None = None, order: float | None = None, seconds: float = SECONDS,
) -> str | None:  # fmt: skip
    """Assert that the gap between a system and its average falls with ω as theory says, in simulations.

    This is an observation, not a proof: where a wrong factor leaves a gap that does not fall, it fails.

    Parameters
    ----------
    system
        A :class:`~ptproof.system.DitherSystem`, or a System in which ``omega`` is a parameter.
    average
        A System whose states are among the first's, by name; or a :class:`~ptproof.averaging.Correction`.
    initial
        The system's initial state, in order or by name; the average starts in its part of it.
    start, end
        The interval of time.
    omega
        The symbol of the frequency, for a plain System.
    values
        Values for parameters and undefined functions of both; they may contain ω.
    omegas
        The frequencies, at least three, increasing (100, 200, … 1600 if left out).
    order
        The power of ω that is expected: −1/2 for an average and −1 for a Correction if left out.
    seconds
        The time limit of each simulation. [s]

    Raises
    ------
    AssertionError
        If the gap falls more slowly, with the gap at each ω; or if a run does not get to the end: undecided.
    InputError, TypeError
        If states, parameters or values don't fit.

    Examples
    --------
    >>> import sympy as sp
    >>> from ptproof import System, average, split_dithers
    >>> from ptproof.testing import assert_converges_to_average
    >>> tau, x = sp.symbols("tau x", real=True)
    >>> omega = sp.Symbol("omega", positive=True)
    >>> seeker = System(tau, (x,), (sp.sqrt(omega) * (sp.cos(omega * tau) - x**2 * sp.sin(omega * tau)),))
    >>> averaged = average(split_dithers(seeker, omega))
    >>> assert_converges_to_average(seeker, averaged, initial=[1], end=1, omega=omega, omegas=(100, 400, 1600))
    """
    from ptproof.simulation import Settings
    from ptproof.simulation.order import LADDER, gap_order

    _check(system, average, initial)
    found = gap_order(
        system, average, initial=initial, end=end, start=start, omega=omega, values=values,
        omegas=LADDER if omegas is None else omegas, expected=order, settings=Settings(rtol=1e-9, time_limit=seconds),
    )  # fmt: skip
    return None if found.agrees else _complaint(found)


def _check(system: Any, average: Any, initial: Any) -> None:
    """Bad use is refused before anything is simulated."""
    from ptproof.averaging import Correction

    if not isinstance(system, DitherSystem | System):
        raise TypeError(f"system: expected a DitherSystem or a System, got {type(system).__name__}")
    if not isinstance(average, System | Correction):
        raise TypeError(f"average: expected a System or a Correction, got {type(average).__name__}")
    if isinstance(initial, Sequence) and len(initial) != len(system.state):
        raise InputError(f"initial: {len(initial)} values for {len(system.state)} states; give one for each")


def _complaint(found: GapOrder) -> str:
    """The gap at each ω, and the powers observed and expected."""
    measured = ((rung, gap) for rung, gap in zip(found.omegas, found.gaps, strict=True) if not math.isnan(gap))
    rows = [(f"omega = {rung:g}", f"largest gap {gap:.6g}") for rung, gap in measured]
    if not math.isfinite(found.slope):
        return lines("the order of convergence could not be observed: undecided", [("reason", found.message), *rows])
    rows += [
        ("observed", f"omega**({found.slope:.3f}), and {found.tail:.3f} between the last two"),
        ("expected", f"omega**({found.expected:g})"),
        ("spread", f"standard error {found.spread:.3f} of the exponent"),
    ]
    return lines("the system does not converge to this average at the expected order", rows)
