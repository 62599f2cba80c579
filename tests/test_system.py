"""Systems as values: what can't be built, brackets, substitution."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.system import DitherSystem, System, lie_bracket
from ptproof.transforms.reduction import split

t, x1, x2, z, phase, omega, mu = sp.symbols("t x1 x2 z phase omega mu", real=True)
k = sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)(x1, x2)


@pytest.mark.parametrize(
    "arguments",
    [
        (t, (x1, x2), (x1,)),
        (t, (x1, x1), (1, 2)),
        (x1, (x1,), (1,)),
        (t, (x1,), (k * x1,), ()),
    ],
)
def test_malformed_system_cannot_exist(arguments: tuple[object, ...]) -> None:
    with pytest.raises(InputError):
        System(*arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "changes",
    [
        {"drift": (0, 0)},
        {"fields": ((1, 1),)},
        {"fields": ((sp.cos(phase),),)},
        {"dithers": (x1,)},
        {"dithers": ()},
        {"period": -1},
        {"time": x1},
    ],
)
def test_malformed_dither_system_cannot_exist(changes: dict[str, object]) -> None:
    good: dict[str, object] = {
        "time": t, "phase": phase, "omega": omega, "state": (x1,), "drift": (0,), "fields": ((1,),),
        "dithers": (sp.cos(phase),),
    }  # fmt: skip
    DitherSystem(**good)  # type: ignore[arg-type]
    with pytest.raises(InputError):
        DitherSystem(**{**good, **changes})  # type: ignore[arg-type]


def test_parameters_are_collected_by_name() -> None:
    assert System(t, (x1,), (k * x1 + mu,)).parameters == (k, mu)


def test_bracket_has_the_sign_of_averaging() -> None:
    # [f, g] = (∂g/∂x) f − (∂f/∂x) g
    assert lie_bracket((sp.Integer(1),), (x1**2,), (x1,)) == (2 * x1,)


def test_derivative_along_includes_time() -> None:
    assert System(t, (x1,), (x2,), parameters=(x2,)).derivative_along(t * x1) == x1 + t * x2


def test_undefined_function_is_replaced_inside_derivatives() -> None:
    system = System(t, (x1, x2), (sp.diff(F, x1), F)).with_values({F: x1**2 * x2})
    assert system.rhs == (2 * x1 * x2, x1**2 * x2)


def test_linearization() -> None:
    system = System(t, (x1, x2), (x1 * x2, sp.sin(x1)))
    assert system.linearization({x1: 0, x2: 3}) == sp.Matrix([[3, 0], [1, 0]])


def test_split_finds_the_unique_quasi_steady_state() -> None:
    parts = split(System(t, (x1, z), (-z, (x1**2 - z) / mu)), [z], mu)
    assert parts.quasi_steady_state == (x1**2,)
    assert parts.unique
    assert parts.reduced_model().rhs == (-(x1**2),)


@pytest.mark.parametrize(
    ("rate", "message"),
    [
        ((x1 - z**2) / mu, "not unique"),
        ((1 + z**2) / mu, "no quasi-steady state"),
        ((x1 - z) / mu**2, "not of the form"),
    ],
)
def test_split_refuses(rate: sp.Expr, message: str) -> None:
    with pytest.raises(InputError, match=message):
        split(System(t, (x1, z), (-z, rate)), [z], mu)


def test_a_system_shows_itself_as_a_formula() -> None:
    assert r"\mathrm{d}" in System(t, (x1,), (-k * x1,))._repr_latex_()
