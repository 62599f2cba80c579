"""The coefficients v_ji = (1/P) ∫₀^P u_j(θ) ∫₀^θ u_i(s) ds dθ of Lie bracket averaging, exactly."""

from __future__ import annotations

import functools
import itertools
from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from flint import arb, fmpq
from sympy.simplify.fu import TR10i

from ptproof.averaging.quasipolynomial import exact_sign
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, NotAPeriod
from ptproof.averaging.signal import Signal, common_pieces, period_of, rates_of, read_signal
from ptproof.balls.ball import enclose, precision, separated
from ptproof.balls.nested import Functions
from ptproof.proof.declarations import SIGNS, declared
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.reals import follows
from ptproof.proof.signs import vanishes
from ptproof.system import DitherSystem

Coefficients = dict[tuple[int, int], sp.Expr]


def signals(system: DitherSystem) -> tuple[Signal, ...]:
    """Each dither over one period, exactly.

    Raises
    ------
    AveragingRefused
        If the period is not one, or a dither does not have zero mean.
    AveragingUndecided
        If a dither is outside the class that is integrated exactly, or not shown to be real for all its symbols.
    """
    if not system.period.is_number or exact_sign(system.period) <= 0:
        raise AveragingRefused("D", "period", f"the period must be a positive number, not {system.period}")
    result = []
    for i, dither in enumerate(system.dithers, start=1):
        where = f"dither {i}"
        try:
            signal = read_signal(dither, system.phase, system.period, where)
        except NotAPeriod as refusal:
            raise AveragingRefused("D", where, refusal.reason + _period_hint(system)) from None
        for value in sorted(signal.coefficients, key=sp.default_sort_key):
            if not _is_real(value, system.time):
                raise AveragingUndecided(f"{where}: {value} is not shown to be a real number for all its symbols")
        mean_is_zero(signal.mean, where, system)
        result.append(signal)
    return tuple(result)


def _is_real(value: sp.Expr, time: sp.Symbol) -> bool:
    """Whether it is shown to be defined and real; at which slow times it is, another hypothesis asks."""
    return all(
        need.settled
        or (
            need.relation is not None
            and (time in need.relation.free_symbols or follows(need.relation, need.given, seconds=1.0).shown)
        )
        for need in obligations(value)
    )


def _period_hint(system: DitherSystem) -> str:
    rates = set().union(*(rates_of(dither, system.phase) for dither in system.dithers))
    if not rates:
        return ""
    common = period_of(rates)
    if common is not None:
        return f"; the smallest common period is {common}"
    names = ", ".join(sorted(map(str, rates)))
    return f"; the frequencies {names} have an irrational ratio, so that there is no common period"


def mean_is_zero(mean: sp.Expr, where: str, system: DitherSystem) -> None:
    """Return if ``mean`` is identically zero, else raise :class:`AveragingRefused` or, unsure, `...Undecided`."""
    mean = sp.expand(mean)
    if vanishes(mean):
        return
    # At which slow times it would have to vanish is not known here, nor does a sample know of even or prime numbers.
    plain = all(set(declared(symbol)) <= {"real", "integer", *SIGNS} for symbol in mean.free_symbols - {system.time})
    if system.time in mean.free_symbols or not plain or separated(mean, sp.S.Zero, sample(mean.free_symbols)) is None:
        raise AveragingUndecided(f"{where}: whether its mean {mean} vanishes is not known")
    raise AveragingRefused(
        "D",
        where,
        f"it has the mean {mean} over a period, not 0; times a power of {system.omega} the average would "
        "grow without bound; subtract the mean",
    )


def v_matrix(system: DitherSystem, *, check: bool = True) -> Coefficients:
    """v_ji for all pairs i < j, exactly.

    Returns
    -------
    dict
        {(j, i): v_ji} with i < j counted from 1, as in eq:Lie_Bracket_System. The values may contain the
        symbols of phases and amplitudes and, where amplitudes vary slowly, the slow time.

    Raises
    ------
    AveragingRefused
        If the period is not one, or a dither does not have zero mean.
    AveragingUndecided
        If a dither is outside the class that is integrated exactly.
    ArithmeticError
        If an exact value lies outside its independent enclosure (that would be a bug).

    Guarantees
    ----------
    Each value is the exact integral, by finite algebra on smooth pieces, and (with ``check``) lies inside a
    rigorous enclosure that is computed from the dithers themselves by another method; where a value contains
    symbols, at exact values of these.

    Examples
    --------
    >>> tau, theta, x = sp.symbols("tau theta x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (F,)), (sp.cos(theta), sp.sin(theta)))
    >>> v_matrix(seeker)
    {(2, 1): 1/2}
    """
    found = signals(system)
    values = _all_pairs(found)
    if check:
        check_coefficients(system, values, [point for signal in found for point in signal.points])
    return values


def _all_pairs(found: tuple[Signal, ...]) -> Coefficients:
    values: Coefficients = {}
    sums = _trigonometric_pairs(found)
    for i, j in itertools.combinations(range(1, len(found) + 1), 2):
        if found[i - 1].is_trigonometric and found[j - 1].is_trigonometric:
            values[j, i] = tidy_constant(sp.Add(*sums.get((j, i), ())))
        else:
            values[j, i] = tidy_constant(nested_mean(found[j - 1], found[i - 1]))
    return values


def _trigonometric_pairs(found: tuple[Signal, ...]) -> dict[tuple[int, int], list[sp.Expr]]:
    """Σ over the common frequencies r of (a_i b_j − a_j b_i) / (2 r)."""
    by_rate: dict[sp.Expr, list[tuple[int, sp.Expr, sp.Expr]]] = defaultdict(list)
    for index, signal in enumerate(found, start=1):
        if signal.is_trigonometric:
            for (_, rate), (a, b) in signal.pieces[0].terms.items():
                if rate != 0:
                    by_rate[rate].append((index, a, b))
    sums: dict[tuple[int, int], list[sp.Expr]] = defaultdict(list)
    for rate, entries in by_rate.items():
        for (i, a_i, b_i), (j, a_j, b_j) in itertools.combinations(entries, 2):
            sums[j, i].append((a_i * b_j - a_j * b_i) / (2 * rate))
    return sums


def nested_mean(outer: Signal, inner: Signal) -> sp.Expr:
    """(1/P) ∫₀^P outer(θ) ∫₀^θ inner(s) ds dθ from the exact pieces of both."""
    total = []
    for start, end, p, q in common_pieces(outer, inner):
        primitive = (outer.pieces[p] * inner.antiderivatives[q]).antiderivative()
        total.append(primitive.at(end) - primitive.at(start))
    return sp.Add(*total) / outer.period


def tidy_constant(value: sp.Expr) -> sp.Expr:
    """The same value in readable form: sums of products of sines of phases become sines of differences."""
    if value.is_Rational:
        return value
    value = sp.expand(value)
    if value.has(sp.sin, sp.cos) and value.free_symbols and sp.count_ops(value) < 200:
        value = min((value, sp.factor_terms(TR10i(value))), key=sp.count_ops)
    return sp.radsimp(value) if value.is_number else value


def triple_means(found: tuple[Signal, ...]) -> Any:
    """⟨u_b U_a U_c⟩ as a function of (b, a, c), each product formed once."""
    rates = [
        frozenset(rate for _, rate in signal.pieces[0].terms) if signal.is_trigonometric else None for signal in found
    ]

    @functools.cache
    def product(a: int, c: int) -> Signal:
        return found[a].primitive * found[c].primitive

    @functools.cache
    def mean(b: int, a: int, c: int) -> sp.Expr:
        if a > c:
            return mean(b, c, a)
        first, second, third = rates[a], rates[b], rates[c]
        if first is not None and second is not None and third is not None:
            sums = {sign * p + q for p in first for q in second for sign in (1, -1)}
            if not any(total in third or -total in third for total in sums):
                return sp.S.Zero
        return (found[b] * product(a, c)).mean

    return mean


_BITS = 80
_COARSEST = arb("1e-6")


def check_coefficients(
    system: DitherSystem, values: Mapping[tuple[int, int], sp.Expr], hints: Sequence[sp.Expr] = ()
) -> None:
    """Raise ``ArithmeticError`` if an exact v_ji lies outside its enclosure.

    ``hints`` are points where a dither may switch; wrong or missing ones cost time, not rigour.
    """
    with precision(_BITS):
        symbols = sample(set().union(*(dither.free_symbols for dither in system.dithers)) - {system.phase})
        period = enclose(system.period, bits=_BITS)
        dithers = Functions(system.dithers, system.phase, period, symbols)
        enclosures, sizes = dithers.nested_integrals(hints), dithers.sizes
        for (j, i), exact in values.items():
            ball = enclosures[j - 1, i - 1] / period
            if not ball.rad() <= _COARSEST * period * sizes[j - 1] * sizes[i - 1]:
                raise ArithmeticError(f"the enclosure {ball} of v_{j},{i} is too wide to check anything")
            if not ball.overlaps(enclose(exact, symbols, bits=_BITS) if exact != 0 else arb(0)):
                raise ArithmeticError(f"v_{j},{i} = {exact} lies outside its enclosure {ball}; please report this")


def sample(symbols: set[sp.Symbol]) -> dict[sp.Symbol, arb]:
    """Exact values for symbols, as balls, that respect their assumptions: the same ones each time."""
    values = {}
    for place, symbol in enumerate(sorted(symbols, key=lambda symbol: symbol.name)):
        size = fmpq(place + 1) if symbol.is_integer else fmpq(7 * place + 5, 3 * place + 8)
        values[symbol] = arb(-size if symbol.is_negative or symbol.is_nonpositive else size)
    return values
