"""Inequalities in one step: a difference of plain sign once variables are moved, products of facts, logarithms."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.hints.goals import Goal, as_factors, upright
from ptproof.proof.kernel.hints.norms import norms
from ptproof.proof.kernel.hints.products import products
from ptproof.proof.kernel.hints.squares import sum_of_squares
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Relation

_BOUND = (sp.Derivative, sp.Integral, sp.Limit, sp.Subs)


def directly(goal: Goal) -> Iterator[str]:
    """The difference of both sides as a term of plain sign, or as products of what is known."""
    relation, known = goal.relation, [item for item in goal.known if item.sign != "!="]
    if relation.sign == "!=" and relation.left.is_nonzero and relation.left.is_Symbol:
        return
    if relation.sign == "!=" and not relation.has(AppliedUndef):
        known = [item for item in known if not item.has(AppliedUndef)]
    atoms = Atoms.over(goal.names)
    atoms.choose(side for item in (relation, *known) for side in (item.left, item.right))
    wanted, facts = relation.standard().map(atoms), []
    for item in known:
        with contextlib.suppress(NoTranslation):
            facts.append(item.standard().map(atoms))
    moved, lines = _slack(facts, atoms)
    gap = as_factors((wanted.right - wanted.left).xreplace(moved))
    if relation.sign == "!=":
        last = f"nonzero_as {term(sum_of_squares(-gap) or -gap, atoms.names)}"
    else:
        last = f"difference_as {term(sum_of_squares(gap) or upright(gap), atoms.names)}"
    yield "; ".join([*atoms.lines, *lines, last])
    if relation.sign == "!=" or gap.is_positive or (gap.is_nonnegative and relation.sign in ("<=", ">=")):
        return
    # Here the variables stay as they are: their bounds are facts like any other.
    gap = as_factors(wanted.right - wanted.left)
    if hint := _by_products(gap, facts, atoms):
        yield "; ".join([*atoms.lines, hint])


def by_norms(goal: Goal) -> Iterator[str]:
    """The same by what squared norms are."""
    if goal.relation.sign != "!=" and (found := norms(goal.relation, goal.known, goal.names)) is not None:
        relation, others, lines = found
        for hint in directly(Goal(relation, tuple(others), goal.names)):
            yield "; ".join([*lines, hint])


def _by_products(gap: sp.Expr, facts: list[Relation], atoms: Atoms) -> str:
    top, bottom = sp.fraction(gap)
    found = products(top, facts)
    if found is None and not bottom.is_positive:
        top, bottom = sp.expand(-top), upright(-bottom)
        found = products(top, facts)
    if found is None:
        return ""
    steps = [f"top_of {term(top, atoms.names)} {term(bottom, atoms.names)}"]
    if found.factor != 1:
        steps.append(f"multiply_by {term(found.factor, atoms.names)}")
    steps += [f"fact_from {term(fact.bottom, atoms.names)} {term(fact.top, atoms.names)}" for fact in found.facts]
    steps += [f"product ({' * '.join(term(factor, atoms.names) for factor in factors)})" for factors in found.products]
    return "; ".join([*steps, "linear"])


def by_logarithms(goal: Goal) -> Iterator[str]:
    """Both sides, and those of what is known, as sums of logarithms, where they are products of powers."""
    wanted = goal.relation.standard()
    if wanted.sign == "!=" or not (_monomial(wanted.left) and _monomial(wanted.right)):
        return
    atoms = Atoms.over(goal.names)
    steps = ["by_logarithms"]
    facts = []
    for item in (given.standard() for given in goal.known):
        if _monomial(item.left) and _monomial(item.right):
            sides = " ".join(map(goal.text, (item.left, item.right)))
            steps.append(f"try (logarithms_of {sides})")
            facts.append(item.map(lambda side: _logarithm(side, atoms)))
        elif item.left.is_number or item.right.is_number:
            facts.append(item.map(atoms))
    facts += [Relation(sp.Integer(1), "<=", symbol) for symbol in goal.names if getattr(symbol, "is_Symbol", False)
              and symbol.is_integer and symbol.is_positive]  # fmt: skip
    wanted = wanted.map(lambda side: _logarithm(side, atoms))
    gap = as_factors(wanted.right - wanted.left)
    if hint := _by_products(gap, facts, atoms):
        yield "; ".join([*steps, "logarithms", *atoms.lines, hint])


def _monomial(expression: sp.Basic) -> bool:
    if expression.is_Mul:
        return all(map(_monomial, expression.args))
    if isinstance(expression, sp.exp):
        return True
    if expression.is_Pow:
        return _monomial(expression.base)
    return bool(expression.is_positive and (expression.is_Symbol or expression.is_Rational))


def _logarithm(expression: sp.Basic, atoms: Atoms) -> sp.Expr:
    """The logarithm of a product of powers as a sum; what an exponential is of is an atom, up to a rational factor."""
    if expression.is_Mul:
        return sp.Add(*(_logarithm(factor, atoms) for factor in expression.args))
    if isinstance(expression, sp.exp):
        constant, rest = sp.factor(expression.args[0]).as_coeff_Mul()
        return constant * atoms.written(rest)
    if expression.is_Pow:
        return atoms(expression.exp) * _logarithm(expression.base, atoms)
    if expression.is_Rational and expression.q != 1:
        return _logarithm(sp.Integer(expression.p), atoms) - _logarithm(sp.Integer(expression.q), atoms)
    return atoms(sp.log(expression))


def _slack(facts: list[Relation], atoms: Atoms) -> tuple[dict[sp.Symbol, sp.Expr], list[str]]:
    """Variables replaced by what they are equal to, or by a lower bound and what is above it; and the lines for Coq."""
    moved: dict[sp.Symbol, sp.Expr] = {}
    lines: list[str] = []
    for relation in facts:
        gap = sp.expand((relation.right - relation.left).xreplace(moved))
        symbol = _solvable(gap, relation.sign)
        if symbol is None:
            continue
        rest = symbol - gap if gap.coeff(symbol) == 1 else symbol + gap
        text = atoms.names[symbol]
        if relation.sign == "=":
            value = rest
            lines.append(f"replace_by {text} {term(value, atoms.names)}")
        else:
            name = fresh(f"gap{len(lines)}", atoms.names)
            above = sp.Symbol(name, **{"positive" if relation.sign == "<" else "nonnegative": True})
            atoms.names[above] = name
            value = rest + above
            lines.append(f"{'above' if relation.sign == '<' else 'at_least'} {text} {term(rest, atoms.names)} {name}")
        moved = {old: new.xreplace({symbol: value}) for old, new in moved.items()} | {symbol: value}
    return moved, lines


def _solvable(gap: sp.Expr, sign: str) -> sp.Symbol | None:
    """A symbol that the gap holds once and with the factor 1 (or -1, for an equation); those without a sign first."""

    def fits(symbol: sp.Symbol) -> bool:
        factor = gap.coeff(symbol)
        return (factor == 1 or (sign == "=" and factor == -1)) and not (gap - factor * symbol).has(symbol)

    found = [symbol for symbol in gap.free_symbols if fits(symbol)]
    return min(found, key=lambda s: (s.name.startswith("gap"), s.is_nonnegative is True, s.name), default=None)


def by_bisection(goal: Goal) -> Iterator[str]:
    """An inequality in one variable between numbers, by intervals that cover all of its values."""
    relation, symbols = goal.relation, goal.relation.free_symbols
    if relation.sign in ("=", "!=") or len(symbols) != 1 or relation.has(AppliedUndef, *_BOUND):
        return
    (symbol,) = symbols
    items = [item.standard() for item in goal.known if item.sign not in ("=", "!=")]
    if any(i.left == symbol and i.right.is_number for i in items) and any(
        i.right == symbol and i.left.is_number for i in items
    ):
        yield f"bisected {goal.text(symbol)}"


def by_growth_of_parts(relation: Relation, known: Sequence[Relation]) -> Iterator[str]:
    """By the squares of both sides, by what exponentials are above, and by parts that grow; of polynomials in these."""
    powers = sp.Tuple(relation.left, relation.right).atoms(sp.Pow)
    others = [part for part in sp.Tuple(relation.left, relation.right).atoms(sp.Function)
              if not isinstance(part, sp.exp | sp.Abs)]  # fmt: skip
    if relation.sign == "!=" or others or any(not power.exp.is_Integer or power.exp < 0 for power in powers):
        return
    if relation.has(sp.exp) and relation.sign in ("<=", ">="):
        yield from ("by_exponentials", "parts_grow")
    elif relation.has(sp.exp):
        yield "; ".join([*("subst" for item in known[:1] if item.sign == "="), "parts_grow_strictly"])
    elif relation.has(sp.Abs) and relation.sign in ("<=", ">="):
        yield "by_squares"
