"""Fields that jump or bend have no certified constants where they do, however their derivatives look."""

import json

import pytest
import sympy as sp
from click.testing import CliRunner

from ptproof.certify import certify_field
from ptproof.commands.bounds import bounds
from ptproof.proof.verdict import Verdict

R = sp.Rational
x, y = sp.symbols("x y", real=True)
square = x**2 + y**2
FACTORS = {
    "Piecewise": sp.Piecewise((1, y < 1), (2, True)),
    "three pieces": sp.Piecewise((1, y < -1), (2, y < 1), (3, True)),
    "sign squared": 1 + sp.sign(x) ** 2,
    "Heaviside": 1 + sp.Heaviside(y - 1),
    "floor": 2 + sp.floor(x),
    "Mod": 1 + sp.Mod(x, 1),
    "quotient": 2 + sp.Abs(x - 1) / (x - 1),
    "atan2": 4 + sp.atan2(y, x - 1),
    "pole in atan": 2 + sp.atan(1 / (x - 1)),
    "hidden pole": 5 + sp.atan(1 / (x - 1)) + sp.atan(x - 1),
    "tan in atan": 4 + sp.atan(sp.tan(x)) - x,
    "angle": 5 + sp.atan2(sp.sin(x), sp.cos(x)) - x,
}


DOMAINS = {"ball": {"radius": 2}, "annulus": {"annulus": (R(1, 2), 2)}, "plane": {}}
ELSEWHERE = {
    "annulus": ("Piecewise", "floor", "atan2", "tan in atan"),
    "plane": ("three pieces", "Heaviside", "quotient", "hidden pole"),
}


@pytest.mark.parametrize(
    ("name", "where"),
    [*((name, "ball") for name in FACTORS), *((name, where) for where, some in ELSEWHERE.items() for name in some)],
)
def test_nothing_is_certified_across_a_jump(name, where):
    factor, domain = FACTORS[name], DOMAINS[where]
    # Wide constants are found soon, so that what ought not to be certified would be, if jumps were not seen.
    found = certify_field(-square * factor, [x, y], [0, 0], 1, rtol=1, seconds=0.4, **domain)
    assert found.verdict is not Verdict.PROVED
    assert found.smaller is None or found.smaller.domain.outer <= R(8, 5)


@pytest.mark.parametrize(
    ("expression", "constants"),
    [
        (-square - sp.Max(x - 1, 0) ** 2, {"a1": R(5, 4), "a2": 1, "b1": 2, "b2": 3}),
        (-sp.Piecewise((square, square < 1), (square + (square - 1) ** 2, True)),
         {"a1": R(13, 4), "a2": 1, "b1": 2, "b2": 14}),
    ],
)  # fmt: skip
def test_a_smooth_seam_is_certified(expression, constants):
    found = certify_field(expression, [x, y], [0, 0], 1, radius=2, seconds=20)
    assert found.verdict is Verdict.PROVED
    for name, value in constants.items():
        ends = getattr(found, name)
        assert ends.lower * (1 - 1e-9) <= value <= ends.upper * (1 + 1e-9)


def test_a_kink_at_the_end_of_the_domain_counts():
    bent = -sp.Piecewise((square, square < 1), (2 * square - 1, True))
    assert certify_field(bent, [x, y], [0, 0], 1, radius=1).verdict is Verdict.UNDECIDED
    assert certify_field(bent, [x, y], [0, 0], 1, annulus=(1, 2)).verdict is Verdict.UNDECIDED
    for domain in ({"radius": R(99, 100)}, {"annulus": (R(101, 100), 2)}):
        assert certify_field(bent, [x, y], [0, 0], 1, **domain).verdict is Verdict.PROVED


def test_the_command_names_the_jump():
    arguments = ["--vars", "x,y", "--kappa", "1", "--json", "-(x**2 + y**2)*Piecewise((1, y < 1), (2, True))"]
    result = CliRunner().invoke(bounds, arguments, standalone_mode=False)
    assert result.return_value == 1
    assert json.loads(result.stdout)["verdict"] == "undecided"
    assert "Piecewise((1, y < 1), (2, True)) is not shown to be continuously differentiable" in result.stderr
