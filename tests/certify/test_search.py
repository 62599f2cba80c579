"""Certificates against constants worked out by hand, and witnesses that anyone can check."""

import functools
import math
from unittest.mock import patch

import numpy as np
import pytest
import sympy as sp

from ptproof.balls.ball import enclose
from ptproof.certify import certify_field, search
from ptproof.errors import InputError
from ptproof.proof.verdict import Verdict
from ptproof.reading.expressions import parse

pi = sp.pi
R = sp.Rational
SINC_MIN = R("-0.21723362821122165741")  # the smallest sin(u)/u, at u = tan u = 4.4934...


def certify(text, source, kappa=1, seconds=30, **options):
    variables = sp.symbols(f"x1:{len(source) + 1}", real=True)
    expression = parse(text, list(variables))
    return certify_field(expression, variables, [sp.sympify(s) for s in source], kappa, seconds=seconds, **options)


# field, source, κ, domain, and a1, a2, b1, b2 by hand
BY_HAND = {
    "first example of the paper": (
        "5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2", (0, 0), 1, {},
        (R(1, 2) + pi**2 / 9, R(1, 2), 1 + 2 * pi**2 / 9 * SINC_MIN, 1 + 2 * pi**2 / 9),
    ),
    "third example of the paper": (
        "cos(x1) + cos(x2) - (x1**4 + x2**4)/2", (0, 0), 1, {"radius": 1},
        (R(3, 2) - sp.cos(1), R(1, 2), 1, sp.sin(1) + 2),
    ),
    "quadratic, source away from the origin": (
        "-x1**2 + x1*(x2 - 1) - 2*(x2 - 1)**2", (0, 1), 1, {},
        ((3 + sp.sqrt(2)) / 2, (3 - sp.sqrt(2)) / 2, 3 - sp.sqrt(2), 3 + sp.sqrt(2)),
    ),
    "quartic": ("-x1**4 - 2*x2**4 - x1**2*x2**2", (0, 0), 2, {}, (2, R(7, 8), R(7, 2), 8)),
    "quartic, source away from the origin": (
        "-(x1 - 1)**4 - 2*(x2 + 1/2)**4", (1, R(-1, 2)), 2, {}, (2, R(2, 3), R(8, 3), 8),
    ),
    "mixed degrees": ("-x1**2 - x2**2 - x1**2*x2**2", (0, 0), 1, {"radius": 1}, (R(5, 4), 1, 2, 3)),
    "double well": ("-(x1**2 - 1)**2", (1,), 1, {"radius": R(1, 2)}, (R(25, 4), R(9, 4), 3, 15)),
    "cosine": ("cos(x1)", (0,), 1, {"radius": 3}, (R(1, 2), (1 - sp.cos(3)) / 9, sp.sin(3) / 3, 1)),
    "irrational source": (
        "sin(x1)", (pi / 2,), 1, {"radius": 3}, (R(1, 2), (1 - sp.cos(3)) / 9, sp.sin(3) / 3, 1),
    ),
    "transcendental, far source, whole line": (
        "-(x1 - 100)**2 - sin(x1 - 100)**2/2", (100,), 1, {}, (R(3, 2), 1, 2 + SINC_MIN, 3),
    ),
    "bounded perturbations": ("-x1**2 - atan(x1)**2 - tanh(x1)**2", (0,), 1, {}, (3, 1, 2, 6)),
    "Gaussian in three dimensions": (
        "exp(-x1**2 - x2**2 - x3**2)", (0, 0, 0), 1, {"radius": 1}, (1, 1 - sp.exp(-1), 2 * sp.exp(-1), 2),
    ),
    "logarithm": (
        "-log(1 + x1**2 + 2*x2**2)", (0, 0), 1, {"radius": 1}, (2, sp.log(2), 1, 4),
    ),
    "root of a square": (
        "-sqrt(1 + x1**2 + x2**2)", (0, 0), 1, {"radius": 10},
        (R(1, 2), (sp.sqrt(101) - 1) / 100, 1 / sp.sqrt(101), 1),
    ),
    "annulus, where a kink at the source does no harm": (
        "-Abs(x1)**3 - x1**2", (0,), 1, {"annulus": (R(1, 2), 3)}, (4, R(3, 2), R(7, 2), 11),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BY_HAND)
def test_enclosures_contain_the_constants_by_hand(name):
    text, source, kappa, domain, expected = BY_HAND[name]
    certificate = certify(text, source, kappa, **domain)
    assert certificate.verdict is Verdict.PROVED, certificate.detail
    for constant, value in zip(("a1", "a2", "b1", "b2"), expected, strict=True):
        ends = getattr(certificate, constant)
        exact = float(enclose(value).mid())
        assert ends.lower <= exact * (1 + 1e-12), constant
        assert ends.upper >= exact * (1 - 1e-12), constant
        assert ends.width <= 1e-3, constant


def test_width_is_what_was_asked_for():
    certificate = certify("cos(x1)", (0,), radius=3, rtol=1e-6)
    assert certificate.verdict is Verdict.PROVED
    assert all(getattr(certificate, name).width <= 1e-6 for name in ("a1", "a2", "b1", "b2"))
    assert abs(certificate.a1.lower - 0.5) < 1e-6


SAMPLED = [
    ("-(1 - x1)**2 - 5*(x2 - x1**2)**2", (1, 1), 1, {"radius": R(1, 2)}),
    ("-x1**2 - 3*x2**2 - x3**2 + sin(x3)**2/2 - sin(x1*x2)/4", (0, 0, 0), 1, {"radius": 1}),
    ("-x1**2 - x2**2 - x3**2 - x1*x2*x3/5", (0, 0, 0), 1, {"radius": 2}),
    ("-(2 + sin(x1))*x1**2 - cosh(x2)", (0, 0), 1, {"radius": 2}),
    ("-x1**4 - x1**3*x2 - x2**4 - x1**6", (0, 0), 2, {"annulus": (R(1, 3), 1)}),
]


@pytest.mark.parametrize(("text", "source", "kappa", "domain"), SAMPLED)
def test_no_sampled_point_is_outside_the_certified_constants(text, source, kappa, domain):
    certificate = certify(text, source, kappa, rtol=1e-2, **domain)
    assert certificate.verdict is Verdict.PROVED, certificate.detail
    field = certificate.field
    generator = np.random.default_rng(7)
    rows = generator.normal(size=(len(source), 20_000))
    outer = float(certificate.domain.outer)
    radii = generator.uniform(max(float(certificate.domain.inner), 0.02), outer, 20_000)
    points = np.array([float(s) for s in source])[:, None] + radii * rows / np.linalg.norm(rows, axis=0)
    drop = float(field.peak) - sp.lambdify(field.variables, field.expression)(*points)
    slopes = sp.lambdify(field.variables, list(field.gradient))(*points)
    value = drop / radii ** (2 * kappa)
    slope = np.sqrt(sum(np.square(part) for part in slopes)) / radii ** (2 * kappa - 1)
    assert certificate.a2.lower * (1 - 1e-9) <= value.min()
    assert value.max() <= certificate.a1.upper * (1 + 1e-9)
    assert certificate.b1.lower * (1 - 1e-9) <= slope.min()
    assert slope.max() <= certificate.b2.upper * (1 + 1e-9)
    # The bounds are sharp, too: samples come near them.
    assert value.min() < certificate.a2.upper * 1.1
    assert slope.max() > certificate.b2.lower * 0.9


# field, source, κ, domain, part of the statement, and between what the largest radius must lie (None: no ball)
REFUTED = {
    "third example on the plane": (
        "cos(x1) + cos(x2) - (x1**4 + x2**4)/2", (0, 0), 1, {}, "tends to ∞ for r → ∞", (1000, math.inf)),
    "third example with κ = 2": (
        "cos(x1) + cos(x2) - (x1**4 + x2**4)/2", (0, 0), 2, {}, "tends to ∞ for r → 0", None),
    "third example with κ = 3": (
        "cos(x1) + cos(x2) - (x1**4 + x2**4)/2", (0, 0), 3, {}, "tends to ∞ for r → 0", None),
    "first example with κ = 2": (
        "cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2", (0, 0), 2, {}, "tends to ∞ for r → 0", None),
    "flat in one direction": (
        "-(x1 - 1)**2 - 2*(x2 + 1/2)**4", (1, R(-1, 2)), 1, {}, "tends to 0 for r → 0", None),
    "flat in an irrational direction": (
        "-(x1 - sqrt(2)*x2)**2 - x2**4", (0, 0), 1, {"radius": 1}, "tends to 0 for r → 0", None),
    "too flat": ("-x1**4", (0,), 1, {"radius": 1}, "tends to 0 for r → 0", None),
    "cubic term": ("-x1**4 + x1**3", (0,), 2, {"radius": 1}, "at another point", None),
    "gradient at the source": ("-x1**2 - x2**2 + x1/100", (0, 0), 1, {"radius": 1}, "F(x*) at another point", None),
    "saddle": ("x1**2/1000 - x2**2", (0, 0), 1, {"radius": 1}, "at another point", None),
    "source shifted": (
        "-(x1**2 - 1)**2 + x1/10 - 1/10", (1,), 1, {}, "the gradient at the source is not zero", None),
    "logarithmic growth": ("-log(1 + x1**2 + x2**2)", (0, 0), 1, {}, "tends to 0 for r → ∞", (1000, math.inf)),
    "bounded field": ("exp(-x1**2 - x2**2)", (0, 0), 1, {}, "tends to 0 for r → ∞", (10, math.inf)),
    "linear growth": ("-sqrt(1 + x1**2 + x2**2)", (0, 0), 1, {}, "tends to 0 for r → ∞", (1000, math.inf)),
    "exponential growth": ("1 - cosh(x1)", (0,), 1, {}, "tends to ∞ for r → ∞", (100, math.inf)),
    "gradient too steep far out": ("-x1**2 - x2**2 - x1*x2**2", (0, 0), 1, {}, "tends to ∞ for r → ∞", (1.7, 3**0.5)),
    "valley in a skew direction": (
        "-(x1 - 2*x2)**2 - x2**2/(1 + x2**2)", (0, 0), 1, {}, "tends to 0 for r → ∞", (1, math.inf)),
    "steep only beside the axis": (
        "-x1**2 - x2**2 - x1**2*exp(-x2**2)/4", (0, 0), 1, {}, "along a ray beside the source", (1, math.inf)),
    "second critical point, exact": ("-(x1**2 - 1)**2", (1,), 1, {"radius": R(3, 2)}, "critical", (0.99, 1)),
    "second critical point, enclosed": ("cos(x1)", (0,), 1, {"radius": 4}, "critical", (3.1, math.pi)),
    "critical circle": (
        "-(x1**2 + x2**2)*(1 + (x1**2 + x2**2 - 1)**2/3 - 13*(x1**2 + x2**2)/20)", (0, 0), 1, {"radius": 1},
        "critical", (0.82, 0.8271)),
    "equally high point": ("-x1**2*(x1 - 2)**2", (0,), 1, {"radius": 3}, "critical", (0.99, 1)),
    "higher point": ("-x1**2 + x1**4", (0,), 1, {"radius": 2}, "at another point", (0.7, 0.7072)),
    "pole": ("-x1**2/(1 - x1/3)**2", (0,), 1, {"radius": 4}, "not defined", (2.9, 3)),
    "three dimensions": (
        "-x1**2 - x2**2 - x3**2 + 2*x1*x2*x3", (0, 0, 0), 1, {"radius": 3}, "critical", (1, 3**0.5)),
}  # fmt: skip


@functools.cache
def refuted(name):
    text, source, kappa, domain, _statement, _radius = REFUTED[name]
    with patch.object(search, "SMALLER_SHARE", 0.02):  # the constants up to the radius are of no interest here
        return certify(text, source, kappa, seconds=4, **domain)


@pytest.mark.parametrize("name", REFUTED)
def test_refuted_with_a_witness_and_the_radius_that_works(name):
    statement, radius = REFUTED[name][-2:]
    certificate = refuted(name)
    assert certificate.verdict is Verdict.REFUTED, certificate.detail
    assert statement in certificate.witness.statement
    if radius is None:
        assert certificate.largest_radius is None
        assert "no ball around it works" in certificate.summary
    else:
        assert radius[0] <= certificate.largest_radius <= radius[1]


@pytest.mark.parametrize(
    "name", [name for name, row in REFUTED.items() if any(word in row[4] for word in ("point", "gradient", "circle"))]
)
def test_witness_can_be_checked_by_hand(name):
    domain, certificate = REFUTED[name][3], refuted(name)
    field = certificate.field
    texts = certificate.witness.values.values()
    if any("±" in entry for entry in texts):
        point = {x: float(entry.split("±")[0]) for x, entry in zip(field.variables, texts, strict=True)}
        assert max(abs(float(entry.subs(point))) for entry in field.gradient) < 1e-6
    else:
        point = {x: sp.sympify(entry) for x, entry in zip(field.variables, texts, strict=True)}
        at_critical_point = all(sp.simplify(entry.subs(point)) == 0 for entry in field.gradient)
        assert at_critical_point or field.value(point) >= field.peak
    offset = [float(point[x]) - float(s) for x, s in zip(field.variables, field.source, strict=True)]
    assert 0 < math.hypot(*offset) <= float(domain.get("radius", math.inf))


@pytest.mark.parametrize(
    ("text", "source", "kappa", "domain", "detail"),
    [
        ("-Abs(x1)**3", (0,), 1, {"radius": 1}, "kink"),
        ("-(x1**2 + x2**2)**(3/2)", (0, 0), 1, {"radius": 1}, "smooth"),
        ("-x1**2 + floor(x1)", (0,), 1, {"radius": 1}, "floor(x1) is not shown"),
    ],
)
def test_what_has_no_enclosure_is_undecided(text, source, kappa, domain, detail):
    certificate = certify(text, source, kappa, **domain)
    assert certificate.verdict is Verdict.UNDECIDED
    assert detail in certificate.detail


def test_out_of_time_is_undecided_and_the_ends_are_rigorous_all_the_same():
    x, y = sp.symbols("x1 x2", real=True)
    field = parse("5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2", [x, y])
    certificate = certify_field(field, (x, y), (0, 0), 1, seconds=0.02)
    assert certificate.verdict is Verdict.UNDECIDED
    assert "boxes" in certificate.detail
    for name, value in (("a1", 0.5 + math.pi**2 / 9), ("a2", 0.5), ("b2", 1 + 2 * math.pi**2 / 9)):
        ends = getattr(certificate, name)
        assert ends.lower is None or ends.lower <= value * (1 + 1e-12)
        assert ends.upper is None or ends.upper >= value * (1 - 1e-12)


def test_progress_is_told():
    told = []
    certify("-x1**2", (0,), progress=told.append)
    assert any("a1" in text for text in told)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"radius": 0}, "larger than 0"),
        ({"radius": -1}, "larger than 0"),
        ({"radius": 0.5}, "exact"),
        ({"radius": sp.oo}, "exact real"),
        ({"radius": sp.Symbol("r")}, "exact real"),
        ({"annulus": (2, 1)}, "larger than 2"),
        ({"annulus": (-1, 1)}, "not be negative"),
        ({"radius": 1, "annulus": (1, 2)}, "not both"),
        ({"rtol": 0}, "relative width"),
        ({"rtol": float("nan")}, "relative width"),
        ({"kappa": 0}, "kappa"),
    ],
)
def test_bad_input_is_refused(options, message):
    with pytest.raises(InputError, match=message):
        certify("-x1**2", (0,), **options)


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf")])
def test_time_limit_must_make_sense(seconds):
    x = sp.Symbol("x", real=True)
    with pytest.raises(InputError, match="time limit"):
        certify_field(-(x**2), (x,), (0,), 1, seconds=seconds)


@pytest.mark.parametrize("rtol", [1.0, 0.1])
@pytest.mark.parametrize("text", ["5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2", "-exp(x1) + x1 - x2**2 - x1**2/3"])
def test_a_wide_tolerance_is_reached_like_a_narrow_one(text, rtol):
    found = certify(text, (0, 0), 1, radius=2, rtol=rtol)
    assert found.verdict is Verdict.PROVED
    assert all(getattr(found, name).width <= rtol for name in ("a1", "a2", "b1", "b2"))


@pytest.mark.parametrize("radius", [R(7, 2), 4])
def test_a_value_that_is_certainly_negative_at_once_has_its_witness(radius):
    found = certify("-x1**2 - x1**3/3", (0,), 1, radius=radius)
    assert found.verdict is Verdict.REFUTED
    assert found.witness is not None
    assert R(199, 100) <= found.largest_radius < 2
