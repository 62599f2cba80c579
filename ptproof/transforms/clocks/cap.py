"""A change of time whose rate stops growing: a clock until an instant, a constant rate from then on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ptproof.errors import InputError
from ptproof.system import System
from ptproof.transforms.clocks.algebra import is_positive, settle, shown_zero
from ptproof.transforms.clocks.clock import Clock
from ptproof.transforms.time import contract, dilate


@dataclass(frozen=True)
class Continuation:
    """A clock until ``until``, which is ``corner_tau`` in τ, and a straight line of rate ``last_rate`` from then on.

    Nothing is checked here: that the pieces fit together is for those who make one to show, each by their own algebra.
    """

    clock: Clock
    until: sp.Expr
    corner_tau: sp.Expr
    last_rate: sp.Expr

    @property
    def late_tau(self) -> sp.Expr:
        """a(t) from the corner on."""
        return self.corner_tau + self.last_rate * (self.clock.t - self.until)

    @property
    def late_t(self) -> sp.Expr:
        """a⁻¹(τ) from the corner on."""
        return self.until + (self.clock.tau - self.corner_tau) / self.last_rate

    @cached_property
    def to_tau(self) -> sp.Expr:
        """a(t), in two pieces."""
        return sp.Piecewise((self.clock.to_tau, self.clock.t <= self.until), (self.late_tau, True))

    @cached_property
    def to_t(self) -> sp.Expr:
        """a⁻¹(τ), in two pieces."""
        return sp.Piecewise((self.clock.to_t, self.clock.tau <= self.corner_tau), (self.late_t, True))


@dataclass(frozen=True)
class ClippedClock:
    """τ = a(t) until ``until``, and from then on a straight line with the rate that it has there, for all times.

    This is what a seeker with a gain that is clipped does: its gain is dτ/dt, bounded and continuous.

    Parameters
    ----------
    clock
        The map until the corner.
    until
        The corner's instant in t, within the clock's interval.

    Raises
    ------
    InputError
        Unless the corner is shown to lie within the interval, and both pieces agree there in value and in rate.
    """

    clock: Clock
    until: sp.Expr

    def __post_init__(self) -> None:
        object.__setattr__(self, "until", sp.sympify(self.until))
        left = [self.until - self.start]
        if self.clock.horizon is not sp.oo:
            left.append(self.start + self.clock.horizon - self.until)
        if not all(is_positive(sp.expand(length)) for length in left):
            raise InputError(
                f"{self.name}: the corner {self.until} is not shown to lie after {self.start} and before the "
                f"interval's end; declare its symbols so that it does, as in t0 + T/(1 + w) with w positive"
            )
        corner = {self.t: self.until}
        if not (shown_zero(self._whole.late_tau.subs(corner) - self.corner_tau)
                and shown_zero(self._whole.late_t.subs(self.tau, self.corner_tau) - self.until)
                and shown_zero(self._whole.late_t.subs(self.tau, self._whole.late_tau) - self.t)
                and is_positive(self.last_rate)):  # fmt: skip
            raise InputError(f"{self.name}: the pieces are not shown to fit together at {self.until}")

    @property
    def t(self) -> sp.Symbol:
        return self.clock.t

    @property
    def tau(self) -> sp.Symbol:
        return self.clock.tau

    @property
    def start(self) -> sp.Expr:
        return self.clock.start

    @property
    def horizon(self) -> sp.Expr:
        return sp.oo

    @property
    def name(self) -> str:
        return f"clipped {self.clock.name}"

    @cached_property
    def corner_tau(self) -> sp.Expr:
        """The corner's instant in τ."""
        return settle(sp.simplify(self.clock.to_tau.subs(self.t, self.until)))

    @cached_property
    def last_rate(self) -> sp.Expr:
        """dτ/dt from the corner on: the largest gain."""
        rate = self.clock.rate.subs(self.t, self.until)
        # SymPy would write 1 + tan² as 1/cos², whose denominator hides that it is positive.
        return settle(rate) if rate.has(sp.tan) else sp.simplify(rate)

    @cached_property
    def _whole(self) -> Continuation:
        return Continuation(self.clock, self.until, self.corner_tau, self.last_rate)

    @property
    def to_tau(self) -> sp.Expr:
        """a(t), in two pieces."""
        return self._whole.to_tau

    @property
    def to_t(self) -> sp.Expr:
        """a⁻¹(τ), in two pieces."""
        return self._whole.to_t

    @property
    def rate(self) -> sp.Expr:
        """dτ/dt, the clipped gain."""
        return sp.Piecewise((self.clock.rate, self.t <= self.until), (self.last_rate, True))

    @property
    def rate_back(self) -> sp.Expr:
        """dt/dτ as an expression in τ."""
        return sp.Piecewise((self.clock.rate_back, self.tau <= self.corner_tau), (1 / self.last_rate, True))

    def dilate(self, system: System) -> System:
        """The system in τ, in two pieces where they differ."""
        early = dilate(self._piece(system, True), self.clock)
        late = tuple(
            entry.subs(self.t, self._whole.late_t) / self.last_rate for entry in self._piece(system, False).rhs
        )
        return self._joined(early, late, self.tau <= self.corner_tau)

    def contract(self, system: System) -> System:
        """The system in t again, in two pieces where they differ."""
        early = contract(self._piece(system, True), self.clock)
        late = tuple(
            sp.expand(self.last_rate * entry.subs(self.tau, self._whole.late_tau))
            for entry in self._piece(system, False).rhs
        )
        return self._joined(early, late, self.t <= self.until)

    def _joined(self, early: System, late: tuple[sp.Expr, ...], condition: sp.Basic) -> System:
        def join(first: sp.Expr, second: sp.Expr) -> sp.Expr:
            difference = first - second
            if shown_zero(difference) or (early.time == self.t and shown_zero(self.clock.on_interval(difference))):
                return second
            return sp.Piecewise((first, condition), (second, True))

        rhs = tuple(join(first, second) for first, second in zip(early.rhs, late, strict=True))
        return System(early.time, early.state, rhs, name=early.name)

    def _piece(self, system: System, early: bool) -> System:
        """The system with every two-piece expression of this clock replaced by its first or second piece."""
        conditions = (self.t <= self.until, self.tau <= self.corner_tau)

        def choose(*pieces: sp.Basic) -> sp.Basic:
            if len(pieces) == 2 and pieces[0][1] in conditions:
                return pieces[0][0] if early else pieces[1][0]
            return sp.Piecewise(*pieces)

        rhs = tuple(entry.replace(sp.Piecewise, choose) for entry in system.rhs)
        return System(system.time, system.state, rhs, name=system.name)

    def latex(self) -> str:
        """The map and its rate as a LaTeX ``aligned`` block, without delimiters."""
        t, tau = sp.latex(self.t), sp.latex(self.tau)
        rows = [
            rf"{tau} &= {sp.latex(self.to_tau)}",
            rf"\frac{{\mathrm{{d}} {tau}}}{{\mathrm{{d}} {t}}} &= {sp.latex(self.rate)}",
        ]
        return r"\begin{aligned}" + r" \\ ".join(rows) + r"\end{aligned}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"
