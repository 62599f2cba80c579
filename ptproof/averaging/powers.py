"""Dithered systems whose amplitudes are powers of the frequency, each its own, and dithers of several frequencies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.exponents import Exponents, check_linear, told
from ptproof.averaging.problem import DitherProblem
from ptproof.errors import InputError
from ptproof.proof.statement import Relation
from ptproof.system import DitherSystem, System


@dataclass(frozen=True)
class PoweredSystem:
    """dx/dt = drift + Σ ω^(powers[i]) fields[i] · dithers[i].

    Parameters
    ----------
    plain
        States, drift, fields and dithers, with one common period, as of a system in which each power is 1/2.
    powers
        N expressions, linear in their parameters with rational coefficients.
    conditions
        What is assumed of the parameters of the powers: linear relations between them. Beside that each power is
        between 0 and 1, which is all that is assumed where no condition is given.

    Raises
    ------
    InputError
        If a power is not between 0 and 1 for any, or for some, values that the conditions allow, or is not linear.

    Examples
    --------
    >>> from ptproof.averaging.problem import OMEGA, PHASE, TIME
    >>> x, p = sp.Symbol("x", real=True), sp.Symbol("p", positive=True)
    >>> plain = DitherSystem(TIME, PHASE, OMEGA, (x,), (0,), ((1,), (x,)), (sp.cos(PHASE), sp.sin(PHASE)))
    >>> PoweredSystem(plain, (p, 1 - p)).to_system().rhs
    (omega**p*cos(omega*tau) + omega**(1 - p)*x*sin(omega*tau),)
    """

    plain: DitherSystem
    powers: tuple[sp.Expr, ...]
    conditions: tuple[Relation, ...] = ()

    def __post_init__(self) -> None:
        system = self.plain
        powers = tuple(sp.sympify(power) for power in self.powers)
        object.__setattr__(self, "powers", powers)
        object.__setattr__(self, "conditions", tuple(self.conditions))
        if len(powers) != len(system.fields):
            raise InputError(f"{system.name}: {len(powers)} powers for {len(system.fields)} dithers")
        for i, power in enumerate(powers, start=1):
            check_linear(power, f"{system.name}: the power of dither {i}")
        own = set().union(*(power.free_symbols for power in powers), set())
        if taken := own & {system.time, system.phase, system.omega, *system.state}:
            raise InputError(f"{system.name}: a power depends on {', '.join(sorted(map(str, taken)))}")
        for condition in self.conditions:
            if condition.sign == "!=" or not condition.free_symbols <= own:
                raise InputError(f"{system.name}: the condition {condition} is not about parameters of the powers")
        self._check_range()

    def _check_range(self) -> None:
        name, conditions = self.plain.name, Exponents(self.conditions)
        spoken = set().union(*(condition.free_symbols for condition in self.conditions), set())
        for i, power in enumerate(self.powers, start=1):
            inside = _inside(power)
            where = f"{name}: the power of dither {i} is {power}"
            if conditions.point(*inside) is None:
                raise InputError(f"{where}, not between 0 and 1")
            if not power.free_symbols or not power.free_symbols <= spoken:
                continue
            for bound in inside:
                if (point := conditions.point(bound.negation())) is not None:
                    raise InputError(
                        f"{where}, not between 0 and 1 for {told(point)}, which the conditions allow; add {bound}"
                    )
        if self.exponents.point() is None:
            raise InputError(f"{name}: for no values of their parameters are all powers between 0 and 1")

    @property
    def exponents(self) -> Exponents:
        """The values of the powers' parameters that are allowed."""
        bounds = dict.fromkeys(bound for power in self.powers for bound in _inside(power))
        return Exponents((*self.conditions, *bounds))

    @property
    def name(self) -> str:
        return self.plain.name

    @property
    def state(self) -> tuple[sp.Symbol, ...]:
        return self.plain.state

    def to_system(self, name: str | None = None) -> System:
        """The equation itself, with the phase replaced by ω·time."""
        system = self.plain
        total = list(system.drift)
        for place, power in enumerate(self.powers):
            alone = replace(
                system, drift=(0,) * len(system.state), fields=(system.fields[place],), dithers=(system.dithers[place],)
            )
            for row, entry in enumerate(alone.to_system().rhs):
                total[row] += entry / sp.sqrt(system.omega) * system.omega**power
        return System(system.time, system.state, tuple(total), name=self.name if name is None else name)

    def _repr_latex_(self) -> str:
        return self.to_system()._repr_latex_()


def _inside(power: sp.Expr) -> tuple[Relation, Relation]:
    return Relation(sp.S.Zero, "<", power), Relation(power, "<", sp.S.One)


@dataclass(frozen=True)
class PoweredProblem:
    """A :class:`PoweredSystem` and what is asked about it; the words are those of :class:`DitherProblem`.

    ``order`` is 1 or 2: brackets of two fields, or of three fields too, are what the average may have.
    """

    system: PoweredSystem
    order: int = 2
    functions: tuple[AppliedUndef, ...] | None = None
    region: dict[sp.Symbol, tuple[sp.Expr, sp.Expr]] = field(default_factory=dict)
    start: sp.Expr | None = sp.S.Zero
    bounded: tuple[AppliedUndef, ...] = ()
    expected: tuple[sp.Expr, ...] | None = None

    def __post_init__(self) -> None:
        if self.order not in (1, 2):
            raise InputError(f"{self.system.name}: the order is 1 or 2, not {self.order}")
        _ = self.plain  # which refuses what does not fit

    @property
    def plain(self) -> DitherProblem:
        """The same about the system in which each power is 1/2: what it says of fields and dithers holds here."""
        return DitherProblem(
            self.system.plain, None, self.functions, self.region, self.start, self.bounded, self.expected
        )


def with_powers(
    system: DitherSystem,
    powers: Sequence[sp.Expr],
    frequencies: Sequence[sp.Expr] | None = None,
    conditions: Sequence[Relation] = (),
) -> PoweredSystem:
    """dx/dt = drift + Σ ω^(powers[i]) fields[i] · dithers[i](frequencies[i] · phase).

    >>> from ptproof.averaging.problem import OMEGA, PHASE, TIME
    >>> x = sp.Symbol("x", real=True)
    >>> plain = DitherSystem(TIME, PHASE, OMEGA, (x,), (0,), ((1,), (x,)), (sp.cos(PHASE), sp.sin(PHASE)))
    >>> with_powers(plain, [sp.Rational(2, 3)] * 2, [1, sp.Rational(3, 2)]).plain.dithers
    (cos(theta), sin(3*theta/2))
    """
    plain = system if frequencies is None else with_frequencies(system, frequencies)
    return PoweredSystem(plain, tuple(map(sp.sympify, powers)), tuple(conditions))


def with_frequencies(system: DitherSystem, frequencies: Sequence[sp.Expr]) -> DitherSystem:
    """The same system with dithers[i](frequencies[i] · phase), over the period that all of them have then.

    Raises
    ------
    InputError
        If a frequency is not a positive rational number.
    """
    ratios = [sp.sympify(value) for value in frequencies]
    if len(ratios) != len(system.dithers):
        raise InputError(f"{system.name}: {len(ratios)} frequencies for {len(system.dithers)} dithers")
    for i, ratio in enumerate(ratios, start=1):
        if not (ratio.is_Rational and ratio > 0):
            raise InputError(f"{system.name}: the frequency of dither {i} is {ratio}, not a positive rational number")
    if all(ratio == 1 for ratio in ratios):
        return system
    # The least common multiple of 1/k, over all k = a/b: of the b over the greatest common divisor of the a.
    turns = sp.Rational(math.lcm(*(int(ratio.q) for ratio in ratios)), math.gcd(*(int(ratio.p) for ratio in ratios)))
    dithers = tuple(_faster(system, dither, ratio) for dither, ratio in zip(system.dithers, ratios, strict=True))
    return replace(system, dithers=dithers, period=system.period * turns)


def _faster(system: DitherSystem, dither: sp.Expr, ratio: sp.Rational) -> sp.Expr:
    """The dither at ``ratio`` times the phase; what is Piecewise in it is extended periodically first."""
    phase, period, inside = system.phase, system.period, sp.Dummy("phase", real=True)
    now = ratio * phase
    pieces = [node for node in dither.atoms(sp.Piecewise) if phase in node.free_symbols]
    moved = dither.xreplace({node: node.subs(phase, inside) for node in pieces})
    return moved.subs(phase, now).subs(inside, now - period * sp.floor(now / period))
