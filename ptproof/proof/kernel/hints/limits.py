"""Hints for limits: every place is approached as 0 from the right, where the function is a simpler one."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.terms import NoTranslation, positive_base, term
from ptproof.proof.statement import Relation


class _Place:
    """A variable that tends to a place, replaced by a distance d > 0 or by 1/d, with what that makes of expressions."""

    def __init__(self, limit: sp.Limit, names: Names) -> None:
        _, self.variable, place, side = limit.args
        self.atoms = Atoms.over(names)
        self.name = fresh("d", self.atoms.names)
        self.d = sp.Symbol(self.name, positive=True)
        self.atoms.names[self.d] = self.name
        if place is sp.oo:
            self.moved: sp.Expr = 1 / self.d
        elif str(side) in ("-", "+") and place.is_finite is not False:
            self.moved = self.atoms(place) + (self.d if str(side) == "+" else -self.d)
        else:
            raise NoTranslation("no hint for a limit at this place")
        self.decaying: dict[sp.Symbol, sp.Expr] = {}
        self.falling: dict[sp.Basic, sp.Expr] = {}
        self.bases: list[sp.Expr] = []
        self.falls: list[str] = []

    def there(self, expression: sp.Basic) -> sp.Expr:
        """The expression in d, rational in d, in what does not move, and in exponentials."""
        if not expression.has(self.variable):
            return self.atoms(expression)
        if expression == self.variable:
            return self.moved
        if isinstance(expression, sp.Add | sp.Mul):
            return expression.func(*map(self.there, expression.args))
        if isinstance(expression, sp.Pow) and expression.exp.is_Integer:
            return self.there(expression.base) ** expression.exp
        if isinstance(expression, sp.exp):
            return self._exponential(self.there(expression.args[0]))
        if isinstance(expression, sp.Pow) and not expression.exp.has(self.variable):
            return self._power(expression)
        raise NoTranslation("no hint for the limit of such a function")

    def _exponential(self, argument: sp.Expr) -> sp.Expr:
        speed = self.positive(-argument)
        if speed in self.decaying.values():
            return next(symbol for symbol, known in self.decaying.items() if known == speed)
        text = term(speed, self.atoms.names)
        symbol = sp.Symbol(fresh(f"e{len(self.decaying)}", self.atoms.names), positive=True)
        self.atoms.names[symbol] = f"(exp (- {text}))"
        self.decaying[symbol] = speed
        return symbol

    def _power(self, power: sp.Pow) -> sp.Expr:
        """A symbol for what tends to 0: the power, or one divided by it. How it does is a line for Coq."""
        if power not in self.falling:
            base = self.positive(self.there(power.base))
            ends = [part.subs(self.d, 0) == 0 for part in sp.fraction(base)]
            where, inverse = self.function(base), self.function(self.positive(1 / base))
            below = positive_base(power) and power.exp.is_negative
            exponent = -power.exp if below else power.exp
            written = term(exponent, self.atoms.names)
            text = f"({'Rpower' if positive_base(power) else 'rpow'} {term(base, self.atoms.names)} {written})"
            if ends == [False, True] and positive_base(power) and exponent.is_positive:
                self.falls.append(f"falls_by_root {where} {inverse} {written} {self.name}")
                text = f"(/ {text})"
            elif ends == [False, True] and not positive_base(power) and exponent.is_negative:
                opposite = term(-exponent, self.atoms.names)
                self.falls.append(f"falls_in_base {where} {inverse} {written} {opposite} {self.name}")
            elif ends == [True, False] and not positive_base(power) and exponent.is_positive:
                self.falls.append(f"falls_with_base {where} {written} {self.name}")
            else:
                raise NoTranslation("no hint for the limit of such a power")
            symbol = sp.Symbol(fresh(f"p{len(self.falling)}", self.atoms.names), positive=True)
            self.atoms.names[symbol] = text
            grows = positive_base(power) and not below
            self.falling[power] = 1 / symbol if grows else symbol
            self.bases.append(base)
        return self.falling[power]

    def positive(self, expression: sp.Expr) -> sp.Expr:
        """As a product of factors, each with the sign that makes it positive close to 0, where that is plain."""
        product: sp.Expr = sp.Integer(1)
        for part, power in zip(sp.fraction(sp.factor(sp.together(expression))), (1, -1), strict=True):
            constant, factors = sp.factor_list(part)
            product *= constant**power
            for factor, times in factors:
                if factor.subs(self.d, 0).could_extract_minus_sign():
                    factor, product = sp.expand(-factor), product * (-1) ** times
                product *= factor ** (power * times)
        return product

    def function(self, expression: sp.Expr) -> str:
        return f"(fun {self.name} => {term(expression, self.atoms.names)})"

    def factors(self, expressions: Iterable[sp.Expr]) -> list[str]:
        """Lines that show what is above and below in the expressions to be different from 0 near 0."""
        found: dict[sp.Expr, None] = {}
        for expression in expressions:
            for part in sp.fraction(sp.factor(sp.together(expression))):
                for factor, _ in sp.factor_list(part)[1]:
                    if factor.subs(self.d, 0).could_extract_minus_sign():
                        factor = sp.expand(-factor)
                    if factor.has(self.d) and factor != self.d and factor.subs(self.d, 0) != 0:
                        found[factor] = None
        return [f"try (right_factor {self.function(factor)})" for factor in found]


def near(part: Part, group: list[Part], names: Names) -> str:
    """The tactics for one part of a limit: a function that is followed, or what is defined near the place.

    Raises
    ------
    NoTranslation
        If there is no hint for it.
    """
    said = part.base if part.relation is None else part.relation.left
    if part.limit is None or said is None:
        raise NoTranslation("no hint for this part of a limit")
    place = _Place(part.limit, names)
    followed: list[sp.Expr] = [
        place.there(other.relation.left) for other in group if other.relation is not None and other.limit == part.limit
    ]
    lines = place.factors([*followed, *place.decaying.values(), *place.bases])
    if part.relation is not None and not part.domain:
        return _followed(part.relation, place, lines)
    form = term(place.positive(place.there(said)), place.atoms.names)
    if part.relation is None:
        last = f"base_as {form}"
    else:
        last = f"first [ sign | {'nonzero_as' if part.relation.sign == '!=' else 'positive_as'} {form} ]"
    return "; ".join([*place.atoms.lines, "near_right_of_0", *lines, f"right_at {place.name}", last])


def _followed(relation: Relation, place: _Place, lines: list[str]) -> str:
    form = place.positive(place.there(relation.left))
    first = "; ".join([*lines, f"{'same_powers_at' if place.falling else 'same_at'} {place.name}"])
    if relation.right is sp.oo:
        rest = [f"grows {place.function(place.positive(1 / form))} {place.name}"]
    else:
        rest = [f"decays {place.function(argument)} {place.function(place.positive(1 / argument))} {place.name}"
                for argument in place.decaying.values()]  # fmt: skip
        rest += [*place.falls, "tends"]
    last = "; ".join([*lines, *rest])
    return "; ".join([*place.atoms.lines, f"limit_at {place.function(form)}; [ {first} | {last} ]"])
