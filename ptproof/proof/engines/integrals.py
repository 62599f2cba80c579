"""Integrals by the fundamental theorem: an antiderivative that is checked, taken between the ends.

The antiderivative comes from SymPy's indefinite integration and is not trusted: its derivative must be the
integrand by exact algebra, and it must be continuous between the ends (no denominator that may vanish).
Definite integration by SymPy is never asked: over a full period it has been wrong without notice.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import relations_of
from ptproof.proof.verdict import Evidence, Verdict

_CONTINUOUS = (
    sp.sin, sp.cos, sp.exp, sp.log, sp.Add, sp.Mul, sp.Pow, sp.Symbol, sp.Number, sp.NumberSymbol, sp.atan
)  # fmt: skip


@engine
def integrals(goal: Goal) -> Evidence:
    """Show equalities whose left side contains definite integrals."""
    for part in relations_of(goal.statement):
        if part.sign != "=":
            return Evidence("fundamental theorem", Verdict.UNDECIDED, f"not an equality: {part}")
        found = evaluate(part.left)
        if found is None:
            return Evidence("fundamental theorem", Verdict.UNDECIDED, f"no checked antiderivative for {part}")
        if not vanishes(found - part.right):
            detail = f"the integral is {found}"
            return Evidence("fundamental theorem", Verdict.UNDECIDED, detail, found={part.left: found})
    detail = "an antiderivative whose derivative is the integrand by exact algebra, between the ends"
    return Evidence("fundamental theorem", Verdict.PROVED, detail)


def evaluate(expression: sp.Expr) -> sp.Expr | None:
    """Replace every definite integral by its value, innermost first; None if one resists."""
    while True:
        inner = [node for node in expression.atoms(sp.Integral) if not node.function.has(sp.Integral)]
        if not inner:
            return expression
        for node in sorted(inner, key=str):
            value = definite(node)
            if value is None:
                return None
            expression = expression.xreplace({node: value})


def definite(node: sp.Integral) -> sp.Expr | None:
    """The value of one definite integral over an interval, or None."""
    if len(node.limits) != 1 or len(node.limits[0]) != 3:
        return None
    variable, low, high = node.limits[0]
    # Between ends at or above 0 the variable itself is, and SymPy may know that a denominator is positive.
    above = bool(low.is_nonnegative) and bool(high is sp.oo or high.is_nonnegative)
    inside = sp.Dummy(variable.name, nonnegative=True) if above else sp.Dummy(variable.name, real=True)
    integrand = node.function.subs(variable, inside)
    antiderivative = sp.integrate(sp.expand(integrand), inside)
    if antiderivative.has(sp.Integral):
        antiderivative = sp.integrate(integrand, inside)
    if antiderivative.has(sp.Integral, sp.Piecewise) or not continuous(antiderivative, inside):
        return None
    if not vanishes(sp.diff(antiderivative, inside) - integrand):
        return None
    upper = limit_of(antiderivative, inside, sp.oo) if high is sp.oo else antiderivative.subs(inside, high)
    return None if upper is None else upper - antiderivative.subs(inside, low)


def continuous(expression: sp.Expr, variable: sp.Symbol) -> bool:
    """Whether its structure and the symbols' signs show it: no denominator, root or logarithm of what may vanish."""
    for node in sp.preorder_traversal(expression):
        if not node.has(variable):
            continue
        if not isinstance(node, _CONTINUOUS):
            return False
        if isinstance(node, sp.Pow) and not (node.exp.is_integer and node.exp.is_nonnegative):
            base = sp.factor(node.base)
            if not (base.is_positive or (node.exp.is_integer and (base.is_negative or base.is_nonzero))):
                return False
        if isinstance(node, sp.log) and not sp.factor(node.args[0]).is_positive:
            return False
    return True
