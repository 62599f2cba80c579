"""What the tests of several rooms share."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ptproof.reading import limits
from ptproof.reading.outcomes import Answered, Unanswered, Why, in_words

# More than a hundred processes are started, and each would compile ptproof again.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# Each of pytest's workers has one processor: threads of linear algebra would only wait for each other, at full speed.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

# Little is left over that only a collection finds, and each looks through all that is young.
gc.set_threshold(100_000, 50, 1_000)

# What takes longest begins first, so that in the end no worker waits for another; of these, what shares a derivation
# or what Coq has said stands together.
_FIRST = ("proof/kernel", "derivations", "report", "test_quality.py", "test_tutorial.py")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    first = tuple(str(Path(__file__).parent / name) for name in _FIRST)
    items.sort(
        key=lambda item: next((n for n, name in enumerate(first) if str(item.path).startswith(name)), len(first))
    )


def pytest_collection_finish() -> None:
    """The tests themselves are not looked through whenever Python collects what is left over."""
    gc.freeze()


def pytest_sessionfinish() -> None:
    """What dies with an exception is found at the first look: pytest takes five, at half a second each."""
    gc.collect()
    gc.freeze()


@pytest.fixture
def saved(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The figures that are written during the test, so that their pictures can be compared with their axes."""
    from matplotlib.figure import Figure

    figures: list[Any] = []
    write = Figure.savefig

    def savefig(self: Figure, *arguments: Any, **options: Any) -> None:
        figures.append(self)
        write(self, *arguments, **options)

    monkeypatch.setattr(Figure, "savefig", savefig)
    return figures


@pytest.fixture(autouse=True)
def own_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """No test recalls what another, or a person, has had decided; nor does it keep anything."""
    monkeypatch.setenv("PTPROOF_CACHE", "")


@pytest.fixture
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command works in this process, which saves the imports of another; some tests of each keep the other."""

    def apart(seconds: float, work: Callable[..., Any], *arguments: Any) -> Answered[Any] | Unanswered:
        try:
            return Answered(work(*arguments))
        except Exception as error:
            return Unanswered(Why.FAILED, in_words(error), error)

    monkeypatch.setattr(limits, "apart", apart)
