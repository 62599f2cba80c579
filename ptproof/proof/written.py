"""Expressions as text, as SymPy writes them; a part that comes up again is written once.

The statements of a derivation share their parts, and SymPy sorts the terms of each of them anew.
"""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

_MOST = 2**15


def written(value: Any) -> str:
    """The text of a side, the same as ``str``; of a column that of the list of its entries.

    >>> x = sp.Symbol("x", real=True)
    >>> written(x**2 + 1), written(sp.Matrix([x, -x]))
    ('x**2 + 1', '[x, -x]')
    """
    if isinstance(value, sp.MatrixBase):
        return f"[{', '.join(map(written, value))}]"
    return str(_PRINTER.doprint(value)) if isinstance(value, sp.Basic) else str(value)


class _Printer(StrPrinter):
    """SymPy's printer with a memory."""

    def __init__(self) -> None:
        super().__init__({"order": None})
        self._known: dict[sp.Basic, str] = {}

    def _print(self, expr: Any, **options: Any) -> str:
        if options or not isinstance(expr, sp.Basic) or not expr.args:
            return str(super()._print(expr, **options))
        text = self._known.get(expr)
        if text is None:
            text = str(super()._print(expr))
            if len(self._known) >= _MOST:
                self._known.clear()
            self._known[expr] = text
        return text


_PRINTER = _Printer()
