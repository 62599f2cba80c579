"""What it takes to evaluate an expression, step by step: its nodes in the order in which a recursion meets them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, Protocol

from ptproof.proof.attack.numbers import SHORT, Exact, Number
from ptproof.proof.attack.scope import Scope, Work
from ptproof.proof.attack.series import Calculus, Series, Value
from ptproof.proof.attack.tree import Node

ADD, MUL, POWER, NUMBERS, OUTSIDE, FUNCTION, OTHER = range(7)


class Kind(NamedTuple):
    """How nodes of one type are evaluated.

    Attributes
    ----------
    code
        One of the words above.
    how
        The function of one value, or what evaluates the node in a scope.
    """

    code: int
    how: Callable[..., Any] | None = None


class Step(NamedTuple):
    """One node, and the nodes that it takes, which were evaluated before; or some numbers on the way to a node."""

    node: Node
    code: int
    how: Any
    parts: tuple[Node, ...]


def program(root: Node, given: frozenset[Node] | None, kind: Callable[[Node], Kind]) -> tuple[Step, ...]:
    """The steps that lead to the root where the ``given`` letters have other values than around; None: everywhere.

    What is free of these letters is one step, and is evaluated around. A step whose value is known is left out, and
    with it nothing is missed: what it takes is known too, or stood in nothing else. Numbers are taken together, as far
    as nothing else is evaluated between them.
    """
    steps: list[Step] = []
    seen: set[Node] = set(given or ())
    numbers: dict[Node, Exact] = {}

    def add(node: Node) -> None:
        nonlocal numbers
        if node in seen:
            return
        seen.add(node)
        if node.constant is not None:
            if not numbers:
                steps.append(Step(root, NUMBERS, numbers, ()))
            numbers[node] = node.constant
            return
        here = Kind(OUTSIDE) if given is not None and node.letters.isdisjoint(given) else kind(node)
        whole = node.parts[1].whole if here.code == POWER else None
        parts = () if here.code in (OUTSIDE, OTHER) else node.parts[:1] if whole is not None else node.parts
        for part in parts:
            add(part)
        steps.append(Step(node, here.code, whole if here.code == POWER else here.how, parts))
        if here.code in (OUTSIDE, OTHER):
            numbers = {}

    add(root)
    return tuple(steps)


class Evaluates(Protocol):
    """Whoever follows programs."""

    calculus: Calculus
    work: Work

    def worth(self, node: Node, scope: Scope) -> Value:
        """The value of a node."""
        ...


def follow(steps: tuple[Step, ...], evaluator: Evaluates, scope: Scope) -> None:
    """Take the steps, each value that is not known yet into what is known in the scope; each counts as work."""
    known, outer, work, calculus = scope.known, scope.outer, evaluator.work, evaluator.calculus
    numbers, count = calculus.numbers, 0
    value: Any
    base: Any
    try:
        for step, code, how, parts in steps:
            if step in known:
                continue
            count += 1
            if code == MUL:
                value = known[parts[0]]
                for part in parts[1:]:  # all of them: 0 times something undefined is undefined
                    other: Any = known[part]
                    if type(value) is Exact and type(other) is Exact:
                        value = value * other
                        if value.height_bits() > SHORT:
                            value = numbers.tidy(value)
                    else:
                        value = calculus.mul(value, other)
            elif code == ADD:
                value = _sum([known[part] for part in parts], calculus)
            elif code == OUTSIDE:
                assert outer is not None
                value = outer.known.get(step)
                if value is None:
                    before = work.steps
                    value = evaluator.worth(step, outer)
                    count -= work.steps != before  # a look counts as a step
            elif code == POWER:
                base = known[parts[0]]
                if how == 2 and type(base) is Exact:
                    value = numbers.tidy(base * base)
                elif how is not None and type(base) is not Series:
                    value = numbers.whole_power(base, how)
                else:
                    value = calculus.power(base, evaluator.worth(step.parts[1], scope))
            elif code == FUNCTION:
                value = how(calculus, known[parts[0]])
            elif code == NUMBERS:
                count += _numbered(how, scope) - 1
                continue
            else:
                value = how(evaluator, step, scope)
            known[step] = value
    finally:
        work.steps += count


def _numbered(numbers: Mapping[Node, Exact], scope: Scope) -> int:
    """Make numbers known here and around; how many were not known here."""
    before, around = len(scope.known), scope.outer
    scope.known.update(numbers)
    count = len(scope.known) - before
    while count and around is not None:
        around.known.update(numbers)
        around = around.outer
    return count


def _sum(terms: list[Value], calculus: Calculus) -> Value:
    total: Number = None
    for term in terms:
        if type(term) is not Exact:
            return calculus.add(terms)
        total = term if total is None else total + term
    return calculus.numbers.tidy(total)
