"""Whether an assumption "for all …" holds for concrete functions, on a grid of its bound variables."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.kinds import fits_kind, holds
from ptproof.proof.attack.numbers import NotReal, Number, Undefined
from ptproof.proof.attack.scope import Scope
from ptproof.proof.statement import ForAll, Relation

_SHARES = tuple(Fraction(k, 6) for k in range(7))
_OFFSETS = tuple(Fraction(text) for text in ("0", "1/100", "1/3", "1", "3", "10", "100", "100000", "100000000"))
_PLACES = tuple(Fraction(text) for text in ("-10", "-1", "-1/3", "0", "1/7", "1", "5"))


def satisfied(items: Iterable[ForAll], evaluator: Evaluator, *, dense: bool) -> bool:
    """Whether each of the assumptions holds at every place of a grid; raises where that cannot be told."""
    return all(_holds(item, evaluator, dense) for item in items)


def _holds(item: ForAll, evaluator: Evaluator, dense: bool) -> bool:
    axes = [_axis(variable, item.domain, evaluator, dense) for variable in item.variables]
    for place in itertools.islice(itertools.product(*axes), 400):
        scope = evaluator.point.with_values(dict(zip(item.variables, place, strict=True)))
        if not all(_inside(part, evaluator, scope) for part in item.domain):
            continue
        for part in item.relation.components():
            if not holds(part, evaluator, scope):
                return False
    return True


def _inside(part: Relation, evaluator: Evaluator, scope: Scope) -> bool:
    try:
        return holds(part, evaluator, scope)
    except (Undefined, NotReal):
        return False


def _axis(variable: Any, domain: Iterable[Relation], evaluator: Evaluator, dense: bool) -> list[Number]:
    """Places of one bound variable between the ends that the domain gives it."""
    numbers = evaluator.calculus.numbers
    low: Number | None = None
    high: Number | None = None
    for part in domain:
        for one, other, sign in ((part.left, part.right, part.sign), (part.right, part.left, _turned(part.sign))):
            if one != variable or other.has(variable):
                continue
            end = evaluator.number(other, evaluator.point)
            if sign in (">=", ">") and (low is None or numbers.sign(numbers.sub(end, low)) > 0):
                low = end
            if sign in ("<=", "<") and (high is None or numbers.sign(numbers.sub(end, high)) < 0):
                high = end
    if low is not None and high is not None:
        width = numbers.sub(high, low)
        shares = tuple(Fraction(k, 40) for k in range(41)) if dense else _SHARES
        found = [numbers.add([low, numbers.mul(width, share)]) for share in shares]
    elif low is not None:
        found = [numbers.add([low, offset]) for offset in _more(_OFFSETS, dense)]
    elif high is not None:
        found = [numbers.sub(high, offset) for offset in _more(_OFFSETS, dense)]
    else:
        found = list(_more(_PLACES, dense))
    return [value for value in found if not isinstance(value, Fraction) or fits_kind(variable, value)]


def _more(places: tuple[Fraction, ...], dense: bool) -> tuple[Fraction, ...]:
    if not dense:
        return places
    return tuple(
        sorted({*places, *(place * Fraction(17, 10) for place in places), *(Fraction(k, 4) for k in range(1, 20))})
    )


def _turned(sign: str) -> str:
    return {"<": ">", "<=": ">=", ">": "<", ">=": "<="}.get(sign, sign)
