"""Clocks of the user's own, by their formula or by their rate; nothing is trusted, the clock checks itself."""

from __future__ import annotations

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.reading.limits import OutOfTime, within
from ptproof.transforms.clocks.algebra import is_positive
from ptproof.transforms.clocks.clock import Clock, inside
from ptproof.transforms.clocks.length import SECONDS, antiderivative, dilated_length


def clock_from_formula(
    t: sp.Symbol, tau: sp.Symbol, formula: sp.Expr, *, start: sp.Expr, horizon: sp.Expr,
    inverse: sp.Expr | None = None, prescribed_time: bool = True, name: str = "clock",
) -> Clock:  # fmt: skip
    """The clock τ = ``formula`` (in t), with its inverse found and checked, or given as an expression in τ.

    Raises
    ------
    InputError
        If no inverse is found, or the one given is not shown to be one; if the map is not shown to increase; or, with
        ``prescribed_time`` and a finite horizon, unless τ → ∞ at its end, with the value that τ − t₀ tends to.
    """
    formula, start, horizon = (sp.sympify(item) for item in (formula, start, horizon))
    wanted = prescribed_time and horizon is not sp.oo
    known = wanted and _refuse_finite(sp.diff(formula, t), t, start, horizon, name)
    candidates = [sp.sympify(inverse)] if inverse is not None else _solutions(formula, t, tau, start, horizon)
    reason = ""
    for candidate in candidates:
        try:
            clock = Clock(t, tau, formula, candidate, start, horizon, name)
        except InputError as error:
            reason = reason or str(error)
            continue
        if wanted and not known and not clock.tends_to_the_end():
            raise InputError(_unknown(sp.diff(formula, t), start, horizon, name))
        return clock
    if inverse is not None:
        raise InputError(reason)
    found = f" was accepted ({reason})" if reason else f" of {formula} was found"
    raise InputError(f"{name}: no inverse{found}; give it as an expression in {tau} with inverse=")


def clock_from_rate(
    t: sp.Symbol, tau: sp.Symbol, rate: sp.Expr, *, start: sp.Expr, horizon: sp.Expr,
    inverse: sp.Expr | None = None, prescribed_time: bool = True, name: str = "clock",
) -> Clock:  # fmt: skip
    """The clock with dτ/dt = ``rate`` (in t), such as a seeker's gain: τ is its integral from t₀.

    With ``prescribed_time`` and a finite horizon a rate whose integral over [t₀, t₀ + horizon) is finite is refused,
    with the value of the integral: in its time τ the seeker ends before it has converged.

    Raises
    ------
    InputError
        As for :func:`clock_from_formula`; also if no antiderivative of the rate is found and checked.
    """
    rate, start, horizon = (sp.sympify(item) for item in (rate, start, horizon))
    if not is_positive(rate.subs(t, inside(start, horizon)[0])):
        raise InputError(f"{name}: it does not hold, or cannot be shown, that dτ/dt = {rate} is positive all the time")
    if prescribed_time and horizon is not sp.oo and not _refuse_finite(rate, t, start, horizon, name):
        raise InputError(_unknown(rate, start, horizon, name))
    formula = start + _integral_from_start(rate, t, start, horizon, name)
    clock = clock_from_formula(
        t, tau, formula, start=start, horizon=horizon, inverse=inverse, prescribed_time=False, name=name
    )
    if not vanishes(clock.on_interval(clock.rate - rate)):
        raise InputError(f"{name}: it cannot be shown that {clock.to_tau} has the rate {rate}")
    return clock


def _refuse_finite(rate: sp.Expr, t: sp.Symbol, start: sp.Expr, horizon: sp.Expr, name: str) -> bool:
    """Whether ∫ rate is shown to be infinite; where it is shown to be finite this raises, with the value."""
    length = dilated_length(rate, t, start=start, horizon=horizon)
    if length is None:
        return False
    if length.value is not sp.oo:
        raise InputError(
            f"{name}: the integral of dτ/dt = {rate} from {start} to {start + horizon} is {length}, which is finite, "
            f"so this is no prescribed-time gain; that of {1 / (1 - (t - start) / horizon) ** 2} is infinite"
        )
    return True


def _unknown(rate: sp.Expr, start: sp.Expr, horizon: sp.Expr, name: str) -> str:
    return (
        f"{name}: cannot tell whether the integral of dτ/dt = {rate} from {start} to {start + horizon} is infinite; "
        "say prescribed_time=False if it need not be"
    )


def _integral_from_start(rate: sp.Expr, t: sp.Symbol, start: sp.Expr, horizon: sp.Expr, name: str) -> sp.Expr:
    """∫ rate from the start to t, by an antiderivative in ν (or in t − t₀) that is checked."""
    elapsed, own = _views(horizon)[-1]
    integrand = rate.subs(t, start + elapsed) * sp.diff(elapsed, own)
    found = antiderivative(integrand, own)
    if found is None:
        raise InputError(f"{name}: no antiderivative of {rate} was found; give the map with clock_from_formula")
    now, first = (t - start, 0) if horizon is sp.oo else (1 - (t - start) / horizon, 1)
    return sp.factor_terms(found.subs(own, now) - found.subs(own, first))


def _solutions(formula: sp.Expr, t: sp.Symbol, tau: sp.Symbol, start: sp.Expr, horizon: sp.Expr) -> list[sp.Expr]:
    """What SymPy's solver suggests for the inverse; nothing is trusted, :class:`Clock` checks each."""
    later = sp.Dummy("e", positive=True)
    found: list[sp.Expr] = []
    for elapsed, own in _views(horizon):
        equation = formula.subs(t, start + elapsed) - start - later
        try:
            roots = within(SECONDS, lambda: sp.solve(equation, own))  # noqa: B023
        except (OutOfTime, NotImplementedError, ValueError, TypeError):
            continue
        for root in roots:
            if isinstance(root, sp.Expr):
                value = elapsed.subs(own, root)
                # The second form has no 0/0 at the start where the first one may have one.
                found += [value, 1 / sp.radsimp(sp.simplify(1 / value))]
    return [start + item.subs(later, tau - start) for item in found if not item.has(sp.zoo, sp.nan)]


def _views(horizon: sp.Expr) -> list[tuple[sp.Expr, sp.Symbol]]:
    """The elapsed time by one symbol: itself, and for a finite horizon by ν."""
    elapsed, nu = sp.Dummy("s", positive=True), sp.Dummy("nu", positive=True)
    return [(elapsed, elapsed)] + ([] if horizon is sp.oo else [(horizon * (1 - nu), nu)])
