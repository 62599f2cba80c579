"""Sums of functions of one variable each, polynomials in it and in sin and cos: not negative, on three pieces.

Close to a zero at the left end by as many derivatives as vanish there; then by enclosures; far away by a power of the
variable times what is bounded away from 0. Where the pieces meet is guessed from values; Coq checks each.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, is_shown
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation

_MOST_DERIVATIVES = 6
_POINTS = 40


def by_halflines(goal: Goal) -> Iterator[str]:
    """The goal's difference, less multiples of what is known, as a sum of functions of one variable each."""
    relation = goal.relation.standard()
    if relation.sign != "<=":
        return
    gap = sp.expand(relation.right - relation.left)
    if gap.atoms(sp.Function) - gap.atoms(sp.sin, sp.cos) or not gap.has(sp.sin, sp.cos):
        return
    for reduced in _without_parameters(gap, goal.known):
        parts = _parts(reduced)
        if parts is None:
            continue
        lines: list[str] = []
        for number, (symbol, part) in enumerate(parts.items()):
            line = _one_part(part, symbol, f"U{number}", goal)
            if line is None:
                break
            lines.append(line)
        else:
            yield "; ".join([*lines, "first [ lra | to_difference; nra ]"])
            return


def _without_parameters(gap: sp.Expr, known: Sequence[Relation]) -> Iterator[sp.Expr]:
    yield gap
    for item in (fact.standard() for fact in known if fact.sign not in ("=", "!=")):
        fact = sp.expand(item.right - item.left)
        for symbol in fact.free_symbols:
            weight = sp.cancel(gap.coeff(symbol) / fact.coeff(symbol)) if fact.coeff(symbol) != 0 else sp.Integer(0)
            if weight.is_number and weight > 0:
                yield sp.expand(gap - weight * fact)


def _parts(gap: sp.Expr) -> dict[sp.Symbol, sp.Expr] | None:
    """The terms by their variable; the constant goes to where the parts have their values at 0."""
    constant, terms = gap.as_independent(*gap.free_symbols, as_Add=True)
    parts: dict[sp.Symbol, sp.Expr] = {}
    for part in sp.Add.make_args(terms):
        if len(part.free_symbols) != 1:
            return None
        (symbol,) = part.free_symbols
        parts[symbol] = parts.get(symbol, sp.Integer(0)) + part
    starts = {symbol: part.subs(symbol, 0) for symbol, part in parts.items()}
    spare = sp.simplify(constant + sum(starts.values()))
    return {symbol: part - starts[symbol] + spare / len(parts) for symbol, part in parts.items()}


def _range(symbol: sp.Symbol, known: Sequence[Relation]) -> tuple[sp.Expr | None, sp.Expr | None]:
    """Its lowest and its highest value, where there are such."""
    low = sp.Integer(0) if symbol.is_nonnegative else None
    high = None
    for item in (fact.standard() for fact in known):
        if item.right == symbol and item.left.is_number:
            low = item.left if low is None else sp.Max(low, item.left)
        elif item.left == symbol and item.right.is_number:
            high = item.right if high is None else sp.Min(high, item.right)
    return low, high


def _one_part(part: sp.Expr, symbol: sp.Symbol, name: str, goal: Goal) -> str | None:
    """That this part is not negative, as a fact called ``name``."""
    if is_shown(part):
        return f"assert ({name} : 0 <= {goal.text(part)}) by sign"
    least, greatest = _range(symbol, goal.known)
    own, x = goal.names[symbol], fresh("every", goal.names)
    variable = sp.Symbol(x, real=True)
    goal = Goal(goal.relation, goal.known, {**goal.names, variable: x})
    part, symbol = part.xreplace({symbol: variable}), variable
    said = goal.text(part)
    if least is None:
        other = part.subs(symbol, -symbol)
        halves = [_half(side, symbol, sp.Integer(0), None, goal) for side in dict.fromkeys((part, other))]
        if None in halves:
            return None
        angles = sorted({call.args[0] for call in part.atoms(sp.sin, sp.cos)}, key=sp.default_sort_key)
        turns = "; ".join(f"turned {goal.text(angle)}" for angle in angles)
        functions = " ".join(f"(fun {x} => {goal.text(side)})" for side in dict.fromkeys((part, other)))
        word = "both_sides" if len(halves) == 2 else "both_sides_alike"
        same = f"intro {x}; cbv beta; {turns}; first [ ring | field ]"
        proof = f"apply ({word} {functions}); [ {' | '.join([same, *(half for half in halves if half)])} ]"
        return f"assert ({name} : forall {x} : R, 0 <= {said}) by ({proof}); specialize ({name} {own})"
    half = _half(part, symbol, least, greatest, goal)
    if half is None:
        return None
    low, high = goal.text(least), "" if greatest is None else goal.text(greatest)
    between = f"{low} <= {x} <= {high}" if high else f"{low} <= {x}"
    said = f"(forall {x} : R, {between} -> 0 <= {goal.text(part)})"
    return f"assert ({name} : {said}) by ({half}); specialize ({name} {own} ltac:(lra))"


def _half(part: sp.Expr, symbol: sp.Symbol, low: sp.Expr, high: sp.Expr | None, goal: Goal) -> str | None:
    """The proof of "for all x from low (to high), 0 <= part"."""
    value = sp.lambdify(symbol, part, "math")
    tail = None
    end = high
    if high is None:
        tail = _tail(part, symbol)
        if low != 0 or tail is None:
            return None
        end = tail[0]
    first = _start(part, symbol, low, end, goal)
    if first is None:
        return None
    middle, proof = first
    if not _is_positive(value, middle, end):
        return None
    predicate = f"(fun {goal.names[symbol]} => 0 <= {goal.text(part)})"
    if tail is None:
        places = " ".join(map(goal.text, (low, middle, end)))
        return f"apply (in_two {predicate} {places}); [ {proof} | enclosed ]"
    places = " ".join(map(goal.text, (middle, end)))
    far = f"intros {goal.names[symbol]} ?; far {goal.text(tail[1])}"
    return f"apply (in_three {predicate} {places}); [ {proof} | enclosed | {far} ]"


def _start(part: sp.Expr, symbol: sp.Symbol, low: sp.Expr, end: sp.Expr, goal: Goal) -> tuple[sp.Expr, str] | None:
    """A place up to which the part is not negative, and the proof there."""
    chain = [part]
    while sp.simplify(chain[-1].subs(symbol, low)) == 0:
        if len(chain) > _MOST_DERIVATIVES:
            return None
        chain.append(sp.diff(chain[-1], symbol))
    last = sp.lambdify(symbol, chain[-1], "math")
    for power in range(9):
        place = low + sp.Rational(end - low) / 2**power if (end - low).is_Rational else None
        if place is None:
            return None
        if power > 0 and _is_positive(last, low, place):
            functions = [f"(fun {goal.names[symbol]} => {goal.text(each)})" for each in chain]
            ends = f"{goal.text(low)} {goal.text(place)}"
            steps = [f"by_derivative {a} {b} {ends}" for a, b in itertools.pairwise(functions)]
            return place, "; ".join([*steps, "enclosed"])
    return None


def _tail(part: sp.Expr, symbol: sp.Symbol) -> tuple[sp.Expr, sp.Expr] | None:
    """From where on the highest power decides, and the part with this power taken out."""
    stands = {call: sp.Dummy() for call in part.atoms(sp.sin, sp.cos)}
    plain = sp.Poly(sp.expand(part).xreplace(stands), symbol)
    if not plain.LC().is_positive:
        return None
    degree = plain.degree()
    bounds = {(power,): sum(abs(term.subs(dict.fromkeys(stands.values(), 1))) for term in sp.Add.make_args(value))
              for (power,), value in plain.terms()}  # fmt: skip
    for place in (1, 2, 3, 5, 8, 12, 20, 50, 100):
        rest = sum(float(value) * float(place) ** (power - degree) for (power,), value in bounds.items()
                   if power != degree)  # fmt: skip
        if float(plain.LC()) > 1.05 * rest:
            inner = sp.Add(*(term / symbol**degree for term in sp.Add.make_args(sp.expand(part))))
            return sp.Integer(place), sp.Mul(symbol**degree, inner, evaluate=False)
    return None


def _is_positive(value: Callable[[float], float], low: sp.Expr, high: sp.Expr) -> bool:
    """Whether the values between are positive, as far as points show."""
    a, b = float(low), float(high)
    return all(value(a + (b - a) * step / _POINTS) > 0 for step in range(_POINTS + 1))
