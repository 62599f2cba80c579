"""Values of derivatives, integrals and limits by this package's own rules.

SymPy's definite integrals and one-sided limits have been wrong without notice (∫₀^{7π} |sin| came out as 2), so no
verdict may rest on ``doit`` of one.
"""

from __future__ import annotations

from functools import lru_cache

import sympy as sp
from sympy.simplify.fu import TR8

from ptproof.proof.definedness import covers
from ptproof.proof.engines.limits import INFINITE, limit_of
from ptproof.proof.signs import vanishes
from ptproof.system import differentiated

_CONTINUOUS = (
    sp.sin, sp.cos, sp.exp, sp.log, sp.Add, sp.Mul, sp.Pow, sp.Symbol, sp.Number, sp.NumberSymbol, sp.atan
)  # fmt: skip


def carried_out(expression: sp.Expr) -> sp.Expr | None:
    """``expression`` without derivatives, integrals and limits, innermost first; None where no rule gives a value.

    What is infinite is a value only by itself: there is no square of it.

    >>> x = sp.Symbol("x", real=True)
    >>> carried_out(sp.Integral(sp.cos(x) ** 2, (x, 0, sp.pi))), carried_out(sp.Integral(abs(sp.sin(x)), (x, 0, 9)))
    (pi/2, None)
    """
    while True:
        expression = differentiated(expression)
        if expression.has(sp.Sum, sp.Product):
            return None
        binders = expression.atoms(sp.Integral, sp.Limit)
        if not binders:
            return expression
        for node in sorted(binders, key=sp.default_sort_key):
            if node.args[0].has(sp.Integral, sp.Limit):
                continue
            if isinstance(node, sp.Integral):
                value = definite(node)
            else:
                inside, variable, point, side = node.args
                value = limit_of(inside, variable, point, str(side))
            if value is None or (value in INFINITE and node != expression):
                return None
            expression = expression.xreplace({node: value})


@lru_cache(maxsize=256)
def definite(node: sp.Integral) -> sp.Expr | None:
    """The value of one definite integral over an interval, or None; of an iterated one the innermost comes first."""
    if len(node.limits) > 1:
        inner = definite(node.func(node.function, node.limits[0]))
        return None if inner is None or inner in INFINITE else definite(node.func(inner, *node.limits[1:]))
    if len(node.limits[0]) != 3:
        return None
    variable, low, high = node.limits[0]
    if not covers(variable, low, high):
        return None
    # Between ends at or above 0 the variable itself is, and SymPy may know that a denominator is positive.
    above = bool(low.is_nonnegative) and bool(high is sp.oo or high.is_nonnegative)
    inside = sp.Dummy(variable.name, nonnegative=True) if above else sp.Dummy(variable.name, real=True)
    integrand = node.function.subs(variable, inside)
    antiderivative = _of_waves(sp.expand(integrand), inside)
    if antiderivative is None:
        antiderivative = sp.integrate(sp.expand(integrand), inside)
    if antiderivative.has(sp.Integral):
        antiderivative = sp.integrate(integrand, inside)
    if antiderivative.has(sp.Integral, sp.Piecewise) or not continuous(antiderivative, inside):
        return None
    if not vanishes(sp.diff(antiderivative, inside) - integrand):
        return None
    upper, lower = (_at_end(antiderivative, inside, end) for end in (high, low))
    if upper is None or lower is None or (upper in INFINITE and lower in INFINITE):
        return None
    return upper - lower


def _of_waves(expression: sp.Expr, variable: sp.Symbol) -> sp.Expr | None:
    """An antiderivative of products of sines and cosines, which are sums of such; None where there are no products.

    It is checked afterwards, as any other.
    """
    if sum(wave.has(variable) for wave in expression.atoms(sp.sin, sp.cos)) < 2:
        return None
    terms = [_of_wave(term, variable) for term in sp.Add.make_args(sp.expand(TR8(expression)))]
    return None if None in terms else sp.Add(*terms)


def _of_wave(term: sp.Expr, variable: sp.Symbol) -> sp.Expr | None:
    """An antiderivative of a polynomial times one sine or cosine of what is linear, or None; by parts."""
    waves = [wave for wave in term.atoms(sp.sin, sp.cos) if wave.has(variable)]
    if len(waves) != 1:
        return None if waves else sp.integrate(term, variable)
    (wave,) = waves
    rate, amplitude = sp.diff(wave.args[0], variable), term / wave
    if rate.has(variable) or not rate.is_nonzero or not amplitude.is_polynomial(variable):
        return None
    raised = (sp.sin(wave.args[0]) if isinstance(wave, sp.cos) else -sp.cos(wave.args[0])) / rate
    left = sp.expand(-sp.diff(amplitude, variable) * raised)
    rest = [_of_wave(part, variable) for part in sp.Add.make_args(left)]
    return None if None in rest else sp.Add(amplitude * raised, *rest)


def _at_end(antiderivative: sp.Expr, variable: sp.Symbol, end: sp.Expr) -> sp.Expr | None:
    if end not in INFINITE:
        return antiderivative.subs(variable, end)
    return limit_of(antiderivative, variable, end)


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
