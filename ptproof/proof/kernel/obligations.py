"""Where an expression is defined, as propositions for Coq; apart from the engines' own, as a second opinion."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import sympy as sp

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, positive_base, term
from ptproof.proof.statement import Exists, ForAll, Relation, RelationSign


@dataclass(frozen=True)
class Part:
    """One proposition: as text for Coq and, for whoever looks for hints, as a relation.

    With a ``limit`` the relation holds near its place: ``domain`` says whether it is what has to be defined there, or
    what the function tends to. A ``base`` is that of a power which is defined where the base is positive, or where it
    is 0 and the ``exponent`` is positive. Where something is said to exist, ``exists`` says so, and ``body`` are its
    parts; where something is assumed ``for_all`` values, ``body`` are the premises.
    """

    text: str
    relation: Relation | None = field(default=None, compare=False)
    limit: sp.Limit | None = field(default=None, compare=False)
    domain: bool = field(default=False, compare=False)
    base: sp.Basic | None = field(default=None, compare=False)
    exponent: sp.Basic | None = field(default=None, compare=False)
    exists: Exists | None = field(default=None, compare=False)
    for_all: ForAll | None = field(default=None, compare=False)
    body: tuple[Part, ...] = field(default=(), compare=False)


def obligations(expression: sp.Basic, names: Names) -> tuple[Part, ...]:
    """Propositions of which all hold exactly where the expression is defined and real (or in fewer places).

    Raises
    ------
    NoTranslation
        As :func:`ptproof.proof.kernel.terms.term`.
    """
    return tuple(dict.fromkeys(_parts(expression, names)))


def _signed(expression: sp.Basic, sign: RelationSign, names: Names) -> Part:
    text = term(expression, names)
    words = {"!=": f"{text} <> 0", ">": f"0 < {text}", ">=": f"0 <= {text}"}
    return Part(words[sign], Relation(expression, sign, sp.Integer(0)))


def _parts(expression: sp.Basic, names: Names) -> list[Part]:
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
        found.append(_signed(expression.args[0], ">", names))
    elif isinstance(expression, sp.tan):
        found.append(_signed(sp.cos(expression.args[0]), "!=", names))
    return found


def _at(part: Part, subs: sp.Subs, names: Names) -> Part:
    variables = " ".join(term(variable, names) for variable in subs.variables)
    text = f"((fun {variables} => {part.text}) {' '.join(term(point, names) for point in subs.point)})"
    there = part.relation and part.relation.map(lambda side: sp.Subs(side, subs.variables, subs.point))
    return Part(text, there, base=part.base and sp.Subs(part.base, subs.variables, subs.point),
                exponent=part.exponent and sp.Subs(part.exponent, subs.variables, subs.point))  # fmt: skip


def _power(power: sp.Pow, names: Names) -> list[Part]:
    base, exponent = power.args
    if base.is_Rational and base > 0:
        return []
    if exponent.is_Integer:
        return [_signed(base, "!=", names)] if exponent < 0 else []
    if exponent.is_Rational and exponent.q == 2:
        return [_signed(base, ">" if exponent < 0 else ">=", names)]
    if positive_base(power):
        return [_signed(base, ">", names)]
    text = term(base, names)
    return [Part(f"(0 < {text} \\/ ({text} = 0 /\\ 0 < {term(exponent, names)}))", base=base, exponent=exponent)]


def _branches(expression: sp.Piecewise, names: Names) -> list[Part]:
    found: list[Part] = []
    past: list[str] = []
    for value, condition in expression.args:
        if condition == sp.true:
            own = obligations(value, names)
            test = ""
        else:
            test = f"{term(condition.lhs, names)} {condition.rel_op} {term(condition.rhs, names)}"
            found += _under(past, [*obligations(condition.lhs, names), *obligations(condition.rhs, names)])
            own = obligations(value, names)
        found += _under([*past, *([test] if test else [])], own)
        past.append(f"~ ({test})")
    return found


def _under(conditions: Sequence[str], parts: Iterable[Part]) -> list[Part]:
    return [Part(f"({' -> '.join([*conditions, part.text])})") if conditions else part for part in parts]


def _derivative(expression: sp.Derivative, names: Names) -> list[Part]:
    """That every step can be differentiated here, and that what is differentiated is defined near by."""
    found: list[Part] = []
    inner = expression.expr
    parts = list(obligations(inner, names))
    for variable in expression.variables:
        name, text = term(variable, names), term(inner, names)
        around = [
            Part(f"locally {name} (fun {name} => {part.text})") if _mentions(part, name) else part for part in parts
        ]
        found = [*around, Part(f"ex_derive (fun {name} => {text}) {name}")]
        inner = sp.Derivative(inner, variable, evaluate=False) if inner is expression.expr else inner.func(
            expression.expr, *inner.variables, variable, evaluate=False)  # fmt: skip
        parts = found
    return found


def _integral(expression: sp.Integral, names: Names) -> list[Part]:
    """That the integrand is defined on the closed interval, and integrable there."""
    inner, parts = expression.function, list(obligations(expression.function, names))
    for limits in expression.limits:
        if len(limits) != 3:
            raise NoTranslation("no translation for an integral without two ends")
        variable, lower, upper = (term(item, names) for item in limits)
        between = f"Rmin {lower} {upper} <= {variable} <= Rmax {lower} {upper}"
        found = [part for bound in limits[1:] for part in obligations(bound, names)]
        found += [Part(f"(forall {variable} : R, {between} -> {part.text})") if _mentions(part, variable) else part
                  for part in parts]  # fmt: skip
        found.append(Part(f"ex_RInt (fun {variable} => {term(inner, names)}) {lower} {upper}"))
        inner, parts = sp.Integral(inner, limits), found
    return parts


def _mentions(part: Part, name: str) -> bool:
    return re.search(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])", part.text) is not None
