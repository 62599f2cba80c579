"""SymPy expressions as Python source: SymPy's own printer, with what a module has to write before its names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.str import StrPrinter

_WIDTH = 108
_KNOWN = (
    sp.Add, sp.Mul, sp.Pow, sp.Symbol, sp.Rational, AppliedUndef, sp.Derivative, sp.Integral, sp.Limit, sp.Subs,
    sp.Tuple, sp.Abs, sp.Max, sp.Min, sp.sin, sp.cos, sp.tan, sp.exp, sp.log, sp.sinh, sp.cosh, sp.tanh, sp.atan,
    sp.asin, sp.acos, sp.sign, sp.Piecewise,
)  # fmt: skip
_CONSTANTS = {sp.pi: "sp.pi", sp.E: "sp.E", sp.oo: "sp.oo", -sp.oo: "-sp.oo"}


class _Printer(StrPrinter):
    """Exact: no quotient of two numbers is left for Python to divide."""

    def _print_Rational(self, expr: sp.Rational) -> str:
        return str(expr.p) if expr.q == 1 else f"sp.Rational({expr.p}, {expr.q})"

    def parenthesize(self, item: Any, level: int, strict: bool = False) -> str:
        fraction = isinstance(item, sp.Rational) and item.q != 1
        return self._print_Rational(item) if fraction else str(super().parenthesize(item, level, strict))

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        if expr.exp.is_Rational and not expr.exp.is_Integer and abs(expr.exp) == sp.S.Half:
            root = f"sp.sqrt({self._print(expr.base)})"
            return root if expr.exp.is_positive else f"1/{root}"
        if expr.exp == -1 and expr.base.is_Integer:
            return f"sp.Rational(1, {expr.base})"
        return str(super()._print_Pow(expr, rational=False))

    def _print_Function(self, expr: sp.Function) -> str:
        prefix = "" if isinstance(expr, AppliedUndef) else "sp."
        return f"{prefix}{expr.func.__name__}({self.stringify(expr.args, ', ')})"

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        return f"sp.{super()._print_Derivative(expr)}"

    def _print_Integral(self, expr: sp.Integral) -> str:
        return f"sp.{super()._print_Integral(expr)}"

    def _print_Limit(self, expr: sp.Limit) -> str:
        body, variable, target, side = expr.args
        return f"sp.Limit({', '.join(map(self._print, (body, variable, target)))}, dir='{side}')"

    def _print_Subs(self, expr: sp.Subs) -> str:
        body, variables, point = expr.args
        return f"sp.Subs({', '.join(map(self._print, (body, variables, point)))})"

    def _print_constant(self, expr: sp.Expr) -> str:
        return _CONSTANTS[expr]

    _print_Exp1 = _print_Pi = _print_Infinity = _print_NegativeInfinity = _print_constant
    _print_Abs = _print_Max = _print_Min = _print_Piecewise = _print_Function
    _print_LatticeOp = _print_Function


def can_be_written(expression: sp.Expr) -> bool:
    """Whether :func:`python` knows everything that occurs."""
    return all(
        isinstance(node, _KNOWN) or node in _CONSTANTS or node.is_Boolean or node.is_Relational
        if isinstance(node, sp.Expr) else True
        for node in sp.preorder_traversal(expression)
    )  # fmt: skip


def python(expression: Any) -> str:
    """The expression as Python in which ``sp`` is SymPy and every letter and function a name of its own.

    >>> x, y = sp.symbols("x y", real=True)
    >>> python(sp.sqrt(x) * y / 3 + sp.Rational(1, 2)), python(x ** sp.Rational(3, 2)), python(2 ** sp.Rational(1, 3))
    ('sp.sqrt(x)*y/3 + sp.Rational(1, 2)', 'x**sp.Rational(3, 2)', '2**sp.Rational(1, 3)')
    """
    return str(_Printer({"order": None}).doprint(expression))


def laid_out(head: str, sides: Sequence[Any], indent: int = 0) -> str:
    """``head(side, side)`` on one line where it fits, or a side a line, a sum term by term where it is long."""
    space = " " * indent
    one = f"{space}{head}({', '.join(map(python, sides))})"
    if len(one) <= _WIDTH:
        return one
    inner = " " * (indent + 4)
    lines = [line for side in sides for line in _lines(side, inner)]
    return "\n".join([f"{space}{head}(", *lines, f"{space})"])


def _lines(side: Any, space: str) -> list[str]:
    one = f"{space}{python(side)},"
    if len(one) <= _WIDTH or not isinstance(side, sp.Add):
        return [one]
    terms = [python(term) for term in side.as_ordered_terms()]
    first, *rest = (term if i == 0 or term.startswith("-") else f"+ {term}" for i, term in enumerate(terms))
    signed = [f"- {term[1:]}" if term.startswith("-") else term for term in rest]
    return [f"{space}{first}", *(f"{space}{term}" for term in signed[:-1]), f"{space}{signed[-1]},"]
