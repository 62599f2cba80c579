"""The tactics that are tried on a proposition, with hints that SymPy finds: Coq checks each of them or fails.

A hint is a rearrangement (a difference as a product, a variable as a bound and what is above it) or a product of what is
not negative. None of them is believed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.products import products
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import Part, Proposition
from ptproof.proof.statement import Relation


@dataclass
class Atoms:
    """Everything that is not rational arithmetic, as a symbol whose text for Coq is that of what it stands for."""

    names: dict[sp.Basic, str]
    symbols: dict[sp.Basic, sp.Symbol]

    @classmethod
    def over(cls, names: Names) -> Atoms:
        return cls(dict(names), {})

    def __call__(self, expression: sp.Basic) -> sp.Basic:
        if isinstance(expression, sp.Rational) or expression.is_Symbol:
            return expression
        if isinstance(expression, sp.Add | sp.Mul):
            return expression.func(*map(self, expression.args))
        if isinstance(expression, sp.Pow) and expression.exp.is_Integer:
            return self(expression.base) ** expression.exp
        if isinstance(expression, sp.Pow) and expression.exp.is_Rational and expression.exp.q == 2:
            return self._atom(sp.sqrt(expression.base)) ** expression.exp.p
        if isinstance(expression, sp.Pow) and expression.exp.could_extract_minus_sign() and expression.base.is_positive:
            return 1 / self._atom(expression.base ** (-expression.exp))
        return self._atom(expression)

    def _atom(self, expression: sp.Basic) -> sp.Symbol:
        if expression not in self.symbols:
            text = term(expression, self.names)
            signs = {"positive": True} if expression.is_positive else {"nonnegative": True} if expression.is_nonnegative else {}
            symbol = sp.Dummy(f"atom{len(self.symbols)}", real=True, **signs)
            self.symbols[expression] = symbol
            self.names[symbol] = text
        return self.symbols[expression]


def script(said: Proposition) -> str:
    """The tactics for the whole proposition, as one sentence for Coq."""
    atoms = Atoms.over(said.names)
    steps = [f"unfold {said.name}", "intros", "facts"]
    moved, lines = _slack(said, atoms)
    steps += lines
    known = _known(said, moved, atoms)
    leaves = [_leaf(part, moved, atoms, known) for part in said.conclusions]
    steps.append("pieces")
    plain = "leaf_or_say"
    steps.append("[> " + " | ".join(f"first [ {hint} | {plain} ]" if hint else plain for hint in leaves) + " ]")
    return "; ".join(steps)


def _slack(said: Proposition, atoms: Atoms) -> tuple[dict[sp.Symbol, sp.Expr], list[str]]:
    """Variables replaced by what they are equal to, or by a lower bound and what is above it."""
    moved: dict[sp.Symbol, sp.Expr] = {}
    lines: list[str] = []
    for part in said.premises:
        relation = part.relation
        if relation is None or relation.sign == "!=" or relation.has(AppliedUndef):
            continue
        relation = relation.standard().map(lambda side: side.xreplace(moved) if moved else side)
        gap = sp.expand(relation.right - relation.left)
        symbol = _solvable(gap, moved, relation.sign)
        if symbol is None:
            continue
        rest = symbol - gap if gap.coeff(symbol) == 1 else symbol + gap
        if rest.has(symbol):
            continue
        text = term(symbol, atoms.names)
        try:
            if relation.sign == "=":
                value = sp.together(rest) if not rest.is_Atom else rest
                lines.append(f"try (replace_by {text} {_brackets(term(value, atoms.names))})")
            else:
                slack = sp.Symbol(f"slack_{len(lines)}", **{"positive" if relation.sign == "<" else "nonnegative": True})
                atoms.names[slack] = _fresh(slack.name, atoms)
                value = rest + slack
                tactic = "above" if relation.sign == "<" else "at_least"
                lines.append(f"try ({tactic} {text} {_brackets(term(rest, atoms.names))} {atoms.names[slack]})")
        except NoTranslation:
            continue
        moved = {old: new.xreplace({symbol: value}) for old, new in moved.items()} | {symbol: value}
    return moved, lines


def _fresh(name: str, atoms: Atoms) -> str:
    taken = set(atoms.names.values())
    while name in taken:
        name += "_"
    return name


def _brackets(text: str) -> str:
    return text if text.startswith("(") or text.isidentifier() else f"({text})"


def _solvable(gap: sp.Expr, moved: dict[sp.Symbol, sp.Expr], sign: str) -> sp.Symbol | None:
    """A symbol that the gap holds once and with the factor 1 (or -1, for an equation); those without a sign first."""
    def fits(symbol: sp.Symbol) -> bool:
        factor = gap.coeff(symbol)
        return factor == 1 or (sign == "=" and factor == -1)

    found = [s for s in gap.free_symbols if s not in moved and fits(s) and not (gap - gap.coeff(s) * s).has(s)]
    return min(found, key=lambda s: (s.name.startswith("slack_"), s.is_nonnegative is True, s.name), default=None)


def _known(said: Proposition, moved: dict[sp.Symbol, sp.Expr], atoms: Atoms) -> list[Relation]:
    """What is assumed, after the replacements, as relations between rational expressions of atoms."""
    known = []
    for part in said.premises:
        if part.relation is not None and part.relation.sign != "!=":
            relation = part.relation.standard().map(lambda side: side.xreplace(moved))
            try:
                known.append(relation.map(atoms))
            except NoTranslation:
                continue
    return known


def _leaf(part: Part, moved: dict[sp.Symbol, sp.Expr], atoms: Atoms, known: list[Relation]) -> str:
    relation = part.relation
    if relation is None or relation.sign == "=":
        return ""
    try:
        gap = atoms(relation.standard().map(lambda side: side.xreplace(moved)).right) - atoms(
            relation.standard().map(lambda side: side.xreplace(moved)).left)
        if relation.sign == "!=":
            gap = -gap
        rational = sp.factor(sp.together(gap))
        text = _brackets(term(rational, atoms.names))
    except (NoTranslation, sp.PolynomialError):
        return ""
    if relation.sign == "!=":
        return f"solve [timeout 10 (nonzero_as {text})]"
    return " | ".join([f"solve [timeout 10 (difference_as {text})]", *_products(rational, relation, atoms, known)])


def _products(rational: sp.Expr, relation: Relation, atoms: Atoms, known: list[Relation]) -> Iterator[str]:
    found = products(rational, relation.sign in ("<", ">"), known)
    if found is None:
        return
    lines = []
    top, bottom = sp.fraction(rational)
    for fact in found.facts:
        lines.append(f"fact_from {_brackets(term(fact.relation_bottom, atoms.names))} {_brackets(term(fact.top, atoms.names))}")
    for product in found.products:
        factors = " * ".join(_brackets(term(factor, atoms.names)) for factor in product)
        lines.append(f"product ({factors})")
    yield f"solve [timeout 20 (top_of {_brackets(term(top, atoms.names))} {_brackets(term(bottom, atoms.names))}; {'; '.join(lines)}; linear)]"
