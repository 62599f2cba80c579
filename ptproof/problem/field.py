"""The signal field with its source, and the constants that bound it.

A field F with source x* satisfies, for one positive integer κ and every x of its domain,

    F(x*) − a₁‖x − x*‖^(2κ)  ≤  F(x)  ≤  F(x*) − a₂‖x − x*‖^(2κ),
    b₁‖x − x*‖^(2κ−1)  ≤  ‖∇F(x)‖  ≤  b₂‖x − x*‖^(2κ−1)

(eq:assumption2, eq:assumption3). :class:`FieldBounds` holds the constants, :class:`Field` the field itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.problem.smooth import short
from ptproof.proof.signs import sign_of
from ptproof.system import gradient

# At 1000 a field is flat to within 1e-300 over half of its unit ball: no double tells it from a constant.
LARGEST_ORDER = 1000


@dataclass(frozen=True)
class FieldBounds:
    """The constants of eq:assumption2 and eq:assumption3, and what the convergence analysis makes of them.

    Parameters
    ----------
    kappa
        κ: a positive integer, or a symbol declared as positive integer.
    a1, a2
        The largest and the smallest (F(x*) − F(x))/‖x − x*‖^(2κ): exact positive numbers or positive symbols.
    b1, b2
        The smallest and the largest ‖∇F(x)‖/‖x − x*‖^(2κ−1), likewise.

    Raises
    ------
    InputError
        If a constant is not exact or not positive, κ is not a positive integer, or a₂ > a₁ or b₁ > b₂.

    Examples
    --------
    >>> FieldBounds(2, 3, 1, 4, 5).q
    3/4
    """

    kappa: sp.Expr
    a1: sp.Expr
    a2: sp.Expr
    b1: sp.Expr
    b2: sp.Expr

    def __post_init__(self) -> None:
        kappa = _exact(self.kappa, "kappa")
        if not (kappa.is_integer and kappa.is_positive):
            raise InputError(f"kappa must be a positive integer or a symbol declared as one, not {short(kappa)}")
        object.__setattr__(self, "kappa", kappa)
        for name in ("a1", "a2", "b1", "b2"):
            value = _exact(getattr(self, name), name)
            if sign_of(value) != 1:
                raise InputError(f"{name} must be a positive number or a positive symbol, not {short(value)}")
            object.__setattr__(self, name, value)
        if sign_of(self.a2 - self.a1) == 1:
            raise InputError(f"a2 must not exceed a1, but a2 = {short(self.a2)} and a1 = {short(self.a1)}")
        if sign_of(self.b1 - self.b2) == 1:
            raise InputError(f"b1 must not exceed b2, but b1 = {short(self.b1)} and b2 = {short(self.b2)}")

    @property
    def q(self) -> sp.Expr:
        """The exponent q = (2κ − 1)/(2κ), in [1/2, 1)."""
        return (2 * self.kappa - 1) / (2 * self.kappa)

    @property
    def sigma(self) -> sp.Expr:
        """The exponent σ = 2q − 1 = (κ − 1)/κ, in [0, 1)."""
        return (self.kappa - 1) / self.kappa

    @property
    def c1(self) -> sp.Expr:
        """c₁ = b₁/a₁^q, the smaller factor between ‖∇F‖ and V^q, V = F(x*) − F(x) (eq:ass4)."""
        return self.b1 / self.a1**self.q

    @property
    def c2(self) -> sp.Expr:
        """c₂ = b₂/a₂^q, the larger factor between ‖∇F‖ and V^q (eq:ass4)."""
        return self.b2 / self.a2**self.q


@dataclass(frozen=True)
class Field:
    """A signal field F with its source x* and the order κ with which it falls off around it.

    Parameters
    ----------
    variables
        n ≥ 1 distinct symbols, declared real or not declared at all.
    expression
        F, a formula in these variables and nothing else that is free.
    source
        The n exact coordinates of x*.
    kappa
        κ: a positive integer, 1000 at most.

    Raises
    ------
    InputError
        If the lengths differ, a coordinate is not an exact real number, F has other symbols or undefined functions
        or is not defined at the source, a variable is declared positive or the like, or κ is not a positive
        integer or above 1000. That x* is a maximum is not checked here but proved by
        :func:`ptproof.certify.certify_field`.

    Examples
    --------
    >>> x, y = sp.symbols("x y", real=True)
    >>> hill = Field((x, y), 3 - x**2 - (y - 1) ** 2, (0, 1), 1)
    >>> hill.peak, hill.gradient.T
    (3, Matrix([[-2*x, 2 - 2*y]]))
    """

    variables: tuple[sp.Symbol, ...]
    expression: sp.Expr
    source: tuple[sp.Expr, ...]
    kappa: int

    def __post_init__(self) -> None:
        variables = tuple(self.variables)
        if not variables or not all(isinstance(item, sp.Symbol) for item in variables):
            raise InputError("field.variables: expected at least one variable, and each must be a symbol")
        if len({item.name for item in variables}) != len(variables):
            raise InputError("field.variables: must be distinct")
        for item in variables:
            if not item.assumptions0.items() <= _REAL.items():
                raise InputError(
                    f"field.variables: {item} is declared to be more than real, but a coordinate takes every real value"
                )
        source = tuple(_exact(item, "field.source") for item in self.source)
        if len(source) != len(variables):
            raise InputError(
                f"field.source: {len(source)} coordinates for {len(variables)} variables; give one for each"
            )
        for item in source:
            if item.free_symbols or not (item.is_real and item.is_finite):
                raise InputError(f"field.source: the coordinates must be real numbers, not {short(item)}")
        kappa = _exact(self.kappa, "field.kappa")
        if not (isinstance(kappa, sp.Integer) and kappa > 0):
            raise InputError(f"field.kappa: must be a positive integer, not {short(kappa)}")
        if kappa > LARGEST_ORDER:
            raise InputError(
                f"field.kappa: orders above {LARGEST_ORDER} are not computed with, and {short(kappa)} is one"
            )
        expression = _exact(self.expression, "field.expression")
        _check_expression(expression, variables)
        object.__setattr__(self, "variables", variables)
        object.__setattr__(self, "expression", expression)
        object.__setattr__(self, "source", source)
        object.__setattr__(self, "kappa", int(kappa))
        peak = self.peak
        if peak.has(sp.zoo, sp.nan, sp.oo, -sp.oo) or peak.is_real is False:
            raise InputError(
                f"field.expression at field.source: the field has no finite real value there, it is {short(peak)}"
            )

    @property
    def dimension(self) -> int:
        """The number n of variables."""
        return len(self.variables)

    @cached_property
    def gradient(self) -> sp.ImmutableDenseMatrix:
        """∇F as a column (n × 1)."""
        return gradient(self.expression, self.variables)

    @cached_property
    def hessian(self) -> sp.ImmutableDenseMatrix:
        """The matrix of second partial derivatives of F (n × n)."""
        return sp.ImmutableDenseMatrix(sp.hessian(self.expression, self.variables))

    @cached_property
    def hessian_at_source(self) -> sp.ImmutableDenseMatrix:
        """The Hessian of F at the source (n × n, exact)."""
        return sp.ImmutableDenseMatrix(self.hessian.subs(self._at(self.source), simultaneous=True))

    @cached_property
    def peak(self) -> sp.Expr:
        """F(x*), exact."""
        return self.value(self.source)

    def value(self, x: Sequence[Any] | Mapping[sp.Symbol, Any]) -> sp.Expr:
        """F at ``x``: n coordinates, or a mapping from variable to coordinate."""
        return self.expression.subs(x if isinstance(x, Mapping) else self._at(x), simultaneous=True)

    def _at(self, x: Sequence[Any]) -> dict[sp.Symbol, sp.Expr]:
        return dict(zip(self.variables, map(sp.sympify, x), strict=True))


_REAL = sp.Symbol("x", real=True).assumptions0
_UNFINISHED = (sp.Derivative, sp.Subs, sp.Integral, sp.Limit, sp.Sum, sp.Product)


def _check_expression(expression: sp.Expr, variables: Sequence[sp.Symbol]) -> None:
    """Refuse what is no formula in the variables alone."""
    if unknown := expression.free_symbols - set(variables):
        names = ", ".join(sorted(str(symbol) for symbol in unknown))
        text = f"field.expression: contains {names}, which is not among the variables"
        if twins := sorted({symbol.name for symbol in unknown} & {item.name for item in variables}):
            text += f"; the symbol {twins[0]} of the expression is declared otherwise than the variable {twins[0]}"
        raise InputError(text)
    if undefined := expression.atoms(AppliedUndef):
        names = ", ".join(sorted(map(str, undefined)))
        raise InputError(f"field.expression: contains the undefined function {names}; put a formula in its place")
    if expression.has(sp.I, *_UNFINISHED):
        found = next((item for item in sp.preorder_traversal(expression) if isinstance(item, _UNFINISHED)), None)
        what = "the imaginary unit" if found is None else f"an unevaluated {type(found).__name__}, {short(found)}"
        raise InputError(f"field.expression: must be a real formula without {what}")


def _exact(value: Any, name: str) -> sp.Expr:
    if isinstance(value, bool | float | str):
        raise InputError(f"{name} must be exact, not {value!r}: give an integer, a fraction or an expression")
    try:
        expression = sp.sympify(value)
    except (sp.SympifyError, TypeError, AttributeError):
        raise InputError(f"{name} must be a number or an expression, not {value!r}") from None
    if not isinstance(expression, sp.Expr) or expression.has(sp.Float):
        raise InputError(f"{name} must be exact, not {short(expression)}: give a fraction")
    if expression.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        raise InputError(f"{name} must be finite, not {short(expression)}")
    return expression
