"""Exact points at which an expression is not smooth: derivatives that jump, poles, values that are not real."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import SAYS, admissible, declared
from ptproof.proof.engines.beside import is_analytic, is_not_real, is_pole, one_sided, sign_beside
from ptproof.proof.kinks import switching
from ptproof.proof.signs import sign_of
from ptproof.proof.statement import MEANING, Relation
from ptproof.proof.substitution import Substitution, holds_at
from ptproof.proof.verdict import Witness
from ptproof.system import substitute

_OTHERS = (sp.S.Zero, sp.S.One, sp.Rational(-1, 2), sp.Rational(3, 2), sp.Integer(-2), sp.Integer(2))
_MOST = 60
_DISTANCES = (sp.Rational(1, 8), sp.Rational(1, 1024))
_NEVER = (sp.Integral, sp.Limit, sp.Sum, sp.Product)

Found = tuple[str, Witness]


def find_singularity(
    expression: sp.Expr,
    variables: Sequence[sp.Symbol],
    order: int,
    suspects: Sequence[sp.Basic],
    domain: Sequence[Relation] = (),
) -> Found | None:
    """A reason and a witness that ``expression`` is not C^order on the domain, or None where none was found.

    Along one variable, with exact values for everything else, the zeros of what the suspect nodes depend on are
    found exactly. A derivative of order up to ``order`` that differs from the left and from the right inside the
    domain, a pole that is approached within it, or a point of it at which the value is not real is a witness. All
    comparisons are certain, and all values are allowed by the declarations and by the domain.
    """
    unknown = expression.atoms(AppliedUndef)
    if expression.has(*_NEVER) or not all(map(_has_concrete, unknown)):
        return None
    plain = (applied for applied in unknown if all(isinstance(argument, sp.Symbol) for argument in applied.args))
    names = {str(applied): str(_concrete(applied)) for applied in sorted(plain, key=str)}
    here, elsewhere = _connected(expression, [*domain, *_declared_relations(variables)])
    others = _some_values(elsewhere)
    if others is None:
        return None  # what is assumed of other symbols may contradict itself
    expression = _concrete(expression).replace(sp.tan, lambda angle: sp.sin(angle) / sp.cos(angle))
    beside = [expression, *(relation.left - relation.right for relation in here)]
    for argument in (entry for suspect in suspects for entry in _arguments(_concrete(suspect))):
        for variable, values in _lines(argument, beside, variables):
            try:
                found = _on_line(argument, expression, order, variable, values, tuple(here), {**names, **others})
            except (ZeroDivisionError, ValueError):  # SymPy's answer to what is not comparable, or modulo 0
                continue
            if found is not None:
                return found
    return None


def _on_line(
    argument: sp.Expr,
    expression: sp.Expr,
    order: int,
    variable: sp.Symbol,
    values: dict[sp.Symbol, sp.Expr],
    domain: tuple[Relation, ...],
    names: dict[str, str],
) -> Found | None:
    """What is wrong at a zero of the argument in the domain, where one variable moves and the others have values."""
    for root in _roots(argument.subs(values, simultaneous=True), variable):
        place = _Place(variable, root, values, domain, names)
        if not place.is_allowed(root):
            continue
        found = place.examine(expression.subs(values, simultaneous=True), order)
        if found is not None:
            return found
    return None


def _connected(expression: sp.Expr, domain: Sequence[Relation]) -> tuple[list[Relation], list[Relation]]:
    """The relations that speak, if only through each other, of the expression's symbols, and the others."""
    reached, here, rest = set(expression.free_symbols), [], list(domain)
    while more := [relation for relation in rest if relation.free_symbols & reached]:
        here += more
        rest = [relation for relation in rest if relation not in more]
        reached |= set().union(*(relation.free_symbols for relation in more))
    return here, rest


def _some_values(relations: Sequence[Relation]) -> dict[str, str] | None:
    """Values with which all of the relations hold, as text; None where none was found."""
    symbols = sorted(set().union(*(relation.free_symbols for relation in relations)), key=lambda symbol: symbol.name)
    for values in _choices(symbols, _MOST):
        if holds_at(relations, values):
            return {str(symbol): str(value) for symbol, value in values.items()}
    return None


def _choices(symbols: Sequence[sp.Symbol], most: int) -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Values that the symbols' declarations allow, for all of them at once; none where one has none."""
    pools = [[value for value in _OTHERS if admissible(symbol, value)] for symbol in symbols]
    for values in itertools.islice(itertools.product(*pools), most):
        yield dict(zip(symbols, values, strict=True))


def _declared_relations(variables: Sequence[sp.Symbol]) -> list[Relation]:
    """The declared signs of the variables as relations."""
    said = ((symbol, sign) for symbol in variables for word, sign in SAYS.items() if declared(symbol).get(word))
    return [Relation(symbol, sign, sp.S.Zero) for symbol, sign in said]


def _has_concrete(applied: AppliedUndef) -> bool:
    """Whether the polynomial of :func:`_concrete` is of the function's declared kind."""
    return set(declared(applied)) <= {"real", *SAYS} and bool(applied.is_real)


def _concrete(expression: sp.Basic) -> sp.Basic:
    """Undefined functions become one fixed polynomial in their arguments, of their declared sign."""
    for applied in sorted(expression.atoms(AppliedUndef), key=str):
        places = [sp.Dummy(f"s{i}", real=True) for i in range(len(applied.args))]
        power = 2 if set(declared(applied)) & SAYS.keys() else 1
        polynomial = sp.Integer(2) + sum((i + 1) * place**power for i, place in enumerate(places))
        polynomial = -polynomial if applied.is_nonpositive else polynomial
        (expression,) = substitute([expression], {applied.func(*places): polynomial})
    return expression


def _arguments(node: sp.Basic) -> list[sp.Expr]:
    """The expressions whose zeros are suspicious for ``node``."""
    match node:
        case sp.Pow():
            return [node.base]
        case sp.tan() | sp.sec():
            return [sp.cos(node.args[0])]
        case sp.asin() | sp.acos():
            return [1 - node.args[0] ** 2]
    return switching(node) if node.args and isinstance(node, sp.Function | sp.Max | sp.Min) else []


def _lines(
    argument: sp.Expr, beside: Sequence[sp.Expr], variables: Sequence[sp.Symbol]
) -> Iterator[tuple[sp.Symbol, dict[sp.Symbol, sp.Expr]]]:
    """A variable to move, with exact values for all other symbols, in the argument and ``beside`` it."""
    free = argument.free_symbols.union(*(entry.free_symbols for entry in beside))
    count = 0
    for variable in variables:
        if variable not in argument.free_symbols:
            continue
        others = sorted(free - {variable}, key=lambda symbol: symbol.name)
        for values in _choices(others, 12):
            count += 1
            if count > _MOST:
                return
            yield variable, values


@functools.lru_cache(maxsize=1024)
def _roots(argument: sp.Expr, variable: sp.Symbol) -> tuple[sp.Expr, ...]:
    """A few exact real zeros; kept, since the fields of a system share what may be singular in them."""
    if variable not in argument.free_symbols:
        return ()
    while isinstance(argument, sp.Abs) or (argument.is_Pow and argument.exp.is_positive):
        argument = argument.args[0]
    try:
        numerator = sp.fraction(sp.together(argument))[0]
        if numerator.is_polynomial(variable):
            polynomial = sp.Poly(numerator, variable)
            found = list(sp.roots(polynomial)) if polynomial.degree() <= 4 else []
            found = found or polynomial.real_roots()
        else:
            found = sp.solve(numerator, variable)
    except (NotImplementedError, sp.PolynomialError, ValueError, TypeError):
        return ()
    return tuple(root for root in found if root.is_real and not root.free_symbols)[:4]


@dataclass(frozen=True)
class _Place:
    """A point on a line: ``variable`` moves through ``root``, all other symbols have the ``values``."""

    variable: sp.Symbol
    root: sp.Expr
    values: dict[sp.Symbol, sp.Expr]
    domain: tuple[Relation, ...]
    names: dict[str, str]

    def is_allowed(self, position: sp.Expr) -> bool:
        """Whether the domain certainly contains this position on the line."""
        point = {**self.values, self.variable: position}
        return holds_at(self.domain, point)

    def is_inside(self, side: int) -> bool:
        """Whether the domain certainly contains all positions close to the root, on this side of it."""
        return all(self._holds_beside(Substitution(self.values).relation(relation), side) for relation in self.domain)

    def _holds_beside(self, relation: Relation, side: int) -> bool:
        difference = relation.left - relation.right
        if self.variable in difference.free_symbols and not is_analytic(difference, self.variable, self.root):
            return False
        sign = sign_beside(difference, self.variable, self.root, side)
        return sign is not None and bool(MEANING[relation.sign](sign, 0))

    def examine(self, line: sp.Expr, order: int) -> Found | None:
        """What is wrong with the ``line`` at the root, if anything certainly is."""
        variable, root = self.variable, self.root
        point = {**self.values, variable: root}
        where = ", ".join(f"{symbol} = {value}" for symbol, value in point.items())
        names = {**self.names, **{str(symbol): str(value) for symbol, value in point.items()}}
        branches = {side: one_sided(line, variable, root, side) for side in (-1, 1)}
        for near in (root + side * distance for side in (-1, 1) for distance in _DISTANCES):
            if self.is_allowed(near) and is_not_real(value := line.subs(variable, near)):
                there = {**names, str(variable): str(near)}
                return f"no real value at {variable} = {near}", Witness(there, str(value), "real")
        for side, branch in branches.items():
            if branch is not None and self.is_inside(side) and is_pole(branch, variable, root):
                return f"unbounded near {where}", Witness(names, str(branch), "a finite value")
        left, right = branches[-1], branches[1]
        if left is None or right is None or not (self.is_inside(-1) and self.is_inside(1)):
            return None  # on the boundary there is only one side
        if not all(is_analytic(branch, variable, root) for branch in (left, right)):
            return None
        value, limit = line.subs(variable, root), left.subs(variable, root)
        if value.is_finite and sign_of(value - limit) in (-1, 1):
            return f"the value jumps at {where}", Witness(names, str(limit), str(value))
        for count in range(order + 1):
            before, after = (sp.diff(branch, variable, count).subs(variable, root) for branch in (left, right))
            if sign_of(before - after) in (-1, 1):
                what = "the value" if count == 0 else f"derivative {count} in {variable}"
                return f"{what} jumps at {where}", Witness(names, str(before), str(after))
        return None
