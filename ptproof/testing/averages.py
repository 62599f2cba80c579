"""The average of a dither system, as an assertion."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.system import DitherSystem, System
from ptproof.testing.failure import SECONDS, assertion, in_time
from ptproof.testing.reading import expression
from ptproof.testing.wording import lines, simplest, witness_text

__unittest = True


@assertion
def assert_average(
    system: Any, expected: Any = None, *, orders: Mapping[int, Any] | None = None, omega: sp.Symbol | None = None,
    assuming: Collection[str] = (), seconds: float = SECONDS,
) -> str | None:  # fmt: skip
    """Assert that averaging ``system`` gives ``expected`` and ``orders``, and that the theorem applies.

    Parameters
    ----------
    system
        A :class:`~ptproof.system.DitherSystem`; a :class:`~ptproof.averaging.DitherProblem`, which may have fast
        states; a :class:`~ptproof.averaging.PoweredSystem` or a :class:`~ptproof.averaging.PoweredProblem`; or a
        :class:`~ptproof.system.System` together with ``omega``.
    expected
        The averaged right-hand side: a System in the same states, or n expressions, each SymPy or text. Text may
        use the names of the system's symbols and undefined functions, and ``Derivative(F(x), x)``. Left out, it is
        what a DitherProblem states itself, as one that is read from a file may.
    orders
        {N: A_N} for orders N from 2 to 12, in the same forms: the averages of dX/dτ = A_1 + A_2/√ω + A_3/ω + …, for
        the change of variables whose correctors have mean 0 over the phase. What a DitherProblem states of others
        is asserted too.
    omega
        The frequency of a plain System, the symbol that stands in it.
    assuming
        Letters of assumptions of the theorem (``"E"``, …) that are taken on trust where they are undecided.
    seconds
        The time limit. [s]

    Raises
    ------
    AssertionError
        If the theorem does not cover the system, an average is another one (with the two sides, their difference
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
    >>> assert_average(System(tau, (x,), (rate,)), ["k/2*Derivative(F(x), x)"], orders={2: [0]}, omega=omega)
    """
    first, higher = _claims(system, expected, orders, omega)
    found = in_time(seconds, "the average", lambda: _studied(system, omega, first, higher))
    if isinstance(found, str):
        return found
    return _complaint(found, (assuming,) if isinstance(assuming, str) else assuming)


def _studied(system: Any, omega: sp.Symbol | None, first: Any, higher: Mapping[int, Any]) -> Any:
    """The averages with what is asserted of them, or why there are none."""
    from ptproof.averaging import AveragingRefused, AveragingUndecided, split_dithers, study

    try:
        dithered = split_dithers(system, omega) if isinstance(system, System) and omega is not None else system
        return study(_asked(dithered, first, higher))
    except AveragingRefused as reason:
        return lines("the averaging theorem does not cover the system: refused", [("reason", str(reason))])
    except AveragingUndecided as reason:
        return lines("the average could not be decided: undecided", [("reason", str(reason))])


def _claims(
    system: Any, expected: Any, orders: Mapping[int, Any] | None, omega: sp.Symbol | None
) -> tuple[tuple[sp.Expr, ...] | None, dict[int, tuple[sp.Expr, ...]]]:
    """What is asserted of the average and of the orders from 2 on, the system's own statements included."""
    from ptproof.averaging import DitherProblem, PoweredProblem
    from ptproof.averaging.problem import check_expected_order

    plain = _plain(system, omega)
    names = _names(system if isinstance(system, DitherProblem) else plain)
    states = isinstance(system, DitherProblem | PoweredProblem)
    first = system.expected if states and expected is None else None
    higher = dict(system.expected_orders) if isinstance(system, DitherProblem) else {}
    if expected is not None:
        first = tuple(_expected(expected, plain, names, "expected"))
    for order, entries in (orders or {}).items():
        check_expected_order(order, "orders")
        higher[order] = tuple(_expected(entries, plain, names, f"orders[{order}]"))
    if first is None and not higher:
        raise InputError("expected: left out, and the system states nothing itself; give the average, or orders")
    return first, higher


def _complaint(found: Any, assuming: Collection[str]) -> str | None:
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
    if found.system is None or found.unexpanded:
        reasons = found.caveats or (found.unexpanded,)
        return lines("the average could not be decided: undecided", [("reason", text) for text in reasons])
    for claim in found.expectations:
        if claim.evidence.verdict is not Verdict.PROVED:
            return _differs(found.system, claim)
    if open_ones:
        title = "the average is as expected, but the theorem's assumptions could not all be shown: undecided"
        return lines(title, [*(("open", text) for text in open_ones),
                             ("to accept", "name its letter in assuming=(...)")])  # fmt: skip
    return None


def _differs(system: System, claim: Any) -> str:
    from ptproof.proof.verdict import Verdict

    evidence = claim.evidence
    refuted = evidence.verdict is Verdict.REFUTED
    what = "the average" if claim.order == 1 else f"the average of order {claim.order}"
    title = f"{what} is not the expected one" if refuted else f"{what} could not be shown to be the expected one"
    rows = []
    for symbol, derived, entry in zip(system.state, claim.derived or (), claim.claimed, strict=False):
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


def _asked(system: Any, first: Any, higher: Mapping[int, Any]) -> Any:
    """The problem with what is asserted of its averages."""
    from ptproof.averaging import DitherProblem, PoweredProblem, PoweredSystem

    if isinstance(system, PoweredSystem | PoweredProblem):
        if higher:
            raise InputError("orders: those in 1/sqrt(omega) are for systems without powers of omega")
        return replace(PoweredProblem(system) if isinstance(system, PoweredSystem) else system, expected=first)
    problem = system if isinstance(system, DitherProblem) else DitherProblem(system)
    return replace(problem, expected=first, expected_orders=higher)


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


def _expected(expected: Any, system: Any, names: Mapping[str, Any], where: str) -> list[sp.Expr]:
    if isinstance(expected, System):
        if expected.state != system.state:
            raise InputError(f"{where}: its states are {_listed(expected.state)}, not {_listed(system.state)}")
        if expected.time != system.time:
            raise InputError(f"{where}: it runs in {expected.time}, the system in {system.time}")
        return list(expected.rhs)
    entries = [expected] if isinstance(expected, str | sp.Expr | int) else expected
    if isinstance(entries, sp.MatrixBase):
        entries = list(entries)
    if not isinstance(entries, Sequence):
        raise TypeError(f"{where}: a System or a sequence of expressions is needed, got {type(expected).__name__}")
    if len(entries) != len(system.state):
        raise InputError(f"{where}: {len(entries)} entries for the states {_listed(system.state)}; give one for each")
    return [expression(entry, f"{where}[{i}]", names) for i, entry in enumerate(entries)]


def _listed(symbols: Sequence[sp.Symbol]) -> str:
    return ", ".join(symbol.name for symbol in symbols)


def _names(system: Any) -> Mapping[str, Any]:
    """By name: every symbol and undefined function of the system, its fast states and its filter."""
    from ptproof.averaging.problem import DitherProblem

    extra: list[Sequence[sp.Expr]] = []
    if isinstance(system, DitherProblem):
        extra = [system.fast.rate if system.fast else (), () if system.mu_omega is None else (system.mu_omega,)]
        system = system.system
    vectors = [system.rhs] if isinstance(system, System) else [system.drift, system.dithers, *system.fields]
    vectors = [*vectors, *extra]
    names: dict[str, Any] = {symbol.name: symbol for symbol in (system.time, *system.state)}
    for entry in (entry for vector in vectors for entry in vector):
        names |= {symbol.name: symbol for symbol in entry.free_symbols}
        names |= {applied.func.__name__: applied.func for applied in entry.atoms(sp.core.function.AppliedUndef)}
    return names
