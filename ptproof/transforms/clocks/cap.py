"""A cap on the rate of any clock: the clock until an instant, the rate that it has there from then on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.engines.reals import follows
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import Relation, le, lt
from ptproof.transforms.clocks.algebra import factored, is_nonnegative, is_positive, settle
from ptproof.transforms.clocks.clock import Clock, Piece, displayed


@dataclass(frozen=True)
class CappedClock:
    """τ = a(t) until ``until``, and from then on a straight line with the rate that it has there, for all times.

    This is what a seeker does whose gain is clipped: its gain is dτ/dt, bounded and continuous. It has a
    :class:`Clock`'s attributes, with expressions in two pieces.

    Parameters
    ----------
    clock
        The map until the corner.
    until
        The corner's instant in t: the clock's start, or an instant within its interval.
    given
        What is known of the symbols beside their declarations, such as ν_min ≤ 1.

    Raises
    ------
    InputError
        Unless the corner is shown to lie within the interval, where the clock has been shown to increase.

    Examples
    --------
    >>> from ptproof.transforms.clocks import power_clock
    >>> t, tau = sp.symbols("t tau", real=True)
    >>> clock = capped(power_clock(t, tau, start=0, horizon=1, order=2), sp.Rational(1, 10))
    >>> clock.until, clock.rate.subs(t, sp.Rational(1, 2)), clock.last_rate
    (9/10, 8, 1000)
    """

    clock: Clock
    until: sp.Expr
    given: tuple[Relation, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "until", sp.sympify(self.until))
        end = self.start + self.clock.horizon
        if self.given and follows(lt(1, 0), self.given, seconds=1.0).shown:
            raise InputError(f"{self.name}: what is given of its symbols contradicts itself")
        if self.until.free_symbols & {self.t, self.tau} or not (
            is_nonnegative(sp.expand(self.until - self.start), self.given)
            and (end is sp.oo or is_positive(sp.expand(end - self.until), self.given))
        ):
            raise InputError(
                f"{self.name}: the corner {self.until} is not shown to lie between {self.start} and the interval's "
                f"end; declare its symbols so that it does, as in t0 + T/(1 + w) with w positive, or say what is "
                f"given of them"
            )

    t = property(attrgetter("clock.t"))
    tau = property(attrgetter("clock.tau"))
    start = property(attrgetter("clock.start"))
    name = property(lambda self: f"capped {self.clock.name}")

    @property
    def horizon(self) -> sp.Expr:
        """Infinite: what is capped goes on for all times."""
        return sp.oo

    @cached_property
    def corner_tau(self) -> sp.Expr:
        """The corner's instant in τ."""
        return _settled(self.clock.to_tau.subs(self.t, self.until))

    @cached_property
    def last_rate(self) -> sp.Expr:
        """dτ/dt from the corner on: the largest gain."""
        return _settled(self.clock.rate.subs(self.t, self.until))

    @cached_property
    def conditions(self) -> tuple[Relational, Relational]:
        """Before the corner in t, and in τ: the only conditions of the choices that this clock makes."""
        return sp.Le(self.t, self.until), sp.Le(self.tau, self.corner_tau)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The clock before the corner, and the straight line from then on."""
        late = Piece(
            self.corner_tau + self.last_rate * (self.t - self.until),
            self.until + (self.tau - self.corner_tau) / self.last_rate,
            self.last_rate, 1 / self.last_rate,
        )  # fmt: skip
        return *self.clock.pieces, late

    def _choice(self, part: str, in_tau: bool) -> sp.Expr:
        early, late = (getattr(piece, part) for piece in self.pieces)
        return sp.Piecewise((early, self.conditions[in_tau]), (late, True))

    # a(t), a⁻¹(τ), dτ/dt, which is the clipped gain, and dt/dτ as an expression in τ.
    to_tau = cached_property(lambda self: self._choice("to_tau", False))
    to_t = cached_property(lambda self: self._choice("to_t", True))
    rate = cached_property(lambda self: self._choice("rate", False))
    rate_back = cached_property(lambda self: self._choice("rate_back", True))

    def _repr_latex_(self) -> str:
        return displayed(self.t, self.tau, Piece(self.to_tau, self.to_t, self.rate, self.rate_back))


def capped(clock: Clock, nu_min: sp.Expr) -> CappedClock:
    """The clock with its rate capped from the instant on at which ν = 1 − (t − t₀)/horizon is ``nu_min`` (eq:kt).

    A symbol ``nu_min`` is taken to be at most 1; at 1 the rate is constant from the start.
    """
    nu_min = sp.sympify(nu_min)
    given = (le(nu_min, 1),) if nu_min.free_symbols else ()
    return CappedClock(clock, clock.instant(nu_min), given)


def _settled(value: sp.Expr) -> sp.Expr:
    """The value at the corner in a short form, where that is shown to be the same; a number stays as it is."""
    if not value.free_symbols:  # exp(899/101) − 1 has factors without end
        return value
    shorter = (lambda: factored(sp.cancel(settle(value))), lambda: settle(sp.simplify(value)), lambda: settle(value))
    for form in (short() for short in shorter):  # ``simplify`` takes longest, and is asked only where it has to be
        # SymPy would write 1 + tan² as 1/cos², whose denominator hides that it is positive.
        if vanishes(form - value) and (form.has(sp.tan) or not value.has(sp.tan)):
            return form
    return value
