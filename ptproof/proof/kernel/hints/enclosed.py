"""What bounds values of functions in a goal: polynomials for waves and powers, numbers where an angle has bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import sympy as sp
from mpmath import iv, mp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.circular import bounds
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.statement import Relation

_PARTS = 1000  # of 1, to which bounds are rounded
_MOST = 4
_MILLISECONDS = 500


def of_waves(goal: Goal) -> Iterator[tuple[str, list[Relation]]]:
    """For each sin and cos a line for Coq, and what holds after it."""
    sides = sp.Tuple(*(side for item in goal.relations() for side in (item.left, item.right)))
    calls = sorted(sides.atoms(sp.sin, sp.cos), key=sp.default_sort_key)
    for call in calls if len(calls) <= _MOST else ():
        (angle,) = call.args
        if angle.has(AppliedUndef, sp.Derivative) or not angle.free_symbols:
            continue
        kind = "sin" if isinstance(call, sp.sin) else "cos"
        yield f"try (bounds_of_{kind} {goal.text(angle)})", bounds(kind, call, angle)
        if angle.is_Symbol and (ends := _ends(angle, goal.known)) is not None:
            low, high = _range(kind, *ends)
            line = f"try (between_numbers {goal.text(low)} {goal.text(call)} {goal.text(high)})"
            yield line, [Relation(low, "<=", call), Relation(call, "<=", high)]


def _ends(angle: sp.Symbol, known: Sequence[Relation]) -> tuple[sp.Rational, sp.Rational] | None:
    """Numbers between which the angle is known to lie."""
    items = [item.standard() for item in known if item.sign not in ("=", "!=")]
    below = [item.left for item in items if item.right == angle and item.left.is_Rational]
    above = [item.right for item in items if item.left == angle and item.right.is_Rational]
    return (max(below), min(above)) if below and above and max(below) <= min(above) else None


def _range(kind: str, low: sp.Rational, high: sp.Rational) -> tuple[sp.Rational, sp.Rational]:
    """Between which numbers its values lie, rounded outwards."""
    found = getattr(iv, kind)(iv.mpf([iv.mpf(low.p) / low.q, iv.mpf(high.p) / high.q]))
    ends = math.floor(_PARTS * mp.mpf(found.a)), math.ceil(_PARTS * mp.mpf(found.b))
    return sp.Rational(ends[0], _PARTS), sp.Rational(ends[1], _PARTS)


def of_exponentials(goal: Goal) -> Iterator[tuple[str, list[Relation]]]:
    """For each exponential that it is above its tangent at 0."""
    sides = sp.Tuple(*(side for item in goal.relations() for side in (item.left, item.right)))
    exponents = {part.args[0] for part in sides.atoms(sp.exp)}
    upright = {-item if item.could_extract_minus_sign() else item for item in exponents}
    for exponent in sorted(upright, key=sp.default_sort_key) if len(upright) <= _MOST else ():
        if not exponent.has(AppliedUndef, sp.Derivative):
            yield f"pose proof (exp_above {goal.text(exponent)})", [Relation(1 + exponent, "<=", sp.exp(exponent))]


def of_powers(goal: Goal) -> Iterator[tuple[str, list[Relation]]]:
    """For each power of unknown exponent n, where that is seen to be at least a whole number, the power of that one."""
    sides = sp.Tuple(*(side for item in goal.relations() for side in (item.left, item.right)))
    powers = sorted((p for p in sides.atoms(sp.Pow) if p.exp.free_symbols), key=sp.default_sort_key)
    whole = (symbol for symbol in sides.free_symbols if symbol.is_integer and symbol.is_positive)
    known = (*goal.known, *(Relation(sp.S.One, "<=", symbol) for symbol in whole))

    def is_known(least: int, value: sp.Expr) -> bool:
        return needed(Relation(sp.Integer(least), "<=", value), known, _MILLISECONDS) is not None

    for power in powers if len(powers) <= _MOST else ():
        base, exponent = (power.base, -power.exp) if power.exp.could_extract_minus_sign() else power.args
        if base.is_positive and is_known(1, base):
            least = next((n for n in (4, 3, 2, 1) if is_known(n, exponent)), 0)
            line = f"try (power_at_least {goal.text(base)} {goal.text(exponent)} {least}%nat)"
            yield line, [Relation(base**least, "<=", base**exponent)]
