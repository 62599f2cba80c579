"""The letters of the loop and those of a problem don't meet: the one gives way, or the other is refused."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.problem.drift import Drift, bounded_drift, gradient_drift, no_drift
from ptproof.problem.field import Field
from ptproof.problem.model import TIME, loop_letters
from ptproof.problem.reading import read

x, y = sp.symbols("x y", real=True)
PLAIN = example("saturated")
FILE = """
[field]
variables = ["NAME", "x2"]
expression = "-(NAME**2 + x2**2)/2"
source = ["0", "0"]
kappa = 1
[drift]
kind = "none"
[seeker]
k = "8"
omega = "100"
mu = "0.001"
T = "1"
nu_min = "0.3"
[initial]
x = ["1", "1"]
"""


def in_letter(name, **assumptions):
    letter = sp.Symbol(name, **assumptions)
    return replace(PLAIN, field=Field((letter, y), -(letter**2) - y**2, (0, 0), 1), drift=no_drift())


def test_every_symbol_of_a_symbolic_loop_is_a_letter_of_the_loop():
    for name in ("pt", "asymptotic", "saturated", "saturated-constant"):
        loop = PLAIN.closed_loop(name, symbolic=True)
        assert {symbol.name for symbol in (loop.time, *loop.parameters)} <= loop_letters()


@pytest.mark.parametrize("name", sorted(loop_letters()))
def test_a_coordinate_has_no_letter_of_the_loop(name):
    for assumptions in ({"real": True}, {}):
        with pytest.raises(InputError, match=rf"field.variables: {name} has a meaning of its own in the loop"):
            in_letter(name, **assumptions)
    with pytest.raises(InputError, match=rf"field.variables: '{name}' has a meaning of its own"):
        read(FILE.replace("NAME", name), "file")


@pytest.mark.parametrize("name", ["theta", "z", "u2", "x1", "x", "omega0", "theta_"])
def test_any_other_letter_is_as_good_as_x(name):
    problem = in_letter(name, real=True)
    for seeker in ("pt", "saturated"):
        loop, plain = problem.closed_loop(seeker), in_letter("w", real=True).closed_loop(seeker)
        back = dict(zip(loop.state, plain.state, strict=True))
        assert tuple(entry.subs(back, simultaneous=True) for entry in loop.rhs) == plain.rhs
    average = problem.averaged(frame="tau")
    back = dict(zip(average.state, in_letter("w", real=True).averaged(frame="tau").state, strict=True))
    assert average.rhs[0].subs(back, simultaneous=True) == in_letter("w", real=True).averaged(frame="tau").rhs[0]
    assert read(FILE.replace("NAME", name), "file").variables[0].name == name


@pytest.mark.parametrize(
    ("drift", "words"),
    [
        (bounded_drift([sp.Symbol("omega", positive=True), 0]), "drift: contains omega"),
        (bounded_drift([sp.sin(sp.Symbol("t")), 0]), "drift: contains t, but may depend on t, x, y alone"),
        (bounded_drift([sp.Symbol("x"), 0]), "with their declarations"),
        (bounded_drift([sp.sin(TIME), 0], bound=abs(x)), "drift.bound: contains x"),
        (gradient_drift([[-1, 0], [0, -1]], -2 * x**2 - y**2, (x, y)), "E∇F of another field"),
        (
            Drift("gradient", (sp.S.Zero, sp.S.Zero), matrix=sp.ImmutableDenseMatrix([[-1, 0], [0, -1]])),
            "another field",
        ),
    ],
)
def test_a_drift_of_something_else_is_refused(drift, words):
    with pytest.raises(InputError, match=words):
        replace(PLAIN, field=Field((x, y), -(x**2) - y**2, (0, 0), 1), drift=drift)


def test_a_drift_of_this_field_is_taken():
    field = Field((x, y), -((x + y) ** 2) - y**2, (0, 0), 1)
    same = gradient_drift([[-1, 0], [2, -1]], sp.expand(field.expression), (x, y))
    for drift in (same, bounded_drift([sp.sin(TIME), sp.cos(x)], bound=sp.sqrt(2))):
        assert replace(PLAIN, field=field, drift=drift).drift == drift
