"""Coverage: labels against claims, and the command."""

import json

import pytest

from ptproof.commands.cli import main
from ptproof.report.coverage import coverage

PAPER = r"\begin{align} a \label{eq:one} \\ b \label{eq:two} \end{align}"
DERIVATION = '''
import sympy as sp
from ptproof.proof.claim import claim, definition
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq

x = sp.Symbol("x", real=True)
one = definition("d/one", "A definition", eq(x, x), labels=["eq:one"])

@claim("c/two", "A claim", eq(x + x, 2 * x), labels={labels})
def two(goal):
    """Add."""
    return exact(goal)
'''


def files(tmp_path, labels, paper=PAPER):
    (tmp_path / "paper.tex").write_text(paper)
    (tmp_path / "part.py").write_text(DERIVATION.replace("{labels}", repr(labels)))
    return [str(tmp_path / "paper.tex"), str(tmp_path / "part.py")]


def status(*arguments):
    with pytest.raises(SystemExit) as ended:
        main(list(arguments))
    return ended.value.code


class Item:
    def __init__(self, id, *labels):
        self.id, self.labels = id, labels


def test_ids_in_order_and_once():
    found = coverage(["b", "a"], [Item("1", "a"), Item("2", "b", "a", "a")])
    assert found.covered == (("b", ("2",)), ("a", ("1", "2")))


def test_missing_and_stale():
    found = coverage(["a", "b"], [Item("1", "a", "gone")])
    assert (found.missing, found.stale, found.complete) == (("b",), (("gone", ("1",)),), False)


def test_complete(tmp_path, capsys):
    assert status("coverage", *files(tmp_path, ["eq:two"]), "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["covered"], found["missing"]) == ({"eq:one": ["d/one"], "eq:two": ["c/two"]}, [])


def test_a_missing_label_is_status_1(tmp_path, capsys):
    assert status("coverage", *files(tmp_path, []), "--json") == 1
    assert json.loads(capsys.readouterr().out)["missing"] == ["eq:two"]


def test_a_stale_label_is_status_1_and_named(tmp_path, capsys):
    assert status("coverage", *files(tmp_path, ["eq:two", "eq:gone"]), "--json") == 1
    captured = capsys.readouterr()
    assert "eq:gone" in captured.err
    assert json.loads(captured.out)["missing"] == []


def test_a_label_of_a_figure_is_not_stale(tmp_path):
    paper = PAPER + r"\begin{figure}\label{fig:one}\end{figure}"
    assert status("coverage", *files(tmp_path, ["eq:two", "fig:one"], paper)) == 0


def test_the_table_names_what_is_missing(tmp_path, capsys):
    status("coverage", *files(tmp_path, []))
    assert "eq:two" in capsys.readouterr().out


@pytest.mark.parametrize("paper", ["", "\\section{S}\\label{sec:s}"])
def test_no_labels_is_bad_input(tmp_path, capsys, paper):
    assert status("coverage", *files(tmp_path, [], paper)) == 2
    assert "no \\label" in capsys.readouterr().err


def test_no_paper_is_bad_input(tmp_path, capsys):
    assert status("coverage", str(tmp_path / "gone.tex")) == 2
    captured = capsys.readouterr()
    assert "gone.tex" in captured.err
    assert captured.out == ""
