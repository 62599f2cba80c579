"""What a symbol or an undefined function is declared to be, as hypotheses for Coq.

A declaration that has no line here (even, prime, …) is left out: with fewer hypotheses Coq is asked for more.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.declarations import declared
from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, term

_KINDS = {
    ("positive", True): "0 < {}", ("negative", True): "{} < 0", ("nonnegative", True): "0 <= {}",
    ("nonpositive", True): "{} <= 0", ("nonzero", True): "{} <> 0", ("zero", True): "{} = 0",
    ("integer", True): "is_integer {}",
}  # fmt: skip


def of_symbol(symbol: sp.Symbol, name: str) -> tuple[str, ...]:
    """What the symbol is declared to be.

    Raises
    ------
    NoTranslation
        If it is not declared real.
    """
    if not symbol.is_real:
        raise NoTranslation(f"no translation for {symbol}, which is not declared real")
    return tuple(text.format(name) for key, text in _KINDS.items() if key in declared(symbol).items())


def of_functions(applied: Iterable[AppliedUndef], free: set[sp.Symbol], names: Names) -> tuple[str, ...]:
    """Of which sign the functions' values are: everywhere, where a function is applied to a plain real symbol.

    A function whose arguments are declared of some kind has its sign on arguments of that kind; applied to anything
    else it has it there.
    """
    found: list[str] = []
    seen: set[Any] = set()
    for call in sorted(applied, key=sp.default_sort_key):
        if not call.is_real:
            raise NoTranslation(f"no translation for {call.func}, which is not declared real")
        signature = (call.func, bare(call) and tuple(of_symbol(item, "x") for item in call.args))
        if signature[1] and signature in seen:
            continue
        seen.add(signature)
        for kind in _strongest(call.func):
            if bare(call):
                found.append(for_all(call.args, kind.format(term(call, names)), names))
            elif call.free_symbols <= free:
                found.append(kind.format(term(call, names)))
    return tuple(dict.fromkeys(found))


def of_derivatives(derivatives: Iterable[sp.Derivative], names: Names) -> tuple[str, ...]:
    """That the undefined functions below the derivatives can be differentiated so often: they stand for smooth ones."""
    found: list[str] = []
    for derivative in sorted(derivatives, key=sp.default_sort_key):
        for call in sorted(derivative.expr.atoms(AppliedUndef), key=sp.default_sort_key):
            if not bare(call):
                continue
            inner = term(call, names)
            for variable in derivative.variables:
                if variable not in call.args:
                    break
                name = term(variable, names)
                found.append(for_all(call.args, f"ex_derive (fun {name} => {inner}) {name}", names))
                inner = f"(Derive (fun {name} => {inner}) {name})"
    return tuple(dict.fromkeys(found))


def bare(call: AppliedUndef) -> bool:
    """Whether the function is applied to different symbols, so that its value there speaks for all of their kind."""
    return all(item.is_Symbol for item in call.args) and len(set(call.args)) == len(call.args)


def for_all(symbols: Iterable[sp.Symbol], said: str, names: Names, premises: Iterable[str] = ()) -> str:
    """What is said for all values of the symbols that are what they are declared to be, under the premises."""
    symbols = list(symbols)
    kinds = [kind for symbol in symbols for kind in of_symbol(symbol, names[symbol])]
    return f"(forall {' '.join(names[symbol] for symbol in symbols)} : R, {' -> '.join([*kinds, *premises, said])})"


def _strongest(function: Any) -> list[str]:
    """What the function's values are declared to be, without what follows from the first sign."""
    own = {word for word, truth in function._kwargs.items() if truth is True}
    signs = next(
        (word for word in ("zero", "positive", "negative", "nonnegative", "nonpositive", "nonzero") if word in own), ""
    )
    return [_KINDS[word, True] for word in (signs, "integer") if word in own]
