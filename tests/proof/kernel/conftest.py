"""What Coq says of the claims of a test module, asked once for all of its tests."""

from __future__ import annotations

import os
import pickle
import time
from typing import Any

import pytest

from ptproof.proof.kernel import Confirmation, check
from ptproof.proof.kernel.check import Effort

_PATIENCE = 240  # seconds: for a worker that died while it asked


@pytest.fixture(scope="module")
def answers(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Confirmation]:
    """Of the module's ``TRUE`` and ``NOT_CONFIRMED`` with its ``EFFORT``; the latter have three seconds each.

    Coq is asked once, however many of pytest's workers share the module's tests.
    """
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    name = request.module.__name__.rpartition(".")[2]
    place, found = folder / f"{name}.asked", folder / f"{name}.answers"
    try:
        place.mkdir()
    except FileExistsError:
        for _ in range(_PATIENCE):
            if found.exists():
                answers: dict[str, Confirmation] = pickle.loads(found.read_bytes())
                return answers
            time.sleep(1)
    asked = _asked(request.module)
    draft = place / "draft"
    draft.write_bytes(pickle.dumps(asked))
    draft.replace(found)
    return asked


def _asked(module: Any) -> dict[str, Confirmation]:
    efforts: list[Effort] = [getattr(module, "EFFORT", "quick")]
    return check(module.TRUE, timeout=20.0, efforts=efforts) | check(module.NOT_CONFIRMED, timeout=3.0, efforts=efforts)
