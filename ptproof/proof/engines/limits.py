"""Limits by the limit theorems: rational functions by their leading terms, then sums, products and composition.

No answer is guessed: where a sign is not known, or a form is indeterminate, there is none.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof.claim import Goal, engine
from ptproof.proof.declarations import declared
from ptproof.proof.definedness import obligations
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import Relation, relations_of
from ptproof.proof.verdict import Evidence, Verdict

INFINITE = (sp.oo, -sp.oo)


@engine
def limits(goal: Goal) -> Evidence:
    """Show equalities of the form ``Limit(expression, variable, point, side) = value``."""
    found_all = {}
    for part in relations_of(goal.statement):
        if part.sign != "=" or not isinstance(part.left, sp.Limit):
            return Evidence("limits", Verdict.UNDECIDED, f"not a limit with its value: {part}")
        expression, variable, point, side = part.left.args
        if str(side) not in ("+", "-"):
            return Evidence("limits", Verdict.UNDECIDED, f"a limit from one side is needed, not {part.left}")
        found = limit_of(expression, variable, point, str(side))
        if found is None:
            return Evidence("limits", Verdict.UNDECIDED, f"no rule gives the limit in {part}")
        if not (found == part.right if {found, part.right} & {*INFINITE} else vanishes(found - part.right)):
            detail = f"the limit comes out as {found}, not {part.right}"
            return Evidence("limits", Verdict.UNDECIDED, detail, found={part.left: found})
        found_all[part.left] = found
    return Evidence("limits", Verdict.PROVED, "limit theorems, leading terms exact", found=found_all)


def limit_of(expression: sp.Expr, variable: sp.Symbol, point: sp.Expr, side: str = "+") -> sp.Expr | None:
    """The one-sided limit of ``expression`` as ``variable`` tends to ``point`` (``oo`` allowed), or None.

    >>> s = sp.Symbol("s", real=True); T = sp.Symbol("T", positive=True)
    >>> limit_of(s / (1 - s / T), s, T, "-"), limit_of(s / (1 + s / T), s, sp.oo, "-")
    (oo, T)
    """
    if expression.has(sp.Limit, sp.Sum, sp.Product):
        return None  # ``doit`` would ask SymPy for the inner one
    if not _approached(variable, point, side):
        return None
    expression = expression.doit(integrals=False)
    # One variable h that falls to 0 from above stands for every kind of approach.
    h = sp.Dummy("h", positive=True)
    if point is sp.oo:
        local = expression.subs(variable, 1 / h)
    elif point is -sp.oo:
        local = expression.subs(variable, -1 / h)
    else:
        local = expression.subs(variable, point + (h if side == "+" else -h))
    return _at_zero(local, h) if _defined_near_zero(local, h) else None


def _approached(variable: sp.Symbol, point: sp.Expr, side: str) -> bool:
    """Whether the values that the variable was declared to have come close to the point, on that side, without gaps.

    Only then is a limit over real values the one that is asked for, and what SymPy simplified on the way right.
    """
    if side not in ("+", "-"):
        return False
    signs = declared(variable)
    if not signs or not set(signs) <= {"real", "positive", "nonnegative", "finite"} or not all(signs.values()):
        return False
    if set(signs) <= {"real", "finite"}:
        return True
    return point is sp.oo or bool(point.is_positive or (point.is_nonnegative and side == "+"))


def _defined_near_zero(expression: sp.Expr, h: sp.Symbol) -> bool:
    """Whether the expression is shown to be defined and real for all h > 0 close to 0."""
    return all(
        need.settled or (need.relation is not None and not need.given and _eventually(need.relation, h))
        for need in obligations(expression)
    )


def _eventually(relation: Relation, h: sp.Symbol) -> bool:
    """Whether a relation with 0 is shown to hold for all h > 0 close to 0."""
    found = _sign_near_zero(relation.left - relation.right, h)
    if found is None:
        return False
    sign, strict = found
    if relation.sign == "!=":
        return strict
    return sign == (1 if relation.sign in (">", ">=") else -1) and (strict or relation.sign in (">=", "<="))


def _sign_near_zero(expression: sp.Expr, h: sp.Symbol) -> tuple[int, bool] | None:
    """The sign for all h > 0 close to 0, and whether the value 0 is excluded; None where it is not known."""
    weak = None
    for sign, strictly, weakly in ((1, "is_positive", "is_nonnegative"), (-1, "is_negative", "is_nonpositive")):
        if getattr(expression, strictly):
            return sign, True
        if getattr(expression, weakly):
            weak = sign, False
    # A square, say, is not negative anywhere, and near 0 it may be known to be positive.
    found = _sign_by_parts(expression, h)
    return weak if found is None else found


def _sign_by_parts(expression: sp.Expr, h: sp.Symbol) -> tuple[int, bool] | None:
    """The same from factors, powers, and limits."""
    if isinstance(expression, sp.Mul):
        found = [_sign_near_zero(factor, h) for factor in expression.args]
        if None in found:
            return None
        signs, stricts = zip(*(entry for entry in found if entry is not None), strict=True)
        return int(sp.prod(signs)), all(stricts)
    if isinstance(expression, sp.Pow) and expression.exp.is_integer:
        found_base = _sign_near_zero(expression.base, h)
        if found_base is not None and expression.exp.is_even:
            return 1, found_base[1]
        return found_base if expression.exp.is_odd else None
    if expression.is_rational_function(h) and expression.has(h):
        return _sign_of_rational(expression, h)
    value = _at_zero(expression, h)
    if value is None:
        return None
    return (1, True) if value is sp.oo or value.is_positive else (
        (-1, True) if value is -sp.oo or value.is_negative else None)  # fmt: skip


def _sign_of_rational(expression: sp.Expr, h: sp.Symbol) -> tuple[int, bool] | None:
    """The sign of the quotient of the lowest terms."""
    signs = 1
    for part in sp.fraction(sp.cancel(sp.together(expression))):
        _, first = _lowest(part, h)
        if not (first.is_positive or first.is_negative):
            return None
        signs *= 1 if first.is_positive else -1
    return signs, True


def _lowest(part: sp.Expr, h: sp.Symbol) -> tuple[int, sp.Expr]:
    """The lowest power of h in a polynomial, and its coefficient, which may vanish for some values of its symbols."""
    terms = ((power, sp.factor(coefficient)) for (power,), coefficient in sorted(sp.Poly(part, h).terms()))
    return next(((power, coefficient) for power, coefficient in terms if not coefficient.is_zero), (0, sp.S.Zero))


def _at_zero(expression: sp.Expr, h: sp.Symbol) -> sp.Expr | None:
    """The limit as h ↓ 0."""
    if not expression.has(h):
        return expression
    if expression.is_rational_function(h):
        return _rational(expression, h)
    match expression:
        case sp.Add():
            return _sum(expression, h)
        case sp.Mul():
            return _product(expression, h)
        case sp.exp():
            return _exponential(_at_zero(expression.args[0], h))
        case sp.Pow() if not expression.exp.has(h):
            if expression.exp == -1:
                return _reciprocal(_at_zero(expression.base, h))
            if expression.exp.is_negative:  # so that a base that falls to 0 is seen from its side
                return _power(_at_zero(1 / expression.base, h), -expression.exp)
            return _power(_at_zero(expression.base, h), expression.exp)
        case sp.cos() | sp.sin() | sp.tanh() | sp.atan():
            inner = _at_zero(expression.args[0], h)
            return None if inner is None or inner in INFINITE else expression.func(inner)
        case sp.log():
            inner = _at_zero(expression.args[0], h)
            if inner is None:
                return None
            return sp.oo if inner is sp.oo else sp.log(inner) if inner.is_positive else None
    return None


def _rational(expression: sp.Expr, h: sp.Symbol) -> sp.Expr | None:
    """Compare the lowest powers of h in numerator and denominator."""
    (p, a), (q, b) = (_lowest(part, h) for part in sp.fraction(sp.cancel(sp.together(expression))))
    if a.is_zero:
        return sp.S.Zero
    # A leading coefficient that may vanish leaves the order open.
    if not _nonzero(b) or (p < q and not _nonzero(a)):
        return None
    if p > q:
        return sp.S.Zero
    if p == q:
        return sp.cancel(a / b)
    ratio = sp.factor(a / b)
    return sp.oo if ratio.is_positive else -sp.oo if ratio.is_negative else None


def _reciprocal(value: sp.Expr | None) -> sp.Expr | None:
    if value is None:
        return None
    if value in INFINITE:
        return sp.S.Zero
    return 1 / value if _nonzero(value) else None


def _nonzero(value: sp.Expr) -> bool:
    return bool(value.is_nonzero or value.is_positive or value.is_negative)


def _sum(expression: sp.Expr, h: sp.Symbol) -> sp.Expr | None:
    parts = [_at_zero(argument, h) for argument in expression.args]
    if any(part is None for part in parts):
        return None
    infinite = {part for part in parts if part in INFINITE}
    if len(infinite) > 1:
        return None
    return infinite.pop() if infinite else sp.Add(*parts)


def _product(expression: sp.Expr, h: sp.Symbol) -> sp.Expr | None:
    rational = sp.Mul(*(a for a in expression.args if a.is_rational_function(h)))
    rest = [a for a in expression.args if not a.is_rational_function(h)]
    parts = [_at_zero(part, h) for part in ([rational] if rational != 1 else []) + rest]
    if any(part is None for part in parts):
        return None
    infinite = [part for part in parts if part in INFINITE]
    finite = [part for part in parts if part not in INFINITE]
    if not infinite:
        return sp.Mul(*finite)
    sign = sp.Mul(*finite, *(1 if part is sp.oo else -1 for part in infinite))
    return sp.oo if sign.is_positive else -sp.oo if sign.is_negative else None


def _exponential(inner: sp.Expr | None) -> sp.Expr | None:
    if inner is None:
        return None
    if inner is -sp.oo:
        return sp.S.Zero
    return sp.oo if inner is sp.oo else sp.exp(inner)


def _power(base: sp.Expr | None, exponent: sp.Expr) -> sp.Expr | None:
    if base is None:
        return None
    if base is sp.oo:
        return sp.oo if exponent.is_positive else sp.S.Zero if exponent.is_negative else None
    if base.is_zero:
        return sp.S.Zero if exponent.is_positive else None
    return base**exponent if base.is_positive else None
