"""What Coq says of the claims of the test modules here, asked once for all of their tests."""

from __future__ import annotations

import os
import pickle
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import Confirmation, check, coq
from ptproof.proof.kernel.asking import Effort
from ptproof.proof.steps import Step, noting

_PATIENCE = 240  # seconds: for a worker that died while it made what others wait for


def _once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], Any]) -> Any:
    """What ``make(folder)`` gives, made by one of pytest's workers for all of them."""
    base = factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        base = base.parent
    folder, found = base / f"{name}.folder", base / f"{name}.made"
    try:
        folder.mkdir()
    except FileExistsError:
        for _ in range(_PATIENCE):
            if found.exists():
                return pickle.loads(found.read_bytes())
            time.sleep(1)
        folder = factory.mktemp(name)
    made = make(folder)
    draft = base / f"{name}.{os.getpid()}"
    draft.write_bytes(pickle.dumps(made))
    draft.replace(found)
    return made


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """The library of tactics, compiled once for all workers: Coq takes five seconds for it."""
    place = _once(tmp_path_factory, "library", _compiled)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coq, "_compiled", lambda: SimpleNamespace(name=place))
        yield


def _compiled(folder: Path) -> str:
    coq.prepare(folder)
    return str(folder)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """The tests of asked.py, for the claims of the module that has them."""
    for name, kind in (("true", "TRUE"), ("not_confirmed", "NOT_CONFIRMED")):
        if name in metafunc.fixturenames:
            metafunc.parametrize(name, [item.id for item in getattr(metafunc.module, kind)])


@pytest.fixture(scope="module")
def answers(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, library: None
) -> dict[str, Confirmation]:
    """Of the module's ``TRUE`` and ``NOT_CONFIRMED`` with its ``EFFORT``.

    Coq is asked once for all modules of one effort that are to be tested, however many of pytest's workers share them;
    in two halves of the thorough ones, so that none of two workers waits for the other.
    """
    effort = _effort(request.module)
    collected = {item.module for item in request.session.items if isinstance(item, pytest.Function)}
    modules = [module for module in collected if hasattr(module, "NOT_CONFIRMED") and _effort(module) == effort]
    modules.sort(key=_own)
    half = modules.index(request.module) % 2 if effort == "thorough" else 0
    some = modules[half::2] if effort == "thorough" else modules
    told = _once(tmp_path_factory, f"{effort}-{half}", lambda folder: _asked(some, effort, folder))
    here = f"{_own(request.module)}/"
    return {id.removeprefix(here): answer for id, answer in told.items() if id.startswith(here)}


def _effort(module: Any) -> Effort:
    return getattr(module, "EFFORT", "quick")


def _own(module: Any) -> str:
    return str(module.__name__).rpartition(".")[2]


class _NotedHere:
    """The steps of proofs, noted in this process: the claims of a test stand in no file of a derivation."""

    def __init__(self, *_: object) -> None:
        pass

    def take(self) -> None:
        pass

    stop = take

    def of(self, claim: Claim) -> tuple[Step, ...]:
        with noting() as steps:
            claim.prove(claim.goal())
        return tuple(steps)


def _asked(modules: Sequence[Any], effort: Effort, folder: Path) -> dict[str, Confirmation]:
    """One file for all: Coq reads the library and finds axioms once, and neither misses any nor is asked again."""
    claims = [
        replace(item, id=f"{_own(module)}/{item.id}")
        for kind in ("TRUE", "NOT_CONFIRMED") for module in modules for item in getattr(module, kind)
    ]  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(import_module("ptproof.proof.kernel.check"), "_IN_A_FILE", {effort: (len(claims), len(claims))})
        patch.setattr(import_module("ptproof.proof.kernel.check"), "Noted", _NotedHere)
        told = check(claims, timeout=20.0, efforts=[effort], keep=folder)
    assert len(list(folder.glob("claims_*.v"))) == 1
    return told
