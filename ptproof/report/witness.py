"""A witness as the report shows it: formulas where its text can be read, its text where not."""

from __future__ import annotations

import re
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.claim import Claim
from ptproof.proof.statement import free_symbols, undefined_functions
from ptproof.proof.verdict import Witness
from ptproof.reading.expressions import parse
from ptproof.report.example import Ball, Example, Point, example_of
from ptproof.report.formula import Names, latex


@dataclass(frozen=True)
class Value:
    """A piece of a witness: its text, and LaTeX where the text could be read."""

    text: str
    latex: str = ""


@dataclass(frozen=True)
class WitnessView:
    """Values of the symbols, and the two sides there; and where that is short, these values in the formula."""

    values: tuple[Value, ...]
    left: Value
    right: Value
    example: Example | None = None
    with_: tuple[Value, ...] = ()  # the values that stand in the example


def witness_view(witness: Witness, claim: Claim, names: Names) -> WitnessView:
    """Set the witness in the letters of the claim."""
    statements = [claim.statement, *claim.assumptions]
    symbols = {symbol.name: symbol for symbol in (*names, *free_symbols(statements)) if isinstance(symbol, sp.Symbol)}
    functions = {applied.func.__name__: applied for applied in undefined_functions(statements)}
    values = {name: _value(name, text, symbols, functions, names) for name, text in witness.values.items()}
    left, right = (_side(side, symbols, names) for side in (witness.left, witness.right))
    example = _example(witness, claim, symbols, names)
    met = [value for name, value in values.items() if example and name.partition("(")[0] in example.letters]
    return WitnessView(tuple(values.values()), left, right, example, tuple(met))


def _example(witness: Witness, claim: Claim, symbols: dict[str, sp.Symbol], names: Names) -> Example | None:
    """The values of the witness in the formula."""
    known: dict[sp.Symbol, sp.Expr] = {}
    functions: dict[str, tuple[tuple[sp.Symbol, ...], sp.Expr]] = {}
    try:
        for name, text in witness.values.items():
            called = re.fullmatch(r"(\w+)\((.*)\)", name)
            if called:
                own = {part.strip(): sp.Symbol(part.strip(), real=True) for part in called.group(2).split(",")}
                functions[called.group(1)] = (tuple(own.values()), _read(text, {**symbols, **own}))
            elif name in symbols and text != "any":
                known[symbols[name]] = _read(text, symbols)
        left, right = (_number(side, symbols) for side in (witness.left, witness.right))
    except InputError:
        return None
    return example_of(claim.statement, Point(known, functions), left, right, names)


def _value(
    name: str, text: str, symbols: dict[str, sp.Symbol], functions: dict[str, AppliedUndef], names: Names
) -> Value:
    plain = f"{name} = {text}"
    called = re.fullmatch(r"(\w+)\((.*)\)", name)
    try:
        if name.isidentifier() and name not in symbols and name not in functions:
            symbols = {**symbols, name: sp.Symbol(name, real=True)}
        if name in symbols and text == "any":
            return Value(plain, rf"\text{{any }}{latex(symbols[name], names)}")
        if name in symbols:
            return Value(plain, f"{latex(symbols[name], names)} = {latex(_read(text, symbols), names)}")
        if called and called.group(1) in functions:
            # The arguments of a function are places: they are named s₁, s₂, … where the text has names of its own.
            places = [part.strip() for part in called.group(2).split(",")]
            own = {part: symbols.get(part) or _place(number, len(places)) for number, part in enumerate(places, 1)}
            head = sp.Function(called.group(1))(*own.values())
            return Value(plain, f"{latex(head, names)} = {latex(_read(text, {**symbols, **own}), names)}")
    except InputError:
        pass
    return Value(plain)


_BALL = re.compile(r"\[?\s*(-?[\d.]+)(?:[eE]([+-]?\d+))?\s*(?:(?:±|\+/-)\s*([\d.]+)(?:[eE]([+-]?\d+))?)?\s*\]?")


def _number(text: str, symbols: dict[str, sp.Symbol]) -> Ball:
    """A side at the witness: exact, or where its text has no more than a ball, the middle and the radius of that."""
    exact, _, _ = text.partition(" = ")
    if found := _BALL.fullmatch(exact):
        middle, power, radius, small = found.groups()
        return sp.Rational(f"{middle}e{power or 0}"), float(f"{radius or 0}e{small or 0}")
    return _read(exact, symbols), 0.0


def _place(number: int, total: int) -> sp.Symbol:
    return sp.Symbol("s" if total == 1 else f"s{number}", real=True)


def _side(text: str, symbols: dict[str, sp.Symbol], names: Names) -> Value:
    """``exact = 1.234 ± 1e-9``: the exact value and its enclosure."""
    exact, equals, ball = text.partition(" = ")
    number = _BALL.fullmatch(ball if equals else exact)
    enclosed = ""
    if number is not None:
        middle, power, radius, small = number.groups()
        enclosed = _scientific(middle, power) + (rf" \pm {_scientific(radius, small)}" if radius else "")
    try:
        shown = latex(_read(exact, symbols), names)
    except InputError:
        return Value(text, "" if equals else enclosed)
    if not equals:
        return Value(text, shown)
    return Value(text, shown if shown == enclosed else f"{shown} = {enclosed}" if enclosed else "")


def _scientific(digits: str, power: str | None) -> str:
    return digits if power is None else rf"{digits} \cdot 10^{{{int(power)}}}"


def _read(text: str, symbols: dict[str, sp.Symbol]) -> sp.Expr:
    safe = {f"v{place}": symbol for place, symbol in enumerate(symbols.values())}
    renamed = {symbol_name: f"v{place}" for place, symbol_name in enumerate(symbols)}
    # Names such as _s0 are not names to the parser.
    source = re.sub(r"[A-Za-z_]\w*", lambda match: renamed.get(match.group(), match.group()), text)
    return parse(source, safe, where="witness")
