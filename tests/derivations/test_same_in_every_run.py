"""The statements of the paper read the same in every run, whatever the order of hashed sets is."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence

from ptproof.proof import Claim

SHOW = """
from ptproof.proof.load import load
from ptproof.proof.shipped import shipped
for claim in load([shipped() / "pt_seeker"]).claims:
    print(claim.id, claim.statement, *claim.assumptions, sep=" | ")
"""


def test_statements_do_not_depend_on_the_hash_seed(claims: Sequence[Claim]) -> None:
    seed = "3" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    run = subprocess.run([sys.executable, "-c", SHOW], env=environment, capture_output=True, text=True, check=True)
    here = [" | ".join(map(str, (claim.id, claim.statement, *claim.assumptions))) for claim in claims]
    assert len(here) > 200
    assert run.stdout.splitlines() == here
