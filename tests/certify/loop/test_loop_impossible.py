"""Problems for which there can be no guarantee, or none is known to make sense: none is given."""

import pytest

from ptproof.certify.loop import certify_loop
from ptproof.problem.reading import read
from ptproof.proof.verdict import Verdict

FILE = """
[field]
variables = ["x1", "x2"]
expression = "{expression}"
source = {source}
kappa = 1
[drift]
{drift}
[seeker]
k = "1.4"
omega = "300"
mu = "0.0001"
T = "1"
{nu}
[initial]
x = {x}
"""
PLAIN = {
    "expression": "-(x1**2 + x2**2)/2", "source": '["0", "0"]', "drift": 'kind = "none"', "nu": 'nu_min = "0.3"',
    "x": '["2", "2"]',
}  # fmt: skip


def verdict(**changes):
    problem = read(FILE.format(**(PLAIN | changes)), "made")
    return certify_loop(problem, tolerance=1.0, workers=1, shapes=("distance",))


def wind(first, second="0"):
    return f'kind = "bounded"\nf = ["{first}", "{second}"]'


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"drift": 'kind = "gradient"\nE = [["1", "0"], ["0", "-9"]]'}, "nothing keeps W"),
        ({"drift": wind("20")}, "nothing keeps W"),
        ({"drift": wind("1/(t - 1/2)")}, "may be zero"),
        ({"drift": wind("sign(t - 1/2)")}, "not shown to be smooth"),
        ({"drift": wind("1/(x1 - 1)")}, "may be zero"),
        ({"drift": wind("1/(1 - t)**3"), "nu": ""}, "may be zero"),
        ({"expression": "(x1**2 - x2**2)/2"}, "not shown to stay"),
        ({"expression": "(x1**2 + x2**2)/2"}, "not shown to stay"),
        ({"expression": "log(4 - x1**2 - x2**2)", "x": '["1.9", "0.5"]'}, "no value around"),
        ({"expression": "-abs(x1) - x2**2"}, "not shown to be smooth"),
        ({"expression": "-(x1**2 - 1)**2/4 - x2**2/2", "source": '["1", "0"]', "x": '["-1", "1"]'}, "not shown to be"),
    ],
)
def test_there_is_no_guarantee(changes, why):
    certificate = verdict(**changes)
    assert certificate.verdict is Verdict.UNDECIDED
    assert certificate.final is None
    assert why in certificate.detail


def test_the_plain_problem_has_one():
    assert verdict().verdict is Verdict.PROVED


def test_nothing_is_said_of_a_long_run_past_an_infinite_gain():
    certificate = verdict(nu="")
    assert certificate.verdict is Verdict.PROVED
    assert certificate.hover is None
    assert "nothing is said of a long run, since the gain is infinite at T" in certificate.detail
