"""`ptproof mutate`: what it prints, and with which status it ends."""

import json

from click.testing import CliRunner

from ptproof.commands.mutate import mutate
from ptproof.errors import InputError
from ptproof.proof.algebra import is_zero

TRUE = """
import sympy as sp
from ptproof.proof import claim, eq, exact

x = sp.Symbol("x", real=True)
SECTION = "One section"
square = claim("square", "A square", eq((x + 1) ** 2, x**2 + 2 * x + 1))(exact)
"""
SABOTAGED = f"""
import ptproof.proof.engines.exact

ptproof.proof.engines.exact.is_zero = lambda expression: True
{TRUE}
"""


def ran(tmp_path, text, *options):
    file = tmp_path / "claims.py"
    file.write_text(text)
    return CliRunner().invoke(mutate, [str(file), "--jobs", "1", *options], standalone_mode=False)


def test_json_and_nothing_else_on_standard_output(tmp_path):
    done = ran(tmp_path, TRUE, "--json")
    data = json.loads(done.stdout)
    assert done.return_value == 0
    assert data["claims"]["square"]["refuted"] > data["claims"]["square"]["undecided"]


def test_a_table_for_people(tmp_path):
    done = ran(tmp_path, TRUE)
    assert "One section" in done.stdout
    assert "0 false and proved" in done.stdout


def test_status_1_and_the_false_ones_first_where_an_engine_proves_anything(tmp_path, monkeypatch):
    monkeypatch.setattr("ptproof.proof.engines.exact.is_zero", is_zero)  # what the file does is undone afterwards
    done = ran(tmp_path, SABOTAGED)
    assert done.return_value == 1
    assert done.stdout.startswith("✗ false, and proved: square")


def test_a_selection_that_is_empty(tmp_path):
    assert isinstance(ran(tmp_path, TRUE, "-k", "nothing like it").exception, InputError)
