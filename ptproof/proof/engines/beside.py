"""An expression of one variable beside an exact point: its smooth branch on one side, its sign, its poles."""

from __future__ import annotations

import sympy as sp

from ptproof.proof.kinks import KINKS, resolved
from ptproof.proof.signs import sign_of

_ANALYTIC = (
    sp.Symbol, sp.Number, sp.NumberSymbol, sp.Add, sp.Mul, sp.Pow, sp.exp, sp.log, sp.sin, sp.cos, sp.sinh, sp.cosh,
    sp.tanh, sp.atan, sp.asinh, sp.asin, sp.acos, sp.erf, sp.sec,
)  # fmt: skip


def is_analytic(branch: sp.Expr, variable: sp.Symbol, root: sp.Expr) -> bool:
    """Whether it is certain that the branch is real and analytic around the root."""
    for node in sp.preorder_traversal(branch):
        if variable not in node.free_symbols:
            continue
        there = [argument.subs(variable, root) for argument in node.args]
        match node:
            case sp.Pow():
                if node.base is sp.E or (node.exp.is_Integer and node.exp > 0):
                    continue
                if sign_of(there[0]) not in ((1, -1) if node.exp.is_Integer else (1,)):
                    return False
            case sp.log():
                if sign_of(there[0]) != 1:
                    return False
            case sp.asin() | sp.acos():
                if sign_of(1 - there[0] ** 2) != 1:
                    return False
            case sp.sec():
                if sign_of(sp.cos(there[0])) not in (1, -1):
                    return False
            case _ if not isinstance(node, _ANALYTIC):
                return False
    return True


def sign_beside(entry: sp.Expr, variable: sp.Symbol, root: sp.Expr, side: int) -> int | None:
    """The sign of ``entry`` beside the root, from its first derivative that does not vanish there."""
    if entry.is_number or not entry.has(variable):
        return sign_of(entry)
    if not is_analytic(entry, variable, root):
        return None
    for count in range(5):
        value = sign_of(sp.diff(entry, variable, count).subs(variable, root))
        if value != 0:
            return None if value is None else value * side**count
    return None


def one_sided(line: sp.Expr, variable: sp.Symbol, root: sp.Expr, side: int) -> sp.Expr | None:
    """The smooth expression that ``line`` is beside ``root``, or None."""

    def sign(entry: sp.Expr) -> int | None:
        return sign_beside(entry, variable, root, side)

    def floor_of(level: sp.Expr) -> int | None:
        """The integer part of ``level`` on that side."""
        there = level.subs(variable, root)
        if not there.is_number or sign_of(there - sp.floor(there)) not in (0, 1):
            return None
        whole = sp.floor(there)
        return int(whole) - (sign_of(there - whole) == 0 and sign(level - whole) == -1)

    branch = resolved(line, {variable}, sign, floor_of)
    return None if branch is None or branch.has(sp.nan, *KINKS) else branch


def is_not_real(value: sp.Expr) -> bool:
    """Whether an exact number certainly has an imaginary part."""
    if not value.has(sp.I) or value.has(sp.nan, sp.zoo, sp.oo, sp.AccumBounds):
        return False
    return sign_of(sp.im(value)) in (-1, 1)


def is_pole(branch: sp.Expr, variable: sp.Symbol, root: sp.Expr) -> bool:
    """Whether the branch is a quotient whose denominator alone vanishes at ``root``."""
    together = sp.cancel(sp.together(branch)) if branch.is_rational_function(variable) else sp.together(branch)
    numerator, denominator = sp.fraction(together)
    if variable not in denominator.free_symbols:
        return False
    if not is_analytic(numerator, variable, root):
        return False
    top = sign_of(numerator.subs(variable, root))
    return top in (-1, 1) and sign_of(denominator.subs(variable, root)) == 0
