"""What the steps from system to system ask of letters and formulas: no clash, no jump, values of the right kind."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.declarations import SAYS, is_kind
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.reals import follows
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Verdict

_SECONDS = 2.0
# Analytic on every interval on which they are defined and real.
_ANALYTIC = (
    sp.Symbol, sp.Number, sp.NumberSymbol, sp.Add, sp.Mul, sp.Pow, sp.exp, sp.log, sp.sin, sp.cos, sp.tan, sp.sinh,
    sp.cosh, sp.tanh, sp.atan, sp.asinh, sp.asin, sp.acos, sp.erf, AppliedUndef,
)  # fmt: skip


def fresh(new: sp.Symbol, used: Iterable[sp.Symbol], where: str) -> None:
    """Refuse a new letter whose name is already in use, be it as a symbol of another kind."""
    if new.name in {symbol.name for symbol in used}:
        raise InputError(f"{where}: the letter {new} is already in use; name another one")


def is_differentiable(expression: sp.Expr, variables: Iterable[sp.Symbol]) -> bool:
    """Whether it is shown to be real and continuously differentiable for all values; undefined functions are smooth."""
    smooth = dict.fromkeys((applied.func for applied in expression.atoms(AppliedUndef)), sp.oo)
    return smoothness(expression, tuple(variables), 1, smooth).verdict is Verdict.PROVED


def moves_smoothly(expression: sp.Expr, variables: Iterable[sp.Symbol]) -> bool:
    """Whether it is shown to be differentiable wherever it is defined and real, and that is not shown to be nowhere.

    Where SymPy differentiates it, nothing is then lost: the derivative of a jump comes out as 0.
    """
    moving = set(variables)
    nodes = (node for node in sp.preorder_traversal(expression) if node.free_symbols & moving)
    if not all(isinstance(node, _ANALYTIC) for node in nodes) and not is_differentiable(expression, moving):
        return False
    return not any(
        need.relation is None or (not need.given and follows(need.relation.negation(), (), seconds=_SECONDS).shown)
        for need in obligations(expression)
        if not need.settled
    )


def is_of_kind(symbol: sp.Symbol, value: sp.Expr) -> bool:
    """Whether ``value`` is shown to be of the kind that ``symbol`` is declared to be."""

    def has_sign(entry: sp.Expr, word: str) -> bool:
        return follows(Relation(entry, SAYS[word], sp.S.Zero), (), seconds=_SECONDS).shown

    def is_real(entry: sp.Expr) -> bool:
        return all(need.settled for need in obligations(entry))

    return is_kind(symbol, value, has_sign, is_real)
