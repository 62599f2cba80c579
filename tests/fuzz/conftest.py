"""``--fuzz N``: every target of this folder runs N examples, from a seed that is printed, and not the suite's few."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from tests.fuzz import sizes

_LARGEST_SEED = 2**32


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("fuzzing")
    group.addoption("--fuzz", type=int, metavar="N", help="examples for each target of tests/fuzz")
    group.addoption("--fuzz-seed", type=int, metavar="S", help="the seed of an earlier run with --fuzz, to repeat it")


def pytest_configure(config: pytest.Config) -> None:
    # Without tests/fuzz among the arguments this file is read late, and its options are not known.
    size = config.getoption("--fuzz", default=None)
    if size is None:
        return
    if config.option.fuzz_seed is None:
        config.option.fuzz_seed = random.SystemRandom().randrange(_LARGEST_SEED)
    sizes.chosen = sizes.Chosen(size, config.option.fuzz_seed)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.path.parent == Path(__file__).parent:
            # Hypothesis writes out its strategies when a draw is filtered, and then warns that they are long.
            item.add_marker(pytest.mark.filterwarnings("ignore:Generating overly large repr"))
            # The limit of an example may strike where Python swallows exceptions, such as while an object dies.
            item.add_marker(pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"))
    if sizes.chosen is not None:
        for item in items:
            item.add_marker(pytest.mark.timeout(0))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if sizes.chosen is not None:
        size, seed = sizes.chosen.examples, sizes.chosen.seed
        terminalreporter.write_line(f"fuzz: {size} examples a target; to repeat: --fuzz {size} --fuzz-seed {seed}")
