"""What it takes to evaluate an expression, step by step: its nodes in the order in which a recursion meets them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ptproof.proof.attack.tree import Node

ADD, MUL, POWER, CONSTANT, OUTSIDE, FUNCTION, OTHER = range(7)


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
    """One node, and the nodes that it takes, which were evaluated before."""

    node: Node
    code: int
    how: Any
    parts: tuple[Node, ...]


def program(root: Node, given: frozenset[Node] | None, kind: Callable[[Node], Kind]) -> tuple[Step, ...]:
    """The steps that lead to the root where the ``given`` letters have other values than around; None: everywhere.

    What is free of these letters is one step, and is evaluated around. A step whose value is known is left out, and
    with it nothing is missed: what it takes is known too, or stood in nothing else.
    """
    steps: list[Step] = []
    seen: set[Node] = set(given or ())

    def add(node: Node) -> None:
        if node in seen:
            return
        seen.add(node)
        here = kind(node)
        if here.code == CONSTANT:
            steps.append(Step(node, CONSTANT, node.rational, ()))
        elif given is not None and node.letters.isdisjoint(given):
            steps.append(Step(node, OUTSIDE, None, ()))
        else:
            whole = node.parts[1].whole if here.code == POWER else None
            parts = () if here.code == OTHER else node.parts[:1] if whole is not None else node.parts
            for part in parts:
                add(part)
            steps.append(Step(node, here.code, whole if here.code == POWER else here.how, parts))

    add(root)
    return tuple(steps)
