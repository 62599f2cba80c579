"""Equations that claims may be under, and what can be told of a relation alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.drafting.printing import can_be_written
from ptproof.errors import InputError
from ptproof.proof.statement import Relation
from ptproof.reading.latex.statements import Pair


@dataclass(frozen=True)
class Fact:
    """An equation about ``head`` that the claims after it may be under: as the paper defines it, or by the chain rule.

    ``written`` is the equation as the paper has it, where that is not solved for its head.

    By the chain rule it is the rate of what the fact ``of`` defines: ``chain`` has the letters that move with the names
    of their rates (none for the time itself), and ``inner`` what is put in before, round by round. The paper may have
    it at a ``shift`` of the argument of its head.
    """

    name: str
    head: sp.Expr
    pair: Pair
    file: str
    shift: sp.Expr | None = None
    written: Pair | None = None
    of: Fact | None = None
    chain: tuple[tuple[str, str], ...] = ()
    inner: tuple[tuple[Fact, ...], ...] = ()

    @property
    def said(self) -> Pair:
        """The equation as the paper has it."""
        return self.written or self.pair

    @property
    def uses(self) -> tuple[Fact, ...]:
        """The facts that it is made from."""
        return () if self.of is None else (self.of, *(fact for put in self.inner for fact in put))


def for_all(fact: Fact) -> tuple[str, str]:
    """A definition of a function as the table of notation has it: for any argument."""
    free = {argument: sp.Symbol(f"_{argument}", real=True) for argument in fact.head.args}
    name = fact.head.func.__name__
    return f"{name}({', '.join(map(str, free.values()))})", str(fact.pair.right.xreplace(free))


def is_general(pair: Pair) -> bool:
    """Whether an equation says what a function is at every argument: these occur on the right, and nothing is bound."""
    nodes = {type(node) for node in sp.preorder_traversal(pair.right)}
    return bool(set(pair.left.args) & pair.right.free_symbols) and not nodes & {
        sp.Integral, sp.Limit, sp.Subs, sp.Derivative, sp.Piecewise,
    }  # fmt: skip


def unshifted(pair: Pair, times: Iterable[str]) -> Pair | None:
    """What an equation such as ν(t − t₀) = 1 − (t − t₀)/T says of the function at every argument: ν(t) = 1 − t/T."""
    head = pair.left
    if pair.sign != "=" or not (isinstance(head, AppliedUndef) and len(head.args) == 1 and head.args[0].is_Add):
        return None
    [argument] = head.args
    for time in (sp.Symbol(name, real=True) for name in times):
        by = argument - time
        right = pair.right.subs(time, time - by)
        at_all = Pair(head.func(time), "=", right)
        if by.free_symbols and time not in by.free_symbols and not by.free_symbols & right.free_symbols:
            return at_all if is_general(at_all) else None
    return None


def depends(expression: sp.Expr, head: sp.Expr, facts: Mapping[sp.Expr, Fact]) -> bool:
    """Whether the expression, with all that is defined put in, has the head in it."""
    seen: set[sp.Expr] = set()
    left = [expression]
    while left:
        parts = left.pop().atoms(sp.Symbol, AppliedUndef)
        if any(part == head or (isinstance(head, AppliedUndef) and part.func == head.func) for part in parts):
            return True
        new = parts - seen
        seen |= new
        left += [facts[part].pair.right for part in new if part in facts]
    return False


def is_again(fact: Fact, pair: Pair) -> bool:
    """Whether a relation repeats an equation that defines something."""
    return not fact.chain and pair.sign == "=" and sp.expand(pair.right - fact.pair.right) == 0


def of_atoms(pair: Pair, facts: Mapping[sp.Expr, Fact]) -> bool:
    """Whether both sides are letters of which nothing is said, or numbers: a condition."""
    sides = (pair.left, pair.right)
    return pair.sign != "=" and all((side.is_Symbol and side not in facts) or side.is_number for side in sides)


def unwritable(pairs: Sequence[Pair]) -> str:
    """Why a relation cannot be written as a claim."""
    for pair in pairs:
        for side in (pair.left, pair.right):
            if side.has(sp.nan, sp.zoo) or side in (sp.oo, -sp.oo):
                return "a side is no real number"
            if not can_be_written(side):
                return f"{side} has no form in Python yet"
        try:
            Relation(pair.left, pair.sign, pair.right)  # type: ignore[arg-type]
        except InputError as error:
            return str(error)
    return ""


def law_of(pair: Pair, moved: Mapping[str, tuple[sp.Expr, sp.Symbol]], facts: Mapping[sp.Expr, Fact]) -> Pair | None:
    """An equation that says how one letter moves, solved for its rate: as m dv/dt = u − bv for dv/dt.

    None where it has the rates of several letters, where the rate is not a term of it, or where something is said of
    the letter or of its rate already.
    """
    symbols = pair.left.free_symbols | pair.right.free_symbols
    rates = [symbol for symbol in symbols if symbol.name in moved]
    if pair.sign != "=" or len(rates) != 1 or rates[0] in facts or moved[rates[0].name][0] in facts:
        return None
    (rate,) = rates
    gap = sp.expand(pair.left - pair.right)
    factor = sp.diff(gap, rate)
    if factor == 0 or factor.has(rate) or pair.left == rate:
        return None
    return Pair(rate, "=", sp.expand(gap - factor * rate) / -factor)


def puts_in(pairs: Sequence[Pair], general: Mapping[str, Fact]) -> dict[Pair, tuple[Fact, ...]]:
    """For each relation the definitions of its functions, those first in which others occur."""
    found = {}
    for pair in pairs:
        names: dict[str, None] = {}
        _functions_in(pair.left, general, names)
        _functions_in(pair.right, general, names)
        if names:
            found[pair] = tuple(general[name] for name in reversed(names))
    return found


def _functions_in(expression: sp.Expr, general: Mapping[str, Fact], names: dict[str, None]) -> None:
    for part in sorted(expression.atoms(AppliedUndef), key=str):
        name = part.func.__name__
        if name in general and name not in names:
            _functions_in(general[name].pair.right, general, names)
            names[name] = None
