"""The statements of the paper read the same in every run, whatever the order of hashed sets is."""

from __future__ import annotations

import os
import subprocess
import sys

SHOW = """
from ptproof.proof.load import load
for claim in load().claims:
    print(claim.id, claim.statement, *claim.assumptions, sep=" | ")
"""


def _statements(seed: int) -> list[str]:
    environment = {**os.environ, "PYTHONHASHSEED": str(seed)}
    run = subprocess.run([sys.executable, "-c", SHOW], env=environment, capture_output=True, text=True, check=True)
    return run.stdout.splitlines()


def test_statements_do_not_depend_on_the_hash_seed() -> None:
    first = _statements(1)
    assert len(first) > 200
    assert _statements(3) == first
