"""Where an expression is defined, as propositions for Coq; generated apart from the engines' own, as a second opinion."""

from __future__ import annotations

import sympy as sp

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import SIGNS, NoTranslation, positive_base, term


def obligations(expression: sp.Basic, names: Names) -> tuple[str, ...]:
    """Propositions of which all hold exactly where the expression is defined and real (or in fewer places).

    Raises
    ------
    NoTranslation
        As :func:`ptproof.proof.kernel.terms.term`.
    """
    return tuple(dict.fromkeys(_parts(expression, names)))


def conjunction(parts: tuple[str, ...] | list[str]) -> str:
    """All of them, or True."""
    return " /\\ ".join(parts) or "True"


def _parts(expression: sp.Basic, names: Names) -> list[str]:
    if expression.is_Atom:
        return []
    match expression:
        case sp.Piecewise():
            return _branches(expression, names)
        case sp.Derivative():
            return _derivative(expression, names)
        case sp.Integral():
            return _integral(expression, names)
        case sp.Subs():
            inner = obligations(expression.expr, names)
            outer = [part for point in expression.point for part in _parts(point, names)]
            return [*outer, *(_at(part, expression, names) for part in inner)]
        case sp.Limit():
            raise NoTranslation("no translation for a limit inside an expression")
    found = [part for argument in expression.args for part in _parts(argument, names)]
    if isinstance(expression, sp.Pow):
        found += _power(expression, names)
    elif isinstance(expression, sp.log):
        found.append(f"0 < {term(expression.args[0], names)}")
    elif isinstance(expression, sp.tan):
        found.append(f"cos {term(expression.args[0], names)} <> 0")
    return found


def _at(proposition: str, subs: sp.Subs, names: Names) -> str:
    variables = " ".join(term(variable, names) for variable in subs.variables)
    return f"((fun {variables} => {proposition}) {' '.join(term(point, names) for point in subs.point)})"


def _power(power: sp.Pow, names: Names) -> list[str]:
    base, exponent = power.args
    if base.is_Rational and base > 0:
        return []
    text = term(base, names)
    if exponent.is_Integer:
        return [f"{text} <> 0"] if exponent < 0 else []
    if exponent.is_Rational and exponent.q == 2:
        return [f"0 < {text}" if exponent < 0 else f"0 <= {text}"]
    if positive_base(power):
        return [f"0 < {text}"]
    return [f"(0 < {text} \\/ ({text} = 0 /\\ 0 < {term(exponent, names)}))"]


def _branches(expression: sp.Piecewise, names: Names) -> list[str]:
    found: list[str] = []
    past: list[str] = []
    for value, condition in expression.args:
        if condition == sp.true:
            own = obligations(value, names)
            test = ""
        else:
            test = f"{term(condition.lhs, names)} {SIGNS[type(condition)]} {term(condition.rhs, names)}"
            found += _under(past, [*obligations(condition.lhs, names), *obligations(condition.rhs, names)])
            own = obligations(value, names)
        found += _under([*past, *([test] if test else [])], own)
        past.append(f"~ ({test})")
    return found


def _under(conditions: list[str], parts: tuple[str, ...] | list[str]) -> list[str]:
    return [f"({' -> '.join([*conditions, part])})" for part in parts]


def _derivative(expression: sp.Derivative, names: Names) -> list[str]:
    """That every step can be differentiated here, and that what is differentiated is defined near by."""
    found: list[str] = []
    inner = expression.expr
    parts = list(obligations(inner, names))
    for variable in expression.variables:
        name, text = term(variable, names), term(inner, names)
        around = [f"locally {name} (fun {name} => {part})" if _mentions(part, name) else part for part in parts]
        found = [*around, f"ex_derive (fun {name} => {text}) {name}"]
        inner = sp.Derivative(inner, variable, evaluate=False) if inner is expression.expr else inner.func(
            expression.expr, *inner.variables, variable, evaluate=False)  # fmt: skip
        parts = found
    return found


def _integral(expression: sp.Integral, names: Names) -> list[str]:
    """That the integrand is defined on the closed interval, and integrable there."""
    inner, parts = expression.function, list(obligations(expression.function, names))
    for limits in expression.limits:
        if len(limits) != 3:
            raise NoTranslation("no translation for an integral without two ends")
        variable, lower, upper = (term(item, names) for item in limits)
        between = f"Rmin {lower} {upper} <= {variable} <= Rmax {lower} {upper}"
        found = [part for bound in limits[1:] for part in obligations(bound, names)]
        found += [f"(forall {variable} : R, {between} -> {part})" if _mentions(part, variable) else part for part in parts]
        found.append(f"ex_RInt (fun {variable} => {term(inner, names)}) {lower} {upper}")
        inner, parts = sp.Integral(inner, limits), found
    return parts


def _mentions(proposition: str, name: str) -> bool:
    import re

    return re.search(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])", proposition) is not None
