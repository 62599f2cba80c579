"""The derivation of the first paper, read when a test first asks for it: collecting tests needs none of it."""

from __future__ import annotations

import pytest

from ptproof.proof import Claim, load
from ptproof.proof.shipped import shipped


@pytest.fixture(scope="session")
def claims() -> tuple[Claim, ...]:
    """Its claims, in order."""
    return tuple(load([shipped() / "pt_seeker"]).claims)
