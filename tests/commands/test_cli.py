"""The command line's contract: what goes to which stream, the exit status, and one sentence for bad input."""

from __future__ import annotations

import importlib
import json
import pkgutil
import subprocess
import sys
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import click
import pytest

import ptproof.commands as package
from ptproof.commands.cli import commands, main

CLAIMS = """
import sympy as sp
from ptproof.proof.claim import claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq
x = sp.Symbol("x", real=True)
SECTION = "Test"
good = claim("good", "a true one", eq(sp.sin(x) ** 2 + sp.cos(x) ** 2, 1), labels=["eq:good"])(exact)
false = claim("false", "a false one", eq(x, x + 1), expected="{expected}")(exact)
"""


@dataclass(frozen=True)
class Done:
    returncode: int
    stdout: str
    stderr: str


Run = Callable[..., Done]


@pytest.fixture
def ptproof(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """The command line in this process, in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments: str) -> Done:
        with pytest.raises(SystemExit) as ended:
            main(list(arguments))
        shown = capsys.readouterr()
        return Done(int(ended.value.code or 0), shown.out, shown.err)

    return run


def derivation(folder: Path, expected: str = "refuted") -> str:
    (folder / "claims.py").write_text(textwrap.dedent(CLAIMS.format(expected=expected)))
    return str(folder)


def test_json_and_nothing_else_on_standard_output(ptproof: Run, tmp_path: Path) -> None:
    done = ptproof("verify", derivation(tmp_path), "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert {"claims", "summary"} <= set(found)
    keys = "id labels title kind statement verdict expected fully_proved uses evidence witness erratum"
    assert set(found["claims"][0]) == set(keys.split())
    false = next(item for item in found["claims"] if item["id"] == "false")
    assert set(false["witness"]) == {"values", "left", "right"}


def test_unexpected_verdict_is_status_1(ptproof: Run, tmp_path: Path) -> None:
    assert ptproof("verify", derivation(tmp_path, expected="proved")).returncode == 1


BAD = [
    ("verify", "nowhere"),
    ("verify", "--jobs", "0"),
    ("verify", "--timeout", "-1"),
    ("verify", ".", "-k", "no such claim at all"),
    ("verify", "--no-such-option"),
    ("no-such-command",),
    ("coverage", "nowhere.tex"),
    ("average", "nowhere.toml"),
    ("simulate", "nowhere"),
    ("gains", "nowhere.toml"),
    ("bounds", "x1 +", "--vars", "x1", "--source", "0", "--kappa", "1"),
    ("bounds", "-x1**2", "--vars", "x1", "--source", "0,0", "--kappa", "1"),
    ("bounds", "__import__('os')", "--vars", "x1", "--source", "0", "--kappa", "1"),
]


@pytest.mark.parametrize("arguments", BAD, ids=" ".join)
def test_bad_input_is_one_sentence_and_status_2(arguments: tuple[str, ...], ptproof: Run, tmp_path: Path) -> None:
    derivation(tmp_path)
    done = ptproof(*arguments)
    assert done.returncode == 2, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.strip()
    assert not done.stdout


def test_a_command_that_is_not_there_names_the_nearest(ptproof: Run) -> None:
    assert "did you mean 'verify'?" in ptproof("verfy").stderr
    assert "there are average, bounds" in ptproof("xyz").stderr


def test_help_does_not_import_the_engines() -> None:
    code = "import sys; from ptproof.commands.cli import main\ntry: main(['--help'])\nexcept SystemExit: pass\n"
    code += (
        "print(sorted({'sympy', 'casadi', 'z3', 'flint', 'matplotlib', 'numpy'} & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert done.stderr.strip() == "[]"
    assert "verify" in done.stdout


@pytest.mark.parametrize("name", [module.name for module in pkgutil.iter_modules(package.__path__)])
def test_a_command_is_a_module_that_says_so_in_its_first_line(name: str) -> None:
    module = importlib.import_module(f"ptproof.commands.{name}")
    assert (name in commands()) == isinstance(getattr(module, name, None), click.Command)


@pytest.mark.parametrize("name", commands())
def test_every_command_explains_itself_and_its_options(name: str, ptproof: Run) -> None:
    done = ptproof(name, "--help")
    assert done.returncode == 0
    context = click.Context(command := getattr(importlib.import_module(f"ptproof.commands.{name}"), name))
    assert command.help
    assert all(option.help for option in command.get_params(context) if isinstance(option, click.Option))
