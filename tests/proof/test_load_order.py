"""The order in which a derivation's claims are shown."""

from ptproof.proof.load import load

HEAD = """
import sympy as sp
from ptproof.proof.claim import claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq

SECTION = "{section}"
x = sp.Symbol("x", real=True)
"""


def test_an_imported_claim_keeps_the_place_of_its_own_section(tmp_path):
    (tmp_path / "a_last.py").write_text(
        HEAD.format(section="9 Last")
        + "from .b_first import second\nthird = claim('third', '', eq(x, x), uses=[second])(exact)\n"
    )
    (tmp_path / "b_first.py").write_text(
        HEAD.format(section="1 First")
        + "first = claim('first', '', eq(x, x))(exact)\nsecond = claim('second', '', eq(x, x))(exact)\n"
    )
    assert [claim.id for claim in load([tmp_path]).claims] == ["third", "first", "second"]
