"""Case by case: minima, maxima, absolute values, branches; and equations of which one factor only can be 0."""

from __future__ import annotations

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, is_shown
from ptproof.proof.kernel.terms import DECIDED
from ptproof.proof.statement import Relation

KINDS = (sp.Max, sp.Min, sp.Abs, sp.Piecewise)
_WORDS = {sp.Max: "Rmax", sp.Min: "Rmin"}


def split(goal: Goal, *kinds: type[sp.Basic]) -> tuple[str, list[Goal]] | None:
    """The line that splits the goal by one of its minima, maxima, absolute values or branches, and the two goals.

    Of these ``kinds`` only, if there are any.
    """
    found = next((part for part in goal.atoms(*(kinds or KINDS)) if not _holds_bound(part)), None)
    if found is None:
        return None
    match found:
        case sp.Abs():
            inner = found.args[0]
            line = f"one_of (Rabs_case_of {goal.text(inner)})"
            values = [(inner, Relation(sp.Integer(0), "<=", inner)), (-inner, Relation(inner, "<=", sp.Integer(0)))]
        case sp.Piecewise():
            (value, test), *others = found.args
            rest = others[0][0] if len(others) == 1 else sp.Piecewise(*others)
            line = f"branch_of ({DECIDED[type(test)]} {goal.text(test.lhs)} {goal.text(test.rhs)})"
            said = Relation(test.lhs, test.rel_op, test.rhs)
            values = [(value, said), (rest, said.negation())]
        case _:
            kind = type(found)
            first, *others = sorted(found.args, key=sp.default_sort_key)  # as they are written
            last = others[0] if len(others) == 1 else kind(*others)
            line = f"one_of ({_WORDS[kind]}_case_of {goal.text(first)} {goal.text(last)})"
            low, high = (last, first) if kind is sp.Max else (first, last)
            values = [(first, Relation(low, "<=", high)), (last, Relation(high, "<=", low))]
    return line, [goal.with_known(fact).replaced(found, value) for value, fact in values]


def _holds_bound(part: sp.Basic) -> bool:
    """Whether the part has a place of its own: a branch that cannot be decided, say."""
    return isinstance(part, sp.Piecewise) and any(
        type(test) not in DECIDED and test != sp.true for _, test in part.args
    )


def factored(goal: Goal) -> tuple[list[str], Goal]:
    """Equations with one factor that can be 0: then it is, and a variable that stands alone in it is replaced."""
    lines: list[str] = []
    nonzero = {sp.factor(item.right - item.left) for item in goal.known if item.sign == "!="}
    nonzero |= {sp.expand(-item) for item in nonzero}
    for relation in goal.known:
        if relation.sign != "=" or relation.right.has(*KINDS) or relation.left.has(*KINDS):
            continue
        top, bottom = sp.fraction(sp.together(relation.right - relation.left))
        try:
            _, factors = sp.factor_list(top)
        except sp.PolynomialError:
            continue
        shown = {part for part, _ in factors if is_shown(part, strictly=True) or is_shown(-part, strictly=True)}
        left = [part for part, _ in factors if part not in nonzero | shown]
        if len(left) != 1 or (len(factors) == 1 and bottom == 1 and factors[0][1] == 1):
            continue
        (part,) = left
        other = sp.factor(sp.cancel((relation.right - relation.left) / part))
        lines.append(f"try (factor_is_zero {goal.text(part)} {goal.text(other)})")
        goal = goal.with_known(Relation(part, "=", sp.Integer(0)))
    return lines, goal
