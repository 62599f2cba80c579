"""Powers and frequencies of dithers, and signs of unknown functions, from TOML; every error names the key."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, cast

import sympy as sp

from ptproof.averaging.exponents import check_linear
from ptproof.averaging.powers import PoweredProblem, PoweredSystem
from ptproof.averaging.problem import DitherProblem
from ptproof.errors import InputError
from ptproof.proof.declarations import SIGNS
from ptproof.proof.statement import Relation, RelationSign
from ptproof.reading.expressions import quoted
from ptproof.reading.tables import check_choice, check_known, finite, listed

_PLAIN = sp.Rational(1, 2)
_SIGNED = ("of", "sign")


def frequencies_of_dithers(dithers: Sequence[Mapping[str, Any]]) -> list[sp.Rational]:
    """The frequency of each dither, a positive rational number, 1 where none is given."""
    result = []
    for i, dither in enumerate(dithers, start=1):
        where = f"system.dither[{i}].frequency"
        value = finite(dither.get("frequency", 1), where)
        if not (value.is_Rational and value > 0):
            raise InputError(f"{where}: expected a positive rational number, got {quoted(dither['frequency'])}")
        result.append(cast(sp.Rational, value))
    return result


def with_order(
    problem: DitherProblem, system: Mapping[str, Any], parameters: Sequence[sp.Symbol]
) -> DitherProblem | PoweredProblem:
    """The problem as it is, or with the powers, conditions and order that the table ``system`` gives."""
    order = system.get("order", 1)
    if isinstance(order, bool) or order not in (1, 2):
        raise InputError(f"system.order: expected 1 or 2, got {quoted(order)}")
    powers = []
    for i, dither in enumerate(system["dither"], start=1):
        where = f"system.dither[{i}].power"
        power = finite(dither.get("power", str(_PLAIN)), where, parameters)
        powers.append(check_linear(power, where))
    conditions = _conditions(system.get("conditions", []), parameters)
    if order == 1 and all(power == _PLAIN for power in powers):
        if conditions:
            raise InputError("system.conditions: there are no powers with parameters that they could be about")
        return problem
    if problem.fast is not None:
        raise InputError("system.fast: fast states are for dithers of the power 1/2 and for order = 1")
    try:
        powered = PoweredSystem(problem.system, tuple(powers), conditions)
    except InputError as error:
        raise InputError(f"system.dither: {str(error).removeprefix(f'{problem.system.name}: ')}") from None
    return PoweredProblem(
        powered,
        order,
        problem.functions,
        dict(problem.region),
        problem.start,
        problem.bounded,
        problem.expected,
    )


def _conditions(value: Any, parameters: Sequence[sp.Symbol]) -> tuple[Relation, ...]:
    """Relations such as ``"1/2 < p"`` or ``"1/2 < p < 1"``."""
    result = []
    for i, text in enumerate(listed(value, "system.conditions"), start=1):
        where = f"system.conditions[{i}]"
        parts = re.split(r"(<=|>=|==|<|>|=)", text) if isinstance(text, str) else []
        if len(parts) < 3:
            raise InputError(f'{where}: expected a relation such as "1/2 < p", got {quoted(text)}')
        sides = [check_linear(finite(side, where, parameters), where) for side in parts[::2]]
        for (left, right), sign in zip(pairwise(sides), parts[1::2], strict=True):
            result.append(Relation(left, cast(RelationSign, sign.replace("==", "=")), right))
    return tuple(result)


def arguments_and_sign(value: Any, where: str) -> tuple[list[Any], str | None]:
    """The arguments of an unknown function and its sign: ``["x"]``, or ``{ of = ["x"], sign = "positive" }``."""
    if not isinstance(value, dict):
        return listed(value, where), None
    check_known(value, _SIGNED, f"key in {where}")
    if "of" not in value:
        raise InputError(f'{where}.of is missing: the arguments of the function, such as of = ["x1", "x2"]')
    sign = check_choice(value["sign"], SIGNS, f"{where}.sign") if "sign" in value else None
    return listed(value["of"], f"{where}.of"), sign
