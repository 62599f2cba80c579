"""Rigorous enclosures of all v_ji at once, from the dithers themselves and by another route than the exact one.

The period is cut into panels. On each the dither is interpolated at Chebyshev points in ball arithmetic; the
error is bounded by the size of the analytic dither on a Bernstein ellipse (4 M ρ⁻ⁿ/(ρ − 1) for degree n, see
Trefethen, Approximation Theory and Approximation Practice, theorem 8.2). Where a dither switches, a sliver of
tiny width is left over and enters with its largest size.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.averaging.switching import on_ball
from ptproof.balls.ball import enclose, precision
from ptproof.balls.entire import compile_entire
from ptproof.proof.kinks import innermost
from ptproof.system import DitherSystem

_BITS = 80
_RULE_BITS = 320
_DEGREE = 32
_COARSEST = sp.Rational(1, 10**6)
_RHO = 4
_TARGET = sp.Rational(1, 10**8)
_SLIVER = sp.Rational(1, 10**13)
_MOST_PANELS = 20_000


def check_coefficients(
    system: DitherSystem, values: Mapping[tuple[int, int], sp.Expr], hints: Sequence[sp.Expr] = ()
) -> None:
    """Raise ``ArithmeticError`` if an exact v_ji lies outside its enclosure.

    ``hints`` are points where panels should end; wrong or missing ones cost time, not rigour.
    """
    from flint import arb

    with precision(_BITS):
        symbols = sample(set().union(*(dither.free_symbols for dither in system.dithers)) - {system.phase})
        readers = [_Reader(system, dither, symbols) for dither in system.dithers]
        enclosures = enclose_coefficients(system, readers, hints)
        unit = enclose(_COARSEST * system.period, bits=_BITS)
        for (j, i), exact in values.items():
            ball = enclosures[j - 1, i - 1]
            if not ball.rad() <= unit * readers[j - 1].scale * readers[i - 1].scale:
                raise ArithmeticError(f"the enclosure {ball} of v_{j},{i} is too wide to check anything")
            if not ball.overlaps(enclose(exact, symbols, bits=_BITS) if exact != 0 else arb(0)):
                raise ArithmeticError(f"v_{j},{i} = {exact} lies outside its enclosure {ball}; please report this")


def sample(symbols: set[sp.Symbol]) -> dict[sp.Symbol, Any]:
    """Exact values for symbols, as balls, that respect their assumptions: the same ones each time."""
    from flint import arb, fmpq

    ordered = sorted(symbols, key=lambda symbol: symbol.name)
    values = {}
    for place, symbol in enumerate(ordered):
        size = fmpq(place + 1) if symbol.is_integer else fmpq(7 * place + 5, 3 * place + 8)
        values[symbol] = arb(-size if symbol.is_negative or symbol.is_nonpositive else size)
    return values


@dataclass(frozen=True)
class _Panel:
    """One dither on one panel: ball values at the nodes, error of the interpolant, largest size."""

    nodes: list[Any] | None
    error: Any
    size: Any


def enclose_coefficients(system: DitherSystem, readers: Sequence[_Reader], hints: Sequence[sp.Expr] = ()) -> Any:
    """The matrix (flint ``arb_mat``, N × N) whose entry (j, i) contains v_ji."""
    from flint import arb, arb_mat

    count, nodes, weights, nested = len(system.dithers), *_rules()
    total, error = arb_mat(count, count), arb_mat(count, count)
    before = arb_mat(count, 1)
    for left, right in _panels(system, hints, readers):
        half, middle = (right - left) / 2, (right + left) / 2
        panels = [reader.panel(middle, half, nodes) for reader in readers]
        rows = arb_mat(count, len(nodes), [v for p in panels for v in (p.nodes or [arb(0)] * len(nodes))])
        sizes = [p.size for p in panels]
        errors = [p.error for p in panels]
        integral = rows * weights
        integrals = arb_mat(
            count, 1, [half * integral[k, 0] + arb(0, 1) * (2 * half * errors[k]) for k in range(count)]
        )
        # |u_j u_i − p_j p_i| ≤ e_j M_i + (M_j + e_j) e_i on a triangle of area 2 half².
        column = arb_mat(count, 1, errors)
        bound = column * arb_mat(1, count, sizes)
        bound += arb_mat(count, 1, [s + e for s, e in zip(sizes, errors, strict=True)]) * column.transpose()
        inner = rows * nested * rows.transpose() * (half * half)
        total += inner + integrals * before.transpose()
        error += bound * (2 * half * half)
        before += integrals
    total += arb_mat(count, count, [arb(0, 1) * entry for entry in error.entries()])
    return total * (1 / enclose(system.period, bits=_BITS))


def _panels(system: DitherSystem, hints: Sequence[sp.Expr], readers: Sequence[_Reader]) -> Iterator[tuple[Any, Any]]:
    """Consecutive panels on each of which every dither is well interpolated, or that are slivers."""
    from flint import arb

    end = enclose(system.period, bits=_BITS)
    gap = enclose(_SLIVER, bits=_BITS)
    inner = sorted({float(enclose(hint, bits=_BITS).mid()): hint for hint in hints}.items())
    cuts = [arb(0)]
    for _, hint in inner:
        point = enclose(hint, bits=_BITS)
        cuts += [cut for cut in ((point - gap).mid(), (point + gap).mid()) if cut > cuts[-1] and cut < end]
    if any(reader.switches for reader in readers):
        cuts += [cut for cut in [(end - gap).mid()] if cut > cuts[-1]]
    cuts.append(end)
    done = 0
    todo = list(reversed(list(itertools.pairwise(cuts))))
    while todo:
        left, right = todo.pop()
        half, middle = (right - left) / 2, (right + left) / 2
        if half < gap or all(reader.fits(middle, half) for reader in readers):
            done += 1
            yield left, right
        else:
            centre = middle.mid()
            todo += [(centre, right), (left, centre)]
        if done + len(todo) > _MOST_PANELS:
            raise ArithmeticError("the check of the coefficients needs too many panels")


class _Reader:
    """Evaluates one dither on panels; switches are resolved where they are decided on the whole panel."""

    def __init__(self, system: DitherSystem, dither: sp.Expr, symbols: Mapping[sp.Symbol, Any]) -> None:
        from flint import arb

        self.phase, self.symbols, self.dither = system.phase, dict(symbols), dither
        self.last: tuple[tuple[Any, Any], Any] | None = None
        self.switches = innermost(dither, {system.phase}) is not None
        whole = enclose(system.period, bits=_BITS) / 2
        self.scale = self.largest(arb(whole.mid(), whole.abs_upper()))
        self.target = enclose(_TARGET, bits=_BITS) * self.scale
        self.compiled = functools.cache(lambda expression: compile_entire(expression, self.symbols, _BITS))

    def smooth(self, middle: Any, half: Any) -> Any:
        """The analytic function that the dither is on the panel, or None."""
        from flint import arb

        if not self.switches:
            return self.compiled(self.dither)
        # A panel is asked about twice, once whether it fits and once for its values.
        place = (middle.mid(), half.mid())
        if self.last is None or self.last[0] != place:
            panel = arb(middle.mid(), _radius(middle, half))
            smooth = on_ball(self.dither, self.phase, panel, self.symbols)
            self.last = (place, None if smooth is None else self.compiled(smooth))
        return self.last[1]

    def fits(self, middle: Any, half: Any) -> bool:
        function = self.smooth(middle, half)
        return function is not None and bool(self.error(function, middle, half) <= self.target)

    def error(self, function: Any, middle: Any, half: Any) -> Any:
        """A bound for the error of the interpolant of degree ``_DEGREE`` on the panel."""
        from flint import acb, arb

        wide, high = arb(_RHO + arb(1) / _RHO) / 2, arb(_RHO - arb(1) / _RHO) / 2
        box = acb(arb(middle.mid(), _radius(middle, half * wide)), arb(0, (half * high).abs_upper()))
        size = acb(function({self.phase: box})).abs_upper()
        return 4 * size / (arb(_RHO) ** _DEGREE * (_RHO - 1))

    def panel(self, middle: Any, half: Any, nodes: Sequence[Any]) -> _Panel:
        from flint import arb

        ball = arb(middle.mid(), _radius(middle, half))
        function = self.smooth(middle, half)
        if function is None:
            size = self.largest(ball)
            return _Panel(None, size, size)
        values = [arb(function({self.phase: middle + half * node})) for node in nodes]
        size = arb(function({self.phase: ball})).abs_upper()
        return _Panel(values, self.error(function, middle, half), size)

    def largest(self, ball: Any) -> Any:
        """An upper bound of the dither's size on ``ball``, over all branches that may apply."""
        from flint import arb

        waves = self.dither.atoms(sp.asin, sp.acos, sp.atan, sp.Heaviside)
        bounded = {node: sp.Dummy("wave", real=True) for node in waves}
        values = {**self.symbols, **{symbol: arb(0, 4) for symbol in bounded.values()}, self.phase: ball}
        return enclose(self.dither.xreplace(bounded), values, bits=_BITS).abs_upper()


def _radius(middle: Any, half: Any) -> Any:
    return (half.abs_upper() + middle.rad()).abs_upper()


@functools.cache
def _rules() -> tuple[list[Any], Any, Any]:
    """Chebyshev nodes on [−1, 1], weights of ∫ p, and Q with f·Q·g = ∫ p_f(t) ∫₋₁^t p_g for interpolants."""
    # Lagrange's basis in powers of t loses most of the bits.
    with precision(_RULE_BITS):
        return _build_rules()


def _build_rules() -> tuple[list[Any], Any, Any]:
    from flint import arb, arb_mat, arb_poly

    n = _DEGREE + 1
    nodes = [-arb.cos_pi(arb(k) / _DEGREE) for k in range(n)]
    basis = []
    for k, node in enumerate(nodes):
        poly = arb_poly([1])
        for other in nodes[:k] + nodes[k + 1 :]:
            poly = poly * arb_poly([-other, 1]) * (1 / (node - other))
        basis.append(poly)

    def integral(poly: Any) -> Any:
        primitive = poly.integral()
        return primitive(arb(1)) - primitive(arb(-1))

    primitives = [poly.integral() for poly in basis]
    primitives = [poly - arb_poly([poly(arb(-1))]) for poly in primitives]
    weights = arb_mat(n, 1, [integral(poly) for poly in basis])
    nested = arb_mat(n, n, [integral(outer * inner) for outer in basis for inner in primitives])
    return nodes, weights, nested
