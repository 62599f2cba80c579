"""Letters for expressions of which a goal needs nothing but that they are the same: less to multiply out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.goals import Goal, as_factors
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation, RelationSign

_MOST = 12
_MILLISECONDS = 500
_BOUND = (sp.Derivative, sp.Subs, sp.Integral, sp.Limit)
_KINDS: dict[RelationSign, str] = {">": "positive", ">=": "nonnegative", "!=": "nonzero"}
_MIRROR: dict[RelationSign, RelationSign] = {"<": ">", "<=": ">=", "!=": "!="}


def masked(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with letters for derivatives of what is composed, and for sums that stand in it more than once."""
    lines: list[str] = []
    for part in list(_candidates(goal))[:_MOST]:
        name = fresh(f"m{len(lines)}", goal.names)
        positive = part.is_Add and needed(Relation(sp.S.Zero, "<", part), goal.known, _MILLISECONDS) is not None
        kinds = {"positive": True} if positive else _kinds(goal, part)
        letter = sp.Symbol(name, real=True, **kinds)
        inner = goal.map(partial(put, {part: letter}), {**goal.names, letter: name})
        # A derivative is worth the time: without its letter it is carried out.
        limit = _MILLISECONDS if part.is_Add else 4 * _MILLISECONDS
        line = f"try (named {name} {goal.text(part)})"
        if inner.relations() == goal.relations() or needed(inner.relation, inner.known, limit) is None:
            if (found := _solved(part, letter, goal)) is None:
                continue
            symbol, value = found
            line = f"try (set ({name} := {goal.text(part)}) in *; moved {name} {goal.text(symbol)} {inner.text(value)})"
            inner = inner.replaced(symbol, value)
        if positive:
            written = goal.text(as_factors(part))
            lines.append(f"try (assert (0 < {goal.text(part)}) by (first [ sign | lra | written_as {written}; sign ]))")
        lines.append(line)
        goal = inner
    return lines, goal


def opaque(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with a letter for each exponential, if it needs nothing but that they are positive and the same."""
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    free = {part for side in sides for part in free_parts(side) if isinstance(part, sp.exp)}
    found = [part for part in goal.atoms(sp.exp) if part in free]
    names = dict(goal.names)
    there: dict[sp.Basic, sp.Basic] = {}
    for number, part in enumerate(found):
        there[part] = letter = sp.Symbol(fresh(f"e{number}", names), positive=True)
        names[letter] = letter.name
    inner = goal.map(partial(put, there), names)
    if not found or needed(inner.relation, inner.known, _MILLISECONDS) is None:
        return [], goal
    return [f"atom {letter} {goal.text(part)}" for part, letter in there.items()], inner


def _solved(part: sp.Basic, letter: sp.Symbol, goal: Goal) -> tuple[sp.Symbol, sp.Expr] | None:
    """A symbol by the letter for a sum that stands below a line."""
    if part not in bottoms(goal):
        return None
    for symbol in sorted(part.free_symbols, key=lambda item: item.name):
        factor = sp.expand(part).coeff(symbol)
        rest = sp.expand(part - factor * symbol)
        if factor.is_Rational and factor != 0 and not rest.has(symbol) and symbol.is_nonnegative is None:
            return symbol, (letter - rest) / factor
    return None


def bottoms(goal: Goal) -> Iterator[sp.Expr]:
    """The sums below a line."""
    for item in goal.relations():
        for power in sp.Tuple(item.left, item.right).atoms(sp.Pow):
            if power.exp.is_negative and power.base.is_Add:
                yield power.base


def put(values: Mapping[sp.Basic, sp.Basic], expression: sp.Basic) -> sp.Basic:
    """The expression with values for parts of it, but where something is bound: a value at one time has no rate."""
    if expression in values:
        return values[expression]
    if not expression.args or isinstance(expression, _BOUND):
        return expression
    return expression.func(*(put(values, argument) for argument in expression.args))


def hidden(goal: Goal) -> Goal:
    """The goal with letters for derivatives of what is composed and for sums below a line, whatever it needs."""
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    parts = dict.fromkeys(part for side in sides for part in free_parts(side) if _is_composed(part))
    parts |= dict.fromkeys(part.base for side in sides for part in free_parts(side)
                           if isinstance(part, sp.Pow) and part.base.is_Add)  # fmt: skip
    there = {part: sp.Symbol(f"hidden{number}", real=True, **_kinds(goal, part)) for number, part in enumerate(parts)}

    def change(side: sp.Basic) -> sp.Basic:
        return side.xreplace(there)

    # Each of what is known is there, in its place.
    return Goal(goal.relation.map(change), tuple(item.map(change) for item in goal.known), goal.names)


def _is_composed(part: sp.Basic) -> bool:
    """Whether more would be looked into than the value: the derivative of what is composed, or waves of a sum."""
    if isinstance(part, sp.sin | sp.cos):
        return not part.args[0].is_Symbol
    return isinstance(part, sp.Derivative) and not isinstance(part.expr, AppliedUndef)


def put_in(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with its value for what an equation gives, and roots of that simplified."""
    lines: list[str] = []
    roots = [power for power in goal.atoms(sp.Pow) if power.exp == sp.Rational(1, 2)]
    there: dict[sp.Basic, sp.Basic] = {}
    for item in goal.known:
        for part, value in ((item.left, item.right), (item.right, item.left)):
            if item.sign != "=" or not _stands_alone(part) or value.has(part) or value.has(*there) or part in there:
                continue
            name = fresh(f"p{len(lines)}", goal.names)
            lines.append(f"try (named {name} {goal.text(part)}; subst {name})")
            there = {old: new.xreplace({part: value}) for old, new in there.items()} | {part: value}
            break
    names = {**goal.names, **{part: goal.text(value) for part, value in there.items()}}
    for root in roots:
        new = root.xreplace(there)
        if new != root and not isinstance(new, sp.Pow):
            lines.append(f"try (root_is {term(root.base, names)} {goal.text(new)})")
    return lines, goal.map(partial(put, there))


def _stands_alone(part: sp.Basic) -> bool:
    return isinstance(part, AppliedUndef) or bool(part.is_Symbol and not part.is_nonnegative)


def _kinds(goal: Goal, part: sp.Basic) -> dict[str, bool]:
    """What is known of the part's sign, as SymPy says it of a symbol."""
    known = {(item.left, item.sign) for item in goal.known if item.right == 0}
    known |= {(item.right, _MIRROR[item.sign]) for item in goal.known if item.left == 0 and item.sign in _MIRROR}
    return {word: True for sign, word in _KINDS.items() if (part, sign) in known}


def _candidates(goal: Goal) -> Iterator[sp.Basic]:
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    yield from dict.fromkeys(part for side in sides for part in free_parts(side) if _is_composed(part))
    seen = Counter(part for side in sides for part in free_parts(side) if part.is_Add)
    exponents = sp.Tuple(*_exponents(sides))
    below = set(bottoms(goal))
    yield from sorted(
        (part for part, times in seen.items() if (times > 1 or part in below) and not exponents.has(part)),
        key=lambda part: (-sp.count_ops(part), sp.default_sort_key(part)),
    )


def free_parts(expression: sp.Basic) -> Iterator[sp.Basic]:
    """The parts in which nothing is bound outside of them, each as often as it stands there; not those of exponents."""
    yield expression
    if not isinstance(expression, (*_BOUND, sp.exp)):
        for part in expression.args[:1] if isinstance(expression, sp.Pow) else expression.args:
            yield from free_parts(part)


def _exponents(sides: Sequence[sp.Basic]) -> Iterator[sp.Basic]:
    for side in sides:
        yield from (power.exp for power in side.atoms(sp.Pow))
        yield from (part.args[0] for part in side.atoms(sp.exp))
