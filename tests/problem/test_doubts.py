"""A stated source that is no maximum is noticed; one that may be a maximum is left alone."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.problem import EXAMPLES, Field, example
from ptproof.problem.doubts import run_doubt, source_doubt

x, y = sp.symbols("x y", real=True)


def of(expression, source=(0, 0)):
    problem = example("saturated")
    return replace(problem, field=Field((x, y), expression, source, 1))


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_papers_examples_are_beyond_doubt(name):
    assert source_doubt(example(name)) is None


@pytest.mark.parametrize(
    ("expression", "source", "words"),
    [
        (-(x**2) - y**2 + x / 1000, (0, 0), "gradient there is (1/1000, 0)"),
        (-(x**2) - y**2, (sp.sqrt(2), 0), "gradient there is (-2*sqrt(2), 0)"),
        (x**2 - y**2, (0, 0), "in a direction of (x)"),
        (-(x**2) - y**2 + 3 * x * y, (0, 0), "in a direction of (x, y)"),
        (sp.cos(x) + sp.cos(y), (sp.pi, 0), "in a direction of (x)"),
    ],
)
def test_what_certainly_is_no_maximum_is_named(expression, source, words):
    found = source_doubt(of(expression, source))
    assert found is not None
    assert words in found


@pytest.mark.parametrize(
    ("expression", "source"),
    [
        (-(x**4) - y**4, (0, 0)),
        (-(x**2) - y**2 + 2 * x * y, (0, 0)),
        (-sp.Abs(x) - sp.Abs(y), (0, 0)),
        (-sp.sqrt(x**2 + y**2), (0, 0)),
        (-(x**2) * (x - 3) * (x - 4) - y**2, (0, 0)),
    ],
)
def test_what_may_be_one_is_left_alone(expression, source):
    assert source_doubt(of(expression, source)) is None


def test_a_field_above_its_value_at_the_source_is_seen_on_the_way():
    problem = of(-(x**2) - y**2)
    assert run_doubt(problem, [-3.0, -1.0, 0.0, 1e-12]) is None
    assert "above the 0 at the stated source" in run_doubt(problem, [-3.0, 0.5])
    assert run_doubt(problem, []) is None
