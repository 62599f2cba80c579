"""Formulas of which nothing is stated: they are counted, and they cover and decide nothing."""

import json

import pytest

from ptproof.commands.cli import main
from ptproof.errors import InputError
from ptproof.proof import gap
from ptproof.proof.load import load

GAP = (
    'from ptproof.proof import gap\nleft = gap("1/a", "Section 1 (1)", 3, "x = ?", "? is not known", labels=["eq:a"])\n'
)
CLAIM = "from ptproof.proof import claim, eq, exact\ntrue = claim('1/b', 'true', eq(1, 1))(exact)\n"


def test_a_folder_of_gaps_alone_is_a_derivation(tmp_path):
    (tmp_path / "section1.py").write_text(GAP)
    found = load([tmp_path])
    assert [(item.id, item.line, item.labels) for item in found.gaps] == [("1/a", 3, ("eq:a",))]
    assert found.claims == found.definitions == ()


def test_a_folder_of_nothing_is_none(tmp_path):
    (tmp_path / "section1.py").write_text("x = 1\n")
    with pytest.raises(InputError, match="no claims found"):
        load([tmp_path])


def test_labels_are_a_list():
    with pytest.raises(InputError, match="takes a list of labels"):
        gap("1/a", "Section 1 (1)", 3, "x", "why", labels="eq:a")


@pytest.mark.parametrize(("text", "gaps"), [(GAP + CLAIM, 1), (CLAIM, None)])
def test_verify_counts_them(tmp_path, capfd, text, gaps):
    (tmp_path / "section1.py").write_text(text)
    with pytest.raises(SystemExit) as ended:
        main(["verify", str(tmp_path), "--json"])
    assert ended.value.code == 0
    assert json.loads(capfd.readouterr().out)["summary"].get("gaps") == gaps
