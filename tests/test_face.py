"""What `import ptproof` and Tab show: the public names, each where its room has it, imported when it is used."""

from __future__ import annotations

import importlib
import subprocess
import sys
from types import ModuleType

import pytest

import ptproof

ROOMS = [
    "averaging", "certify", "design", "gains", "problem", "proof", "simulation", "testing", "transforms",
    "transforms.clocks",
]  # fmt: skip


@pytest.mark.parametrize("room", ["ptproof", *(f"ptproof.{room}" for room in ROOMS)])
def test_every_public_name_can_be_had_and_nothing_else_is_shown(room: str) -> None:
    face = importlib.import_module(room)
    assert dir(face) == face.__all__
    for name in dir(face):
        assert getattr(face, name) is not None


def test_a_name_that_is_not_public_is_no_attribute() -> None:
    with pytest.raises(AttributeError, match="no_such_name"):
        ptproof.no_such_name  # noqa: B018


def test_a_function_and_the_room_that_it_stands_in_may_share_a_name() -> None:
    importlib.import_module("ptproof.gains.upper")
    assert callable(ptproof.gains)
    assert isinstance(importlib.import_module("ptproof.gains"), ModuleType)


def test_import_costs_nothing() -> None:
    code = (
        "import sys, ptproof, ptproof.proof, ptproof.simulation, ptproof.testing, ptproof.gains, ptproof.averaging\n"
        "print(sorted({'sympy', 'casadi', 'z3', 'flint', 'matplotlib', 'numpy', 'pytest'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "[]"


def test_python_m_ptproof_is_the_command() -> None:
    command = [sys.executable, "-m", "ptproof", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.startswith("ptproof, version")


@pytest.mark.parametrize("room", ["ptproof", "ptproof.testing"])
def test_every_public_name_has_an_example(room: str) -> None:
    face = importlib.import_module(room)
    assert [name for name in dir(face) if ">>>" not in (getattr(face, name).__doc__ or "")] == []
