"""What is not rational arithmetic, as fresh real numbers with what is known of them: the lines for Coq that do so."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import sympy as sp

from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.terms import term


@dataclass
class Atoms:
    """Turns expressions into rational ones in symbols that stand for everything else; collects how Coq follows.

    ``names`` are the identifiers of the claim's symbols and of the atoms made so far. ``lines`` are tactics, in order:
    equations between powers of one base, then one line an atom.
    """

    names: dict[sp.Basic, str]
    made: dict[sp.Basic, sp.Symbol] = field(default_factory=dict)
    powers: dict[sp.Basic, list[sp.Basic]] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    multiples: tuple[int, ...] = (1, 2, 3, -1)

    @classmethod
    def over(cls, names: Names, multiples: tuple[int, ...] = (1, 2, 3, -1)) -> Atoms:
        """Without atoms yet; one power is written by another where its exponent is one of these ``multiples``."""
        return cls(dict(names), multiples=multiples)

    def __call__(self, expression: sp.Basic) -> sp.Basic:
        if isinstance(expression, sp.Rational) or expression.is_Symbol:
            return expression
        if isinstance(expression, sp.Add | sp.Mul):
            return expression.func(*map(self, expression.args))
        if isinstance(expression, sp.Pow):
            base, exponent = expression.args
            if exponent.is_Integer:
                return self(base) ** exponent
            if exponent.is_Rational and exponent.q == 2:
                return self._atom(sp.sqrt(base)) ** exponent.p
            if base.is_positive and exponent.could_extract_minus_sign():
                return 1 / self(base ** (-exponent))
            if base.is_positive:
                return self._power(base, exponent)
        return self._atom(expression)

    def written(self, expression: sp.Basic) -> sp.Symbol:
        """A symbol for the expression that is written out again for Coq."""
        if expression.is_Symbol:
            return expression
        key = sp.Tuple(expression)
        if key not in self.made:
            self.made[key] = sp.Symbol(fresh(f"w{len(self.made)}", self.names), real=True)
            self.names[self.made[key]] = term(expression, self.names)
        return self.made[key]

    def _power(self, base: sp.Basic, exponent: sp.Basic) -> sp.Basic:
        """The power by the one chosen for its base, where the exponents differ by whole numbers."""
        for chosen in self.powers.setdefault(base, []):
            if exponent != chosen and (found := _whole(exponent, chosen, self.multiples)) is not None:
                times, rest = found
                old, new = (term(base**e, self.names) for e in (exponent, chosen))
                text = term(base, self.names)
                factors = [f"({new} ^ {times})" if times > 1 else new if times == 1 else f"(/ {new})"]
                if rest:
                    factors.append(f"({text} ^ {rest})" if rest > 0 else f"(/ ({text} ^ {-rest}))")
                line = f"try (power_as {old} ({' * '.join(factors)}))"
                if line not in self.lines:
                    self.lines.insert(0, line)
                return self._atom(base**chosen) ** times * self(base) ** rest
        if exponent not in self.powers[base]:
            self.powers[base].append(exponent)
        return self._atom(base**exponent)

    def choose(self, expressions: Iterable[sp.Basic]) -> None:
        """Choose, for every base, the powers by which the others are written with the fewest denominators."""
        found: dict[sp.Basic, set[sp.Basic]] = {}
        for expression in expressions:
            for power in expression.atoms(sp.Pow):
                base, exponent = power.args
                if base.is_positive and not (2 * exponent).is_Integer:
                    found.setdefault(base, set()).add(-exponent if exponent.could_extract_minus_sign() else exponent)
        for base, exponents in found.items():
            left = set(exponents)
            while left:
                best = min(left, key=lambda e: (self._cost(e, left), str(e)))
                self.powers.setdefault(base, []).append(best)
                left = {e for e in left if e != best and _whole(e, best, self.multiples) is None}

    def _before(self, expression: sp.Basic) -> int:
        """Where the line for an atom stands: before those of the atoms in it, which would change its text."""
        inside = tuple(f"try (atom {symbol} " for part, symbol in self.made.items() if expression.has(part))
        own = f"try (atom {self.made[expression]} "
        places = (i for i, line in enumerate(self.lines) if line.startswith(inside) and not line.startswith(own))
        return next(places, len(self.lines))

    def _atom(self, expression: sp.Basic) -> sp.Symbol:
        if expression not in self.made:
            text = term(expression, self.names)
            name = fresh(f"a{len(self.made)}", self.names)
            sign = {"positive": True} if expression.is_positive else {}
            sign = sign or ({"nonnegative": True} if expression.is_nonnegative else {})
            symbol = sp.Symbol(name, real=True, **sign)
            self.made[expression] = symbol
            self.names[symbol] = name
            self.lines.insert(self._before(expression), f"try (atom {name} {text})")
        return self.made[expression]

    def _cost(self, chosen: sp.Basic, exponents: set[sp.Basic]) -> int:
        cost = 0
        for exponent in exponents:
            found = _whole(exponent, chosen, self.multiples)
            cost += 10 if found is None else (found[0] if found[0] > 0 else 5) + (found[1] if found[1] >= 0 else 5)
        return cost


def _whole(exponent: sp.Basic, chosen: sp.Basic, multiples: tuple[int, ...]) -> tuple[int, int] | None:
    """Whole numbers with exponent = times chosen + rest."""
    for times in multiples:
        rest = sp.simplify(exponent - times * chosen)
        if rest.is_Integer and abs(rest) <= 4:
            return times, int(rest)
    return None
