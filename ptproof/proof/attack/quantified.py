"""Whether an assumption "for all …" holds for concrete functions, on a grid of its bound variables."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
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


@dataclass(frozen=True, eq=False)
class Everywhere:
    """A quantified assumption as the evaluator takes it.

    Attributes
    ----------
    item
        The assumption.
    variables, given
        The bound variables, and these as a set.
    domain, said
        Where it speaks, and the scalar relations that it says.
    ends
        For each variable the ends that the domain gives it: whether it is a lower one, an upper one, and what it is.
    """

    item: ForAll
    variables: tuple[Node, ...]
    given: frozenset[Node]
    domain: tuple[Sides, ...]
    said: tuple[Sides, ...]
    ends: tuple[tuple[tuple[bool, bool, Node], ...], ...]

    @cached_property
    def tight(self) -> tuple[Sides, ...]:
        """Of the inequalities that it says the sides, the smaller one first."""
        parts = (part for part in self.item.relation.components() if part.sign in ("<=", "<", ">=", ">"))
        return tuple(Sides.of(part.standard()) for part in parts)


@lru_cache(maxsize=512)
def everywhere(item: ForAll) -> Everywhere:
    """The assumption, taken apart."""
    variables = tuple(map(tree, item.variables))
    said = tuple(map(Sides.of, item.relation.components()))
    ends = tuple(tuple(_ends(variable, item.domain)) for variable in item.variables)
    return Everywhere(item, variables, frozenset(variables), tuple(map(Sides.of, item.domain)), said, ends)


def _ends(variable: Any, domain: Iterable[Relation]) -> Iterator[tuple[bool, bool, Node]]:
    for part in domain:
        for one, other, sign in ((part.left, part.right, part.sign), (part.right, part.left, _turned(part.sign))):
            if one == variable and not other.has(variable):
                yield sign in (">=", ">"), sign in ("<=", "<"), tree(other)


def satisfied(items: Iterable[Everywhere], evaluator: Evaluator, *, dense: bool) -> bool:
    """Whether each of the assumptions holds at every place of a grid; raises where that cannot be told."""
    return all(_holds(item, evaluator, dense) for item in items)


def _holds(item: Everywhere, evaluator: Evaluator, dense: bool) -> bool:
    variables, around = item.variables, evaluator.point.around
    axes = [_axis(variable, ends, evaluator, dense) for variable, ends in zip(variables, item.ends, strict=True)]
    for place in itertools.islice(itertools.product(*axes), 400):
        scope = around(dict(zip(variables, place, strict=True)), item.given)
        if all(_inside(part, evaluator, scope) for part in item.domain) and not all(
            part.hold(evaluator, scope) for part in item.said
        ):
            return False
    if not dense or len(axes) != 1 or len(axes[0]) < 3:
        return True
    return all(_holds_between(item, sides, axes[0], evaluator) for sides in item.tight)


def _holds_between(item: Everywhere, sides: Sides, places: list[Number], evaluator: Evaluator) -> bool:
    """Whether an inequality holds also where it is tightest between the places of the grid."""
    numbers, (variable,) = evaluator.calculus.numbers, item.variables

    def scope_at(place: Number) -> Scope:
        return evaluator.point.around({variable: place}, item.given)

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
                if all(_inside(where, evaluator, scope) for where in item.domain) and not sides.hold(evaluator, scope):
                    return False
            low, high = (low, right) if slack(left) < slack(right) else (left, high)
    return True


def _inside(part: Sides, evaluator: Evaluator, scope: Scope) -> bool:
    try:
        return part.hold(evaluator, scope)
    except (Undefined, NotReal):
        return False


def _axis(variable: Node, ends: Iterable[tuple[bool, bool, Node]], evaluator: Evaluator, dense: bool) -> list[Number]:
    """Places of one bound variable between the ends that the domain gives it."""
    numbers = evaluator.calculus.numbers
    low: Number | None = None
    high: Number | None = None
    for lower, upper, place in ends:
        end = evaluator.plain(place, evaluator.point)
        if lower and (low is None or numbers.sign(numbers.sub(end, low)) > 0):
            low = end
        if upper and (high is None or numbers.sign(numbers.sub(end, high)) < 0):
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
