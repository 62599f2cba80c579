"""Identities and inequalities, decided by the engines that decide claims."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.statement import Relation, free_symbols, relations_of
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.reading.limits import OutOfTime, within
from ptproof.testing.failure import SECONDS, assertion
from ptproof.testing.reading import assumptions, relation, side
from ptproof.testing.wording import lines, simplest, witness_text

__unittest = True
_BINDERS = (sp.Limit, sp.Integral)


@assertion
def assert_identity(left: Any, right: Any, *, given: Any = (), seconds: float = SECONDS) -> str | None:
    """Assert that two expressions, or two columns, are equal wherever both are defined.

    Parameters
    ----------
    left, right
        SymPy expressions, integers or fractions, or columns of them. Integrals and limits may be left unevaluated.
    given
        Assumptions beyond those of the symbols: relations such as ``ge(x, 0)`` or ``eq(y, x**2)``.
    seconds
        The time limit. [s]

    Raises
    ------
    AssertionError
        If the difference does not have the normal form 0: refuted with a witness, or undecided.
    InputError, TypeError
        For sides that are not exact expressions of the same shape.

    Examples
    --------
    >>> from ptproof.testing import assert_identity, eq
    >>> x, y = sp.symbols("x y", real=True)
    >>> assert_identity(sp.cos(2 * x), 1 - 2 * sp.sin(x) ** 2)
    >>> assert_identity(x**4, y**2, given=eq(y, x**2))
    """
    sides = side(left, "left"), side(right, "right")
    goal = Goal("assert_identity", Relation(sides[0], "=", sides[1]), assumptions(given))
    return _reason(goal, seconds, "the two sides are not equal", "the two sides could not be shown to be equal")


@assertion
def assert_inequality(statement: Any, *, given: Any = (), seconds: float = SECONDS) -> str | None:
    """Assert that a relation holds for all real values that its symbols' assumptions and ``given`` allow.

    Parameters
    ----------
    statement
        A relation, such as ``le(left, right)``, or SymPy's own, such as ``sp.Le(left, right)``, where SymPy has not
        evaluated it.
    given, seconds
        As for :func:`assert_identity`.

    Raises
    ------
    AssertionError
        If it is refuted, with a witness, or undecided.
    InputError, TypeError
        For something that is not a relation, among it one that has been evaluated to true or false.

    Examples
    --------
    >>> from ptproof.testing import assert_inequality, ge, le
    >>> x, y = sp.symbols("x y", real=True)
    >>> assert_inequality(le(2 * x * y, x**2 + y**2))
    >>> assert_inequality(ge(x**3, 1), given=ge(x, 1))
    """
    goal = Goal("assert_inequality", relation(statement, "statement"), assumptions(given))
    return _reason(goal, seconds, "the relation does not hold", "the relation could not be decided")


def decide(goal: Goal, seconds: float) -> Evidence:
    """What the engines that fit the goal say, the first that decides; undecided when the time is over."""
    try:
        return within(seconds, lambda: _first_decision(goal, seconds))
    except OutOfTime:
        return Evidence("time limit", Verdict.UNDECIDED, f"no answer in {seconds:g} s", seconds)


def _first_decision(goal: Goal, seconds: float) -> Evidence:
    from ptproof.proof.settling import settle

    tried: list[Evidence] = []
    for proof in _attempts(goal, seconds):
        # A witness is sought after the first attempt: what it doesn't find then, it doesn't find later.
        evidence = settle(goal, proof, seconds=0 if tried else None)
        if evidence.verdict is not Verdict.UNDECIDED:
            return evidence
        tried.append(evidence)
    if len(tried) == 1:
        return tried[0]
    return replace(tried[-1], detail="; ".join(f"{item.engine}: {item.detail}" for item in tried))


def _attempts(goal: Goal, seconds: float) -> Iterator[Callable[[Goal], Evidence]]:
    from ptproof.proof.engines.enclosures import enclosures
    from ptproof.proof.engines.exact import exact
    from ptproof.proof.engines.integrals import integrals
    from ptproof.proof.engines.limits import limits
    from ptproof.proof.engines.reals import reals

    parts = relations_of(goal.statement)
    equalities = all(part.sign == "=" for part in parts)
    if equalities and any(part.left.has(sp.Limit) for part in parts):
        yield limits
        return
    if equalities and any(part.left.has(sp.Integral) for part in parts):
        yield integrals
        return
    if equalities:
        yield exact
        if goal.assumptions or any(part.left.has(sp.Max, sp.Min, sp.Abs) for part in parts):
            yield partial(reals, seconds=seconds / 2)
        return
    yield partial(reals, seconds=seconds / 3)
    box = _box(goal)
    if box is not None and all(part.sign in ("<", "<=", ">", ">=") for part in parts):
        yield partial(enclosures, box=box, seconds=seconds / 3)


def _box(goal: Goal) -> dict[sp.Symbol, tuple[sp.Expr, sp.Expr]] | None:
    """The range of every symbol, where the assumptions give each two numbers for ends."""
    ends: dict[sp.Symbol, list[sp.Expr | None]] = {
        symbol: [sp.S.Zero if symbol.is_nonnegative else None, None] for symbol in free_symbols([goal.statement])
    }
    for item in goal.relations:
        part = item.standard()
        if part.sign not in ("<=", "<"):
            continue
        if part.right in ends and part.left.is_number:
            ends[part.right][0] = part.left
        if part.left in ends and part.right.is_number:
            ends[part.left][1] = part.right
    box = {symbol: (low, high) for symbol, (low, high) in ends.items() if low is not None and high is not None}
    return box if len(box) == len(ends) else None


def _by_engine(goal: Goal) -> Goal:
    """The same equality with the integral or limit on the left, where the engines read it."""
    match goal.statement:
        case Relation(left, "=", right) if right.has(*_BINDERS) and not left.has(*_BINDERS):
            return replace(goal, statement=Relation(right, "=", left))
    return goal


def _reason(goal: Goal, seconds: float, refuted: str, undecided: str) -> str | None:
    asked = _by_engine(goal)
    evidence = decide(asked, seconds)
    if evidence.verdict is Verdict.PROVED:
        return None
    title = refuted if evidence.verdict is Verdict.REFUTED else undecided
    statement = goal.statement
    rows: list[tuple[str, str]] = []
    if isinstance(statement, Relation) and statement.sign == "=":
        differences = [simplest(part.left - part.right) for part in statement.components()]
        shown = str(differences[0]) if len(differences) == 1 else str(differences)
        left, right = (list(s) if isinstance(s, sp.MatrixBase) else s for s in (statement.left, statement.right))
        note = "left - right"
        if evidence.verdict is not Verdict.REFUTED and not any(differences):
            note += ", by simplification, which proves nothing"
        rows += [("left", str(left)), ("right", str(right)), ("difference", f"{shown}  ({note})")]
    else:
        rows.append(("statement", str(statement)))
    rows += [("given", str(item)) for item in goal.assumptions]
    witness = evidence.witness
    if witness is not None and asked is not goal:
        witness = replace(witness, left=witness.right, right=witness.left)
    rows.append(("witness", witness_text(witness)))
    if evidence.verdict is not Verdict.REFUTED:
        rows.append(("tried", f"{evidence.engine}: {evidence.detail}"))
    return lines(f"{title}: {evidence.verdict}", rows)
