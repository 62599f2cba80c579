"""Whether an assumption "for all …" holds for concrete functions, on a grid of its bound variables."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.kinds import Sides, fits_kind
from ptproof.proof.attack.numbers import Exact, NotReal, Number, Undefined
from ptproof.proof.attack.scope import Scope
from ptproof.proof.attack.tree import Node, tree
from ptproof.proof.statement import ForAll, Relation

_NARROWING = 40
_SHARES = tuple(Exact(k, 6) for k in range(7))
_NEAR = tuple(Exact(1, 10**k) for k in (2, 3, 4, 6, 8, 12, 20, 30))
_CLOSE = tuple(sorted({*(Exact(k, 40) for k in range(41)), *_NEAR, *(1 - share for share in _NEAR)}))
_OFFSETS = (
    *(Exact(0), Exact(1, 100), Exact(1, 3), Exact(1), Exact(3), Exact(10), Exact(100), Exact(10**5), Exact(10**8)),
)
_PLACES = (Exact(-10), Exact(-1), Exact(-1, 3), Exact(0), Exact(1, 7), Exact(1), Exact(5))


def satisfied(items: Iterable[ForAll], evaluator: Evaluator, *, dense: bool) -> bool:
    """Whether each of the assumptions holds at every place of a grid; raises where that cannot be told."""
    return all(_holds(item, evaluator, dense) for item in items)


@lru_cache(maxsize=512)
def _taken_apart(item: ForAll) -> tuple[tuple[Node, ...], tuple[Sides, ...], tuple[Sides, ...]]:
    """The bound variables, the domain and what is said, as the evaluator takes them."""
    said = item.relation.components()
    return tuple(map(tree, item.variables)), tuple(map(Sides.of, item.domain)), tuple(map(Sides.of, said))


def _holds(item: ForAll, evaluator: Evaluator, dense: bool) -> bool:
    variables, domain, said = _taken_apart(item)
    axes = [_axis(variable, item.domain, evaluator, dense) for variable in item.variables]
    for place in itertools.islice(itertools.product(*axes), 400):
        scope = evaluator.point.around(dict(zip(variables, place, strict=True)))
        if all(_inside(part, evaluator, scope) for part in domain) and not all(
            part.hold(evaluator, scope) for part in said
        ):
            return False
    return (
        not dense
        or len(axes) != 1
        or all(_holds_between(item, part, axes[0], evaluator) for part in item.relation.components())
    )


def _holds_between(item: ForAll, part: Relation, places: list[Number], evaluator: Evaluator) -> bool:
    """Whether an inequality holds also where it is tightest between the places of the grid."""
    if part.sign not in ("<=", "<", ">=", ">") or len(places) < 3:
        return True
    numbers, ((variable,), domain, _) = evaluator.calculus.numbers, _taken_apart(item)
    sides = Sides.of(part.standard())

    def scope_at(place: Number) -> Scope:
        return evaluator.point.around({variable: place})

    def slack(place: Number) -> Any:
        scope = scope_at(place)
        return numbers.ball(numbers.sub(*(evaluator.plain(side, scope) for side in (sides.right, sides.left)))).mid()

    heights = [slack(place) for place in places]
    for k in range(1, len(places) - 1):
        if heights[k] > min(heights[k - 1], heights[k + 1]):
            continue
        low, high = places[k - 1], places[k + 1]
        for _ in range(_NARROWING):
            third = numbers.mul(Exact(1, 3), numbers.sub(high, low))
            left, right = numbers.add([low, third]), numbers.sub(high, third)
            for place in (left, right):
                scope = scope_at(place)
                if all(_inside(where, evaluator, scope) for where in domain) and not sides.hold(evaluator, scope):
                    return False
            low, high = (low, right) if slack(left) < slack(right) else (left, high)
    return True


def _inside(part: Sides, evaluator: Evaluator, scope: Scope) -> bool:
    try:
        return part.hold(evaluator, scope)
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
        shares = _CLOSE if dense else _SHARES
        found = [numbers.add([low, numbers.mul(width, share)]) for share in shares]
    elif low is not None:
        found = [numbers.add([low, offset]) for offset in _more(_OFFSETS, dense)]
    elif high is not None:
        found = [numbers.sub(high, offset) for offset in _more(_OFFSETS, dense)]
    else:
        found = list(_more(_PLACES, dense))
    return [value for value in found if type(value) is not Exact or fits_kind(variable, value)]


def _more(places: tuple[Exact, ...], dense: bool) -> tuple[Exact, ...]:
    if not dense:
        return places
    between = (place * Exact(17, 10) for place in places)
    return tuple(sorted({*places, *between, *_NEAR, *(Exact(k, 4) for k in range(1, 20))}))


def _turned(sign: str) -> str:
    return {"<": ">", "<=": ">=", ">": "<", ">=": "<="}.get(sign, sign)
