"""Bounds that grow at least as fast as what they bound wherever it is above them: then it never is.

``U' <= f(s, U)`` for p <= s <= q, U(p) <= y(p), and ``f(s, U) <= y'`` wherever U > y: then U(q) <= y(q). The bound y is
what the claim says of q.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.comparisons import Compared, Rate, rates
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.kernel.terms import term
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.statement import Relation


def never_above(said: Proposition, known: list[Relation]) -> Iterator[Compared]:
    """The claim's bounds of functions of which it knows the rates, each with the line for Coq."""
    for rate, _ in rates(said.claim, known, said.names):
        for part in said.conclusions:
            wanted = part.relation and part.relation.standard()
            start = _start(rate)
            if not wanted or wanted.sign != "<=" or start is None or wanted.left.func != rate.function.func:
                continue
            (end,) = wanted.left.args
            if end.is_Symbol:
                yield from _never_above(rate, start, end, wanted)


def _start(rate: Rate) -> sp.Expr | None:
    """The first time at which the rate is known."""
    for item in map(Relation.standard, rate.domain):
        if item.right == rate.time:
            return item.left
    return None


def _never_above(rate: Rate, start: sp.Expr, end: sp.Symbol, wanted: Relation) -> Iterator[Compared]:
    time, bound = rate.time, wanted.right.xreplace({end: rate.time})
    slope = sp.diff(bound, time)
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
    lines = [
        "bound",
        f"intros {s} ?; facts; apply (is_derive_minus {U} {Y}); "
        f"[ apply Derive_correct; first [ assumption | match goal with H : forall _, _ |- _ => apply H end ] "
        f"| auto_derive; [ repeat split; sign | first [ rational | same_values; rational ] ] ]",
        f"cbv beta; {'; '.join([*replaced, ''])}apply Rle_minus; apply Rle_trans with {rate.write(first)}; "
        f"[ {before[0]} | right; first [ rational | same_values; rational ] ]",
        f"intros {s} ? ?; facts; cbv beta in *; rate {U} {s}; apply Rle_minus; "
        f"assert ({rate.write(bound)} < {rate.write(rate.function)}) by lra; "
        f"apply Rle_trans with {rate.write(rate.rate)}; [ first [ assumption | lra ] | {between[0]} ]",
    ]
    yield wanted, (
        f"assert ({rate.write(wanted.left)} <= {rate.write(wanted.right)}); [ apply Rminus_le; "
        f"apply (stays_below (fun {s} => {U} {s} - {Y} {s}) (fun {s} => Derive {U} {s} - {y} {s}) {p} {q}); "
        f"[> {' | '.join(lines)} ] | ]"
    )
