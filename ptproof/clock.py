"""Changes of time: a clock, and what it does to a system.

``dilate`` writes a system in the stretched time τ, ``contract`` writes it in the original time t again. They
undo each other, for every clock, because a clock whose rate and inverse don't fit together can't be made.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.system import System


@dataclass(frozen=True)
class Clock:
    """A change of time τ = a(t) on [t₀, t₀ + horizon).

    Parameters
    ----------
    t, tau
        The two times, real symbols.
    to_tau
        a, an expression in ``t``.
    to_t
        a⁻¹, an expression in ``tau``.
    start
        t₀, where both times agree.
    horizon
        The length of the interval in t (``oo`` allowed). [time]
    name
        For people.

    Raises
    ------
    InputError
        Unless a⁻¹(a(t)) = t, a(t₀) = t₀ and (da/dt)·(da⁻¹/dτ) = 1 hold by exact algebra.
    """

    t: sp.Symbol
    tau: sp.Symbol
    to_tau: sp.Expr
    to_t: sp.Expr
    start: sp.Expr
    horizon: sp.Expr
    name: str = "clock"

    def __post_init__(self) -> None:
        for field in ("to_tau", "to_t", "start", "horizon"):
            object.__setattr__(self, field, sp.sympify(getattr(self, field)))
        checks = {
            "the inverse undoes the map": self.to_t.subs(self.tau, self.to_tau) - self.t,
            "both times agree at the start": self.to_tau.subs(self.t, self.start) - self.start,
            "the two rates are reciprocal": self.rate * self.rate_back.subs(self.tau, self.to_tau) - 1,
        }
        for what, difference in checks.items():
            try:
                holds = is_zero(difference)
            except NotAlgebraic as error:
                raise InputError(f"{self.name}: cannot check that {what} ({error})") from None
            if not holds:
                raise InputError(f"{self.name}: it does not hold, or cannot be shown, that {what}")

    @property
    def rate(self) -> sp.Expr:
        """dτ/dt as an expression in t."""
        return sp.factor(sp.diff(self.to_tau, self.t))

    @property
    def rate_back(self) -> sp.Expr:
        """dt/dτ as an expression in τ."""
        return sp.factor(sp.diff(self.to_t, self.tau))

    @property
    def rate_at_tau(self) -> sp.Expr:
        """dτ/dt as an expression in τ: the reciprocal of :attr:`rate_back`."""
        return 1 / self.rate_back


def dilate(system: System, clock: Clock) -> System:
    """The system in the clock's stretched time: dx/dτ = (dt/dτ) · rhs(a⁻¹(τ), x).

    An undefined function of time, such as a drift f(t, x), is taken at the same instant: f(a⁻¹(τ), x).
    """
    if system.time != clock.t:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} dilates {clock.t}")
    rhs = tuple(_tidy(entry.subs(clock.t, clock.to_t), clock.rate_back) for entry in system.rhs)
    return System(clock.tau, system.state, rhs, name=f"{system.name} in {clock.tau}")


def contract(system: System, clock: Clock) -> System:
    """The system in the clock's original time: dx/dt = (dτ/dt) · rhs(a(t), x)."""
    if system.time != clock.tau:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} contracts {clock.tau}")
    rhs = tuple(_tidy(entry.subs(clock.tau, clock.to_tau), clock.rate) for entry in system.rhs)
    return System(clock.t, system.state, rhs, name=f"{system.name} in {clock.t}")


def _tidy(entry: sp.Expr, rate: sp.Expr) -> sp.Expr:
    """``rate`` times ``entry``, term by term, with rational factors cancelled and arguments in factored form."""
    entry = entry.replace(
        lambda node: isinstance(node, sp.core.function.AppliedUndef),
        lambda node: node.func(*(sp.factor(sp.cancel(argument)) for argument in node.args)),
    )
    return sp.Add(*(_cancel_factors(rate * term) for term in sp.Add.make_args(entry)))


def _cancel_factors(term: sp.Expr) -> sp.Expr:
    rational: list[sp.Expr] = []
    rest: list[sp.Expr] = []
    for factor in sp.Mul.make_args(term):
        (rational if factor.is_rational_function() and not factor.is_Add else rest).append(factor)
    return sp.factor(sp.cancel(sp.Mul(*rational))) * sp.Mul(*rest)


def prescribed_time_clock(
    t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr, name: str = "prescribed-time clock"
) -> Clock:
    """The paper's map τ = t₀ + (t − t₀)/ν with ν = 1 − (t − t₀)/T (eq:tau_to_t, eq:nu, eq:t_to_tau)."""
    elapsed, stretched = t - start, tau - start
    return Clock(
        t, tau,
        to_tau=start + elapsed / (1 - elapsed / horizon),
        to_t=start + stretched / (1 + stretched / horizon),
        start=start, horizon=horizon, name=name,
    )  # fmt: skip


def identity_clock(t: sp.Symbol, tau: sp.Symbol, *, start: sp.Expr) -> Clock:
    """τ = t: the clock of an asymptotic seeker."""
    return Clock(t, tau, to_tau=t, to_t=tau, start=start, horizon=sp.oo, name="identity clock")


def scale_time(system: System, factor: sp.Expr, time: sp.Symbol, name: str | None = None) -> System:
    """The system in the time ``system.time``/factor, such as the fast time τ̃ = τ/μ."""
    rhs = tuple(factor * entry.subs(system.time, factor * time) for entry in system.rhs)
    return System(time, system.state, rhs, name=system.name if name is None else name)


def change_variable(
    system: System,
    replaced: sp.Symbol,
    by: sp.Symbol,
    forward: sp.Expr,
    backward: sp.Expr,
    name: str | None = None,
) -> System:
    """Exchange one state for another, such as the heading θ for p = θ + kz.

    Parameters
    ----------
    replaced, by
        The old and the new state.
    forward
        The new state in terms of the old ones.
    backward
        The old state in terms of the new one and the states that stay.

    Raises
    ------
    InputError
        Unless ``forward`` and ``backward`` undo each other by exact algebra.
    """
    if not (is_zero(forward.subs(replaced, backward) - by) and is_zero(backward.subs(by, forward) - replaced)):
        raise InputError(f"{system.name}: {by} = {forward} and {replaced} = {backward} do not undo each other")
    old = {replaced: backward}
    rate = system.derivative_along(forward).subs(old)
    rhs = tuple(
        sp.expand(rate) if variable == replaced else entry.subs(old)
        for variable, entry in zip(system.state, system.rhs, strict=True)
    )
    renamed = replace(
        system, state=tuple(by if v == replaced else v for v in system.state), rhs=rhs, parameters=None,
        name=system.name if name is None else name,
    )  # fmt: skip
    return renamed


def solve_state(system: System, variable: sp.Symbol, solution: sp.Expr, name: str | None = None) -> System:
    """Remove a state whose equation has the closed-form ``solution`` in time.

    Raises
    ------
    InputError
        Unless the derivative of ``solution`` is the state's right-hand side by exact algebra.
    """
    index = system.state.index(variable)
    rate = system.rhs[index].subs(variable, solution)
    if not is_zero(sp.diff(solution, system.time) - rate):
        raise InputError(f"{system.name}: {variable} = {solution} does not solve its equation")
    keep = [i for i in range(system.dimension) if i != index]
    return System(
        system.time, tuple(system.state[i] for i in keep),
        tuple(system.rhs[i].subs(variable, solution) for i in keep), name=system.name if name is None else name,
    )  # fmt: skip
