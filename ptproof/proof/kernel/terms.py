"""Expressions as Coq's terms over the reals; what has no faithful translation is refused with its name."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.names import Names


class NoTranslation(Exception):
    """An expression, symbol or statement that this translation does not know."""


_FUNCTIONS = {
    sp.exp: "exp", sp.log: "ln", sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.sinh: "sinh", sp.cosh: "cosh",
    sp.tanh: "tanh", sp.atan: "atan", sp.Abs: "Rabs",
}  # fmt: skip
_CONSTANTS = {sp.pi: "PI", sp.E: "(exp 1)"}
DECIDED = {sp.LessThan: "Rle_dec", sp.StrictLessThan: "Rlt_dec", sp.GreaterThan: "Rge_dec",
            sp.StrictGreaterThan: "Rgt_dec"}  # fmt: skip
SIGNS = {"=": "=", "!=": "<>", "<=": "<=", "<": "<", ">=": ">=", ">": ">"}


def term(expression: sp.Basic, names: Names) -> str:
    """The expression in the scope of Coq's reals, in brackets where it is not an atom: one argument of anything.

    Coq's functions are total: what they say outside their domain is excluded by
    :func:`ptproof.proof.kernel.obligations.obligations`.

    Raises
    ------
    NoTranslation
        For a symbol without a name (one that is not real, say), a number that is not exact, or an unknown function.
    """

    def write(part: sp.Basic) -> str:
        return term(part, names)

    if expression in names:
        return names[expression]
    if isinstance(expression, sp.Rational):
        return _rational(expression)
    if expression in _CONSTANTS:
        return _CONSTANTS[expression]
    for kind, writer in _WRITERS.items():
        if isinstance(expression, kind):
            return writer(expression, write)
    if isinstance(expression, AppliedUndef) and expression.func in names:
        return f"({names[expression.func]} {' '.join(map(write, expression.args))})"
    if expression.func in _FUNCTIONS:
        return f"({_FUNCTIONS[expression.func]} {' '.join(map(write, expression.args))})"
    what = f"the number {expression}" if isinstance(expression, sp.Number) else f"{type(expression).__name__}"
    raise NoTranslation(f"no translation for {what}" + (f" {expression}" if expression.is_Symbol else ""))


def _rational(value: sp.Rational) -> str:
    top = str(value.p) if value.p >= 0 else f"(-{-value.p})"
    return top if value.q == 1 else f"({top} / {value.q})"


Write = Callable[[sp.Basic], str]


def _sum(expression: sp.Basic, write: Write) -> str:
    first, *rest = expression.as_ordered_terms()
    text = write(first)
    for part in rest:
        text += f" - {write(-part)}" if part.could_extract_minus_sign() else f" + {write(part)}"
    return f"({text})"


def _product(expression: sp.Basic, write: Write) -> str:
    coefficient, rest = expression.as_coeff_Mul()
    if coefficient == -1:
        return f"(- {write(rest)})"
    above: list[str] = []
    below: list[str] = []
    for factor in expression.as_ordered_factors():
        if isinstance(factor, sp.Rational):
            if factor.p != 1:
                above.append(_rational(sp.Integer(factor.p)))
            if factor.q != 1:
                below.append(str(factor.q))
        elif _divides(factor):
            below.append(write(factor.base ** (-factor.exp)))
        else:
            above.append(write(factor))
    top = " * ".join(above) or "1"
    if not below:
        return f"({top})"
    bottom = " * ".join(below)
    return f"({top} / {bottom})" if len(below) == 1 else f"({top} / ({bottom}))"


def _divides(factor: sp.Basic) -> bool:
    """Whether the factor is written below the line: b^(-e) is 1 / b^e for numbers e, and for every e where b > 0."""
    if not isinstance(factor, sp.Pow) or not factor.exp.could_extract_minus_sign():
        return False
    return bool(factor.exp.is_Rational or positive_base(factor))


def positive_base(power: sp.Pow) -> bool:
    """Whether the power is written as e^(exponent ln base): its base then has to be shown positive."""
    return bool(power.base.is_positive)


def _power(expression: sp.Basic, write: Write) -> str:
    base, exponent = expression.args
    if exponent.could_extract_minus_sign() and _divides(expression):
        return f"(/ {write(base**-exponent)})"
    if isinstance(exponent, sp.Integer):
        return f"({write(base)} ^ {exponent})"
    if isinstance(exponent, sp.Rational) and exponent.q == 2:
        root = f"(sqrt {write(base)})"
        return root if exponent.p == 1 else f"({root} ^ {exponent.p})"
    return f"({'Rpower' if positive_base(expression) else 'rpow'} {write(base)} {write(exponent)})"


def _chain(name: str) -> Callable[[sp.Basic, Write], str]:
    def write_chain(expression: sp.Basic, write: Write) -> str:
        *others, last = sorted(expression.args, key=sp.default_sort_key)
        text = write(last)
        for part in reversed(others):
            text = f"({name} {write(part)} {text})"
        return text

    return write_chain


def _piecewise(expression: sp.Basic, write: Write) -> str:
    *branches, (last, otherwise) = expression.args
    if otherwise != sp.true:
        raise NoTranslation("no translation for a Piecewise that leaves a case out")
    text = write(last)
    for value, condition in reversed(branches):
        if type(condition) not in DECIDED:
            raise NoTranslation(f"no translation for the condition {condition}")
        test = f"{DECIDED[type(condition)]} {write(condition.lhs)} {write(condition.rhs)}"
        text = f"(if {test} then {write(value)} else {text})"
    return text


def _derivative(expression: sp.Basic, write: Write) -> str:
    text = write(expression.expr)
    for variable in expression.variables:
        if not variable.is_Symbol:
            raise NoTranslation(f"no translation for a derivative by {variable}")
        text = f"(Derive (fun {write(variable)} => {text}) {write(variable)})"
    return text


def _integral(expression: sp.Basic, write: Write) -> str:
    text = write(expression.function)
    for limits in expression.limits:
        if len(limits) != 3 or any(bound.is_infinite for bound in limits[1:]):
            raise NoTranslation("no translation for an integral without two finite ends")
        text = f"(RInt (fun {write(limits[0])} => {text}) {write(limits[1])} {write(limits[2])})"
    return text


def _subs(expression: sp.Basic, write: Write) -> str:
    variables = " ".join(map(write, expression.variables))
    return f"((fun {variables} => {write(expression.expr)}) {' '.join(map(write, expression.point))})"


_WRITERS: dict[type, Callable[[sp.Basic, Write], str]] = {
    sp.Add: _sum, sp.Mul: _product, sp.Pow: _power, sp.Max: _chain("Rmax"), sp.Min: _chain("Rmin"),
    sp.Piecewise: _piecewise, sp.Derivative: _derivative, sp.Integral: _integral, sp.Subs: _subs,
}  # fmt: skip
