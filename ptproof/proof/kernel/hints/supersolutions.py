"""Bounds that grow at least as fast as what they bound wherever it is above them: then it never is.

``U' <= f(s, U)`` for p <= s <= q, U(p) <= y(p), and ``f(s, U) <= y'`` wherever U > y: then U(q) <= y(q). The bound y is
what the claim says of q.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.comparisons import Compared, Rate, rates
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.masks import bottoms
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.kernel.terms import term
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.statement import Relation


def never_above(said: Proposition, known: list[Relation]) -> Iterator[Compared]:
    """The claim's bounds of functions of which it knows the rates, each with the line for Coq."""
    wanted = [part.relation.standard() for part in said.conclusions if part.relation]
    for rate, _ in rates(said.claim, known, said.names):
        start = _start(rate)
        if start is None or rate.function.args != (rate.time,):
            continue
        for item in wanted:
            if item.sign == "<=" and item.left.func == rate.function.func and item.left.args[0].is_Symbol:
                yield from _never_above(rate, start, item.left.args[0], item)


def _simpler(expression: sp.Expr) -> sp.Expr:
    """The expression in factors, its exponentials as they are."""
    letters = {part: sp.Dummy(positive=True) for part in expression.atoms(sp.exp)}
    return sp.factor(expression.xreplace(letters)).xreplace({letter: part for part, letter in letters.items()})


def weakened(said: Proposition, found: Compared, known: list[Relation]) -> Iterator[Compared]:
    """From U <= w exp(a): the claim's own bound w exp(b), by a <= b."""
    relation, line = found
    for part in said.conclusions:
        wanted = part.relation and part.relation.standard()
        if not wanted or wanted.sign != "<=" or wanted.left != relation.left or wanted.right == relation.right:
            continue
        (first, small), (factor, large) = map(_exponential, (relation.right, wanted.right))
        if first != factor or not small or not large:
            continue
        plain = tuple(item for item in known if not item.has(AppliedUndef))
        for below in by_refutation(Goal(Relation(small, "<=", large), plain, said.names)):
            w, a, b, bound = (term(item, said.names) for item in (first, small, large, wanted.right))
            yield (
                wanted,
                (
                    f"{line}; assert ({term(wanted.left, said.names)} <= {bound}); "
                    f"[ apply Rle_trans with ({w} * exp {a}); [ found_as | apply Rle_trans with ({w} * exp {b}); "
                    f"[ apply Rmult_le_compat_l; [ solve [ sign | lra ] | apply exp_le_exp; {below} ] "
                    f"| right; rewrite <- ?Rmult_assoc, <- ?exp_plus; exponents_agree ] ] | ]"
                ),
            )


def _exponential(product: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """The factors without e, and the exponent of e."""
    parts = sp.Mul.make_args(product)
    exponents = [part.args[0] for part in parts if isinstance(part, sp.exp)]
    return sp.Mul(*(part for part in parts if not isinstance(part, sp.exp))), sp.Add(*exponents)


def _start(rate: Rate) -> sp.Expr | None:
    """The first time at which the rate is known."""
    for item in map(Relation.standard, rate.domain):
        if item.right == rate.time:
            return item.left
    return None


def _never_above(rate: Rate, start: sp.Expr, end: sp.Symbol, wanted: Relation) -> Iterator[Compared]:
    time, bound = rate.time, wanted.right.xreplace({end: rate.time})
    slope = _simpler(sp.diff(bound, time))
    inside = [Relation(start, "<=", time), Relation(time, "<=", end)]
    first = bound.xreplace({time: start})
    known = (*rate.known, *inside, Relation(bound, "<", rate.function))
    between = list(by_refutation(Goal(Relation(rate.rate, "<=", slope), known, rate.names)))
    before = list(by_refutation(Goal(Relation(rate.at(start), "<=", first), rate.known, rate.names)))
    if not between or not before:
        return
    U, s, p, q = rate.names[rate.function.func], rate.names[time], rate.write(start), rate.write(end)
    Y, y = (f"(fun {s} : R => {rate.write(item)})" for item in (bound, slope))
    there = {**rate.names, time: p}
    values = [(part, part.xreplace({time: start})) for part in bound.atoms(sp.exp, sp.Pow)]
    replaced = [f"try (value_at {term(part, there)} {rate.write(value)})" for part, value in values if value.is_number]
    defined = "; ".join(_defined(Goal(Relation(slope, "=", bound), (*rate.known, *inside), rate.names)))
    lines = [
        "bound",
        f"gap_moves {U} {Y} {s} ltac:({defined or 'idtac'})",
        f"cbv beta; {'; '.join([*replaced, ''])}apply Rle_minus; apply Rle_trans with {rate.write(first)}; "
        f"[ {before[0]} | right; first [ rational | same_values; rational ] ]",
        f"intros {s} ? ?; facts; cbv beta in *; rate {U} {s}; apply Rle_minus; "
        f"assert ({rate.write(bound)} < {rate.write(rate.function)}) by lra; "
        f"apply Rle_trans with {rate.write(rate.rate)}; [ first [ assumption | lra ] | {between[0]} ]",
    ]
    yield (
        wanted,
        (
            f"assert ({rate.write(wanted.left)} <= {rate.write(wanted.right)}); [ apply Rle_trans with ({Y} {q}); "
            f"[ apply Rminus_le; "
            f"apply (stays_below (fun {s} => {U} {s} - {Y} {s}) (fun {s} => Derive {U} {s} - {y} {s}) {p} {q}); "
            f"[> {' | '.join(lines)} ] | right; cbv beta; first [ rational | same_values; rational ] ] | ]"
        ),
    )


def _defined(goal: Goal) -> Iterator[str]:
    """That what stands below a line in the relation is not 0."""
    for bottom in dict.fromkeys(bottoms(replace(goal, known=()))):
        wanted = Relation(bottom, "!=", sp.S.Zero)
        for tactic in by_refutation(replace(goal, relation=wanted)) if not bottom.is_positive else ():
            yield f"assert ({goal.text(bottom)} <> 0) by (solve [ {tactic} ])"
