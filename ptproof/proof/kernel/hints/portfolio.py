"""The tactics that are tried on a proposition, with hints that SymPy finds: Coq checks each of them or fails.

A hint is a rearrangement (a difference as a product, a variable as a bound and what is above it) or a product of what
is not negative. None of them is believed.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.declared import of_symbol
from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.hints.certificates import certificate
from ptproof.proof.kernel.hints.derived import Derived, derived
from ptproof.proof.kernel.hints.equations import by_equations
from ptproof.proof.kernel.hints.goals import Goal, upright
from ptproof.proof.kernel.hints.integrals import integrals
from ptproof.proof.kernel.hints.limits import near
from ptproof.proof.kernel.hints.norms import norms
from ptproof.proof.kernel.hints.products import products
from ptproof.proof.kernel.hints.search import by_steps
from ptproof.proof.kernel.hints.squares import sum_of_squares
from ptproof.proof.kernel.hints.witnesses import witnesses
from ptproof.proof.kernel.names import fresh
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.smooth import script as smoothness
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.statement import Relation


def script(said: Proposition, *, thorough: bool = False) -> str:
    """The tactics for the whole proposition, as one sentence for Coq; the thorough ones take longer to find and try."""
    assumed = (part.relation for part in said.premises if part.limit is None)
    told = (item for item in assumed if item is not None and item.sign != "!=" and not _trivial(item))
    known = list(dict.fromkeys(told))
    more = derived(known, said)
    leaves = [
        _near(part, said, thorough) if part.limit is not None else _leaf(part, known, more, said, thorough)
        for part in said.conclusions
    ]
    shown = [f"try (assert ({part.text}) by (solve [ {leaf} ]))"
             for part, leaf in zip(said.conclusions, leaves, strict=True) if part.relation is not None]  # fmt: skip
    leaves = [smoothness(part, shown) or leaf for part, leaf in zip(said.conclusions, leaves, strict=True)]
    # Coq would rename a variable that is called like a constant of its own.
    # What the others need: a sum that is not 0.
    early = [line for part, line in zip((p for p in said.conclusions if p.relation is not None), shown, strict=True)
             if part.limit is None and part.relation and part.relation.sign == "!=" and part.relation.left.is_Add
             and not part.relation.left.is_positive]  # fmt: skip
    steps = [
        *([f"intros {' '.join(said.binders)}"] if said.binders else []),
        "intros",
        "facts",
        *early,
        *integrals([part.relation for part in said.conclusions if part.relation], said.names),
    ]
    return f"{'; '.join(steps)}; pieces; [> {' | '.join(leaves)} ]"


def _tried(*hints: str) -> str:
    """Each of the tactics that proves all, one after the other; Coq says what is left."""
    return "; ".join([*(f"try (solve [ {hint} ])" for hint in hints), "leaf_or_say"])


def _near(part: Part, said: Proposition, thorough: bool) -> str:
    tries = ["near_by_sign"] if thorough else []
    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        tries.append(near(part, list(said.conclusions), said.names))
    if part.limit and part.limit.args[2] is sp.oo and (part.domain or part.limit.args[0].has(sp.log)):
        tries.append("far_away")
    return _tried(*tries)


def _trivial(relation: Relation) -> bool:
    """Whether the relation is what the symbol is declared to be."""
    return bool(relation.right == 0 and relation.left.is_Symbol and relation.left.is_positive)


def _leaf(part: Part, known: list[Relation], more: list[Derived], said: Proposition, thorough: bool) -> str:
    if part.exists is not None and thorough and (hint := _witnessed(part, known, said)):
        return _tried(hint)
    if part.relation is None or _trivial(part.relation):
        return _tried("everywhere") if thorough else _tried()
    goal = Goal(part.relation, tuple(known), said.names)
    if part.relation.sign == "=":
        return _equal(goal, said, thorough)
    tries: list[str] = []
    if more or thorough:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            tries += certificate(part.relation, known, said.names, more)
    ways = () if tries else (_by_norms, _directly, _by_logarithms)
    if thorough:
        tries += _by_steps(goal, said)
    for way in ways:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            tries += way(goal)
    powers = sp.Tuple(part.relation.left, part.relation.right).atoms(sp.Pow)
    if part.relation.sign != "!=" and any(not power.exp.is_number for power in powers):
        tries.append("by_growth")
    tries += _by_growth_of_parts(part.relation, known)
    return f"quickly; {_tried(*tries)}"


def _by_growth_of_parts(relation: Relation, known: list[Relation]) -> Iterator[str]:
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


def _witnessed(part: Part, known: list[Relation], said: Proposition) -> str:
    """The witnesses one after the other, and then the body for them."""
    values = witnesses(part.exists, known) if part.exists else None
    if part.exists is None or values is None:
        return ""
    steps: list[str] = []
    for symbol in part.exists.variables:
        positive = Goal(Relation(sp.Integer(0), "<", values[symbol]), tuple(known), said.names)
        ways = " | ".join(f"solve [ {hint} ]" for hint in _by_steps(positive, said)) or "fail"
        kinds = f"; split; [> solve [ first [ sign | {ways} ] ] | ]" * len(of_symbol(symbol, said.names[symbol]))
        steps.append(f"exists {term(values[symbol], said.names)}{kinds}")
    put = (item.relation and item.relation.map(lambda side: side.xreplace(values)) for item in part.body)
    body = [replace(item, relation=relation) for item, relation in zip(part.body, put, strict=True)]
    leaves = [_leaf(item, known, [], said, True) for item in body]
    intro = f"intros {' '.join(said.names[symbol] for symbol in part.exists.over)}; " if part.exists.over else ""
    return f"{'; '.join(steps)}; {intro}intros; facts; pieces; [> {' | '.join(leaves)} ]"


def _by_steps(goal: Goal, said: Proposition) -> Iterator[str]:
    """After what is quick; the ways of this module close what the steps leave."""
    given = (part.relation for part in said.premises if part.limit is None)
    return by_steps(goal.with_known(*(item for item in given if item is not None and item.sign == "!=")), [_directly])


def _equal(goal: Goal, said: Proposition, thorough: bool) -> str:
    """Powers of one base by each other, and angles at the ends of integrals, before anything else is tried."""
    relation = goal.relation
    atoms = Atoms.over(said.names)
    atoms.choose((relation.left, relation.right))
    try:
        relation.map(atoms)
    except NoTranslation:
        return _tried()
    powers = [line for line in atoms.lines if "power_as" in line]
    if relation.has(sp.Integral) and relation.has(sp.sin, sp.cos):
        return _tried("; ".join([*powers, "at_multiples_of_PI", "rational"]))
    quick = ["; ".join([*powers, "rational"])] if powers else []
    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        quick += by_equations(goal)
    return _tried(*quick, *(_by_steps(goal, said) if thorough else ()))


def _directly(goal: Goal) -> Iterator[str]:
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
    moved, lines = slack(facts, atoms)
    gap = sp.factor(sp.together((wanted.right - wanted.left).xreplace(moved)))
    if relation.sign == "!=":
        last = f"nonzero_as {term(sum_of_squares(-gap) or -gap, atoms.names)}"
    else:
        last = f"difference_as {term(sum_of_squares(gap) or upright(gap), atoms.names)}"
    yield "; ".join([*atoms.lines, *lines, last])
    if relation.sign == "!=" or gap.is_positive or (gap.is_nonnegative and relation.sign in ("<=", ">=")):
        return
    # Here the variables stay as they are: their bounds are facts like any other.
    gap = sp.factor(sp.together(wanted.right - wanted.left))
    if hint := _by_products(gap, facts, atoms):
        yield "; ".join([*atoms.lines, hint])


def _by_norms(goal: Goal) -> Iterator[str]:
    if goal.relation.sign != "!=" and (found := norms(goal.relation, goal.known, goal.names)) is not None:
        relation, others, lines = found
        for hint in _directly(Goal(relation, tuple(others), goal.names)):
            yield "; ".join([*lines, hint])


def _by_products(gap: sp.Expr, facts: list[Relation], atoms: Atoms) -> str:
    top, bottom = sp.fraction(gap)
    found = products(top, facts)
    if found is None:
        return ""
    steps = [f"top_of {term(top, atoms.names)} {term(bottom, atoms.names)}"]
    if found.factor != 1:
        steps.append(f"multiply_by {term(found.factor, atoms.names)}")
    steps += [f"fact_from {term(fact.bottom, atoms.names)} {term(fact.top, atoms.names)}" for fact in found.facts]
    steps += [f"product ({' * '.join(term(factor, atoms.names) for factor in factors)})" for factors in found.products]
    return "; ".join([*steps, "linear"])


def _by_logarithms(goal: Goal) -> Iterator[str]:
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
    gap = sp.factor(sp.together(wanted.right - wanted.left))
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


def slack(facts: list[Relation], atoms: Atoms) -> tuple[dict[sp.Symbol, sp.Expr], list[str]]:
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
