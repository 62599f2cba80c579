"""Formatting, lint, strict types and the direction of imports: the same command runs them with the tests."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
CHECKS = {
    "formatting": [sys.executable, "-m", "ruff", "format", "--check", "."],
    "lint": [sys.executable, "-m", "ruff", "check", "."],
    "types": [sys.executable, "-m", "mypy"],
    "imports": [str(Path(sys.executable).parent / "lint-imports"), "--no-cache"],
}


@pytest.mark.parametrize("name", CHECKS)
def test_quality(name: str) -> None:
    done = subprocess.run(CHECKS[name], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("room", ["ptproof", "derivations", "benchmarks"])
def test_functions_and_modules_are_short(room: str) -> None:
    """A function has at most 60 lines, its docstring included, and a module 300."""
    long = []
    for file in (ROOT / room).rglob("*.py"):
        text = file.read_text("utf-8")
        parts = [("module", 300, 1, len(text.splitlines()))]
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                parts.append((node.name, 60, node.lineno, node.end_lineno or node.lineno))
        long += [f"{file}:{first} {name}" for name, most, first, last in parts if last - first + 1 > most]
    assert not long
