"""Conditions on gains, initial values and horizons, as an assertion."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import sympy as sp

from ptproof.errors import InputError
from ptproof.testing.failure import SECONDS, assertion, in_time
from ptproof.testing.wording import lines

if TYPE_CHECKING:
    from ptproof.gains import GainData
    from ptproof.gains.answer import Gains
    from ptproof.problem import Problem

__unittest = True
_RELATION = re.compile(r"^([^<>=]+)(<=|>=|<|>)([^<>=]+)$")
_KEY = re.compile(r"\b([a-z_]+)\.([A-Za-z]\w*)")


@assertion
def assert_gain_condition(data: GainData | Problem, condition: str, *, seconds: float = SECONDS) -> str | None:
    """Assert a condition between the data and the quantities that follow from them, decided on exact numbers.

    Parameters
    ----------
    data
        The constants of the field, the drift and the tuning; or a seeking problem, whose constants are certified where
        its average is shown to stay.
    condition
        One of <, <=, > or >= between two expressions in the numbers of ``data`` (``k``, ``T``, ``V0``, …), its
        constants (``kappa``, ``a1``, …) and the keys of :func:`ptproof.gains.gains`: ``"k > asymptotic.k_min"``,
        ``"V0 < critical.V0_threshold"``, ``"clip.residual_bound <= 1/10"``. A threshold that does not exist, since
        the bound holds for every value, counts as infinite. Bounds and thresholds are those of the averaged system;
        the vehicle circles around it at about ``vehicle.hover_radius``.
    seconds
        The time limit. [s]

    Raises
    ------
    AssertionError
        If the condition is false, with the exact value of both sides; or if it is undecided, as where a quantity
        does not apply to these data.
    InputError, TypeError
        For a condition that cannot be read, or a name that is unknown or not given in ``data``.

    Examples
    --------
    >>> from ptproof import FieldBounds, GainData
    >>> from ptproof.testing import assert_gain_condition
    >>> data = GainData(FieldBounds(1, 1, 1, 2, 2), drift_norm=1, k=3)
    >>> assert_gain_condition(data, "k > asymptotic.k_min")
    """
    from ptproof.gains import GainData
    from ptproof.problem import Problem

    if not isinstance(data, GainData | Problem):
        raise TypeError(f"data: expected GainData or a Problem, got {type(data).__name__}")
    if not isinstance(condition, str):
        raise TypeError(f"condition: expected text such as 'k > asymptotic.k_min', got {type(condition).__name__}")
    match = _RELATION.match(condition.strip())
    if match is None:
        raise InputError(f"condition: {condition!r} is not one of <, <=, > or >= between two expressions")
    return in_time(seconds, f"the condition {condition}", lambda: _decide(data, condition, *match.groups()))


def _decide(asked: GainData | Problem, condition: str, left: str, symbol: str, right: str) -> str | None:
    from ptproof.gains.numbers import sign

    undecided = f"the condition {condition} could not be decided: undecided"
    answer, open_question, doubt = _answer(asked)
    if answer is None:
        return lines(undecided, [("reason", open_question)])
    data = answer.data
    keys: dict[str, sp.Expr] = {}
    for section, name in _KEY.findall(condition):
        try:
            found = answer[f"{section}.{name}"]
        except KeyError:
            raise InputError(f"condition: {section}.{name} is not a quantity; see ptproof.gains.gains") from None
        key = f"{section}.{name}"
        if found is not None:
            keys[key] = found.exact
        elif key in answer.unlimited:
            keys[key] = sp.oo
        else:
            return lines(undecided, [(key, f"does not apply: {answer.why[key]}")])
    sides = [_value(text, data, keys) for text in (left, right)]
    for text, value in zip((left, right), sides, strict=True):
        if value.free_symbols:
            raise InputError(f"condition: {text.strip()} is a formula in {value.free_symbols}, not a number")
    try:
        if sp.oo in sides:
            order = (1 if sides[0] is sp.oo else 0) - (1 if sides[1] is sp.oo else 0)
        else:
            order = sign(sides[0] - sides[1])
    except InputError as error:
        return lines(undecided, [("reason", str(error))])
    if {"<": order < 0, "<=": order <= 0, ">": order > 0, ">=": order >= 0}[symbol]:
        open_ones = [(key, reason) for key in keys if (reason := doubt(key)) is not None]
        return lines(undecided, open_ones) if open_ones else None
    gap = sides[0] - sides[1]
    return lines(f"the condition {condition} does not hold: refuted", [
        (left.strip(), _shown(sides[0])), (right.strip(), _shown(sides[1])),
        ("difference", f"{_shown(gap)}  (left - right)" if gap.is_finite else ""),
    ])  # fmt: skip


def _answer(asked: GainData | Problem) -> tuple[Gains | None, str, Callable[[str], str | None]]:
    """All quantities; None, and why, where the constants of a problem are not certain along its average.

    The last says of a key that speaks of all time why it is not certain.
    """
    from ptproof.gains import GainData, gains
    from ptproof.gains.problem import study

    if isinstance(asked, GainData):
        return gains(asked), "", lambda _: None
    found = study(asked)
    assert found.certificate is not None
    if found.answer is None:
        return None, f"the constants of the field are not certified: {found.certificate.summary}", found.doubt
    if not found.applies:
        return None, f"the constants of the field hold {found.condition}, which is not shown", found.doubt
    return found.answer, "", found.doubt


def _value(text: str, data: GainData, keys: Mapping[str, sp.Expr]) -> sp.Expr:
    """A side of the condition: its keys are masked by names that the parser can read."""
    from ptproof.reading.expressions import parse

    masks = {key: key.replace(".", "__") for key in keys}
    masked = _KEY.sub(lambda found: masks[found[0]], text)
    known = {**data.numbers, **{masks[key]: value for key, value in keys.items()}}
    names = {name: sp.Symbol(name, real=True) for name in known}
    value = parse(masked, names, where="condition").subs(
        {names[name]: value for name, value in known.items()}, simultaneous=True
    )
    if value.has(sp.oo, -sp.oo, sp.nan, sp.zoo) and value is not sp.oo:
        raise InputError(f"condition: {text.strip()} has no finite value")
    return value


def _shown(value: sp.Expr) -> str:
    if value.is_Rational or not value.is_finite:
        return str(value)
    exact = str(value)
    return f"{exact} = {sp.N(value, 8)}" if len(exact) <= 80 else str(sp.N(value, 8))
