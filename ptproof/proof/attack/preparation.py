"""What an attack knows about a goal before it draws points: its free values, and how assumptions bound them."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache, partial
from random import Random
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.functions import differentiable, solutions
from ptproof.proof.attack.isolation import Isolated, isolated, isolated_in
from ptproof.proof.attack.kinds import Sides
from ptproof.proof.attack.settings import Setting, settings
from ptproof.proof.attack.trajectories import trajectories
from ptproof.proof.attack.tree import BINDERS, Node, tree
from ptproof.proof.claim import Goal
from ptproof.proof.statement import (
    Exists,
    ForAll,
    Prose,
    Relation,
    Runs,
    Smooth,
    Statement,
    expressions_of,
    free_symbols,
    plain,
    relations_of,
)


@dataclass(frozen=True)
class Bound:
    """A plain assumption with every atom that it isolates, or gives by the two roots of a quadratic equation."""

    relation: Relation
    isolated: tuple[Isolated, ...]
    roots: tuple[tuple[Node, Node], ...]
    atoms: tuple[Node, ...]
    sides: Sides


@dataclass(frozen=True)
class Prepared:
    """The free values of a goal, and what its assumptions say of them.

    Attributes
    ----------
    atoms
        Symbols, and applied undefined functions that may take any value of their kind at each argument.
    functions
        The other undefined functions, by one application of each.
    defined
        Functions that an assumption gives by an expression.
    solutions
        Functions that satisfy a differential inequality with equality, or a system of differential equations.
    special
        An atom and a value of it, in the other atoms, at which something vanishes: a denominator, what is under a
        root, the distance from a kink, or the difference of the two sides.
    limited
        Functions that are differentiable only so often, by what draws one.
    smooth
        Whether the statement is about smoothness.
    settings
        Fields for the assumptions on several variables, each with a motion if a system is assumed.
    definitions
        The assumptions that define the functions of ``defined``, which therefore hold.
    """

    parts: tuple[Relation, ...]
    bounds: tuple[Bound, ...]
    quantified: tuple[ForAll, ...]
    atoms: tuple[Any, ...]
    functions: tuple[AppliedUndef, ...]
    defined: tuple[tuple[Any, Concrete], ...]
    solutions: tuple[tuple[Any, Concrete], ...]
    special: tuple[Isolated, ...]
    limited: tuple[tuple[Any, Callable[[Random], Concrete]], ...] = ()
    smooth: bool = False
    settings: tuple[Setting, ...] = ()
    definitions: frozenset[ForAll] = frozenset()


def prepared(goal: Goal) -> Prepared:
    """Everything about the goal that does not depend on the point."""
    statement: list[Statement] = [] if isinstance(goal.statement, Prose) else [goal.statement]
    everything = [*statement, *goal.assumptions]
    quantified = tuple(item for item in goal.assumptions if isinstance(item, ForAll))
    definitions = {function: (concrete, item) for function, concrete, item in _definitions(quantified)}
    defined = {function: concrete for function, (concrete, _) in definitions.items()}
    symbols = _free(goal, everything)
    applied = sorted(set().union(*(e.atoms(AppliedUndef) for e in expressions_of(everything))), key=str)
    bound_inside = _applied_inside(everything, quantified)
    assumed = {
        node.func for item in plain(goal.assumptions) for e in (item.left, item.right) for node in e.atoms(AppliedUndef)
    }
    pinned = [node for node in applied if node.func in assumed and node.func not in bound_inside]
    functions = {node.func: node for node in applied if node not in pinned and node.func not in defined}
    relations = plain(goal.assumptions)
    parts = _parts(goal.statement)
    used = frozenset(item for _, item in definitions.values())
    return Prepared(
        parts,
        tuple(_bound(relation, (*symbols, *pinned)) for relation in relations),
        quantified,
        (*symbols, *pinned),
        tuple(functions.values()),
        tuple(defined.items()),
        (*itertools.chain.from_iterable(solutions(item) for item in quantified), *trajectories(quantified)),
        tuple(itertools.islice(_special(_places(goal.statement), (*symbols, *pinned)), 60)),
        _limited(goal.statement),
        isinstance(goal.statement, Smooth),
        settings(quantified, used, tuple(defined.items())),
        used,
    )


def _limited(statement: Statement) -> tuple[tuple[Any, Callable[[Random], Concrete]], ...]:
    assumed = statement.assumed if isinstance(statement, Smooth) else ()
    return tuple(
        (function.func, partial(differentiable, function, order)) for function, order in assumed if order != sp.oo
    )


def _parts(statement: Statement) -> tuple[Relation, ...]:
    return () if isinstance(statement, Prose | Smooth | Exists | Runs) else relations_of(statement)


def _places(statement: Statement) -> tuple[Relation, ...]:
    """The relations in which special places are looked for."""
    if isinstance(statement, Smooth):
        return tuple(Relation(expression, "=", sp.S.Zero) for expression in statement.expressions)
    return _parts(statement)


def _free(goal: Goal, everything: list[Any]) -> list[sp.Symbol]:
    found: set[sp.Symbol] = set()
    for item in everything:
        here = free_symbols([item])
        if isinstance(item, ForAll):
            here -= set(item.variables)
        if isinstance(item, Exists):
            here -= {*item.variables, *item.over}
        found |= here
    return sorted(found, key=lambda symbol: (symbol.name, str(symbol.assumptions0)))


def _applied_inside(everything: list[Any], quantified: Iterable[ForAll]) -> set[Any]:
    """The functions that occur where a variable is bound, or inside the arguments of others."""
    found: set[Any] = set()
    for expression in expressions_of(everything):
        for node in expression.atoms(*BINDERS):
            found |= {inner.func for inner in node.atoms(AppliedUndef)}
        for node in expression.atoms(AppliedUndef):
            found |= {inner.func for argument in node.args for inner in argument.atoms(AppliedUndef)}
    for item in quantified:
        for expression in expressions_of([item]):
            found |= {inner.func for inner in expression.atoms(AppliedUndef)}
    return found


def _definitions(quantified: Iterable[ForAll]) -> Iterable[tuple[Any, Concrete, ForAll]]:
    """f(s) = expression for all s: the function is that expression."""
    for item in quantified:
        left, right = item.relation.left, item.relation.right
        if item.relation.sign != "=":
            continue
        for one, other in ((left, right), (right, left)):
            inside = {node.func for node in other.atoms(AppliedUndef)}
            if isinstance(one, AppliedUndef) and one.args == item.variables and one.func not in inside:
                places = tuple(sp.Dummy(variable.name, real=True) for variable in item.variables)
                body = other.xreplace(dict(zip(item.variables, places, strict=True)))
                yield one.func, Concrete(places, body), item
                break


@lru_cache(maxsize=1024)
def _bound(relation: Relation, atoms: tuple[Any, ...]) -> Bound:
    letters = tree(relation.left).letters | tree(relation.right).letters
    inside = sorted({atom for atom in atoms if tree(atom) in letters}, key=str)
    difference = sp.Add(relation.left, -relation.right, evaluate=True)
    found = []
    for atom in inside:
        one = isolated(difference, atom)
        if one is not None:
            found.append(one)
    roots: tuple[tuple[Any, sp.Expr], ...] = ()
    if relation.sign == "=" and not found:
        places = _special((relation,), tuple(inside))
        roots = _roots(difference, inside) or tuple((one.atom, one.bound) for one in places)
    ends = tuple((tree(atom), tree(root)) for atom, root in roots)
    return Bound(relation, tuple(found), ends, tuple(map(tree, inside)), Sides.of(relation))


def _roots(difference: sp.Expr, atoms: Iterable[Any]) -> tuple[tuple[Any, sp.Expr], ...]:
    found: list[tuple[Any, sp.Expr]] = []
    for atom in sorted(atoms, key=str):
        if not _polynomial(difference, atom):
            continue
        letter = sp.Dummy()
        polynomial = difference.xreplace({atom: letter}).as_poly(letter)
        if polynomial is None or polynomial.degree() != 2:
            continue
        a, b, c = polynomial.all_coeffs()
        root = sp.sqrt(b**2 - 4 * a * c)
        found += [(atom, (-b + root) / (2 * a)), (atom, (-b - root) / (2 * a))]
    return tuple(found)


def _polynomial(expression: sp.Expr, atom: Any) -> bool:
    """Whether it is a polynomial in the atom as it is written: SymPy would rebuild the rest to find that out."""
    if expression == atom or not expression.has(atom):
        return True
    if isinstance(expression, sp.Pow) and not (expression.exp.is_Integer and expression.exp.is_positive):
        return False
    return isinstance(expression, sp.Add | sp.Mul | sp.Pow) and all(_polynomial(part, atom) for part in expression.args)


def _special(parts: Iterable[Relation], atoms: tuple[Any, ...]) -> Iterable[Isolated]:
    """Where something in the relations vanishes, for every atom in which it is linear."""
    seen: set[sp.Expr] = set()
    nodes_of = {atom: tree(atom) for atom in atoms}
    for part in parts:
        sides = (part.left, part.right)
        nodes = dict.fromkeys(node for side in sides for node in sp.preorder_traversal(side))
        for expression in (part.left - part.right, *itertools.chain.from_iterable(map(_critical, nodes))):
            if expression in seen or expression.is_number or len(seen) > 40:
                continue
            seen.add(expression)
            letters = tree(expression).letters
            inside = [atom for atom, node in nodes_of.items() if node in letters]
            for one in isolated_in(expression, tuple(inside)):
                if one is not None:
                    yield one


def _critical(node: sp.Basic) -> Iterable[sp.Expr]:
    """What an expression depends on in another way on either side of 0."""
    if isinstance(node, sp.Pow) and not (node.exp.is_nonnegative and node.exp.is_integer):
        return [node.base]
    if isinstance(node, sp.log | sp.Abs | sp.sign | sp.Heaviside):
        return [node.args[0]]
    if isinstance(node, sp.Max | sp.Min):
        return [*node.args, *(a - b for a, b in itertools.combinations(node.args, 2))]
    if isinstance(node, sp.core.relational.Relational):
        return [node.lhs - node.rhs]
    return []
