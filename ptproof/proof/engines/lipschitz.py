"""Rates that are locally Lipschitz in a value, by their form."""

from __future__ import annotations

import sympy as sp


def is_lipschitz(phi: sp.Expr, value: sp.Symbol) -> bool:
    """Combinations of powers of the value, with exponents 0 or ≥ 1, or integers ≥ 0, are locally Lipschitz.

    A power that is not an integer is so on [0, ∞), where a value that is declared not negative stays, and every power
    on (0, ∞), where one that is declared positive stays. The larger and the smaller of such expressions are so as well.
    """
    choices = {node for node in phi.atoms(sp.Max, sp.Min) if node.has(value)}
    if choices:
        if not all(is_lipschitz(side, value) for node in choices for side in node.args):
            return False
        # As one more value of its own, by which the rate has to depend on it linearly.
        masks = {node: sp.Dummy(f"choice{i}", real=True) for i, node in enumerate(_outermost(choices))}
        phi = sp.expand_mul(phi.xreplace(masks))
        rest = phi.as_independent(*masks.values(), as_Add=True)[0]
        linear = all(phi.diff(mask).free_symbols.isdisjoint({value, *masks.values()}) for mask in masks.values())
        return linear and (not rest.has(value) or is_lipschitz(rest, value))
    for term in sp.Add.make_args(sp.expand_mul(phi)):
        independent, dependent = term.as_independent(value, as_Add=False)
        if independent.has(value):
            return False
        if dependent == 1:
            continue
        base, exponent = dependent.as_base_exp()
        if base != value or exponent.has(value):
            return False
        if value.is_positive and exponent.is_real:
            continue
        if not sp.factor(sp.together(exponent - 1)).is_nonnegative:
            return False
        if not value.is_nonnegative and not exponent.is_integer:
            return False
    return True


def _outermost(nodes: set[sp.Expr]) -> list[sp.Expr]:
    return sorted((node for node in nodes if not any(node != other and other.has(node) for other in nodes)), key=str)


def is_polynomial(phi: sp.Expr, value: sp.Symbol) -> bool:
    """Whether the rate makes sense for every real value."""
    powers = [node for node in sp.expand_mul(phi).atoms(sp.Pow) if node.base == value]
    return all(node.exp.is_integer for node in powers)
