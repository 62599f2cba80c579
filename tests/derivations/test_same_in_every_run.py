"""The statements of the paper read the same in every run, whatever the order of hashed sets is."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ptproof.proof import Claim

ROOT = Path(__file__).resolve().parents[2]
SHOW = """
from ptproof.proof.load import load
from ptproof.proof.shipped import shipped
from tests.derivations.test_same_in_every_run import shown
print(*shown(load([shipped() / "pt_seeker"]).claims), sep="\\n")
"""
SPELT_OUT = 5


def shown(claims: Sequence[Claim]) -> Iterator[str]:
    """Each claim by its content, which is everything in its order; every fifth as it reads too, which takes longer."""
    yield from (f"{claim.id} {claim.content}" for claim in claims)
    yield from (" | ".join(map(str, (claim.statement, *claim.assumptions))) for claim in claims[::SPELT_OUT])


def test_statements_do_not_depend_on_the_hash_seed(claims: Sequence[Claim]) -> None:
    seed = "3" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(ROOT)}
    run = subprocess.run([sys.executable, "-c", SHOW], env=environment, capture_output=True, text=True, check=True)
    here = list(shown(claims))
    assert len(here) > 200
    assert run.stdout.splitlines() == here
