"""The order in which a derivation's claims are shown."""

import os
import subprocess
import sys
import time

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
    assert load(str(tmp_path)).claims == load([tmp_path]).claims  # one path, and no sequence of letters


def test_a_text_of_the_same_size_and_second_is_not_taken_for_the_one_that_was_compiled(tmp_path):
    code = (
        "import os, pathlib, sys\n"
        "from ptproof.proof.load import load\n"
        "print([claim.id for claim in load([pathlib.Path(sys.argv[1])]).claims])"
    )
    file, said, stamp = tmp_path / "paper.py", [], 0
    for name in ("first", "other"):
        file.write_text(HEAD.format(section="1") + f"one = claim('{name}', '', eq(x, x))(exact)\n")
        stamp = stamp or int(time.time()) + 60
        os.utime(file, (stamp, stamp))
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
        done = subprocess.run(
            [sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, check=True, env=environment,
        )  # fmt: skip
        said.append(done.stdout.strip())
    assert said == ["['first']", "['other']"]
