"""The average of a dither system, as an assertion."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.limits import OutOfTime, within
from ptproof.system import DitherSystem, System
from ptproof.testing.failure import assertion
from ptproof.testing.reading import expression
from ptproof.testing.wording import lines, simplest, witness_text

__unittest = True
SECONDS = 60.0


@assertion
def assert_average(
    system: Any, expected: Any, *, omega: sp.Symbol | None = None, assuming: Collection[str] = (),
    seconds: float = SECONDS,
) -> str | None:  # fmt: skip
    """Assert that Lie bracket averaging of ``system`` gives ``expected``, and that its theorem applies.

    Parameters
    ----------
    system
        A :class:`~ptproof.system.DitherSystem`; a :class:`~ptproof.averaging.DitherProblem`, which may have fast
        states; a :class:`~ptproof.averaging.PoweredSystem` or a :class:`~ptproof.averaging.PoweredProblem`; or a
        :class:`~ptproof.system.System` together with ``omega``.
    expected
        The averaged right-hand side: a System in the same states, or n expressions, each SymPy or text. Text may
        use the names of the system's symbols and undefined functions, and ``Derivative(F(x), x)``.
    omega
        The frequency of a plain System, the symbol that stands in it.
    assuming
        Letters of assumptions of the theorem (``"E"``, …) that are taken on trust where they are undecided.
    seconds
        The time limit. [s]

    Raises
    ------
    AssertionError
        If the theorem does not cover the system, the average is another one (with the two sides, their difference
        and a witness), or anything is undecided.
    InputError, TypeError
        For bad use, such as another number of entries or an unknown letter.

    Examples
    --------
    >>> from ptproof import System
    >>> from ptproof.testing import assert_average
    >>> tau, x = sp.symbols("tau x", real=True)
    >>> k, omega = sp.symbols("k omega", positive=True)
    >>> F = sp.Function("F", real=True)(x)
    >>> rate = sp.sqrt(omega) * (sp.cos(omega * tau) + k * F * sp.sin(omega * tau))
    >>> assert_average(System(tau, (x,), (rate,)), ["k/2*Derivative(F(x), x)"], omega=omega)
    """
    from ptproof.averaging import AveragingRefused, AveragingUndecided, split_dithers, study

    if isinstance(assuming, str):
        assuming = (assuming,)
    wanted = _expected(expected, _plain(system, omega))

    def work() -> Any:
        dithered = split_dithers(system, omega) if isinstance(system, System) and omega is not None else system
        return study(replace(_asked(dithered), expected=tuple(wanted)))

    try:
        found = within(seconds, work)
    except OutOfTime:
        return f"the average could not be decided: no answer in {seconds:g} s"
    except AveragingRefused as reason:
        return lines("the averaging theorem does not cover the system: refused", [("reason", str(reason))])
    except AveragingUndecided as reason:
        return lines("the average could not be decided: undecided", [("reason", str(reason))])
    return _complaint(found, wanted, assuming)


def _complaint(found: Any, wanted: Sequence[sp.Expr], assuming: Collection[str]) -> str | None:
    """What speaks against the average ``found``, with the assumptions ``assuming`` taken on trust."""
    from ptproof.proof.verdict import Verdict

    if unknown := set(assuming) - set(found.ledger.entries):
        known = ", ".join(found.ledger.entries)
        raise InputError(f"assuming: {sorted(unknown)[0]!r} is not an assumption of the theorem; they are {known}")
    if found.refusals:
        rows = [("reason", text) for text in found.refusals]
        return lines("the averaging theorem does not cover the system: refused", rows)
    trusted = tuple(f"{letter}: {found.ledger.entries[letter].detail}" for letter in assuming)
    open_ones = [text for text in found.caveats if text not in trusted]
    if found.system is None or found.expected is None:
        return lines("the average could not be decided: undecided", [("reason", text) for text in found.caveats])
    if found.expected.verdict is not Verdict.PROVED:
        return _differs(found.system, wanted, found.expected)
    if open_ones:
        title = "the average is as expected, but the theorem's assumptions could not all be shown: undecided"
        return lines(title, [*(("open", text) for text in open_ones),
                             ("to accept", "name its letter in assuming=(...)")])  # fmt: skip
    return None


def _differs(system: System, wanted: Sequence[sp.Expr], evidence: Any) -> str:
    from ptproof.proof.verdict import Verdict

    refuted = evidence.verdict is Verdict.REFUTED
    title = (
        "the average is not the expected one" if refuted else "the average could not be shown to be the expected one"
    )
    rows = []
    for symbol, derived, entry in zip(system.state, system.rhs, wanted, strict=True):
        difference = simplest(entry - derived)
        if difference == 0:
            continue
        rate = f"d{symbol}/d{system.time}"
        rows += [(f"{rate} derived", str(derived)), (f"{rate} expected", str(entry)),
                 ("difference", f"{difference}  (expected - derived)")]  # fmt: skip
    rows.append(("witness", witness_text(evidence.witness, "derived", "expected")))
    if not refuted:
        rows.append(("tried", f"{evidence.engine}: {evidence.detail}"))
    return lines(f"{title}: {evidence.verdict}", rows)


def _asked(system: Any) -> Any:
    """The problem without a claimed average."""
    from ptproof.averaging import DitherProblem, PoweredProblem, PoweredSystem

    if isinstance(system, PoweredSystem):
        return PoweredProblem(system)
    return system if isinstance(system, DitherProblem | PoweredProblem) else DitherProblem(system)


def _plain(system: Any, omega: sp.Symbol | None) -> Any:
    """The object whose time, states and symbols the expected average may use; bad use is refused here."""
    from ptproof.averaging import DitherProblem, PoweredProblem, PoweredSystem

    if isinstance(system, PoweredProblem):
        system = system.system
    if isinstance(system, PoweredSystem):
        return system.plain
    if isinstance(system, DitherProblem):
        return system.system
    if isinstance(system, DitherSystem):
        return system
    if isinstance(system, System):
        if not isinstance(omega, sp.Symbol):
            raise InputError("omega: a plain System needs the symbol of its frequency, as in omega=w")
        if omega not in (system.parameters or ()):
            raise InputError(f"omega: {omega} does not occur in {system.name}")
        return system
    raise TypeError(f"system: expected a DitherSystem, a DitherProblem or a System, got {type(system).__name__}")


def _expected(expected: Any, system: Any) -> list[sp.Expr]:
    if isinstance(expected, System):
        if expected.state != system.state:
            raise InputError(f"expected: its states are {_listed(expected.state)}, not {_listed(system.state)}")
        if expected.time != system.time:
            raise InputError(f"expected: it runs in {expected.time}, the system in {system.time}")
        return list(expected.rhs)
    entries = [expected] if isinstance(expected, str | sp.Expr | int) else expected
    if isinstance(entries, sp.MatrixBase):
        entries = list(entries)
    if not isinstance(entries, Sequence):
        raise TypeError(f"expected: a System or a sequence of expressions is needed, got {type(expected).__name__}")
    if len(entries) != len(system.state):
        raise InputError(f"expected: {len(entries)} entries for the states {_listed(system.state)}; give one for each")
    names = _names(system)
    return [expression(entry, f"expected[{i}]", names) for i, entry in enumerate(entries)]


def _listed(symbols: Sequence[sp.Symbol]) -> str:
    return ", ".join(symbol.name for symbol in symbols)


def _names(system: Any) -> Mapping[str, Any]:
    """By name: every symbol and undefined function of the system."""
    vectors = [system.rhs] if isinstance(system, System) else [system.drift, system.dithers, *system.fields]
    names: dict[str, Any] = {symbol.name: symbol for symbol in (system.time, *system.state)}
    for entry in (entry for vector in vectors for entry in vector):
        names |= {symbol.name: symbol for symbol in entry.free_symbols}
        names |= {applied.func.__name__: applied.func for applied in entry.atoms(sp.core.function.AppliedUndef)}
    return names
