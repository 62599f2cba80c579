"""Exact points at which an expression is not smooth: derivatives that jump, poles, values that are not real."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import admissible
from ptproof.proof.kinks import resolved, switching
from ptproof.proof.signs import holds, sign_of
from ptproof.proof.statement import Relation
from ptproof.proof.substitution import NotOfKind, Substitution
from ptproof.proof.verdict import Witness
from ptproof.system import substitute

_OTHERS = (sp.S.Zero, sp.S.One, sp.Rational(-1, 2), sp.Rational(3, 2))
_MOST = 60
Found = tuple[str, Witness]


def find_singularity(
    expression: sp.Expr,
    variables: Sequence[sp.Symbol],
    order: int,
    suspects: Sequence[sp.Basic],
    domain: Sequence[Relation] = (),
) -> Found | None:
    """A reason and a witness that ``expression`` is not C^order, or None where none was found.

    Along one variable, with exact values for everything else, the zeros of what the suspect nodes depend on are
    found exactly. A derivative of order up to ``order`` that differs from the left and from the right, a pole, or
    a value that is not real near such a point is a witness; all comparisons are certain.
    """
    names = {str(applied): str(_concrete(applied)) for applied in sorted(_plain(expression), key=str)}
    # A relation among symbols that play no part here does not exclude a point.
    free = expression.free_symbols
    domain = [relation for relation in domain if relation.free_symbols & free]
    expression = _concrete(expression).replace(sp.tan, lambda angle: sp.sin(angle) / sp.cos(angle))
    for suspect in suspects:
        for argument in _arguments(_concrete(suspect)):
            for variable, values in _lines(argument, expression, variables):
                restricted = argument.subs(values, simultaneous=True)
                for root in _roots(restricted, variable):
                    point = {**values, variable: root}
                    if not _inside(domain, point):
                        continue
                    line = expression.subs(values, simultaneous=True)
                    found = _examine(line, variable, order, point, domain, names)
                    if found is not None:
                        return found
    return None


def _plain(expression: sp.Basic) -> set[AppliedUndef]:
    return {
        applied
        for applied in expression.atoms(AppliedUndef)
        if all(isinstance(argument, sp.Symbol) for argument in applied.args)
    }


def _concrete(expression: sp.Basic) -> sp.Basic:
    """Undefined functions become one fixed polynomial in their arguments, of their declared sign."""
    for applied in sorted(expression.atoms(AppliedUndef), key=str):
        places = [sp.Dummy(f"s{i}", real=True) for i in range(len(applied.args))]
        power = 2 if applied.is_nonnegative or applied.is_nonpositive else 1
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
    argument: sp.Expr, expression: sp.Expr, variables: Sequence[sp.Symbol]
) -> Iterator[tuple[sp.Symbol, dict[sp.Symbol, sp.Expr]]]:
    """A variable to move, with exact values for all other symbols."""
    free = argument.free_symbols | expression.free_symbols
    count = 0
    for variable in variables:
        if variable not in argument.free_symbols:
            continue
        others = sorted(free - {variable}, key=lambda symbol: symbol.name)
        choices = [[value for value in _OTHERS if admissible(symbol, value)] or [sp.S.One] for symbol in others]
        for values in itertools.islice(itertools.product(*choices), 12):
            count += 1
            if count > _MOST:
                return
            yield variable, dict(zip(others, values, strict=True))


def _roots(argument: sp.Expr, variable: sp.Symbol) -> list[sp.Expr]:
    if variable not in argument.free_symbols:
        return []
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
        return []
    return [root for root in found if root.is_real and not root.free_symbols][:4]


def _examine(
    line: sp.Expr,
    variable: sp.Symbol,
    order: int,
    point: dict[sp.Symbol, sp.Expr],
    domain: Sequence[Relation],
    names: dict[str, str],
) -> Found | None:
    root = point[variable]
    where = ", ".join(f"{symbol} = {value}" for symbol, value in point.items())
    names = {**names, **{str(symbol): str(value) for symbol, value in point.items()}}
    left, right = (_one_sided(line, variable, root, side) for side in (-1, 1))
    if left is None or right is None:
        return None
    for side, branch in ((-1, left), (1, right)):
        for near in _not_real(branch, variable, root, side):
            if _inside(domain, {**point, variable: near}):
                there = {**names, str(variable): str(near)}
                return f"no real value at {variable} = {near}", Witness(there, str(branch.subs(variable, near)), "real")
        if _is_pole(branch, variable, root):
            return f"unbounded near {where}", Witness(names, str(branch), "a finite value")
    if not _inside(list(map(_strict, domain)), point):
        return None  # on the boundary there is only one side
    value, limit = line.subs(variable, root), left.subs(variable, root)
    if value.is_finite and limit.is_finite and sign_of(value - limit) in (-1, 1):
        return f"the value jumps at {where}", Witness(names, str(limit), str(value))
    for count in range(order + 1):
        before, after = (sp.diff(branch, variable, count).subs(variable, root) for branch in (left, right))
        if any(value.has(sp.nan, sp.zoo, sp.oo, sp.AccumBounds) for value in (before, after)):
            return None
        if sign_of(before - after) in (-1, 1):
            what = "the value" if count == 0 else f"derivative {count} in {variable}"
            return f"{what} jumps at {where}", Witness(names, str(before), str(after))
    return None


def _inside(domain: Sequence[Relation], point: dict[sp.Symbol, sp.Expr]) -> bool:
    """Whether the point is certainly one that the symbols and the domain allow."""
    try:
        there = Substitution(point)
    except NotOfKind:
        return False
    return all(holds(there.relation(relation)) for relation in domain)


def _strict(relation: Relation) -> Relation:
    relation = relation.standard()
    return Relation(relation.left, "<" if relation.sign == "<=" else relation.sign, relation.right)


def _one_sided(line: sp.Expr, variable: sp.Symbol, root: sp.Expr, side: int) -> sp.Expr | None:
    """The smooth expression that ``line`` is beside ``root``, or None."""

    def sign(entry: sp.Expr) -> int | None:
        """The sign of ``entry`` on that side, from its first derivative that does not vanish at the root."""
        for count in range(5):
            value = sign_of(sp.diff(entry, variable, count).subs(variable, root))
            if value != 0:
                return None if value is None else value * side**count
        return None

    def floor_of(level: sp.Expr) -> int | None:
        """The integer part of ``level`` on that side."""
        there = level.subs(variable, root)
        if not there.is_number or sign_of(there - sp.floor(there)) not in (0, 1):
            return None
        whole = sp.floor(there)
        return int(whole) - (sign_of(there - whole) == 0 and sign(level - whole) == -1)

    branch = resolved(line, {variable}, sign, floor_of)
    return None if branch is None or branch.has(sp.nan) else branch


def _not_real(branch: sp.Expr, variable: sp.Symbol, root: sp.Expr, side: int) -> Iterator[sp.Expr]:
    """Points close to ``root`` at which the branch has certainly no real value."""
    for node in branch.atoms(sp.Pow, sp.log):
        if isinstance(node, sp.Pow) and (node.exp.is_integer or not node.exp.is_Rational):
            continue
        if variable not in node.free_symbols:
            continue
        for distance in (sp.Rational(1, 8), sp.Rational(1, 1024)):
            near = root + side * distance
            if sign_of(node.args[0].subs(variable, near)) == -1:
                yield near


def _is_pole(branch: sp.Expr, variable: sp.Symbol, root: sp.Expr) -> bool:
    """Whether the branch is a quotient whose denominator alone vanishes at ``root``."""
    numerator, denominator = sp.fraction(sp.cancel(sp.together(branch)) if branch.is_rational_function(variable) else
                                         sp.together(branch))  # fmt: skip
    if variable not in denominator.free_symbols:
        return False
    top = sign_of(numerator.subs(variable, root))
    return top in (-1, 1) and sign_of(denominator.subs(variable, root)) == 0
