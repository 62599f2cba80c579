"""Letters for expressions of which a goal needs nothing but that they are the same: less to multiply out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Relation

_MOST = 12
_MILLISECONDS = 500
_BOUND = (sp.Derivative, sp.Subs, sp.Integral, sp.Limit)
_KINDS = {">": "positive", ">=": "nonnegative", "!=": "nonzero"}


def masked(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with letters for derivatives of what is composed, and for sums that stand in it more than once."""
    lines: list[str] = []
    for part in list(_candidates(goal))[:_MOST]:
        name = fresh(f"m{len(lines)}", goal.names)
        kinds = {_KINDS[sign]: True for sign in _signs(goal, part)}
        if part.is_Add and needed(Relation(sp.S.Zero, "<", part), goal.known, _MILLISECONDS) is not None:
            kinds = {"positive": True}
            lines.append(f"try (assert (0 < {goal.text(part)}) by (first [ sign | lra ]))")
        letter = sp.Symbol(name, real=True, **kinds)
        inner = goal.map(partial(_put, part, letter), {**goal.names, letter: name})
        if inner.relations() != goal.relations():
            # A derivative is worth the time: without its letter it is carried out.
            limit = _MILLISECONDS if part.is_Add else 4 * _MILLISECONDS
            if needed(inner.relation, inner.known, limit) is None:
                continue
            lines.append(f"try (named {name} {goal.text(part)})")
            goal = inner
    return lines, goal


def _put(part: sp.Basic, letter: sp.Symbol, expression: sp.Basic) -> sp.Basic:
    """The expression with a letter for the part, but where something is bound."""
    if expression == part:
        return letter
    if not expression.args or isinstance(expression, _BOUND):
        return expression
    return expression.func(*(_put(part, letter, argument) for argument in expression.args))


def hidden(goal: Goal) -> Goal:
    """The goal with letters for derivatives of what is composed and for sums below a line, whatever it needs."""
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    parts = dict.fromkeys(part for side in sides for part in _free(side) if _is_composed(part))
    parts |= dict.fromkeys(part.base for side in sides for part in _free(side)
                           if isinstance(part, sp.Pow) and part.base.is_Add)  # fmt: skip
    there = {}
    for number, part in enumerate(parts):
        kinds = {_KINDS[sign]: True for sign in _signs(goal, part)}
        there[part] = sp.Symbol(f"hidden{number}", real=True, **kinds)

    def change(side: sp.Basic) -> sp.Basic:
        return side.xreplace(there)

    return Goal(goal.relation.map(change), tuple(item.map(change) for item in goal.known), goal.names)


def _is_composed(part: sp.Basic) -> bool:
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
    return lines, goal.map(lambda side: side.xreplace(there))


def _stands_alone(part: sp.Basic) -> bool:
    return isinstance(part, AppliedUndef) or bool(part.is_Symbol and not part.is_nonnegative)


def _signs(goal: Goal, part: sp.Basic) -> Iterator[str]:
    for item in goal.known:
        if item.right == 0 and item.left == part and item.sign in _KINDS:
            yield item.sign
        elif item.left == 0 and item.right == part and item.standard().sign in ("<", "<=") and item.sign != ">":
            yield {"<": ">", "<=": ">="}[item.sign]


def _candidates(goal: Goal) -> Iterator[sp.Basic]:
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    composed = [part for side in sides for part in _free(side)
                if _is_composed(part)]  # fmt: skip
    yield from dict.fromkeys(composed)
    seen = Counter(part for side in sides for part in _free(side) if part.is_Add)
    exponents = sp.Tuple(*_exponents(sides))
    yield from sorted(
        (part for part, times in seen.items() if times > 1 and not exponents.has(part)),
        key=lambda part: (-sp.count_ops(part), sp.default_sort_key(part)),
    )


def _free(expression: sp.Basic) -> Iterator[sp.Basic]:
    """The parts in which nothing is bound outside of them, each as often as it stands there; not those of exponents."""
    yield expression
    if not isinstance(expression, (*_BOUND, sp.exp)):
        for part in expression.args[:1] if isinstance(expression, sp.Pow) else expression.args:
            yield from _free(part)


def _exponents(sides: Sequence[sp.Basic]) -> Iterator[sp.Basic]:
    for side in sides:
        yield from (power.exp for power in side.atoms(sp.Pow))
        yield from (part.args[0] for part in side.atoms(sp.exp))
