"""The pytest plugin: with ``--ptproof``, each claim of a derivation is a test.

``pytest --ptproof derivations/`` collects the claims of every Python file below the paths given; an item fails
when its verdict is not the one that the author recorded. Without the option nothing happens, and nothing is imported:
this module is loaded in every run of pytest on the machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim
    from ptproof.proof.result import Result

SECONDS_PER_CLAIM = 60.0


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("ptproof", "claims of derivations")
    group.addoption("--ptproof", action="store_true", default=False, help="collect the claims of derivations as tests")
    group.addoption(
        "--ptproof-timeout", type=_seconds, default=SECONDS_PER_CLAIM, metavar="SECONDS",
        help=f"time limit of one claim (default: {SECONDS_PER_CLAIM:g})",
    )  # fmt: skip


def _seconds(text: str) -> float:
    import argparse

    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < 1e6:
        raise argparse.ArgumentTypeError(f"expected a positive number of seconds, got {text!r}")
    return value


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("--ptproof"):
        from ptproof.testing.collecting import Claims

        config.stash[_CLAIMS] = Claims(config.getoption("--ptproof-timeout"))


def pytest_unconfigure(config: pytest.Config) -> None:
    if (claims := config.stash.get(_CLAIMS, None)) is not None:
        claims.close()


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    claims = parent.config.stash.get(_CLAIMS, None)
    if claims is None or not claims.may_hold_claims(file_path):
        return None
    return ClaimFile.from_parent(parent, path=file_path)


_CLAIMS: pytest.StashKey[Any] = pytest.StashKey()


class ClaimFile(pytest.File):
    """A module of a derivation."""

    def collect(self) -> Iterator[ClaimItem]:
        """One item for each claim, in the order of the module."""
        from ptproof.errors import InputError

        try:
            found = self.config.stash[_CLAIMS].of_file(self.path)
        except InputError as error:
            raise self.CollectError(str(error)) from None
        for claim in found:
            yield ClaimItem.from_parent(self, name=claim.id, claim=claim)


class ClaimItem(pytest.Item):
    """One claim: it passes if its verdict is the one that its author expects."""

    def __init__(self, *, claim: Claim, **arguments: Any) -> None:
        super().__init__(**arguments)
        self.claim = claim
        self.extra_keyword_matches.update((claim.title, claim.section, *claim.labels))

    def runtest(self) -> None:
        result = self.config.stash[_CLAIMS].result(self.path, self.claim)
        self.user_properties.append(("verdict", str(result.verdict)))
        if not result.as_expected:
            raise NotAsExpected(result)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        if isinstance(excinfo.value, NotAsExpected):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        code = getattr(self.claim.prove, "__code__", None)
        line = code.co_firstlineno - 1 if code is not None and Path(code.co_filename) == self.path else None
        return self.path, line, self.claim.id


class NotAsExpected(Exception):
    """The verdict of a claim is not the one that its author recorded."""

    def __init__(self, result: Result) -> None:
        self.result = result
        super().__init__(result)

    def __str__(self) -> str:
        from ptproof.testing.collecting import explain

        return explain(self.result)
