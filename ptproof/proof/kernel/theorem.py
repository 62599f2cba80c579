"""A claim as a proposition of Coq: what is declared and assumed, what has to be defined, and the relation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof import declarations
from ptproof.proof.claim import Claim
from ptproof.proof.kernel import declared, smooth
from ptproof.proof.kernel.names import Names, as_identifier, called, identifiers
from ptproof.proof.kernel.obligations import Part, obligations
from ptproof.proof.kernel.terms import SIGNS, NoTranslation, term
from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Relation,
    Smooth,
    Statement,
    expressions_of,
    free_symbols,
    plain,
    relations_of,
    undefined_functions,
)


@dataclass(frozen=True)
class Proposition:
    """A claim in Coq's words.

    ``name`` is its identifier in Coq and ``names`` says which symbol or function became which. ``binders`` are those of
    its functions and free symbols, in their order; ``premises`` and ``conclusions`` its parts.
    """

    name: str
    text: str
    names: Names
    binders: tuple[str, ...]
    premises: tuple[Part, ...]
    conclusions: tuple[Part, ...]
    claim: Claim


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
    premises = [Part(text) for symbol in _sorted(free) for text in declared.of_symbol(symbol, names[symbol])]
    premises += map(Part, declared.of_functions(applied, free, names))
    derivatives = {part for expression in expressions_of(statements) for part in expression.atoms(sp.Derivative)}
    premises += map(Part, declared.of_derivatives(derivatives, names))
    if not isinstance(claim.statement, Smooth):
        premises += smooth.of_derivatives(derivatives, names)
    else:
        premises += smooth.premises(claim.statement, functions, names)
    for item in outside(claim):
        premises += given(item, names)
    conclusions, domain = _said(claim, names)
    if claim.where_defined:
        premises += domain
    else:
        conclusions = [*domain, *conclusions]
    order = (_sorted(functions), _sorted(free))
    return Proposition(
        f"claim_{as_identifier(claim.id)}", _text(names, *order, applied, premises, conclusions), names,
        tuple(names[item] for items in order for item in items), tuple(premises), tuple(conclusions), claim,
    )  # fmt: skip


def _text(
    names: Names, functions: Sequence[Any], free: Sequence[sp.Symbol], applied: set[AppliedUndef],
    premises: Sequence[Part], conclusions: Sequence[Part],
) -> str:  # fmt: skip
    lines = [f"forall {names[function]} : {_type(function, applied)},\n  " for function in functions]
    if free:
        lines.append(f"forall {' '.join(names[symbol] for symbol in free)} : R,\n  ")
    said = "\n  /\\ ".join(part.text for part in conclusions) or "True"
    return "".join(lines) + "\n  -> ".join([*(part.text for part in premises), said])


def _free(claim: Claim) -> set[sp.Symbol]:
    free = free_symbols(inside(claim))
    for item in (claim.statement, *outside(claim)):
        match item:
            case ForAll(variables=variables):
                free |= free_symbols([item]) - set(variables)
            case Exists(variables=variables, over=over):
                free = (free | free_symbols([item])) - {*variables, *over}
            case Smooth(variables=variables):
                free |= free_symbols([item]) | set(variables)
            case Relation() | All():
                free |= free_symbols([item])
            case _:
                raise NoTranslation(f"no translation for a statement of the kind {type(item).__name__.lower()}")
    return free


def _bound(statements: Iterable[Statement | Assumption]) -> set[sp.Symbol]:
    found: set[sp.Symbol] = set()
    for item in statements:
        if isinstance(item, ForAll | Exists):
            found.update(item.variables, item.over if isinstance(item, Exists) else ())
        elif isinstance(item, Smooth):
            found |= smooth.symbols(item)
    return found


def _sorted(items: Iterable[Any]) -> list[Any]:
    """By name, and then by what tells items of one name apart."""

    def key(item: Any) -> tuple[str, str, int]:
        own = declarations.declared(item) if isinstance(item, sp.Symbol) else item._kwargs
        return called(item), str(sorted(own.items())), getattr(item, "dummy_index", 0)

    return sorted(items, key=key)


def _type(function: sp.Basic, applied: set[AppliedUndef]) -> str:
    lengths = {len(call.args) for call in applied if call.func == function}
    if len(lengths) != 1:
        raise NoTranslation(f"no translation for {function}, which has different numbers of arguments")
    return " -> ".join(["R"] * (lengths.pop() + 1))


def given(item: Assumption, names: Names) -> list[Part]:
    """An assumption, and that its sides are defined: it allows only such values."""
    if isinstance(item, Relation):
        return [part for relation in item.components() for part in _relation(relation, names)]
    premises = tuple(part for given in plain(item.domain) for part in _relation(given, names))
    said = _conjunction(everywhere(item, names))
    text = declared.for_all(item.variables, f"({said})", names, (part.text for part in premises))
    return [Part(text, for_all=item, body=premises)]


def everywhere(item: ForAll, names: Names) -> list[Part]:
    """What an assumption for all values says of each, one after the other."""
    parts = (part for component in item.relation.components() for part in _relation(component, names))
    return list({part.text: part for part in parts}.values())


def _conjunction(parts: Iterable[Part]) -> str:
    return " /\\ ".join(dict.fromkeys(part.text for part in parts)) or "True"


def _relation(relation: Relation, names: Names) -> list[Part]:
    """What has to be defined for the relation, and then the relation itself."""
    domain, said = _sides(relation, names)
    return [*domain, said]


def _sides(relation: Relation, names: Names) -> tuple[tuple[Part, ...], Part]:
    if relation.sign == "=":
        for side, other in ((relation.left, relation.right), (relation.right, relation.left)):
            if isinstance(side, sp.Limit):
                return _limit(side, other, names)
            if isinstance(side, sp.Integral) and any(end.is_infinite for end in side.limits[0][1:]):
                return _improper(side, other, names)
    domain = tuple(dict.fromkeys([*obligations(relation.left, names), *obligations(relation.right, names)]))
    text = f"{term(relation.left, names)} {SIGNS[relation.sign]} {term(relation.right, names)}"
    return domain, Part(text, relation)


def _limit(limit: sp.Limit, value: sp.Basic, names: Names) -> tuple[tuple[Part, ...], Part]:
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
    domain += [Part(f"{where} (fun {name} => {part.text})", part.relation, limit, True, part.base)
               for part in obligations(expression, names)]  # fmt: skip
    said = f"filterlim (fun {name} => {term(expression, names)}) {where} {target}"
    return tuple(domain), Part(said, Relation(expression, "=", value), limit)


def _improper(integral: sp.Integral, value: sp.Basic, names: Names) -> tuple[tuple[Part, ...], Part]:
    """An integral to infinity exists and is the value."""
    ((variable, lower, upper),) = integral.limits
    if upper is not sp.oo or lower.is_infinite:
        raise NoTranslation(f"no translation for an integral from {lower} to {upper}")
    name, start = term(variable, names), term(lower, names)
    inside = [Part(f"(forall {name} : R, {start} <= {name} -> {part.text})")
              for part in obligations(integral.function, names)]  # fmt: skip
    domain = (*obligations(lower, names), *obligations(value, names), *inside)
    function = f"(fun {name} => {term(integral.function, names)})"
    said = f"is_RInt_gen {function} (at_point {start}) (Rbar_locally p_infty) {term(value, names)}"
    return domain, Part(said)


def _said(claim: Claim, names: Names) -> tuple[list[Part], list[Part]]:
    """The conclusions, and what has to be defined for them."""
    statement = claim.statement
    if isinstance(statement, Exists):
        return [_exists(statement, inside(claim), names)], []
    if isinstance(statement, Smooth):
        return smooth.conclusions(statement, names), []
    if not isinstance(statement, Relation | All):
        raise NoTranslation(f"no translation for a statement of the kind {type(statement).__name__.lower()}")
    said = [_sides(part, names) for part in relations_of(statement)]
    return [text for _, text in said], list(dict.fromkeys(part for domain, _ in said for part in domain))


def inside(claim: Claim) -> tuple[Assumption, ...]:
    """What is assumed of letters that come after those which exist: it says which of their values count."""
    if not isinstance(claim.statement, Exists):
        return ()
    later = set(claim.statement.over)
    own = (set(item.variables) if isinstance(item, ForAll) else set() for item in claim.assumptions)
    return tuple(item for item, bound in zip(claim.assumptions, own, strict=True)
                 if later & (free_symbols([item]) - bound))  # fmt: skip


def outside(claim: Claim) -> tuple[Assumption, ...]:
    """What is assumed before the statement."""
    later = inside(claim)
    return tuple(item for item in claim.assumptions if item not in later)


def _exists(statement: Exists, assumed: Sequence[Assumption], names: Names) -> Part:
    body = {part.text: part for given in plain(statement.body) for part in _relation(given, names)}
    text = _conjunction(body.values())
    if free_symbols(assumed) & set(statement.variables):
        raise NoTranslation("no translation for an assumption about both what exists and what comes after it")
    if statement.over:
        premises = (part.text for item in assumed for part in given(item, names))
        text = declared.for_all(statement.over, f"({text})", names, premises)
    for symbol in reversed(statement.variables):
        text = " /\\ ".join([*declared.of_symbol(symbol, names[symbol]), text])
        text = f"(exists {names[symbol]} : R, {text})"
    return Part(text, exists=statement, body=tuple(body.values()))
