"""Symmetries of an expression that hold identically, shown by structure and by algebra.

No derivative decides alone: that of a jump is 0 for SymPy. Only a polynomial is differentiated.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.balls.rest import expandable


def same(left: sp.Expr, right: sp.Expr) -> bool:
    """Whether two expressions are seen to be equal when they are multiplied out."""
    return bool(left == right) or (expandable(left, 3) and bool(sp.expand(left - right) == 0))


def is_rotational(expression: sp.Expr, offsets: Sequence[sp.Symbol]) -> bool:
    """Whether every rotation about the origin leaves ``expression`` as it is, value and place of definition alike.

    Whatever is made of rotation-invariant parts, jumps included, is invariant: from the inside out, each such part is
    replaced by a letter, and what is left in the coordinates has to be a polynomial whose derivative along every
    rotation of two coordinates is identically 0, which for a polynomial is enough.

    Examples
    --------
    >>> x, y = sp.symbols("x y", real=True)
    >>> is_rotational(sp.exp(-(x**2) - y**2) * x**2 + y**2 * sp.exp(-(x**2) - y**2), [x, y])
    True
    >>> is_rotational((x**2 + y**2) * sp.Piecewise((1, y < 1), (2, True)), [x, y])
    False
    """
    if not expandable(expression, 3):
        return False
    rotations = _Rotations(tuple(offsets))
    # One exponential in the place of several: exp(-x²)·exp(-y²) turns as a whole.
    return not rotations.masked(sp.powsimp(expression, combine="exp")).free_symbols & rotations.own


class _Rotations:
    def __init__(self, offsets: tuple[sp.Symbol, ...]) -> None:
        self.offsets, self.own = offsets, frozenset(offsets)
        self._letters: dict[sp.Basic, sp.Dummy] = {}

    def masked(self, node: sp.Basic) -> sp.Basic:
        """``node`` with its invariant parts replaced by letters; it has no coordinate left where it is invariant."""
        if not node.free_symbols & self.own or node.is_Symbol:
            return node
        parts = [self.masked(argument) for argument in node.args]
        arithmetic = node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer and node.exp > 0)
        if arithmetic:
            rebuilt = node.func(*parts)
            return self._letter(node) if self._is_invariant_polynomial(rebuilt) else rebuilt
        return self._letter(node) if not any(part.free_symbols & self.own for part in parts) else node

    def _letter(self, node: sp.Basic) -> sp.Dummy:
        return self._letters.setdefault(node, sp.Dummy("invariant"))

    def _is_invariant_polynomial(self, node: sp.Basic) -> bool:
        if not (isinstance(node, sp.Expr) and node.is_polynomial(*self.offsets)):
            return False
        first, *rest = self.offsets
        return all(sp.expand(first * sp.diff(node, y) - y * sp.diff(node, first)) == 0 for y in rest)
