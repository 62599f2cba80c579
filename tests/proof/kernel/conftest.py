"""What Coq says of the claims of a test module, asked once for all of its tests."""

from __future__ import annotations

import pytest

from ptproof.proof.kernel import Confirmation, check


@pytest.fixture(scope="module")
def answers(request: pytest.FixtureRequest) -> dict[str, Confirmation]:
    """Of the module's ``TRUE`` and ``NOT_CONFIRMED``; the latter have one short try, or two if it says ``AGAIN``."""
    module = request.module
    again = getattr(module, "AGAIN", False)
    return check(module.TRUE, timeout=20.0) | check(module.NOT_CONFIRMED, timeout=3.0, again=again)
