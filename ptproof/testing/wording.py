"""What a failed assertion says."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable

import sympy as sp

from ptproof.proof.verdict import Witness
from ptproof.reading.limits import OutOfTime, within

SIMPLIFY_SECONDS = 2.0
_SMALL = 80


def lines(title: str, rows: Iterable[tuple[str, str]]) -> str:
    """A title and rows of name and text, the texts in one column."""
    shown = [(f"{name}:", text) for name, text in rows if text]
    width = max((len(name) for name, _ in shown), default=0)
    return "\n".join([title, *(f"  {name:<{width}} {text}" for name, text in shown)])


def witness_text(witness: Witness | None, left: str = "left", right: str = "right") -> str:
    """The witness in one line, with the names of the two sides."""
    if witness is None:
        return ""
    values = ", ".join(f"{name} = {value}" for name, value in witness.values.items())
    at = f"{values}: " if values else ""
    return f"{at}{left} {witness.left}, {right} {witness.right}"


def simplest(expression: sp.Expr) -> sp.Expr:
    """The shortest of a few equivalent forms, found in little time; only for showing, never for deciding."""
    if expression.has(sp.Integral, sp.Limit):  # SymPy would evaluate them, and has been wrong without notice
        return expression
    forms = [expression]
    attempts = [sp.expand, sp.factor, lambda e: sp.factor(sp.cancel(sp.together(e))), sp.trigsimp]
    if sp.count_ops(expression) <= _SMALL:
        attempts.append(sp.simplify)

    def try_all() -> None:
        for attempt in attempts:
            with contextlib.suppress(
                ValueError, TypeError, NotImplementedError, AttributeError, RecursionError, sp.PolynomialError
            ):
                forms.append(attempt(expression))

    with contextlib.suppress(OutOfTime):
        within(SIMPLIFY_SECONDS, try_all)
    return min(forms, key=lambda form: (sp.count_ops(form), len(str(form))))
