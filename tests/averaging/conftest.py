"""What the tests of averaging share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from ptproof.reading import limits
from ptproof.reading.outcomes import Answered, Unanswered, Why, in_words


@pytest.fixture
def in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command works in this process, which saves the imports of another; ``test_command.py`` has the real one."""

    def apart(seconds: float, work: Callable[..., Any], *arguments: Any) -> Answered[Any] | Unanswered:
        try:
            return Answered(work(*arguments))
        except Exception as error:
            return Unanswered(Why.FAILED, in_words(error), error)

    monkeypatch.setattr(limits, "apart", apart)
