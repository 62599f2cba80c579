"""The two forms of the quotients agree with their definition, and symmetries are used only where they hold."""

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, enclose, interval, precision
from ptproof.balls.cube import Box, Face, reduced_faces
from ptproof.balls.jet import JETS, variables
from ptproof.balls.rest import line_bound, split_polynomial
from ptproof.balls.tape import Undefined
from ptproof.certify.quotients import Quotients

y = sp.symbols("y1:4", real=True)
a, b, c = y
R = sp.Rational

FIELDS = [
    (a**2 + 2 * b**2 + a * b**2, 2, 1),
    (1 - sp.cos(a) + b**2 + sp.sin(a * b) ** 2, 2, 1),
    (a**2 + b**2 + 1 - sp.exp(-(a**2) * b**2), 2, 1),
    (a**4 + b**4 + a**2 * b**3 + 1 - sp.cos(a * b**2) ** 2, 2, 2),
    (sp.log(1 + a**2 + 2 * b**2 + c**2), 3, 1),
    (1 - sp.cos(a) + a**2, 1, 1),
]
FACES = {1: Face(0, -1, ()), 2: Face(1, -1, ((-1, 1),)), 3: Face(1, 1, ((-1, 1), (-1, 1)))}
POINTS = {1: (), 2: (R(-1, 4),), 3: (R(1, 2), R(-3, 4))}


def by_definition(drop, n, kappa, slope, offset):
    size = sp.sqrt(sum(entry**2 for entry in offset))
    at = dict(zip(y, offset, strict=False))
    if not slope:
        return enclose(drop.subs(at) / size ** (2 * kappa))
    return enclose(sum(sp.diff(drop, z).subs(at) ** 2 for z in y[:n]) / size ** (4 * kappa - 2))


def offset_of(face, v, radius):
    u = [*v[: face.axis], sp.Integer(face.sign), *v[face.axis :]]
    return [radius * entry / sp.sqrt(sum(other**2 for other in u)) for entry in u]


@pytest.mark.parametrize(("drop", "n", "kappa"), FIELDS)
@pytest.mark.parametrize("slope", [False, True])
@pytest.mark.parametrize("outer", [False, True])
def test_every_form_contains_the_quotient(drop, n, kappa, slope, outer):
    face, v, t = FACES[n], POINTS[n], R(1, 8)
    expected = by_definition(drop, n, kappa, slope, offset_of(face, v, 1 / t if outer else t))
    with precision(128):
        quotients = Quotients(drop, y[:n], kappa)
        quotients.vanishing_is_proved = True
        point = [enclose(t), *map(enclose, v)]
        box = Box(
            face, outer, ((arb(1) / 16, arb(3) / 16), *((ball - arb(1) / 8, ball + arb(1) / 8) for ball in point[1:]))
        )
        assert quotients.direct(face, outer, slope)(point, BALLS).overlaps(expected)
        parts = quotients.direct(face, outer, slope, rest=False)(box.balls(), BALLS)
        assert (parts + quotients.direct_rest(box, slope)).contains(expected)
        try:
            main = quotients.leading(face, outer, slope)(box.balls(), BALLS)
        except Undefined:
            assert outer
            assert quotients.polynomial.total_degree() > 2 * kappa
            return
        assert (main + quotients.remainder(box, slope)).contains(expected)


@pytest.mark.parametrize(("drop", "n", "kappa"), FIELDS)
def test_slopes_of_the_quotient_are_its_derivatives(drop, n, kappa):
    face, v = FACES[n], POINTS[n]
    with precision(128):
        quotients = Quotients(drop, y[:n], kappa)
        point = [arb(1) / 2, *map(enclose, v)]
        function = quotients.direct(face, False, True)
        jet = function(variables(point), JETS)
        for index in range(n):
            if jet.slopes[index] is None:
                continue
            step = arb(2) ** -40
            moved = [ball + step * (i == index) for i, ball in enumerate(point)]
            difference = (function(moved, BALLS) - function(point, BALLS)) / step
            assert abs(difference - jet.slopes[index]) < arb("1e-8")


def test_form_at_the_source_is_refused_before_the_order_is_proved():
    quotients = Quotients(a**2, (a,), 1)
    with pytest.raises(Undefined, match="order of vanishing"):
        quotients.leading(FACES[1], False, False)


@pytest.mark.parametrize(
    ("drop", "n", "count"),
    [
        (a**2 + b**2 + sp.exp(-(a**2) - b**2), 2, 1),  # rotations
        (a**2 + b**2 + c**2, 3, 1),
        (a**4 + b**4, 2, 1),  # reflections and the swap
        (a**2 + 2 * b**2, 2, 2),  # reflections
        (a**2 + b**2 + a * b, 2, 1),  # the swap and y -> -y
        (a**2 + 2 * b**2 + a * b, 2, 2),  # y -> -y
        (a**2 + b**2 + a**3 + b**3, 2, 2),  # the swap
        (a**2 + b**2 + a**3, 2, 3),  # one reflection
        (a**2 + 2 * b**2 + a**3 + a * b, 2, 4),  # none
        (a**2, 1, 1),
        (a**2 + a**3, 1, 2),
    ],
)
def test_number_of_faces_that_remain(drop, n, count):
    faces = reduced_faces(drop, y[:n])
    assert len(faces) == count


@pytest.mark.parametrize("drop", [a**2 + b**2 + a**3, a**2 + 2 * b**2 + a * b, a**2 + 2 * b**2])
def test_faces_that_remain_see_every_value(drop):
    # The values on a fine grid of all directions are all taken on the faces that remain.
    def values(faces):
        found = set()
        for face in faces:
            ((low, high),) = face.sides
            for k in range(-4, 5):
                v = R(k, 4)
                if low <= v <= high:
                    u = [v]
                    u.insert(face.axis, sp.Integer(face.sign))
                    found.add(drop.subs(dict(zip(y, u, strict=False))))
        return found

    every = [Face(axis, sign, ((-1, 1),)) for axis in (0, 1) for sign in (1, -1)]
    assert values(reduced_faces(drop, y[:2])) == values(every)


def test_polynomial_part_is_split_off():
    polynomial, rest = split_polynomial(sp.Rational(1, 2) - sp.cos(a) / 2 + (a + b) ** 2, (a, b))
    assert polynomial.as_expr() == a**2 + 2 * a * b + b**2
    assert rest == sp.Rational(1, 2) - sp.cos(a) / 2


def test_huge_power_of_a_sum_is_not_multiplied_out():
    polynomial, rest = split_polynomial((1 + a + b) ** 900 + a**2, (a, b))
    assert polynomial.is_zero
    assert rest.has(sp.Pow)


@pytest.mark.parametrize(
    ("term", "degree"),
    [
        (a**3 * sp.exp(-(a**2)), 0),
        (sp.sin(a), 0),
        (1 / (1 + a**2), 0),
        (a**3 / sp.sqrt(1 + a**4), 1),
        (a * sp.sin(a), 1),
        (sp.log(1 + a**2), R(1, 2)),
    ],
)
def test_bound_over_the_line(term, degree):
    bound = line_bound(term, (a, b))
    assert (bound.index, bound.degree) == (0, degree)
    for z in (-1000, -17, -2, -R(1, 3), 0, 1, R(5, 2), 16, 40, 10**6):
        value = enclose(term, {a: z})
        width = bound.size * enclose(sp.Abs(z) ** degree)
        assert (bound.near + interval(-width.upper(), width.upper())).contains(value)


@pytest.mark.parametrize("term", [a * sp.exp(-b), sp.exp(a), 1 / a, sp.Integer(3)])
def test_no_bound_over_the_line(term):
    assert line_bound(term, (a, b)) is None
