"""More changes of time: the power, logarithmic, exponential and tangent maps, and maps of the user's own.

Every one of them is a :class:`~ptproof.clock.Clock`, so it can't be made with a wrong inverse. With s = t − t₀,
e = τ − t₀ and ν = 1 − s/T:

=============  ==================================  =====================  ===========================
map            τ − t₀                              rate dτ/dt             t − t₀
=============  ==================================  =====================  ===========================
power          (T/m)(ν⁻ᵐ − 1)                      ν⁻⁽ᵐ⁺¹⁾                T(1 − (1 + me/T)^(−1/m))
logarithmic    −T ln ν                             ν⁻¹                    T(1 − exp(−e/T))
exponential    T(exp(s/(T − s)) − 1)               ν⁻² exp(s/(T − s))     T L/(1 + L), L = ln(1 + e/T)
tangent        (2T/π) tan(πs/(2T))                 1 + tan²(πs/(2T))      (2T/π) arctan(πe/(2T))
growing        (exp(gs) − 1)/g, for all s ≥ 0      exp(gs)                ln(1 + ge)/g
=============  ==================================  =====================  ===========================

The power map of order m = 1 is the paper's. In τ a seeker with the gain dτ/dt is one with a constant gain, so what
decays like exp(−λe) there decays in t like ν^(λT) under the logarithmic map, and faster than every power of ν under
the others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from ptproof.clock import Clock
from ptproof.clock_algebra import is_positive, limit_at_infinity, settle, shown_zero
from ptproof.dilated_length import dilated_length
from ptproof.errors import InputError
from ptproof.system import System
from ptproof.time_limit import OutOfTime, within

SOLVE_SECONDS = 10.0


def power_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, order: sp.Expr, name: str = "power clock"
) -> Clock:
    """dτ/dt = ν^(−(m+1)) with the ``order`` m > 0, a positive number or symbol; m = 1 is the paper's map."""
    m = sp.sympify(order)
    if not m.is_positive or m.has(sp.Float):
        raise InputError(f"{name}: the order must be an exact positive number or a positive symbol, got {m}")
    nu = 1 - (t - start) / horizon
    return Clock(
        t, tau,
        to_tau=start + horizon / m * (nu ** (-m) - 1),
        to_t=start + horizon * (1 - (1 + m * (tau - start) / horizon) ** (-1 / m)),
        start=start, horizon=horizon, name=name,
    )  # fmt: skip


def logarithmic_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "logarithmic clock"
) -> Clock:
    """dτ/dt = 1/ν, the slowest growth of this kind that still reaches τ = ∞; its inverse is an exponential."""
    return Clock(
        t, tau,
        to_tau=start - horizon * sp.log(1 - (t - start) / horizon),
        to_t=start + horizon * (1 - sp.exp(-(tau - start) / horizon)),
        start=start, horizon=horizon, name=name,
    )  # fmt: skip


def exponential_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "exponential clock"
) -> Clock:
    """dτ/dt = ν⁻² exp(s/(T − s)), which grows faster than every power of 1/ν."""
    stretched = (t - start) / (1 - (t - start) / horizon) / horizon
    logarithm = sp.log(1 + (tau - start) / horizon)
    return Clock(
        t, tau,
        to_tau=start + horizon * (sp.exp(stretched) - 1),
        to_t=start + horizon * logarithm / (1 + logarithm),
        start=start, horizon=horizon, name=name,
    )  # fmt: skip


def tangent_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "tangent clock"
) -> Clock:
    """dτ/dt = 1 + tan²(πs/(2T))."""
    scale = 2 * horizon / sp.pi
    return Clock(
        t, tau,
        to_tau=start + scale * sp.tan((t - start) / scale),
        to_t=start + scale * sp.atan((tau - start) / scale),
        start=start, horizon=horizon, name=name,
    )  # fmt: skip


def growing_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, growth: sp.Expr, name: str = "growing clock"
) -> Clock:
    """dτ/dt = exp(g(t − t₀)) for all t ≥ t₀, with ``growth`` g > 0: an exponential gain on an infinite horizon."""
    g = sp.sympify(growth)
    if not g.is_positive:
        raise InputError(f"{name}: the growth must be positive, got {g}")
    return Clock(
        t, tau,
        to_tau=start + (sp.exp(g * (t - start)) - 1) / g,
        to_t=start + sp.log(1 + g * (tau - start)) / g,
        start=start, horizon=sp.oo, name=name,
    )  # fmt: skip


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
    clock, reason = _first_accepted(t, tau, formula, candidates, start, horizon, name)
    if clock is None and inverse is not None:
        raise InputError(reason)
    if clock is None:
        found = f" was accepted ({reason})" if reason else f" of {formula} was found"
        raise InputError(f"{name}: no inverse{found}; give it as an expression in {tau} with inverse=")
    if wanted and not known:
        end = limit_at_infinity(clock.to_t, tau)
        if end is None or end is sp.oo or not shown_zero(end - start - horizon):
            raise InputError(_unknown(sp.diff(formula, t), start, horizon, name))
    return clock


def _first_accepted(
    t: sp.Symbol, tau: sp.Symbol, formula: sp.Expr, candidates: Sequence[sp.Expr], start: sp.Expr, horizon: sp.Expr,
    name: str,
) -> tuple[Clock | None, str]:  # fmt: skip
    reason = ""
    for candidate in candidates:
        try:
            return Clock(t, tau, formula, candidate, start, horizon, name), ""
        except InputError as error:
            reason = reason or str(error)
    return None, reason


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
    w = sp.Dummy("w", nonnegative=True)
    if not is_positive(rate.subs(t, start + (w if horizon is sp.oo else horizon * w / (1 + w)))):
        raise InputError(f"{name}: it does not hold, or cannot be shown, that dτ/dt = {rate} is positive all the time")
    if prescribed_time and horizon is not sp.oo and not _refuse_finite(rate, t, start, horizon, name):
        raise InputError(_unknown(rate, start, horizon, name))
    formula = start + _integral_from_start(rate, t, start, horizon, name)
    return clock_from_formula(
        t, tau, formula, start=start, horizon=horizon, inverse=inverse, prescribed_time=False, name=name
    )


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
    inside = sp.Dummy("nu", positive=True)
    finite = horizon is not sp.oo
    integrand = rate.subs(t, start + (horizon * (1 - inside) if finite else inside)) * (-horizon if finite else 1)
    try:
        found = within(SOLVE_SECONDS, lambda: sp.integrate(sp.simplify(integrand), inside))
    except OutOfTime:
        found = sp.Integral(integrand, inside)
    if found.has(sp.Integral, sp.Piecewise) or not shown_zero(sp.diff(found, inside) - integrand):
        raise InputError(f"{name}: no antiderivative of {rate} was found; give the map with clock_from_formula")
    back = 1 - (t - start) / horizon if finite else t - start
    first = found.subs(inside, 1) if finite else found.subs(inside, 0)
    return sp.factor_terms(found.subs(inside, back) - first)


def _solutions(formula: sp.Expr, t: sp.Symbol, tau: sp.Symbol, start: sp.Expr, horizon: sp.Expr) -> list[sp.Expr]:
    """What SymPy's solver suggests for the inverse; nothing is trusted, :class:`Clock` checks each."""
    later = sp.Dummy("e", positive=True)
    found: list[sp.Expr] = []
    for elapsed, inside in _views(horizon):
        equation = formula.subs(t, start + elapsed) - start - later
        try:
            roots = within(SOLVE_SECONDS, lambda: sp.solve(equation, inside))  # noqa: B023
        except (OutOfTime, NotImplementedError, ValueError, TypeError):
            continue
        for root in roots:
            if isinstance(root, sp.Expr):
                value = elapsed.subs(inside, root)
                # The second form has no 0/0 at the start where the first one may have one.
                found += [value, 1 / sp.radsimp(sp.simplify(1 / value))]
    return [start + item.subs(later, tau - start) for item in found if not item.has(sp.zoo, sp.nan)]


def _views(horizon: sp.Expr) -> list[tuple[sp.Expr, sp.Symbol]]:
    """The elapsed time by one symbol: itself, and for a finite horizon by ν."""
    elapsed, nu = sp.Dummy("s", positive=True), sp.Dummy("nu", positive=True)
    return [(elapsed, elapsed)] + ([] if horizon is sp.oo else [(horizon * (1 - nu), nu)])


def carry_solution(solution: Mapping[sp.Symbol, sp.Expr], clock: Clock) -> dict[sp.Symbol, sp.Expr]:
    """A solution of a dilated system, in τ, as one of the system in t: x(t) = x̂(a(t)), state by state.

    A bound in τ is carried in the same way.

    >>> t, tau, x = sp.symbols("t tau x", real=True); T, k = sp.symbols("T k", positive=True)
    >>> carry_solution({x: sp.exp(-k * tau)}, logarithmic_clock(t, tau, start=0, horizon=T))
    {x: ((T - t)/T)**(T*k)}
    """
    return {state: _as_power(settle(value.subs(clock.tau, clock.to_tau))) for state, value in solution.items()}


def _as_power(expression: sp.Expr) -> sp.Expr:
    """exp(c ln b) as b^c."""

    def power(exponent: sp.Expr) -> sp.Expr:
        factors = sp.Mul.make_args(exponent)
        logarithms = [factor for factor in factors if isinstance(factor, sp.log)]
        if len(logarithms) != 1:
            return sp.exp(exponent)
        return logarithms[0].args[0] ** sp.Mul(*(factor for factor in factors if factor is not logarithms[0]))

    return expression.replace(sp.exp, power)


def bring_solution(solution: Mapping[sp.Symbol, sp.Expr], clock: Clock) -> dict[sp.Symbol, sp.Expr]:
    """A solution in t as one of the dilated system: x̂(τ) = x(a⁻¹(τ))."""
    return {state: settle(value.subs(clock.t, clock.to_t)) for state, value in solution.items()}


def solves(system: System, solution: Mapping[sp.Symbol, sp.Expr], clock: Clock | None = None) -> bool:
    """Whether exact algebra shows that ``solution`` satisfies the system's equations; False says "not shown".

    With the clock in whose time t it runs, only t₀ ≤ t < t₀ + horizon counts.

    Raises
    ------
    InputError
        If a state has no solution.
    """
    if missing := [state.name for state in system.state if state not in solution]:
        raise InputError(f"{system.name}: no solution is given for {', '.join(missing)}")
    view = clock.on_interval if clock is not None else (lambda entry: entry)
    return all(
        shown_zero(view(sp.diff(solution[state], system.time) - rate.subs(dict(solution), simultaneous=True)))
        for state, rate in zip(system.state, system.rhs, strict=True)
    )


__all__ = [
    "bring_solution",
    "carry_solution",
    "clock_from_formula",
    "clock_from_rate",
    "exponential_clock",
    "growing_clock",
    "logarithmic_clock",
    "power_clock",
    "solves",
    "tangent_clock",
]
