"""The check of an expansion: it is put back into the system, and everything up to its order has to cancel.

Nothing of the calculation is used but what it prints: SymPy differentiates, another algebra adds up
(:mod:`ptproof.averaging.fractions`), and the series in δ are formed by derivatives at δ = 0.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import sympy as sp

from ptproof.averaging.damped import Pieces
from ptproof.averaging.expansion import Expansion
from ptproof.averaging.fractions import Fractions, Sum, reading, total
from ptproof.averaging.oscillation import DELTA, Oscillation
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.switching import between, branch_at
from ptproof.proof.kinks import innermost
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "substitution"


def put_back(expansion: Expansion) -> Evidence:
    """proved: along every solution dW/dσ equals the means up to the order of the expansion, exactly.

    For a closed expansion the means are taken at X = x + δ W_1 + …, for an open one at x, and there all of ``rest`` is
    checked too. The correctors are checked to be continuous and periodic where dithers switch, and the means to depend
    on slow states only. undecided: something did not cancel in the algebra that is used.
    """
    own = expansion.oscillation
    for row in expansion.means:
        for entry in row:
            if entry.free_symbols & {own.phase, *own.fast}:
                return _open(f"the mean {entry} depends on the phase or a fast state")
    middles, joints = _pieces(expansion)
    try:
        for middle in middles:
            if (found := _first_left(expansion, middle)) is not None:
                return _open(found)
        for left, right, first, second in joints:
            if (found := _first_jump(expansion, left, right, first, second)) is not None:
                return _open(found)
    except AveragingUndecided as error:
        return _open(str(error))
    return Evidence(
        ENGINE, Verdict.PROVED, f"put back into the system, everything up to delta^{expansion.order} cancels"
    )


def _open(detail: str) -> Evidence:
    return Evidence(ENGINE, Verdict.UNDECIDED, detail)


def _first_left(expansion: Expansion, middle: sp.Expr) -> str | None:
    """The first order at which something is left over on the piece of the period around ``middle``, in words."""
    return reading(lambda algebra: _Substituted(expansion, middle, algebra).first_left())


class _Substituted:
    """An expansion, put into its system, on one piece of the period."""

    def __init__(self, expansion: Expansion, middle: sp.Expr, algebra: Fractions) -> None:
        self._expansion, self._algebra = expansion, algebra
        own = self._own = expansion.oscillation

        def there(entry: sp.Expr) -> Sum:
            return algebra.read(_at_piece(entry, own.phase, middle))

        self._there = there
        correctors = [expansion.observables, *expansion.correctors]
        self._rates = [[*map(there, row)] for row in _by_powers(own, expansion.order + 1 if own.whole else None)]
        self._local = [[*map(there, row)] for row in correctors]
        self._shifts: dict[tuple[int, int], sp.Dummy] = {}
        self._derived: dict[tuple[int, int, int], sp.Expr] = {}

    def first_left(self) -> str | None:
        expansion, order = self._expansion, self._expansion.order
        for power in range(1, order + 1 if expansion.closed else max((*expansion.rest, order)) + 1):
            for place, observable in enumerate(expansion.observables):
                said = ({below: -value for below, value in entry.items()} for entry in self._said(place, power))
                terms = [*self._derivative(place, power), *said]
                if not self._algebra.vanishes(terms):
                    return f"at delta^{power} something is left over in the equation of {observable}"
        return None

    def _derivative(self, place: int, power: int) -> Iterator[Sum]:
        """The terms of dW/dσ at δ^power."""
        for n, row in enumerate(self._local):
            if 0 <= power - n < len(self._rates):
                for symbol, rate in zip(self._own.states, self._rates[power - n], strict=True):
                    if rate:
                        yield self._algebra.product(rate, self._algebra.derivative(row[place], symbol))

    def _said(self, place: int, power: int) -> Iterator[Sum]:
        """What the expansion says that they are."""
        expansion = self._expansion
        if not expansion.closed:
            said = expansion.means[power - 1] if power <= expansion.order else expansion.rest.get(power)
            return iter(() if said is None else (self._there(said[place]),))
        return (
            self._put(self._moved(j, place, power - j), sp.Rational(1, sp.factorial(power - j)))
            for j in range(1, power + 1)
            if expansion.means[j - 1][place] != 0
        )

    def _moved(self, j: int, place: int, times: int) -> sp.Expr:
        """∂^times G_j(X)/∂δ^times at δ = 0, where ξ_r stands for the r-th derivative of X: D ξ_r = ξ_(r+1)."""
        key = j, place, times
        if key not in self._derived:
            if times == 0:
                return self._expansion.means[j - 1][place]
            before = self._moved(j, place, times - 1)
            moves = [(symbol, self._shift(i, 1)) for i, symbol in enumerate(self._own.slow)]
            moves += [(symbol, self._shift(i, r + 1)) for (i, r), symbol in list(self._shifts.items())]
            self._derived[key] = sp.Add(*(sp.diff(before, symbol) * shift for symbol, shift in moves))
        return self._derived[key]

    def _shift(self, i: int, r: int) -> sp.Dummy:
        return self._shifts.setdefault((i, r), sp.Dummy(f"xi{i}_{r}", real=True))

    def _put(self, value: sp.Expr, factor: sp.Rational) -> Sum:
        """``value`` times ``factor`` with r! W_r in place of ξ_r."""
        algebra = self._algebra
        result = algebra.read(sp.S.Zero)
        own = {symbol: (i, r) for (i, r), symbol in self._shifts.items()}
        for term in sp.Add.make_args(sp.expand_mul(value)):
            rest, shifted = term.as_independent(*own, as_Add=False)
            product = algebra.read(rest * factor)
            for symbol, power in shifted.as_powers_dict().items():
                i, r = own.get(symbol, (0, 0))
                for _ in range(int(power) if symbol in own else 0):
                    product = algebra.product(product, self._local[r][i])
                    product = algebra.product(product, algebra.read(sp.factorial(r)))
            result = total(result, product)
        return result


def _by_powers(own: Oscillation, highest: int | None) -> list[list[sp.Expr]]:
    """[j] holds the rates of slow states, phase and fast states at δ^j, by derivatives at δ = 0."""
    found: list[list[sp.Expr]] = []
    current = list(own.right_hand_side)
    for power in itertools.count():
        if all(entry == 0 for entry in current) or (highest is not None and power > highest):
            break
        found.append([entry.subs(DELTA, 0).doit() / sp.factorial(power) for entry in current])
        current = [sp.diff(entry, DELTA) for entry in current]
    return found


def _pieces(expansion: Expansion) -> tuple[list[sp.Expr], list[tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]]]:
    """A point inside each piece of the period; (left end, right start, point before, point after) of each joint."""
    phases = expansion.waves.phases
    if not isinstance(phases, Pieces):
        return [sp.S.Zero], []
    points = phases.points
    middles = [between(a, b) for a, b in itertools.pairwise(points)]
    joints = [(point, point, a, b) for point, (a, b) in zip(points[1:-1], itertools.pairwise(middles), strict=True)]
    return middles, [*joints, (points[-1], points[0], middles[-1], middles[0])]


def _at_piece(entry: sp.Expr, phase: sp.Symbol, middle: sp.Expr) -> sp.Expr:
    """The smooth expression that holds around the phase ``middle``."""
    while (node := innermost(entry, {phase})) is not None:
        value = branch_at(node, phase, middle)
        if value is None:
            raise AveragingUndecided(f"which branch of {node} holds is not known")
        entry = entry.xreplace({node: value})
    return entry


def _first_jump(expansion: Expansion, left: sp.Expr, right: sp.Expr, first: sp.Expr, second: sp.Expr) -> str | None:
    """A corrector that is not shown to be continuous where the pieces around two points meet, in words."""
    return reading(lambda algebra: _jump(expansion, algebra, left, right, first, second))


def _jump(
    expansion: Expansion, algebra: Fractions, left: sp.Expr, right: sp.Expr, first: sp.Expr, second: sp.Expr
) -> str | None:
    phase = expansion.oscillation.phase
    for power, row in enumerate(expansion.correctors, start=1):
        for entry in row:
            before = _at_piece(entry, phase, first).subs(phase, left)
            after = _at_piece(entry, phase, second).subs(phase, right)
            if not algebra.vanishes(map(algebra.read, (before, -after))):
                return f"the corrector of order {power} is not shown to be continuous at {phase} = {left}"
    return None
