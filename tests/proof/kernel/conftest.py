"""What Coq says of the claims of a test module, asked once for all of its tests."""

from __future__ import annotations

import pytest

from ptproof.proof.kernel import Confirmation, check
from ptproof.proof.kernel.check import Effort


@pytest.fixture(scope="module")
def answers(request: pytest.FixtureRequest) -> dict[str, Confirmation]:
    """Of the module's ``TRUE`` and ``NOT_CONFIRMED`` with its ``EFFORT``; the latter have three seconds each."""
    module = request.module
    efforts: list[Effort] = [getattr(module, "EFFORT", "quick")]
    return check(module.TRUE, timeout=20.0, efforts=efforts) | check(module.NOT_CONFIRMED, timeout=3.0, efforts=efforts)
