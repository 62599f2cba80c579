"""``ptproof report`` as a whole, with real workers."""

import pytest

from ptproof.commands.cli import main

GOOD = '''
import sympy as sp
from ptproof.proof.claim import claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq

x = sp.Symbol("x", real=True)

@claim("c/one", "A sum", eq(x + x, {right}))
def one(goal):
    """Add."""
    return exact(goal)
'''
FIGURES = """
from ptproof.report.content import Figure, Table

def figures():
    {body}
    return [Figure(name="f", caption="A figure.", content=b"<svg xmlns='http://www.w3.org/2000/svg'/>")]

def tables():
    return [Table("T", "C", ("a",), (("1",),))]
"""


def status(*arguments):
    with pytest.raises(SystemExit) as ended:
        main(["report", "--jobs", "1", *map(str, arguments)])
    return ended.value.code


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "derivation"
    folder.mkdir()
    (folder / "claims.py").write_text(GOOD.replace("{right}", "2 * x"))
    return folder


def test_a_report_is_written_and_its_place_named(folder, tmp_path, capsys):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    assert status(folder, "--out", tmp_path / "out") == 0
    files = {str(path.relative_to(tmp_path / "out")) for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert {"index.html", "report.md", "graph.svg", "figures/f.svg"} <= files
    assert str(tmp_path / "out" / "index.html") in capsys.readouterr().out
    assert str(tmp_path) not in (tmp_path / "out" / "index.html").read_text()


def test_what_is_unexpected_is_status_1_and_the_report_is_written(folder, tmp_path):
    (folder / "claims.py").write_text(GOOD.replace("{right}", "3 * x"))
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "not as expected" in (tmp_path / "out" / "index.html").read_text()


def test_a_figure_that_fails_is_named_and_the_report_is_written(folder, tmp_path, capsys):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "raise ValueError('no picture')"))
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "no picture" in (tmp_path / "out" / "report.md").read_text()
    assert "no picture" in capsys.readouterr().err


def test_no_figures_draws_none(folder, tmp_path):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "raise ValueError('no picture')"))
    assert status(folder, "--out", tmp_path / "out", "--no-figures") == 0
    assert not (tmp_path / "out" / "figures").exists()


def test_a_file_as_place_is_bad_input_before_anything_runs(folder, tmp_path, capsys):
    (tmp_path / "out").write_text("mine")
    assert status(folder, "--out", tmp_path / "out") == 2
    assert "is a file" in capsys.readouterr().err
    assert (tmp_path / "out").read_text() == "mine"


def test_no_derivation_is_bad_input(tmp_path):
    assert status(tmp_path / "gone", "--out", tmp_path / "out") == 2
    assert not (tmp_path / "out").exists()


def test_the_derivation_is_known_also_where_engines_are_its_proofs(folder, tmp_path):
    direct = GOOD[: GOOD.index("@claim")] + 'one = claim("c/one", "A sum", eq(x + x, 2 * x))(exact)\n'
    (folder / "claims.py").write_text(direct)
    (folder / "__init__.py").write_text('"""A title."""')
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    assert status(folder, "--out", tmp_path / "out") == 0
    assert "# A title" in (tmp_path / "out" / "report.md").read_text()
    assert (tmp_path / "out" / "figures" / "f.svg").exists()


def test_an_entry_of_the_notation_that_cannot_be_read_is_named_with_its_file(folder, tmp_path, capsys):
    (folder / "notation.py").write_text("NOTATION = [3]")
    assert status(folder, "--out", tmp_path / "out") == 2
    assert "notation.py: 3 in NOTATION has no symbol" in capsys.readouterr().err


def test_what_is_no_figure_is_named_and_the_report_is_written(folder, tmp_path, capsys):
    (folder / "figures.py").write_text("def figures(): return [3]")
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "got 3" in capsys.readouterr().err
