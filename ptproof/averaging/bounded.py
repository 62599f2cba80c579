"""Whether a function of slow time and states stays bounded in time, with all its derivatives."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.utilities.iterables import sift

from ptproof.averaging.samples import masked_functions, sample_points
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.engines.reals import follows
from ptproof.proof.kinks import KINKS
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Evidence, Verdict, Witness

ENGINE = "bounded in time"
_ENTIRE = (sp.exp, sp.sin, sp.cos, sp.sinh, sp.cosh, sp.tanh, sp.atan, sp.asinh, sp.erf)
_MOST = 6
_SECONDS = 2.0


def bounded_in_time(
    expression: sp.Expr,
    time: sp.Symbol,
    states: Sequence[sp.Symbol],
    start: sp.Expr | None,
    domain: Sequence[Relation] = (),
    assumed: Iterable[AppliedUndef] = (),
) -> Evidence:
    """Whether ``expression`` and its derivatives are bounded in ``time`` on every compact set of states.

    Parameters
    ----------
    expression
        Smooth in time and states (that is examined elsewhere).
    start
        The times are ``start`` ≤ time < ∞; None stands for all real times.
    domain
        The same as relations, and what else restricts time and states.
    assumed
        Undefined functions, as applied, that are bounded in time with all their derivatives, for the other arguments
        in any compact set.

    Returns
    -------
    Evidence
        proved: the time enters through functions that are bounded with all their derivatives (sines and cosines
        of affine arguments, rational functions that do not grow, decaying exponentials, …). refuted: with exact
        states at which the limit as time → ∞ is infinite. undecided otherwise.
    """
    tame = _Tame(time, frozenset(states), start, domain, tuple(assumed))
    if tame(expression):
        entering = time in expression.free_symbols
        moving = "time enters through functions that are bounded with their derivatives"
        return Evidence(ENGINE, Verdict.PROVED, moving if entering else "continuous and free of time")
    if (found := _unbounded(expression, time, domain)) is not None:
        limit, witness = found
        detail = f"{expression} tends to {limit} as {time} grows"
        return Evidence(ENGINE, Verdict.REFUTED, detail, witness=witness)
    functions = sorted({str(applied) for applied in expression.atoms(AppliedUndef) if time in applied.args})
    detail = f"not known whether {expression} is bounded in {time}"
    if functions:
        detail = f"rests on {', '.join(functions)} being bounded in {time} with its derivatives"
    return Evidence(ENGINE, Verdict.UNDECIDED, detail)


def _unbounded(expression: sp.Expr, time: sp.Symbol, domain: Sequence[Relation]) -> tuple[sp.Expr, Witness] | None:
    """Exact values of everything else, in the region, at which the limit as time grows is infinite."""
    # At one point a smooth function of the states may have any value of its kind.
    masked, back = masked_functions(expression)
    if any(time in node.free_symbols for node in back.values()):
        return None
    others = [relation for relation in domain if time not in relation.free_symbols]
    for point in itertools.islice(sample_points(masked.free_symbols - {time}, others, back), _MOST):
        limit = limit_of(masked.subs(point, simultaneous=True), time, sp.oo)
        if limit in (sp.oo, -sp.oo):
            names = {str(back.get(symbol, symbol)): str(value) for symbol, value in point.items()}
            return limit, Witness({**names, str(time): "oo"}, str(limit), "a finite bound")
    return None


@dataclass(frozen=True)
class _Tame:
    """Decides by structure; True is a proof."""

    time: sp.Symbol
    states: frozenset[sp.Symbol]
    start: sp.Expr | None
    domain: Sequence[Relation]
    assumed: tuple[AppliedUndef, ...]

    def __call__(self, node: sp.Expr) -> bool:
        if self.time not in node.free_symbols:
            return True
        if self.is_scalar(node):
            return self.rational(node)
        if node.is_Add:
            return all(map(self, node.args))
        if node.is_Mul:
            scalar, rest = sift(node.args, self.is_scalar, binary=True)
            return self.rational(sp.Mul(*scalar)) and all(map(self, rest))
        if node.is_Pow:
            return self.power(node)
        if isinstance(node, sp.sin | sp.cos | sp.tanh | sp.atan) and self.is_affine(node.args[0]):
            return True
        if isinstance(node, sp.exp) and self.decays(node.args[0]):
            return True
        if isinstance(node, _ENTIRE):
            return self(node.args[0])
        if isinstance(node, AppliedUndef):
            return self.is_assumed(node) or (all(map(self, node.args)) and self.time not in node.args)
        return False

    def is_assumed(self, node: AppliedUndef) -> bool:
        """Whether it is one of the functions that are bounded in time, at a time that runs on evenly.

        Of a(τ) it is assumed that all its derivatives are bounded. Those of a(τ²) and, by x, of a(τx) need not be.
        """
        for known in self.assumed:
            if known.func == node.func and len(known.args) == len(node.args):
                pairs = zip(known.args, node.args, strict=True)
                return all(self.runs_on(entry) if letter == self.time else self(entry) for letter, entry in pairs)
        return False

    def runs_on(self, argument: sp.Expr) -> bool:
        """Whether it is rate·time + rest with a constant rate that leads to late times, or that is 0."""
        rate = sp.diff(argument, self.time)
        even = self.is_affine(argument) and not (argument - rate * self.time).expand().has(self.time)
        return even and (self.start is None or bool(rate.is_nonnegative))

    def is_scalar(self, node: sp.Expr) -> bool:
        return not node.free_symbols & self.states and bool(node.is_rational_function(self.time))

    def rational(self, node: sp.Expr) -> bool:
        if self.time not in node.free_symbols:
            return True
        top, bottom = (sp.Poly(part, self.time) for part in sp.fraction(sp.cancel(sp.together(node))))
        if top.degree() > bottom.degree():
            return False
        if not (bottom.LC().is_nonzero or bottom.LC().is_positive):
            return False
        return bottom.degree() == 0 or self.holds(Relation(bottom.as_expr(), "!=", sp.S.Zero))

    def power(self, node: sp.Pow) -> bool:
        if node.base is sp.E:
            return self.decays(node.exp) or self(node.exp)
        if self.time in node.exp.free_symbols or not self(node.base):
            return False
        if node.exp.is_integer and node.exp.is_nonnegative:
            return True
        # Bounded derivatives of 1/g, √g, log g need g away from 0.
        return any(
            self.holds(Relation(bound, "<=", sign * node.base))
            for bound in (sp.S.One, sp.Rational(1, 10), sp.Rational(1, 1000))
            for sign in ((1, -1) if node.exp.is_integer else (1,))
        )

    def is_affine(self, argument: sp.Expr) -> bool:
        """Whether it is rate·time + rest, with a rate that is constant."""
        if argument.has(*KINKS):
            return False
        rate = sp.diff(argument, self.time)
        return not (rate.free_symbols & (self.states | {self.time}) or rate.atoms(AppliedUndef))

    def decays(self, argument: sp.Expr) -> bool:
        if self.start is None or not argument.is_polynomial(self.time) or argument.atoms(AppliedUndef):
            return False
        polynomial = sp.Poly(argument, self.time)
        return not polynomial.free_symbols_in_domain & self.states and bool(polynomial.LC().is_negative)

    def holds(self, relation: Relation) -> bool:
        return follows(relation, self.domain, seconds=_SECONDS).shown
