"""A chain of inequalities, as lines for Coq."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.hints.chains import Chain, Search, Used, directed
from ptproof.proof.kernel.hints.views import View, view
from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Relation

# What binds a symbol: nothing is put in there.
_BOUND = (sp.Derivative, sp.Integral, sp.Limit, sp.Subs)


def certificate(
    goal: Relation, known: Sequence[Relation], names: Names, more: Sequence[tuple[Relation, str]] = ()
) -> Iterator[str]:
    """The lines by which ``goal`` follows from what is known, if a chain is found.

    ``more`` follows from what is known by the line that stands with it, which comes in only where it is used.
    """
    if goal.sign not in ("<=", ">=") or goal.has(*_BOUND):
        return
    wanted = goal.standard()
    alike = [(relation, line) for relation, line in more if relation.left == wanted.left]
    same = [f"solve [ {line}; lra ]" for relation, line in alike if relation.right == wanted.right]
    same = same or [f"solve [ {line}; found_as ]" for relation, line in alike if _same(relation.right, wanted.right)]
    if same:
        yield from same
        return
    known = [item for item in known if not item.has(*_BOUND)]
    seen, facts = view(known), list(directed([*known, *(relation for relation, _ in more)]))
    derived = {seen.relation(relation): line for relation, line in more}
    inside = {seen.relation(item): item for item in facts}
    search = Search([item for item in inside if item.left != item.right])
    said = seen.relation(wanted)
    chain = search.chain(said.right - said.left)
    if chain is None:
        return
    writer = _Writer(seen, inside, derived, _names(seen, [*facts, goal], names))
    yield f"solve [ {'; '.join(writer.lines(chain, said))} ]"


def _same(first: sp.Expr, second: sp.Expr) -> bool:
    """Whether the two are the same as rational functions."""
    return bool(sp.expand(sp.fraction(sp.together(first - second))[0]) == 0)


def _names(seen: View, relations: Sequence[Relation], names: Names) -> Names:
    """Names under which the expressions of the view stand as they stood in the claim."""
    found = dict(names)
    for symbol, gap in seen.back.items():
        found[symbol] = term(gap, names)
    for relation in relations:
        for part in (p for side in (relation.left, relation.right) for p in sp.preorder_traversal(side)):
            if isinstance(part, AppliedUndef | sp.exp) or (isinstance(part, sp.Pow) and not part.exp.is_Rational):
                shown = seen.of(part)
                if shown != part:
                    found.setdefault(shown, term(part, names))
    return found


@dataclass
class _Writer:
    """Writes a chain for Coq: what is known as it stands in the claim, all else as it is in the view."""

    seen: View
    inside: dict[Relation, Relation]
    derived: dict[Relation, str]
    names: Names

    def lines(self, chain: Chain, said: Relation) -> list[str]:
        """All lines, in their order."""
        logs = dict.fromkeys(item.relation for below in chain.matched for item in below.known)
        lines = [f"try (fact {self.write(item.left)} {self.write(item.right)})" for item in self.inside.values()
                 if item.right - item.left in self.seen.back.values()]  # fmt: skip
        lines += [f"try (assert (0 < {self.write(base)}) by sign)" for base in self._sums(chain, said)]
        every = dict.fromkeys([*(item.relation for item in chain.used), *logs])
        lines += [self.derived[relation] for relation in every if relation in self.derived]
        lines += [f"fact {' '.join(self.sides(item.relation))}" for item in chain.used]
        lines += [self._log_fact(relation) for relation in logs]
        for below in chain.matched:
            lower, upper = self.write(below.lower), self.write(below.upper)
            lines.append(f"below_by_logarithms {lower} {upper} ({' + '.join(map(self._logarithm, below.known))})")
        lines.append(f"chain_as ({' + '.join(self._summands(chain))})")
        return [*lines, *self._equation(chain, said)]

    def write(self, expression: sp.Basic) -> str:
        return term(expression, self.names)

    def sides(self, relation: Relation) -> tuple[str, str]:
        """Both sides, as they stand in the claim."""
        item = self.inside.get(relation, relation)
        return self.write(item.left), self.write(item.right)

    def _log_fact(self, relation: Relation) -> str:
        low, high = self.sides(relation)
        if relation in self.inside:
            return f"log_fact {low} {high}"
        if isinstance(relation.right, sp.exp):
            return f"log_exp {high} {self.write(relation.right.args[0])}"
        return f"log_fact_as {low} {high} {self.write(sp.factor(relation.right - relation.left))}"

    def _times(self, factor: sp.Expr, text: str) -> str:
        return text if factor == 1 else f"{self.write(factor)} * {text}"

    def _logarithm(self, item: Used) -> str:
        low, high = self.sides(item.relation)
        return self._times(item.factor, f"(ln {high} - ln {low})")

    def _summands(self, chain: Chain) -> list[str]:
        found = []
        for item in chain.used:
            low, high = self.sides(item.relation)
            found.append(self._times(item.factor, f"({high} - {low})"))
        for below in chain.matched:
            low, high = self.write(below.lower), self.write(below.upper)
            found.append(self._times(below.common, f"({high} - {low})"))
        return [*found, *map(self.write, chain.left)] or ["0"]

    def _expressions(self, chain: Chain, said: Relation) -> list[sp.Expr]:
        found = [said.left, said.right, *chain.left]
        for item in chain.used:
            found += [item.factor, item.relation.left, item.relation.right]
        for below in chain.matched:
            found += [below.common, below.lower, below.upper]
        return found

    def _sums(self, chain: Chain, said: Relation) -> list[sp.Expr]:
        """Sums that are seen to be positive in the view."""
        every = (part for item in self._expressions(chain, said) for part in item.atoms(sp.Add))
        return [part for part in dict.fromkeys(every) if part.is_positive and part.free_symbols & set(self.seen.back)]

    def _equation(self, chain: Chain, said: Relation) -> list[str]:
        """That the sum is the difference: every power by one of its base, every symbol by its root."""
        expressions = self._expressions(chain, said)
        products = {part: sp.expand_power_base(part) for item in expressions for part in item.atoms(sp.Pow)
                    if part.base.is_Mul and part.base.is_positive and not part.exp.is_Rational}  # fmt: skip
        expressions += products.values()
        atoms = Atoms.over(self.names, (1, 2, 3, -1, -2))
        atoms.choose(expressions)
        for item in expressions:
            with contextlib.suppress(NoTranslation):
                atoms(item)
        powers = [line for line in atoms.lines if "power_as" in line]
        roots = {part.base for item in expressions for part in item.atoms(sp.Pow)
                 if part.base.is_Symbol and part.exp.is_Rational and part.exp.q == 2}  # fmt: skip
        found = [f"by_root {self.names[symbol]}" for symbol in sorted(roots, key=str)]
        powers = [f"try (power_as {self.write(old)} {self.write(new)})" for old, new in products.items()] + powers
        powers += list(self._exponentials(expressions))
        values = [f"put_value {self.names[symbol]}" for symbol in self.seen.equal]
        return [*(f"try ({line})" for line in values), *powers, *found, "rational"]

    def _exponentials(self, expressions: Sequence[sp.Expr]) -> Iterator[str]:
        """An exponential as a power of another one, where the one exponent is a multiple of the other."""
        found = list(dict.fromkeys(part for item in expressions for part in item.atoms(sp.exp)))
        for large, small in itertools.permutations(found, 2):
            times = sp.cancel(large.args[0] / small.args[0])
            if times.is_Integer and times > 1:
                yield f"try (power_as {self.write(large)} ({self.write(small)} ^ {times}))"
