"""The command line's contract: what goes to which stream, the exit status, and one sentence for bad input."""

from __future__ import annotations

import json
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

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


def ptproof(*arguments: str, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ptproof.commands.cli", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder, timeout=120)


def derivation(folder: Path, expected: str = "refuted") -> str:
    (folder / "claims.py").write_text(textwrap.dedent(CLAIMS.format(expected=expected)))
    return str(folder)


def test_json_and_nothing_else_on_standard_output(tmp_path: Path) -> None:
    done = ptproof("verify", derivation(tmp_path), "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert {"claims", "summary"} <= set(found)
    keys = "id labels title kind statement verdict expected fully_proved uses evidence witness"
    assert set(found["claims"][0]) == set(keys.split())
    false = next(item for item in found["claims"] if item["id"] == "false")
    assert set(false["witness"]) == {"values", "left", "right"}


def test_unexpected_verdict_is_status_1(tmp_path: Path) -> None:
    assert ptproof("verify", derivation(tmp_path, expected="proved")).returncode == 1


BAD = [
    ("verify", "nowhere"),
    ("verify", "--jobs", "0"),
    ("verify", "--timeout", "-1"),
    ("verify", "-k", "no such claim at all"),
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
def test_bad_input_is_one_sentence_and_status_2(arguments: tuple[str, ...], tmp_path: Path) -> None:
    done = ptproof(*arguments, folder=tmp_path)
    assert done.returncode == 2, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    assert done.stderr.strip()
    assert not done.stdout


def test_help_does_not_import_the_engines() -> None:
    code = "import sys; from ptproof.commands.cli import main\ntry: main(['--help'])\nexcept SystemExit: pass\n"
    code += (
        "print(sorted({'sympy', 'casadi', 'z3', 'flint', 'matplotlib', 'numpy'} & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert done.stderr.strip() == "[]"
    assert "verify" in done.stdout
