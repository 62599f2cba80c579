"""How far a clock's stretched time gets within the prescribed time, and what a drift's push adds up to by then."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import sympy as sp

from ptproof.errors import InputError
from ptproof.gains.numbers import NotApplicable, sign
from ptproof.problem.model import Tuning
from ptproof.proof.signs import sign_of, vanishes
from ptproof.transforms.clocks.algebra import is_nonnegative, settle
from ptproof.transforms.clocks.cap import CappedClock, capped
from ptproof.transforms.clocks.clock import Clock, Piece
from ptproof.transforms.clocks.named import named_clock

_T, _TAU = sp.symbols("t tau", real=True)
_NU = sp.Symbol("nu", positive=True)


@lru_cache
def unit_clock(name: str = "paper", exponent: sp.Expr | None = None) -> Clock:
    """The clock of that name on [0, 1); the power clock needs its exponent m, and no other has one."""
    return named_clock(name, _T, _TAU, start=sp.S.Zero, horizon=sp.S.One, exponent=exponent)


@dataclass(frozen=True)
class Horizon:
    """The prescribed time T that a clock runs through, its rate K capped at the instant T(1 − ν_min).

    All times here are elapsed: e = t − t₀ in [0, T], s = τ − t₀; ν = 1 − e/T.

    Parameters
    ----------
    T
        The prescribed time.
    nu_min
        ν_min ∈ (0, 1]; None is no cap.
    clock
        On [0, 1): a clock of the prescribed time T is this one with both times in units of T.

    Raises
    ------
    InputError
        Unless the clock's rate is shown never to fall, on which turning points, bounds and grids rest.
    """

    T: sp.Expr
    nu_min: sp.Expr | None = None
    clock: Clock = field(default_factory=unit_clock)

    def __post_init__(self) -> None:
        if not _increases(self.clock):
            raise InputError(f"{self.clock.name}: it does not hold, or cannot be shown, that its rate never falls")

    @property
    def corner(self) -> sp.Expr:
        """e from which on the rate is constant: T(1 − ν_min); T without a cap."""
        return self.T if self.nu_min is None else self.T * (1 - self.nu_min)

    @cached_property
    def _capped(self) -> CappedClock:
        if self.nu_min is None:
            raise InputError("without a clip the stretched time is infinite at t0 + T")
        return capped(self.clock, self.nu_min)

    @property
    def cap(self) -> sp.Expr:
        """The largest rate, K(ν_min): 1/ν_min² for the paper's clock (eq:kt)."""
        return self._capped.last_rate

    @property
    def stretched_corner(self) -> sp.Expr:
        """s at the corner."""
        return self.T * self._capped.corner_tau

    @property
    def stretched_end(self) -> sp.Expr:
        """s at e = T: s at the corner plus ν_min·T at the largest rate."""
        return self.T * self._capped.pieces[1].to_tau.subs(self.clock.t, 1)

    def stretched(self, elapsed: sp.Expr) -> sp.Expr:
        """s at the elapsed time e."""
        late = self.nu_min is not None and sign(elapsed - self.corner) >= 0
        if not late and sign(self.T - elapsed) <= 0:
            raise InputError("without a clip the stretched time is infinite at t0 + T")
        return self.T * self._piece(late).to_tau.xreplace({self.clock.t: elapsed / self.T})

    def elapsed(self, stretched: sp.Expr) -> sp.Expr:
        """e at the stretched time s."""
        return self.T * self._piece(self._is_late(stretched)).to_t.xreplace({self.clock.tau: stretched / self.T})

    def weight(self, stretched: sp.Expr) -> sp.Expr:
        """w = dt/dτ = 1/K at the stretched time s, with which a drift enters dx/dτ."""
        return self._piece(self._is_late(stretched)).rate_back.xreplace({self.clock.tau: stretched / self.T})

    def _is_late(self, stretched: sp.Expr) -> bool:
        return self.nu_min is not None and sign(stretched - self.stretched_corner) >= 0

    def _piece(self, late: bool) -> Piece:
        return (self._capped if late else self.clock).pieces[-1]

    def balance(self, elapsed: sp.Expr, push: sp.Expr, k: sp.Expr) -> sp.Expr:
        """J(e) = ∫ (m·w − k/2) dτ = m·e − (k/2)·s(e): the drift's push m against the gain.

        The drift enters dx/dτ with w = dt/dτ, whose integral over τ is the elapsed time itself.
        """
        return sp.expand_mul(push * elapsed - k / 2 * self.stretched(elapsed))

    def turning(self, push: sp.Expr, k: sp.Expr) -> sp.Expr:
        """The e up to which the push outweighs the gain, where K = 2m/k: 0 for small m, T if the cap prevents it."""
        clock, rate = self.clock, 2 * push / k
        if sign(rate - clock.rate.subs(clock.t, 0)) <= 0:
            return sp.S.Zero
        if self.nu_min is not None and sign(rate - self.cap) > 0:
            return self.T
        return self.T * instant(clock, rate)

    @property
    def is_printed(self) -> bool:
        """Whether the clock is the paper's own, K = 1/ν², for which alone some of its formulas are printed."""
        return powers(self.clock) == (2, 0)

    def only_printed(self) -> None:
        """Raise :class:`NotApplicable` unless the clock is the paper's own."""
        if not self.is_printed:
            raise NotApplicable(f"printed for the paper's own clock only, not for the {self.clock.name}")

    def clip_for(self, stretched: sp.Expr) -> sp.Expr:
        """The largest ν_min ≤ 1 with which s at e = T is at least ``stretched``, where K is a power of ν.

        With K = ν^(−p) that end is T(ν^(1−p) − 1)/(p − 1) + Tν^(1−p), or T(1 − ln ν) for p = 1.
        """
        found, s = powers(self.clock), stretched / self.T
        if found is None or found[1] != 0:
            raise NotApplicable(f"solved in closed form for powers of ν only, not for the {self.clock.name}")
        p = found[0]
        if p == 1:
            nu = sp.exp(1 - s, evaluate=not s.has(sp.log))  # see times_exponential
        else:
            base = ((p - 1) * s + 1) / p
            nu = base ** (-1 / (p - 1)) if sign(base) > 0 else sp.S.One
        return sp.S.One if sign(nu - 1) > 0 else nu


def horizon_of(tuning: Tuning) -> Horizon:
    """That of a problem's seeker."""
    return Horizon(tuning.T, tuning.nu_min, unit_clock(tuning.clock, tuning.exponent))


@lru_cache
def powers(clock: Clock) -> tuple[sp.Expr, sp.Expr] | None:
    """(p, q) with K = ν^(−p)·exp(q(1/ν − 1)) on [0, 1), p, q ≥ 0 and not both 0; None for any other rate.

    It is read from ν·K'/K = −p − q/ν, which fixes K up to the factor K(1) = 1.
    """
    K = settle(clock.rate.subs(clock.t, clock.start + clock.horizon * (1 - _NU)))
    slope = sp.simplify(_NU * sp.diff(K, _NU) / K)
    p, q = (-term for term in sp.expand(slope).as_independent(_NU, as_Add=True))
    q = sp.cancel(q * _NU)
    if not (vanishes(slope + p + q / _NU) and vanishes(K.subs(_NU, 1) - 1)) or q.has(_NU):
        return None
    signs = {sign_of(p), sign_of(q)}
    return (p, q) if signs <= {0, 1} and 1 in signs else None


def instant(clock: Clock, rate: sp.Expr) -> sp.Expr:
    """The t at which the rate of a clock on [0, 1) is ``rate``, a number that is at least its first rate.

    K = ν^(−p)·exp(q(1/ν − 1)) is solved for 1/ν with the principal branch of Lambert's W, y·e^y = c; where K is a
    parabola in τ, with no negative coefficient, the positive root in τ is taken. Either way K increases, so that there
    is no other instant.

    Raises
    ------
    NotApplicable
        For a rate of any other form.
    """
    found = powers(clock)
    if found is not None:
        p, q = found
        if q == 0:
            return 1 - rate ** (-1 / p)
        inverse = 1 + sp.log(rate) / q if p == 0 else p / q * sp.LambertW(q / p * (rate * sp.exp(q)) ** (1 / p))
        return 1 - 1 / inverse
    if (parabola := _parabola(clock)) is not None:
        a, b, c = parabola
        return clock.to_t.subs(clock.tau, (sp.sqrt(b**2 - 4 * a * (c - rate)) - b) / (2 * a))
    raise NotApplicable(f"the instant at which the gain of the {clock.name} is {rate} has no closed form here")


@lru_cache
def _parabola(clock: Clock) -> tuple[sp.Expr, ...] | None:
    """a, b ≥ 0 and c with K = aτ² + bτ + c, if K is such a parabola."""
    rate = sp.cancel(1 / clock.rate_back)
    if not rate.is_polynomial(clock.tau) or sp.degree(rate, clock.tau) != 2:
        return None
    a, b, c = sp.Poly(rate, clock.tau).all_coeffs()
    return (a, b, c) if all(sign_of(value) in (0, 1) for value in (a, b)) else None


@lru_cache
def _increases(clock: Clock) -> bool:
    """Whether it is shown that K never falls."""
    if powers(clock) is not None or _parabola(clock) is not None:
        return True
    return is_nonnegative(clock.on_interval(sp.diff(clock.rate, clock.t)))
