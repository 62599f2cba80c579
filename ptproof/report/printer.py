"""SymPy's expressions as LaTeX in the letters of a paper."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import _coeff_isneg
from sympy.printing.latex import LatexPrinter, greek_letters_set

Names = Mapping[Any, str]


class _Printer(LatexPrinter):
    """SymPy's printer, but a sum does not open with a minus sign where it need not (τ − t₀, not −t₀ + τ), and a norm
    needs no parentheses around it before an exponent. Each part is printed once: statements have much in common."""

    def __init__(self, settings: dict[str, Any]) -> None:
        super().__init__(settings)
        self._shown: dict[sp.Basic, str] = {}

    def _print(self, expr: Any, **kwargs: Any) -> str:
        if kwargs or not isinstance(expr, sp.Basic):
            return str(super()._print(expr, **kwargs))
        if expr not in self._shown:
            self._shown[expr] = str(super()._print(expr))
        return self._shown[expr]

    def _as_ordered_terms(self, expr: sp.Expr, order: str | None = None) -> list[sp.Expr]:
        return ordered(super()._as_ordered_terms(expr, order=order))

    def parenthesize_super(self, s: str) -> str:
        return f"{{{s}}}" if re.fullmatch(r"\\\|.*\\\||.*\)", s) else str(super().parenthesize_super(s))

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        names = self._settings["symbol_names"]
        if expr not in names and expr.name.endswith("_dot"):  # the value of a derivative
            letter = sp.Symbol(expr.name.removesuffix("_dot"), **expr.assumptions0)
            known = next((glyph for other, glyph in names.items() if getattr(other, "name", "") == letter.name), "")
            return rf"\dot{{{known or super()._print_Symbol(letter)}}}"
        shown = str(super()._print_Symbol(expr, style=style))
        return shown if expr in names else _upright(shown)

    def _hprint_Function(self, func: str) -> str:
        return _upright(str(super()._hprint_Function(func)))

    def _print_Mul(self, expr: sp.Expr) -> str:
        # SymPy asks of each power with a negative symbolic exponent whether it is constant, which takes seconds on a
        # page. None is, so letters that are printed like the powers stand in for them.
        names = self._settings["symbol_names"]
        masks = {}
        for factor in sp.Mul.make_args(expr):
            exponent = factor.as_base_exp()[1]
            if exponent.free_symbols and exponent.is_negative:
                shown = self._print(factor)  # which may need letters as well
                masks[factor] = sp.Symbol(f"zz{len(names):06}", positive=True)
                names[masks[factor]] = shown
        if masks:
            expr = sp.Mul(*(masks.get(factor, factor) for factor in sp.Mul.make_args(expr)))
            if not isinstance(expr, sp.Mul):
                return self._print(expr)
        return str(super()._print_Mul(expr))


_ACCENTS = {"hat": r"\hat{#}", "tilde": r"\tilde{#}", "bar": r"\bar{#}", "dot": r"\dot{#}", "star": "{#}^{*}"}


def _upright(shown: str) -> str:
    """A letter without a glyph: words stand upright, an index such as ``kappa1`` is a letter with a number, and one
    such as ``hat`` is an accent; ``ijm`` is three indices."""
    shown = re.sub(rf"\{{({'|'.join(sorted(greek_letters_set))})(\d*)\}}", _greek, shown)
    if accented := re.fullmatch(rf"(.+)_\{{({'|'.join(_ACCENTS)})\}}", shown):
        return _ACCENTS[accented[2]].replace("#", accented[1])
    shown = re.sub(r"_\{(?![i-q]+\})([a-z]{3,})\}", r"_{\\mathrm{\1}}", shown)
    return re.sub(r"^[A-Za-z]{3,}(?=$|_)", lambda found: rf"\mathrm{{{found[0]}}}", shown)


def _greek(found: re.Match[str]) -> str:
    return rf"{{\{found[1]}{f'_{{{found[2]}}}' if found[2] else ''}}}"


def ordered(terms: list[sp.Expr]) -> list[sp.Expr]:
    """The terms of a sum with one in front that has no minus sign, where there is such."""
    first = next((place for place, term in enumerate(terms) if not _coeff_isneg(term)), 0)
    return [terms[first], *terms[:first], *terms[first + 1 :]]


def latex(expression: Any, names: Names, dots: bool = False) -> str:
    """SymPy's LaTeX with the glyphs of the notation; with ``dots`` between factors."""
    return str(_printer(tuple(names.items()), dots).doprint(expression))


@lru_cache(maxsize=16)
def _printer(names: tuple[tuple[Any, str], ...], dots: bool) -> _Printer:
    return _Printer({"symbol_names": dict(names), "ln_notation": True, **({"mul_symbol": "dot"} if dots else {})})


def numbers(value: sp.Expr) -> str:
    """A number in the place of a letter."""
    shown = latex(value, {})
    return shown if value.is_Integer and value >= 0 else rf"\left({shown}\right)"
