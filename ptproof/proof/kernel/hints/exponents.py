"""Letters for powers with unknown exponents, where all powers of a base are whole powers of one of them."""

from __future__ import annotations

from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, is_shown
from ptproof.proof.kernel.hints.masks import put
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.names import fresh

_MILLISECONDS = 500


def by_one_power(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with a letter for the least power of each such base: where the base may be 0, the letter may be, too."""
    lines: list[str] = []
    powers = [power for power in goal.atoms(sp.Pow) if not power.exp.is_number]
    for base in dict.fromkeys(power.base for power in powers):
        own = [power for power in powers if power.base == base]
        if (found := _whole_powers([power.exp for power in own])) is None or not is_shown(base):
            continue
        least, times = found
        name = fresh(f"w{len(lines)}", goal.names)
        letter = sp.Symbol(name, **{"positive" if base.is_positive else "nonnegative": True})
        values = {power: letter ** times[power.exp] for power in own}
        inner = goal.map(partial(put, values), {**goal.names, letter: name})
        if needed(inner.relation, inner.known, _MILLISECONDS) is None:
            continue
        for count in sorted({abs(count) for count in times.values()} - {1}):
            old = next(
                base ** (sp.sign(times[power.exp]) * power.exp) for power in own if abs(times[power.exp]) == count
            )
            lines.append(f"try (whole_power {goal.text(old)} {goal.text(base**least)} {count}%nat)")
        lines.append(f"try (atom {name} {goal.text(base**least)})")
        goal = inner
    return lines, goal


def _whole_powers(exponents: list[sp.Expr]) -> tuple[sp.Expr, dict[sp.Expr, int]] | None:
    """The exponent of which all are multiples, and by how much each."""
    for exponent in exponents:
        least = -exponent if exponent.could_extract_minus_sign() else exponent
        times = {each: sp.cancel(each / least) for each in exponents}
        if all(count.is_Integer for count in times.values()):
            return least, {each: int(count) for each, count in times.items()}
    return None
