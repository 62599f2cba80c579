"""z3: an inequality that is said to follow holds at every point that its assumptions allow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.proof.engines.reals import follows
from ptproof.proof.statement import Relation
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

SECONDS = 0.4
FUNCTIONS = {"F": lambda a: MP.sin(3 * a) - a / 3, "G": lambda a: MP.exp(-(a**2)) + MP.mpf(1) / 7}
RULES: tuple[Callable[[Any, Any], tuple[Any, Any]], ...] = (
    lambda a, b: (a * b, (a**2 + b**2) / 2),
    lambda a, b: (2 * a, a**2 + 1),
    lambda a, b: (sp.Abs(a + b), sp.Abs(a) + sp.Abs(b)),
    lambda a, b: (sp.Abs(a) - sp.Abs(b), sp.Abs(a - b)),
    lambda a, b: (a, sp.Max(a, b)),
    lambda a, b: (sp.Min(a, b), (a + b) / 2),
    lambda a, b: (a, sp.sqrt(a**2 + b**2)),
    lambda a, b: (sp.sqrt(a**2 + b**2), sp.Abs(a) + sp.Abs(b)),
    lambda a, b: (sp.sqrt(a * b), (a + b) / 2),
    lambda a, b: (sp.sin(a) * sp.cos(a), sp.Rational(1, 2)),
    lambda a, b: (sp.sin(a), 1),
    lambda a, b: (0, sp.exp(a)),
    lambda a, b: (sp.exp(a) * sp.exp(b), (sp.exp(2 * a) + sp.exp(2 * b)) / 2),
    lambda a, b: (1 / (1 + a**2), 1),
    lambda a, b: (a / (1 + a), 1),
    lambda a, b: (sp.tanh(a), 1),
    lambda a, b: (sp.sqrt(a), (1 + a) / 2),
    lambda a, b: (a ** sp.Rational(1, 3), (2 + a) / 3),
    lambda a, b: (a ** sp.Rational(3, 2), a**2 + 1),
    lambda a, b: (0, sp.Piecewise((a**2, a < b), (1, True))),
    lambda a, b: (sp.Piecewise((a, a < b), (b, True)), b),
    lambda a, b: (sp.log(a), a - 1),
    lambda a, b: (0, trees.G(a)),
    lambda a, b: (0, trees.F(a) ** 2 + sp.Abs(b)),
    lambda a, b: (a, b),
    lambda a, b: (1 / a, 1 / b),
    lambda a, b: (a**3, b**3),
    lambda a, b: (sp.sign(a) * b, sp.Abs(b)),
    lambda a, b: (sp.floor(a), a),
    lambda a, b: (sp.acos(a), 4),
    lambda a, b: (0, a**b),
)
small = trees.expressions(functions=(sp.sin, sp.exp, sp.sqrt, sp.Abs, sp.log), undefined=(trees.F, trees.G), leaves=2)
scales = st.sampled_from([sp.S.One, sp.S.One, sp.S.One, sp.Rational(1, 2), sp.Integer(2), sp.Integer(-1)])
signs = st.sampled_from(["<=", "<", ">=", ">", "!=", "="])


@st.composite
def relations(draw: Any) -> Relation:
    """True and false ones, which look alike."""
    a, b = draw(small), draw(small)
    try:
        left, right = draw(st.sampled_from(RULES))(a, b)
    except (ValueError, TypeError):  # SymPy's Max, or comparison, of what is not real
        left, right = a, b
    left, right = sp.sympify(left) * draw(scales), sp.sympify(right) * draw(scales)
    if not (trees.is_plain(left) and trees.is_plain(right)):
        left, right = a, b
    return Relation(left, draw(st.sampled_from(["<=", "<=", "<", ">=", ">", "!=", "="])), right)


@given(relations(), st.lists(st.builds(Relation, small, signs, small), max_size=2), trees.seeds)
@fuzz(15)
def test_what_follows_holds_wherever_the_assumptions_do(
    conclusion: Relation, assumptions: list[Relation], seed: int
) -> None:
    answer = or_nothing(5, lambda: follows(conclusion, assumptions, seconds=SECONDS))
    if answer is None or not answer.shown:
        return
    event("answered")
    symbols = conclusion.free_symbols.union(*(item.free_symbols for item in assumptions))
    for point in trees.points(symbols, 12, seed):
        try:
            if not all(_holds(item, point) for item in assumptions):
                continue
        except oracle.NoValue:
            continue
        where = f"{conclusion} under {', '.join(map(str, assumptions))} at {point}"
        try:
            failed = oracle.fails(conclusion.left, conclusion.sign, conclusion.right, point, FUNCTIONS)
        except oracle.Unsure:
            continue
        except oracle.NoValue as error:
            raise AssertionError(f"{where}: {error}") from None
        assert not failed, where


def _holds(item: Relation, point: Any) -> bool:
    side = oracle.sign(item.left - item.right, point, FUNCTIONS)
    return {"<": side < 0, "<=": side < 0, ">": side > 0, ">=": side > 0, "!=": side != 0, "=": False}[item.sign]
