"""Whether a field may be differentiated: for SymPy a jump has the derivative 0, so smoothness is shown first."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.balls.tape import METHODS, switching_part
from ptproof.errors import InputError

_WITH_POLES = (sp.log, sp.tan, sp.cot)
_WITH_ENDS = (sp.asin, sp.acos)
_TIMES = {1: "continuously differentiable", 2: "twice continuously differentiable"}


def roughness(
    expression: sp.Expr, variables: Sequence[sp.Symbol], order: int, domain: Iterable[Any] = (), *,
    covered: bool = False,
) -> str | None:  # fmt: skip
    """Why ``expression`` is not shown to be ``order`` times continuously differentiable, in words; None if it is.

    Polynomials and compositions of functions without singularities need no look. A pole at the top level is seen by
    whoever evaluates the derivative; one inside a function, as in ``atan(1/x)``, may be a jump. What is left goes to
    the engine of smoothness, on what the relations in ``domain`` leave of the space. Undefined functions stand for
    smooth ones.

    Parameters
    ----------
    covered
        Whether the caller also encloses the expression itself, with its derivatives, everywhere on the domain, and
        gives up where there is no enclosure: then only what has an enclosure beside a jump or a kink is in doubt.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> roughness(sp.exp(-(x**2)), [x], 2) is None, roughness(sp.Abs(x) ** 3, [x], 2) is None
    (True, True)
    >>> roughness(sp.sign(x) ** 2, [x], 1)
    'sign(x) is not shown to be continuously differentiable (not C^1: the value jumps at x = 0)'
    """
    suspect = (switching_part if covered else _suspect)(expression, frozenset(variables))
    if suspect is None:
        return None
    from ptproof.proof.engines.smoothness import smoothness
    from ptproof.proof.verdict import Verdict

    real = {symbol: sp.Symbol(symbol.name, real=True) for symbol in variables}
    assumed = {str(item.func): sp.oo for item in expression.atoms(AppliedUndef)}
    relations = [relation.map(lambda side: side.xreplace(real)) for relation in domain]
    found = smoothness(expression.xreplace(real), list(real.values()), order, assumed, relations)
    if found.verdict is Verdict.PROVED:
        return None
    return f"{short(suspect)} is not shown to be {_TIMES[order]} ({found.detail})"


def require_smooth(expression: sp.Expr, variables: Sequence[sp.Symbol], order: int, why: str) -> None:
    """Refuse an expression that is not shown to be C^``order``; ``why`` opens the sentence."""
    if (reason := roughness(expression, variables, order)) is not None:
        raise InputError(f"{why}: {reason}")


def _suspect(node: sp.Basic, variables: frozenset[sp.Symbol]) -> sp.Basic | None:
    """The outermost part that may jump or bend although its derivative does not show it; None if there is none."""
    if not node.free_symbols & variables or node.is_Symbol:
        return None
    if not (node.is_Add or node.is_Mul or isinstance(node, AppliedUndef)):
        known = node.is_Pow or node.func in METHODS
        ends = isinstance(node, _WITH_ENDS) or (node.is_Pow and node.base is not sp.E and not node.exp.is_Integer)
        if not known or ends or _hides_a_pole(node, variables):
            return node
    return next((found for part in node.args if (found := _suspect(part, variables)) is not None), None)


def _hides_a_pole(node: sp.Basic, variables: frozenset[sp.Symbol]) -> bool:
    """Whether a function, or a denominator, has something singular inside."""
    if node.is_Pow and node.exp.is_Integer and node.exp > 0:
        return False
    inner = (item for argument in node.args for item in sp.preorder_traversal(argument))
    return any(_is_singular(item) and item.free_symbols & variables for item in inner)


def _is_singular(node: sp.Basic) -> bool:
    if isinstance(node, _WITH_POLES):
        return True
    return bool(node.is_Pow and node.base is not sp.E and not (node.exp.is_Integer and node.exp > 0))


def short(node: Any) -> str:
    """An expression for the end of a sentence, cut where it is long."""
    text = str(node)
    return text if len(text) <= 60 else text[:57] + "..."
