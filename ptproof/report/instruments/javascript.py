"""Expressions as JavaScript on floats: each node has an exact counterpart, or the expression is refused.

SymPy's own printer of JavaScript lets through what JavaScript has not, or has with another meaning: ``%`` takes the
sign of the dividend, chains of comparisons compare truth values, and what is unknown to it becomes a call of a function
that nobody has; what is divided by 0 is infinite to it, and 1 over that is 0. Here it is NaN, and a comparison is 1, 0,
or NaN where a side is not defined or too large for a float.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from typing import Any

import sympy as sp
from sympy.printing.jscode import JavascriptCodePrinter

from ptproof.errors import InputError

_SAME = {
    "Abs": "Math.abs", "sign": "Math.sign", "floor": "Math.floor", "ceiling": "Math.ceil", 
    "exp": "Math.exp", "sin": "Math.sin", "cos": "Math.cos", "tan": "Math.tan", "asin": "Math.asin",
    "acos": "Math.acos", "atan": "Math.atan", "atan2": "atan2", "sinh": "Math.sinh", "cosh": "Math.cosh",
    "tanh": "Math.tanh", "asinh": "Math.asinh", "acosh": "Math.acosh", "atanh": "Math.atanh",
}  # fmt: skip
_COMPARISONS = {
    sp.StrictLessThan: "lt", sp.LessThan: "le", sp.StrictGreaterThan: "gt", sp.GreaterThan: "ge", sp.Equality: "same",
    sp.Unequality: "differ",
}  # fmt: skip
# What the printed code calls. A comparison, and what is made of comparisons, is 1, 0 or NaN, which is "not known".
HELPERS = """\
const known = (a, b) => Number.isFinite(a) && Number.isFinite(b);
const lt = (a, b) => known(a, b) ? +(a < b) : NaN, le = (a, b) => known(a, b) ? +(a <= b) : NaN;
const gt = (a, b) => lt(b, a), ge = (a, b) => le(b, a);
const same = (a, b) => known(a, b) ? +(a === b) : NaN, not = (a) => 1 - a, differ = (a, b) => not(same(a, b));
const and = (...all) => all.includes(0) ? 0 : all.every((a) => a === 1) ? 1 : NaN;
const or = (...all) => all.includes(1) ? 1 : all.every((a) => a === 0) ? 0 : NaN;
const pick = (chosen, a, b) => chosen === 1 ? a : chosen === 0 ? b : NaN;
const div = (a, b) => b === 0 ? NaN : a / b, power = (a, b) => a === 0 && b < 0 ? NaN : Math.pow(a, b);
const log = (a) => a > 0 ? Math.log(a) : NaN;
const atan2 = (a, b) => a === 0 && b === 0 ? NaN : Math.atan2(a, b);
const mod = (a, b) => { const r = a % b; return r !== 0 && (r < 0) !== (b < 0) ? r + b : r; };
"""


class _Printer(JavascriptCodePrinter):
    """SymPy's printer, which meets nothing but what has a method here, or is a sum."""

    def __init__(self, names: Mapping[sp.Symbol, str]) -> None:
        super().__init__()
        self.names = names

    def _print(self, expr: Any, **settings: Any) -> str:
        # By SymPy's own classes: somebody else's function of the same name is another one.
        for kind in (base.__name__ for base in type(expr).__mro__ if (base.__module__ or "").startswith("sympy.")):
            if (own := getattr(self, f"own_{kind}", None)) is not None:
                return str(own(expr))
            if kind in _SAME:
                return f"{_SAME[kind]}({self._all(expr.args)})"
        if isinstance(expr, sp.Add):
            return str(super()._print(expr, **settings))
        raise InputError(f"{expr} has no exact counterpart in JavaScript ({type(expr).__name__})")

    def _all(self, parts: Sequence[Any]) -> str:
        return ", ".join(map(self._print, parts))

    def own_Symbol(self, expr: sp.Symbol) -> str:
        if expr not in self.names:
            raise InputError(f"{expr} has no value in JavaScript")
        return self.names[expr]

    def own_Number(self, expr: sp.Number) -> str:
        return _float(expr)

    own_NumberSymbol = own_Number

    def own_Infinity(self, expr: sp.Expr) -> str:
        return "Infinity"

    def own_NegativeInfinity(self, expr: sp.Expr) -> str:
        return "(-Infinity)"

    def own_NaN(self, expr: sp.Expr) -> str:
        raise InputError("an expression that is nowhere defined has no counterpart in JavaScript")

    def own_Pow(self, expr: sp.Pow) -> str:
        base, exponent = expr.base, expr.exp
        if exponent.is_Number and exponent.is_negative:
            return f"div(1, {self._print(sp.Pow(base, -exponent))})"
        if exponent == sp.Rational(1, 2):
            return f"Math.sqrt({self._print(base)})"
        call = "Math.pow" if exponent.is_nonnegative else "power"
        return f"{call}({self._print(base)}, {self._print(exponent)})"

    def own_Mul(self, expr: sp.Mul) -> str:
        below = [item for item in expr.args if item.is_Pow and item.exp.is_Number and item.exp.is_negative]
        if not below:
            return str(super()._print_Mul(expr))
        above = sp.Mul(*(item for item in expr.args if item not in below))
        return f"div({self._print(above)}, {self._print(sp.Mul(*(1 / item for item in below)))})"

    def own_log(self, expr: sp.Expr) -> str:
        if len(expr.args) != 1:
            raise InputError(f"{expr} has no exact counterpart in JavaScript (a logarithm to another base)")
        return f"log({self._print(expr.args[0])})"

    def own_Mod(self, expr: sp.Expr) -> str:
        return f"mod({self._all(expr.args)})"

    def own_Max(self, expr: sp.Expr) -> str:
        return f"Math.max({self._all(expr.args)})"

    def own_Min(self, expr: sp.Expr) -> str:
        return f"Math.min({self._all(expr.args)})"

    def own_Heaviside(self, expr: sp.Expr) -> str:
        at, middle = map(self._print, expr.args)
        return f"pick(gt({at}, 0), 1, pick(lt({at}, 0), 0, {middle}))"

    def own_Piecewise(self, expr: sp.Piecewise) -> str:
        found = "NaN"
        for value, chosen in reversed(expr.args):
            shown = self._print(value)
            found = shown if chosen == sp.true else f"pick({self._print(chosen)}, {shown}, {found})"
        return found

    def own_Relational(self, expr: Any) -> str:
        return f"{_COMPARISONS[type(expr)]}({self._all(expr.args)})"

    def own_And(self, expr: Any) -> str:
        return f"and({self._all(expr.args)})"

    def own_Or(self, expr: Any) -> str:
        return f"or({self._all(expr.args)})"

    def own_Not(self, expr: Any) -> str:
        return f"not({self._print(expr.args[0])})"

    def own_BooleanTrue(self, expr: Any) -> str:
        return "1"

    def own_BooleanFalse(self, expr: Any) -> str:
        return "0"


def _float(number: sp.Expr) -> str:
    """The float next to a number; a negative one in parentheses."""
    value = float(number)
    if not abs(value) < float("inf") or (value == 0) != (number == 0):
        raise InputError(f"{number} is too large or too small for a float of JavaScript")
    text = repr(value)
    return f"({text})" if value < 0 else text


def _letters() -> Iterator[sp.Symbol]:
    """Letters that nobody has, whose order is that of their making, in every run."""
    return (sp.Dummy(f"c{place:06}") for place in count())


def _tamed(source: sp.Basic) -> sp.Basic:
    """The expression with products of exponentials as one: the factors alone would leave the range of floats."""

    def joined(product: sp.Expr) -> sp.Expr:
        exponents = [factor.args[0] for factor in product.args if isinstance(factor, sp.exp)]
        others = [factor for factor in product.args if not isinstance(factor, sp.exp)]
        return sp.Mul(*others, sp.exp(sp.Add(*exponents)))

    return sp.sympify(source).replace(lambda node: isinstance(node, sp.Mul), joined)


def expression(source: sp.Basic, names: Mapping[sp.Symbol, str]) -> str:
    """One expression, its symbols under these names.

    Raises
    ------
    InputError
        For what has no exact counterpart, naming it, and for a symbol without a name.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> expression(x ** sp.Rational(1, 3) + sp.Mod(x, 2), {x: "v"})
    'Math.pow(v, 0.3333333333333333) + mod(v, 2.0)'
    """
    return _Printer(names)._print(sp.sympify(source))


def function(sources: Sequence[sp.Basic], arguments: Mapping[str, Sequence[sp.Symbol] | sp.Symbol]) -> str:
    """A function from ``arguments`` to an array of the values, with what the expressions share computed once.

    An argument that stands for several symbols is an array.

    Examples
    --------
    >>> x, y = sp.symbols("x y", real=True)
    >>> function([x + y, sp.sqrt(x + y)], {"s": [x, y]})
    '(s) => { const c0 = s[0] + s[1]; return [c0, Math.sqrt(c0)]; }'
    """
    names: dict[sp.Symbol, str] = {}
    for name, symbols in arguments.items():
        if isinstance(symbols, sp.Symbol):
            names[symbols] = name
        else:
            names |= {symbol: f"{name}[{place}]" for place, symbol in enumerate(symbols)}
    for source in sources:  # what is wrong is named as it was written
        expression(source, names)
    shared, reduced = sp.cse(list(map(_tamed, sources)), symbols=_letters())
    lines = []
    for place, (symbol, value) in enumerate(shared):
        lines.append(f"const c{place} = {expression(value, names)}; ")
        names[symbol] = f"c{place}"
    values = ", ".join(expression(item, names) for item in reduced)
    return f"({', '.join(arguments)}) => {{ {''.join(lines)}return [{values}]; }}"
