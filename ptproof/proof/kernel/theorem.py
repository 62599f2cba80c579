"""A claim as a proposition of Coq: what its declarations and assumptions allow, what has to be defined, and the relation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import declared
from ptproof.proof.kernel.names import Names, identifiers, plain
from ptproof.proof.kernel.obligations import conjunction, obligations
from ptproof.proof.kernel.terms import SIGNS, NoTranslation, term
from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Relation,
    Statement,
    expressions_of,
    free_symbols,
    undefined_functions,
)


@dataclass(frozen=True)
class Proposition:
    """A claim in Coq's words.

    Attributes
    ----------
    id
        The claim's.
    name
        Its identifier in Coq.
    text
        The proposition.
    names
        Which symbol or function became which identifier.
    """

    id: str
    name: str
    text: str
    names: Names


def proposition(claim: Claim) -> Proposition:
    """The claim, restated from its statement, its assumptions and its declarations; nothing else is looked at.

    Raises
    ------
    NoTranslation
        With what of it has no translation.
    """
    statements: list[Statement | Assumption] = [claim.statement, *claim.assumptions]
    free = _free(claim)
    applied = undefined_functions(statements)
    functions = {call.func for call in applied}
    bound = {s for expression in expressions_of(statements) for s in expression.atoms(sp.Symbol)} | _bound(statements)
    names = identifiers([*_sorted(functions), *_sorted(free), *_sorted(bound - free)])
    lines = [f"forall {names[function]} : {_type(function, applied)}" for function in _sorted(functions)]
    premises: list[str] = []
    for symbol in _sorted(free):
        premises += declared.of_symbol(symbol, names[symbol])
    premises += declared.of_functions(applied, free, names)
    derivatives = {part for expression in expressions_of(statements) for part in expression.atoms(sp.Derivative)}
    premises += declared.of_derivatives(derivatives, names)
    for item in claim.assumptions:
        premises += _given(item, names)
    conclusions, domain = _said(claim.statement, names)
    if getattr(claim, "where_defined", False):
        premises += domain
    else:
        conclusions = [*domain, *conclusions]
    if free:
        lines.append(f"forall {' '.join(names[symbol] for symbol in _sorted(free))} : R")
    body = "\n  -> ".join([*premises, conjunction(conclusions)])
    return Proposition(claim.id, f"claim_{plain(claim.id)}", "".join(f"{line},\n  " for line in lines) + body, names)


def _free(claim: Claim) -> set[sp.Symbol]:
    free: set[sp.Symbol] = set()
    for item in (claim.statement, *claim.assumptions):
        match item:
            case ForAll(variables=variables):
                free |= free_symbols([item]) - set(variables)
            case Exists(variables=variables, over=over):
                free |= free_symbols([item]) - {*variables, *over}
            case Relation() | All():
                free |= free_symbols([item])
            case _:
                raise NoTranslation(f"no translation for a statement of the kind {type(item).__name__.lower()}")
    return free


def _bound(statements: Iterable[Statement | Assumption]) -> set[sp.Symbol]:
    return {symbol for item in statements if isinstance(item, ForAll | Exists) for symbol in item.variables} | {
        symbol for item in statements if isinstance(item, Exists) for symbol in item.over
    }


def _sorted(items: Iterable[sp.Basic]) -> list[sp.Basic]:
    def key(item: sp.Basic) -> tuple[str, str]:
        own = item._assumptions_orig if isinstance(item, sp.Symbol) else item._kwargs
        return (getattr(item, "name", None) or item.__name__, str(sorted(own.items())) + str(getattr(item, "dummy_index", "")))

    return sorted(items, key=key)


def _type(function: sp.Basic, applied: set[AppliedUndef]) -> str:
    lengths = {len(call.args) for call in applied if call.func == function}
    if len(lengths) != 1:
        raise NoTranslation(f"no translation for {function}, which has different numbers of arguments")
    return " -> ".join(["R"] * (lengths.pop() + 1))


def _given(item: Assumption, names: Names) -> list[str]:
    """The assumption, and that its sides are defined: it allows only such values."""
    if isinstance(item, Relation):
        return [part for relation in item.components() for part in _relation(relation, names)]
    premises: list[str] = []
    for symbol in item.variables:
        premises += declared.of_symbol(symbol, names[symbol])
    for part in (component for given in item.domain for component in given.components()):
        premises += _relation(part, names)
    variables = " ".join(names[symbol] for symbol in item.variables)
    said = conjunction([text for part in item.relation.components() for text in _relation(part, names)])
    return [f"(forall {variables} : R, {' -> '.join([*premises, f'({said})'])})"]


def _relation(relation: Relation, names: Names) -> list[str]:
    """What has to be defined for the relation, and then the relation itself."""
    domain, text = _sides(relation, names)
    return [*domain, text]


def _sides(relation: Relation, names: Names) -> tuple[tuple[str, ...], str]:
    if relation.sign == "=":
        for side, other in ((relation.left, relation.right), (relation.right, relation.left)):
            if isinstance(side, sp.Limit):
                return _limit(side, other, names)
            if isinstance(side, sp.Integral) and any(end.is_infinite for end in side.limits[0][1:]):
                return _improper(side, other, names)
    domain = tuple(dict.fromkeys([*obligations(relation.left, names), *obligations(relation.right, names)]))
    return domain, f"{term(relation.left, names)} {SIGNS[relation.sign]} {term(relation.right, names)}"


def _limit(limit: sp.Limit, value: sp.Basic, names: Names) -> tuple[tuple[str, ...], str]:
    """A limit exists and is the value; near the place, what is followed is defined."""
    expression, variable, place, side = limit.args
    infinite = {sp.oo: "(Rbar_locally p_infty)", -sp.oo: "(Rbar_locally m_infty)"}
    if place in infinite:
        where = infinite[place]
    else:
        words = {"-": "at_left", "+": "at_right", "+-": "locally'"}
        where = f"({words[str(side)]} {term(place, names)})"
    name = term(variable, names)
    target = infinite.get(value) or f"(locally {term(value, names)})"
    domain = [] if place in infinite else list(obligations(place, names))
    domain += [] if value in infinite else list(obligations(value, names))
    domain += [f"{where} (fun {name} => {part})" for part in obligations(expression, names)]
    return tuple(domain), f"filterlim (fun {name} => {term(expression, names)}) {where} {target}"


def _improper(integral: sp.Integral, value: sp.Basic, names: Names) -> tuple[tuple[str, ...], str]:
    """An integral to infinity exists and is the value."""
    ((variable, lower, upper),) = integral.limits
    if upper is not sp.oo or lower.is_infinite:
        raise NoTranslation(f"no translation for an integral from {lower} to {upper}")
    name, start = term(variable, names), term(lower, names)
    inside = [f"(forall {name} : R, {start} <= {name} -> {part})" for part in obligations(integral.function, names)]
    domain = (*obligations(lower, names), *obligations(value, names), *inside)
    function = f"(fun {name} => {term(integral.function, names)})"
    return domain, f"is_RInt_gen {function} (at_point {start}) (Rbar_locally p_infty) {term(value, names)}"


def _said(statement: Statement, names: Names) -> tuple[list[str], list[str]]:
    """The conclusions, and what has to be defined for them."""
    match statement:
        case Relation():
            parts: Sequence[Relation] = statement.components()
        case All(every):
            parts = [component for part in every for component in part.components()]
        case Exists():
            return [_exists(statement, names)], []
        case _:
            raise NoTranslation(f"no translation for a statement of the kind {type(statement).__name__.lower()}")
    said = [_sides(part, names) for part in parts]
    domain = list(dict.fromkeys(part for parts_of, _ in said for part in parts_of))
    return [text for _, text in said], domain


def _exists(statement: Exists, names: Names) -> str:
    body = [text for part in statement.body for relation in part.components() for text in _relation(relation, names)]
    text = conjunction(list(dict.fromkeys(body)))
    if statement.over:
        kinds = [kind for symbol in statement.over for kind in declared.of_symbol(symbol, names[symbol])]
        variables = " ".join(names[symbol] for symbol in statement.over)
        text = f"(forall {variables} : R, {' -> '.join([*kinds, f'({text})'])})"
    for symbol in reversed(statement.variables):
        text = " /\\ ".join([*declared.of_symbol(symbol, names[symbol]), text])
        text = f"(exists {names[symbol]} : R, {text})"
    return text


