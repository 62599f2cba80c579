"""The paper's derivation, read when a test first asks for it: collecting tests needs none of it."""

from __future__ import annotations

import pytest

from ptproof.proof import Claim, load


@pytest.fixture(scope="session")
def claims() -> tuple[Claim, ...]:
    """Its claims, in order."""
    return tuple(load().claims)
