"""Expressions made ready for exact algebra: derivatives carried out, everything written in a few functions."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.powers import reduced
from ptproof.proof.rewriting import carried_out, everywhere

_COMPARISONS = (sp.LessThan, sp.StrictLessThan, sp.GreaterThan, sp.StrictGreaterThan)

_WRITTEN = {
    sp.tan: lambda a: sp.sin(a) / sp.cos(a),
    sp.cot: lambda a: sp.cos(a) / sp.sin(a),
    sp.sec: lambda a: 1 / sp.cos(a),
    sp.csc: lambda a: 1 / sp.sin(a),
    sp.sinh: lambda a: (sp.exp(a) - sp.exp(-a)) / 2,
    sp.cosh: lambda a: (sp.exp(a) + sp.exp(-a)) / 2,
    sp.tanh: lambda a: (sp.exp(a) - sp.exp(-a)) / (sp.exp(a) + sp.exp(-a)),
}


class NotAlgebraic(Exception):
    """The expression contains something that exact algebra has no rule for."""


@lru_cache(maxsize=4096, typed=True)
def prepare(expression: sp.Expr) -> sp.Expr:
    """Carry out derivatives, write tan and hyperbolic functions by sin, cos, exp, and split sums of angles."""
    expression = sp.sympify(expression)
    if expression.has(sp.Limit, sp.Sum, sp.Product):
        # ``doit`` would ask SymPy for it, hint or no hint, and SymPy's answers are not trusted here.
        raise NotAlgebraic("a limit, a sum or a product over an index, about which exact algebra knows nothing")
    expression = carried_out(expression)
    if expression.has(sp.Float):
        raise NotAlgebraic("a floating-point number; write it as a fraction or as decimal text")
    if expression.has(*_WRITTEN):
        for function, written in _WRITTEN.items():
            expression = expression.replace(function, written)
    # One function at two equal arguments has to become one generator.
    return _angles(reduced(_arguments(expression)))


@lru_cache(maxsize=2**14)
def _factored(argument: sp.Expr) -> sp.Expr:
    return argument if argument.is_Symbol else sp.factor(sp.cancel(sp.together(argument)))


def by_comparisons(expression: sp.Piecewise) -> bool:
    """Whether it is a choice by one comparison after the other, and nothing is left over."""
    *some, (_, last) = expression.args
    return last is sp.true and all(isinstance(condition, _COMPARISONS) for _, condition in some)


def real_where_defined(expression: sp.Expr) -> bool:
    """Whether every value is real: a quotient, a power or a choice of real numbers is, wherever it is defined."""
    match expression:
        case sp.Piecewise():
            return all(real_where_defined(value) for value, _ in expression.args)
        case sp.Add() | sp.Mul():
            return all(map(real_where_defined, expression.args))
        case sp.Pow() if expression.exp.is_integer:
            return real_where_defined(expression.base)
    return bool(expression.is_real)


def _angle(function: type, argument: sp.Expr) -> sp.Expr:
    """Write sin or cos of a sum by sines and cosines of its terms, their arguments in expanded form."""
    numerator, denominator = sp.fraction(sp.together(argument))
    terms = [sp.cancel(term / denominator) for term in sp.Add.make_args(sp.expand(numerator))]
    return sp.expand_trig(function(sp.Add(*terms)))


_arguments = everywhere(AppliedUndef, lambda node: node.func(*map(_factored, node.args)))
_angles = everywhere((sp.sin, sp.cos), lambda node: _angle(node.func, node.args[0]))
