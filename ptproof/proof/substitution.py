"""Values put in the place of symbols and undefined functions: for everyone, in one place.

A substitution is a value that can't be made with what is not of the kind that a letter stands for. What is bound is
never caught: a bound variable that stands in a value is renamed, and a derivative is taken before its variable gets
a value. What the values need in order to be defined goes along (:attr:`Substitution.domain`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.declarations import everywhere, is_kind
from ptproof.proof.definedness import Obligation, obligations
from ptproof.proof.signs import holds
from ptproof.proof.statement import ForAll, Relation, expressions_of

_WITH_LIMITS = (sp.Integral, sp.Sum, sp.Product)
BINDERS = (sp.Derivative, sp.Limit, sp.Subs, sp.Lambda, *_WITH_LIMITS)


class NotOfKind(InputError):
    """A value is not known to be what the letter stands for."""


def _real_where_defined(value: sp.Expr) -> bool:
    """What is asked of the value goes along as the substitution's domain."""
    return all(need.relation is not None for need in obligations(value))


@dataclass(frozen=True)
class Substitution:
    """Values of symbols, and of undefined functions written as applied to symbols: an expression in these.

    All values are put in at once: what stands in a value is not replaced again.

    Parameters
    ----------
    values
        Symbol, or applied function → expression.
    has_sign
        Whether an expression is shown to be "positive", "nonnegative", …, where SymPy does not know it.
    elsewhere
        Functions whose values somebody else has shown to be of their kind wherever they are taken.

    Raises
    ------
    NotOfKind
        If a value is not known to be what its letter was declared to be; for a function at all real arguments.
    InputError
        If a function is not written as applied to distinct symbols.

    Examples
    --------
    >>> x, c = sp.symbols("x c", real=True)
    >>> Substitution({c: x}).into(sp.Derivative(c * x, x)).doit()
    x
    """

    values: Mapping[Any, Any]
    has_sign: Callable[[sp.Expr, str], bool] = field(default=lambda value, sign: False, repr=False, compare=False)
    elsewhere: Collection[Any] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", {key: sp.sympify(value) for key, value in self.values.items()})
        for letter, value in self.values.items():
            if isinstance(letter, AppliedUndef):
                if len(set(letter.args)) != len(letter.args) or not all(isinstance(x, sp.Symbol) for x in letter.args):
                    raise InputError(
                        f"the value of a function is given for it applied to distinct symbols, not for {letter}"
                    )
                if letter in self.elsewhere:
                    continue
                if any(not need.settled for need in obligations(everywhere(letter, value))):
                    raise NotOfKind(f"{value} is not known to be defined for all arguments of {letter}")
            if not is_kind(letter, value, self.has_sign, _real_where_defined):
                raise NotOfKind(f"{value} is not known to be what {letter} stands for")

    @cached_property
    def domain(self) -> tuple[Obligation, ...]:
        """What has to hold for the values of the symbols to be defined."""
        values = [value for letter, value in self.values.items() if isinstance(letter, sp.Symbol)]
        return tuple(need for value in values for need in obligations(value) if not need.settled)

    def into(self, expression: sp.Expr) -> sp.Expr:
        """The expression with the values put in; limits, integrals and derivatives are not carried out."""
        return _put(sp.sympify(expression), *self._split())

    def relation(self, relation: Relation) -> Relation:
        """Both sides with the values put in."""
        return relation.map(self.into)

    def quantified(self, item: ForAll) -> ForAll:
        """An assumption for all values of its variables, which stay what they are: it says nothing about a free letter.

        Raises
        ------
        InputError
            If a value would be caught by the quantifier.
        """
        symbols, functions = self._split()
        said = list(expressions_of([item]))
        within = set().union(*(side.free_symbols for side in said)) - set(item.variables)
        called = {node.func for side in said for node in side.atoms(AppliedUndef)}
        symbols = {letter: value for letter, value in symbols.items() if letter in within}
        functions = {function: value for function, value in functions.items() if function in called}
        if caught := _free(symbols.values(), functions) & set(item.variables):
            names = ", ".join(sorted(map(str, caught)))
            raise InputError(f"a value with {names} would be caught by the quantifier of {item}")

        def change(relation: Relation) -> Relation:
            return relation.map(lambda side: _put(sp.sympify(side), symbols, functions))

        return ForAll(item.variables, change(item.relation), tuple(map(change, item.domain)))

    def _split(self) -> tuple[dict[sp.Symbol, sp.Expr], Functions]:
        """The values of symbols, and those of functions with the letters in which they are written."""
        symbols = {letter: value for letter, value in self.values.items() if isinstance(letter, sp.Symbol)}
        functions = {
            letter.func: (letter, value) for letter, value in self.values.items() if isinstance(letter, AppliedUndef)
        }
        return symbols, functions


def holds_at(relations: Iterable[Relation], values: Mapping[Any, Any]) -> bool:
    """Whether exact values are ones that their letters may have, and certainly satisfy all the relations."""
    try:
        there = Substitution(values)
    except NotOfKind:
        return False
    return all(holds(there.relation(relation)) for relation in relations)


def replaced(expression: sp.Expr, equal: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    """The expression with symbols and values of functions exchanged for what is assumed to be equal to them.

    Two values agree, not two functions: what is applied to an argument is not replaced under a derivative, an
    integral or a limit, where the argument may be another one. Kinds are not asked: equal values are of both.
    """
    symbols = {letter: value for letter, value in equal.items() if isinstance(letter, sp.Symbol)}
    masks: dict[sp.Expr, sp.Expr] = {}
    traversal = sp.preorder_traversal(expression)
    for node in traversal:
        if isinstance(node, BINDERS):
            masks.setdefault(node, sp.Dummy("bound", real=True))
            traversal.skip()
    outside = expression.xreplace(masks).xreplace(dict(equal))
    return outside.xreplace({mask: _put(node, symbols, {}) for node, mask in masks.items()})


Functions = Mapping[Any, tuple[AppliedUndef, sp.Expr]]


def _put(node: sp.Basic, symbols: Mapping[sp.Symbol, sp.Expr], functions: Functions) -> Any:
    if isinstance(node, sp.Symbol):
        return symbols.get(node, node)
    if not node.args:
        return node
    free, called = _within(node)
    if free.isdisjoint(symbols) and called.isdisjoint(functions):
        return node
    match node:
        case sp.Derivative() if not all(isinstance(variable, sp.Symbol) for variable in node.variables):
            return _put(_by_a_letter(node), symbols, functions)
        case sp.Derivative():
            return _put_derivative(node, symbols, functions)
        case sp.Integral() | sp.Sum() | sp.Product():
            return _put_limits(node, symbols, functions)
        case sp.Limit():
            inside, variable, point, side = node.args
            new, within = _entered(variable, symbols, functions, inside)
            return sp.Limit(_put(inside, within, functions), new, _put(point, symbols, functions), side)
        case sp.Subs():
            points = [_put(point, symbols, functions) for point in node.point]
            within, names = dict(symbols), []
            for variable in node.variables:
                new, within = _entered(variable, within, functions, node.expr)
                names.append(new)
            return sp.Subs(_put(node.expr, within, functions), names, points)
    if isinstance(node, sp.Lambda) or getattr(node, "bound_symbols", None):
        raise InputError(f"values cannot be put into {node}")
    arguments = [_put(argument, symbols, functions) for argument in node.args]
    if isinstance(node, AppliedUndef) and node.func in functions:
        letter, value = functions[node.func]
        return _put(value, dict(zip(letter.args, arguments, strict=True)), {})
    return node.func(*arguments)


@lru_cache(maxsize=2**14)
def _within(node: sp.Basic) -> tuple[frozenset[sp.Symbol], frozenset[Any]]:
    """The free symbols of a node, and the undefined functions that are applied in it."""
    own = {node.func} if isinstance(node, AppliedUndef) else set()
    parts = [_within(entry) for entry in node.args]
    called = frozenset(own.union(*(called for _, called in parts)))
    if type(node).free_symbols is sp.Basic.free_symbols:  # nothing is bound here
        return frozenset[sp.Symbol]().union(*(free for free, _ in parts)), called
    return frozenset(node.free_symbols), called


def _entered(
    variable: sp.Symbol, symbols: Mapping[sp.Symbol, sp.Expr], functions: Functions, inside: sp.Basic
) -> tuple[sp.Symbol, dict[sp.Symbol, sp.Expr]]:
    """The name of a bound variable, another one where a value would be caught by it, and the values inside."""
    within = {letter: value for letter, value in symbols.items() if letter != variable}
    if variable in _free(within.values(), functions):
        new = _fresh(variable, [inside, *within.values(), *within, *(value for _, value in functions.values())])
        return new, within | {variable: new}
    return variable, within


def _free(values: Iterable[sp.Expr], functions: Functions) -> set[sp.Symbol]:
    """The symbols that would be caught: those of the values, and of functions those that are no arguments."""
    found: set[sp.Symbol] = set().union(*(value.free_symbols for value in values))
    return found.union(*(value.free_symbols - set(letter.args) for letter, value in functions.values()))


def _fresh(variable: sp.Symbol, among: Iterable[sp.Basic]) -> sp.Symbol:
    """A symbol of the same kind under a name that does not occur; the same one for the same question."""
    names = {symbol.name for entry in among for symbol in entry.atoms(sp.Symbol)}
    number = next(i for i in range(1, len(names) + 2) if f"{variable.name}_{i}" not in names)
    return sp.Symbol(f"{variable.name}_{number}", **variable.assumptions0)


def _put_limits(node: Any, symbols: Mapping[sp.Symbol, sp.Expr], functions: Functions) -> sp.Expr:
    limits, within = [], dict(symbols)
    for limit in reversed(node.limits):  # the outermost first: the ends of an inner one may depend on it
        if len(limit) != 3:
            raise InputError(f"values cannot be put into {node}, which has no ends")
        variable, *ends = limit
        ends = [_put(end, within, functions) for end in ends]
        new, within = _entered(variable, within, functions, node)
        limits.append((new, *ends))
    return node.func(_put(node.function, within, functions), *reversed(limits))


def _put_derivative(node: sp.Derivative, symbols: Mapping[sp.Symbol, sp.Expr], functions: Functions) -> sp.Expr:
    inside, within = node.expr, dict(symbols)
    names, points, bodies = [], [], [value for _, value in functions.values()]
    for variable, count in node.variable_count:
        caught = variable in within or variable in _free(within.values(), functions)
        value = within.pop(variable, variable)
        new = _fresh(variable, [inside, *within.values(), *within, value, *bodies]) if caught else variable
        if caught:
            within[variable] = new
            points.append((new, value))
        names.append((new, count))
    inside = _put(inside, within, functions)
    # Another letter for the variable is all that happens, where it does not stand for something inside already.
    plain = {
        new: value for new, value in points if value.is_Symbol and value not in inside.free_symbols
        and [point for _, point in points].count(value) == 1
    }  # fmt: skip
    inside = inside.xreplace(plain)
    derivative = sp.Derivative(inside, *((plain.get(name, name), count) for name, count in names))
    left = [(new, value) for new, value in points if new not in plain]
    return sp.Subs(derivative, *zip(*left, strict=True)) if left else derivative


def _by_a_letter(node: sp.Derivative) -> sp.Subs:
    """∂g/∂l(x), as SymPy's chain rule writes it, as a derivative by a letter that then gets the value l(x)."""
    place = node.variables[0]
    if set(node.variables) != {place} or not isinstance(place, AppliedUndef) or not place.is_real:
        raise InputError(f"values cannot be put into {node}, a derivative by what is not one function")
    if node.expr.has(*BINDERS):
        raise InputError(f"values cannot be put into {node}, where it may be asked whether {place} varies")
    letter = _fresh(sp.Symbol(place.func.__name__, real=True), [node.expr])
    return sp.Subs(sp.Derivative(node.expr.xreplace({place: letter}), (letter, len(node.variables))), letter, place)
