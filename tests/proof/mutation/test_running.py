"""All mutants of claims: here, in other processes, and where one of these dies."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import claim, eq, exact, load, mutate

x = sp.Symbol("x", real=True)
SQUARE = claim("square", "A square", eq((x + 1) ** 2, x**2 + 2 * x + 1))(exact)
FALSE = claim("false", "False", eq(x, x + 1), expected="refuted")(exact)
TEXT = """
import os
import sympy as sp
from ptproof.proof import claim, eq, exact

x = sp.Symbol("x", real=True)
square = claim("square", "A square", eq((x + 1) ** 2, x**2 + 2 * x + 1))(exact)


@claim("deadly", "Ends its process for one mutant", eq(x + x, 2 * x))
def deadly(goal):
    if goal.statement.left == 4 * x:
        os._exit(3)
    return exact(goal)
"""


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    folder = tmp_path_factory.mktemp("derivation")
    (folder / "claims.py").write_text(TEXT)
    return mutate(load([folder]), workers=1, count=12)


def test_only_what_is_expected_to_be_proved_is_corrupted():
    assert [item.id for item in mutate([SQUARE, FALSE], count=3).claims] == ["square"]


def test_the_counts_add_up(found):
    for item in found.claims:
        counts = found.counts(item.id)
        assert counts.pop("made") == sum(counts.values()) >= 12


def test_the_order_is_that_of_the_mutants(found):
    here = mutate([SQUARE], count=12)
    assert [item.change for item in found.outcomes["square"]] == [item.change for item in here.outcomes["square"]]


def test_a_process_that_dies_costs_its_mutant_only(found):
    lost = [item for item in found.outcomes["deadly"] if "process" in item.why]
    assert [item.change for item in lost] == ["left: 2*x → 4*x"]
    assert found.counts("deadly")["refuted"] > 5


def test_json(found):
    data = found.to_json()
    assert {"made", "equivalent", "refuted", "undecided", "proved"} <= data["claims"]["square"].keys()
    assert data["summary"]["made"] == sum(item["made"] for item in data["claims"].values())
    assert data["summary"]["false_proved"] == 0


@pytest.mark.parametrize("options", [{"count": 0}, {"workers": 0}, {"timeout": 0}, {"select": "no such text"}])
def test_bad_input(options):
    with pytest.raises(InputError):
        mutate([SQUARE], **options)


def test_nothing_to_corrupt():
    with pytest.raises(InputError, match="nothing to corrupt"):
        mutate([FALSE])
