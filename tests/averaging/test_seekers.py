"""Published extremum seekers, their averages, and near misses that must not pass.

The averages are known from the literature on Lie bracket averaging (bounded update rates, generating functions,
unicycles); each is checked against the definition with dense brackets as well.
"""

from dataclasses import dataclass, replace

import pytest
import sympy as sp

from ptproof.averaging import DitherProblem, average, derive, study
from ptproof.proof.algebra import is_zero
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem, lie_bracket

tau, theta = sp.symbols("tau theta", real=True)
x1, x2 = x = sp.symbols("x1:3", real=True)
omega, k, a, b, Omega = sp.symbols("omega k a b Omega", positive=True)
F = sp.Function("F", real=True)(x1, x2)
G = sp.Function("G", positive=True)(x1, x2)
F1, F2 = sp.diff(F, x1), sp.diff(F, x2)
G1, G2 = sp.diff(G, x1), sp.diff(G, x2)
s, c, R = sp.sin, sp.cos, sp.Rational
SQUARE = sp.Piecewise((1, theta < sp.pi), (-1, True))
QUARTER = sp.Piecewise((1, theta < sp.pi / 2), (-1, theta < 3 * sp.pi / 2), (1, True))
Vector = tuple[sp.Expr, sp.Expr]


@dataclass(frozen=True)
class Seeker:
    """A dither system, its average, and wrong claims about it by name."""

    name: str
    fields: tuple[Vector, ...]
    dithers: tuple[sp.Expr, ...]
    average: Vector
    wrong: dict[str, Vector]
    drift: Vector = (sp.S.Zero, sp.S.Zero)
    period: sp.Expr = 2 * sp.pi

    @property
    def system(self) -> DitherSystem:
        return DitherSystem(tau, theta, omega, x, self.drift, self.fields, self.dithers, self.period, name=self.name)


def along(i: int, value: sp.Expr) -> Vector:
    return (value, sp.S.Zero) if i == 0 else (sp.S.Zero, value)


def phi(value: sp.Expr) -> sp.Expr:
    return sp.sqrt((1 - sp.exp(-value)) / (1 + sp.exp(value)))


def psi(value: sp.Expr) -> sp.Expr:
    return sp.exp(value) + 2 * sp.log(sp.exp(value) - 1)


SEEKERS = [
    Seeker(
        "measurement times cosine, constant times sine, in one coordinate",
        (along(0, sp.S.One * a), along(0, k * F)),
        (c(theta), s(theta)),
        along(0, a * k * F1 / 2),
        {"factor": along(0, a * k * F1), "sign": along(0, -a * k * F1 / 2), "both": (a * k * F1 / 2, a * k * F2 / 2)},
    ),
    Seeker(
        "bounded update rates, one frequency per coordinate",
        (
            along(0, sp.sqrt(a) * c(k * F)),
            along(0, -sp.sqrt(a) * s(k * F)),
            along(1, sp.sqrt(2 * a) * c(k * F)),
            along(1, -sp.sqrt(2 * a) * s(k * F)),
        ),
        (c(theta), s(theta), c(2 * theta), s(2 * theta)),
        (-k * a * F1 / 2, -k * a * F2 / 2),
        {
            "factor": (-k * a * F1, -k * a * F2),
            "sign": (k * a * F1 / 2, k * a * F2 / 2),
            "frequency": (-k * a * F1 / 2, -k * a * F2),
        },
    ),
    Seeker(
        "unicycle with bounded angular velocity",
        ((c(k * F), -s(k * F)), (s(k * F), c(k * F))),
        (c(theta), s(theta)),
        (k * F1 / 2, k * F2 / 2),
        {"factor": (k * F1, k * F2), "sign": (-k * F1 / 2, -k * F2 / 2), "row": (k * F1 / 2, -k * F2 / 2)},
    ),
    Seeker(
        "unicycle that turns slowly at a constant rate",
        (
            (a * c(Omega * tau), a * s(Omega * tau)),
            (k * F * c(Omega * tau), k * F * s(Omega * tau)),
        ),
        (c(theta), s(theta)),
        tuple(
            a * k / 2 * (F1 * c(Omega * tau) + F2 * s(Omega * tau)) * direction
            for direction in (c(Omega * tau), s(Omega * tau))
        ),
        {"averaged slow rotation": (a * k * F1 / 4, a * k * F2 / 4)},
    ),
    Seeker(
        "generating functions sqrt(G) sin(ln G) and sqrt(G) cos(ln G)",
        (along(0, sp.sqrt(G) * s(sp.log(G))), along(0, sp.sqrt(G) * c(sp.log(G)))),
        (c(theta), s(theta)),
        along(0, -G1 / 2),
        {"factor": along(0, -G1), "measurement": along(0, -G * G1 / 2)},
    ),
    Seeker(
        "generating functions that vanish at the optimum",
        (along(1, phi(G) * s(psi(G))), along(1, phi(G) * c(psi(G)))),
        (c(theta), s(theta)),
        along(1, -G2 / 2),
        {"sign": along(1, G2 / 2)},
    ),
    Seeker(
        "equal frequencies with phases, all pairs coupled",
        (along(0, sp.S.One), along(0, F), along(1, sp.S.One), along(1, F)),
        (c(theta), s(theta), c(theta + sp.pi / 3), s(theta + sp.pi / 3)),
        (F1 / 2 + F2 / 4 + sp.sqrt(3) / 4 * F * F2, F1 / 4 + F2 / 2 - sp.sqrt(3) / 4 * F * F1),
        {"dropped cross pair": (F1 / 2, F2 / 2), "measurements do not commute": (F1 / 2 + F2 / 4, F1 / 4 + F2 / 2)},
    ),
    Seeker(
        "square waves a quarter of a period apart",
        (along(0, sp.S.One), along(0, k * F)),
        (SQUARE, QUARTER),
        along(0, -sp.pi / 4 * k * F1),
        {"first harmonic": along(0, -8 / sp.pi**2 * k * F1), "sign": along(0, sp.pi / 4 * k * F1)},
    ),
    Seeker(
        "an unstable drift beside the dither",
        ((c(k * F), -s(k * F)), (s(k * F), c(k * F))),
        (c(theta), s(theta)),
        (x1 + x2 / (1 + tau) ** 2 + k * F1 / 2, -x1 + k * F2 / 2),
        {"drift lost": (k * F1 / 2, k * F2 / 2)},
        drift=(x1 + x2 / (1 + tau) ** 2, -x1),
    ),
    Seeker(
        "slow amplitudes",
        (along(0, sp.S.One), along(0, k * F)),
        (b * c(theta) / (1 + tau), c(tau) * s(theta)),
        along(0, b * c(tau) * k * F1 / (2 * (1 + tau))),
        {"amplitude squared": along(0, b * c(tau) ** 2 * k * F1 / (2 * (1 + tau)))},
    ),
    Seeker(
        "stabilisation with unknown control direction",
        (along(0, b * sp.sqrt(a) * c(k * x1**2)), along(0, -b * sp.sqrt(a) * s(k * x1**2))),
        (c(theta), s(theta)),
        along(0, x1 - k * a * b**2 * x1),
        {"factor": along(0, x1 - 2 * k * a * b**2 * x1), "direction": along(0, x1 - k * a * b * x1)},
        drift=along(0, x1),
    ),
    Seeker(
        "two measurements, each on its own harmonic, with filter states in the drift",
        (along(0, sp.sqrt(2) * c(F)), along(0, -sp.sqrt(2) * s(F)), along(1, F), along(1, sp.S.One)),
        (c(3 * theta), s(3 * theta), c(5 * theta), s(5 * theta)),
        (x2 - F1 / 3, -x2 - F2 / 10),
        {"frequency": (x2 - F1, -x2 - F2 / 2), "swapped": (x2 - F1 / 3, -x2 + F2 / 10)},
        drift=(x2, -x2),
    ),
    Seeker(
        "a triangle wave against a sine",
        (along(0, sp.S.One), along(0, k * F)),
        (2 * sp.asin(s(theta)) / sp.pi, c(theta)),
        along(0, -4 / sp.pi**2 * k * F1),
        {"amplitude squared": along(0, -32 / sp.pi**4 * k * F1)},
    ),
    Seeker(
        "a concrete quadratic field",
        (
            (c(k * (x1**2 + 3 * x2**2)), -s(k * (x1**2 + 3 * x2**2))),
            (s(k * (x1**2 + 3 * x2**2)), c(k * (x1**2 + 3 * x2**2))),
        ),
        (c(theta), s(theta)),
        (k * x1, 3 * k * x2),
        {"factor": (2 * k * x1, 6 * k * x2)},
    ),
]
by_name = pytest.mark.parametrize("seeker", SEEKERS, ids=lambda seeker: seeker.name)
NEAR_MISSES = [
    pytest.param(seeker, wrong, id=f"{seeker.name}-{name}")
    for seeker in SEEKERS
    for name, wrong in seeker.wrong.items()
]


@by_name
def test_the_average_is_the_published_one(seeker: Seeker) -> None:
    for entry, published in zip(average(seeker.system).rhs, seeker.average, strict=True):
        assert is_zero(entry - published)


@by_name
def test_the_average_is_the_definition(seeker: Seeker) -> None:
    derived = derive(seeker.system)
    total = sp.Matrix(seeker.drift)
    for (j, i), value in derived.v.items():
        total += value * sp.Matrix(lie_bracket(seeker.fields[i - 1], seeker.fields[j - 1], x))
    for entry, defined in zip(derived.system.rhs, total, strict=True):
        assert is_zero(entry - defined)


@by_name
def test_the_average_is_readable(seeker: Seeker) -> None:
    slow = set().union(*(entry.atoms(sp.sin, sp.cos) for entry in seeker.average))
    for entry in average(seeker.system).rhs:
        assert entry.atoms(sp.sin, sp.cos) <= slow


@by_name
def test_the_published_average_is_proved(seeker: Seeker) -> None:
    found = study(DitherProblem(seeker.system, expected=seeker.average))
    assert found.expected is not None
    assert found.expected.verdict is Verdict.PROVED


@pytest.mark.parametrize(("seeker", "wrong"), NEAR_MISSES)
def test_a_near_miss_is_refuted_with_a_witness(seeker: Seeker, wrong: Vector) -> None:
    found = study(DitherProblem(seeker.system, expected=wrong))
    assert found.expected is not None
    assert found.expected.verdict is Verdict.REFUTED
    assert found.expected.witness is not None
    assert not found.as_expected


def test_the_gradient_is_recognised() -> None:
    found = study(SEEKERS[2].system)
    assert found.gradient == (k / 2, F)
    assert study(SEEKERS[0].system).gradient is None


def test_states_keep_their_names_and_order() -> None:
    swapped = replace(SEEKERS[2].system, state=(x2, x1))
    assert average(swapped).state == (x2, x1)


def test_only_brackets_that_enter_are_formed() -> None:
    assert set(derive(SEEKERS[1].system).brackets) == {(1, 2), (3, 4)}


def test_a_concrete_field_of_high_degree_is_simplified() -> None:
    degree = (x1 + x2) ** 6 + x1**5 - x2**3 * x1
    system = replace(SEEKERS[2].system, fields=((c(k * degree), -s(k * degree)), (s(k * degree), c(k * degree))))
    for entry, variable in zip(average(system).rhs, x, strict=True):
        assert not entry.has(sp.sin, sp.cos)
        assert is_zero(entry - k * sp.diff(degree, variable) / 2)
