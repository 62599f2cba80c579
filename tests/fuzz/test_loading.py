"""Folders with odd files: claims, or one sentence that names the file."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import hypothesis.strategies as st
from hypothesis import given

from ptproof.errors import InputError
from ptproof.proof.load import Derivation, load
from tests.fuzz.sizes import fuzz, within

GOOD = """from ptproof.proof import claim, eq, exact
import sympy as sp
x = sp.Symbol("x", real=True)
@claim("ID", "a square", eq((x + 1)**2, x**2 + 2*x + 1))
def square(goal):
    "Prose."
    return exact(goal)
"""
CONTENTS = st.sampled_from(
    [
        GOOD, GOOD.replace("ID", "other"), GOOD.replace('"ID"', "7"), GOOD.replace("eq(", "no("),
        GOOD.replace('"a square"', "None"),
        "", "x = 1\n", "def f(:\n", "raise ValueError('no')\n", "raise SystemExit(0)\n",
        "import sys; sys.exit(3)\n", "\0", "é = 1\n",
        "from . import missing\n", "from .good import square\n", "import nowhere_at_all\n", "1/0\n",
        "assert False\n",
        "def f():\n    return f()\nf()\n", "raise BaseException('b')\n", "raise KeyboardInterrupt\n",
        "raise GeneratorExit\n",
        "claims = [1, None, 'text']\n", "SECTION = 7\n" + GOOD,
        "from ptproof.errors import InputError\nraise InputError('said')\n",
        "class E(Exception):\n    def __str__(self):\n        raise ValueError\nraise E()\n",
        "# -*- coding: nonsense -*-\n",
        "import warnings; warnings.warn('w')\n", "__name__ = 'x'\n" + GOOD, "import ptproof.nothing\n",
        "(" * 3000 + "\n",
        "__getattr__ = 1\nx = type('T', (), {'__class__': property(lambda self: 1 / 0)})()\n",
    ]
)  # fmt: skip
NAMES = st.sampled_from(
    ["good.py", "bad.py", "__init__.py", "test_it.py", "a b.py", "é.py", "class.py", "1.py", ".hidden.py",
    "x.txt", "sub/one.py", "sub/__init__.py",
     "folder.py/inner.py", "conftest.py", "sympy.py", "UPPER.PY", "a.b.py", "-.py"]
)  # fmt: skip
KINDS = st.sampled_from(["text", "text", "text", "text", "latin", "link to nowhere", "link to itself", "unreadable"])


@given(
    st.dictionaries(NAMES, st.tuples(CONTENTS, KINDS), max_size=3),
    st.sampled_from(["", "good.py", "sub", "missing", "x.txt", "folder.py"]),
)
@fuzz(10)
def test_a_folder_holds_claims_or_the_file_is_named(files: dict[str, Any], part: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, (content, kind) in files.items():
            _put(root / name, content, kind)
        try:
            with within(10.0):
                found = load([root / part])
        except InputError as error:
            refused: InputError = error
        except (KeyboardInterrupt, GeneratorExit):
            assert any("Interrupt" in content or "GeneratorExit" in content for content, _ in files.values())
            return
        else:
            assert isinstance(found, Derivation)
            assert found.claims
            return
    assert str(root) in str(refused)
    assert len(str(refused)) < 3000


def _put(path: Path, content: str, kind: str) -> None:
    path.parent.mkdir(exist_ok=True)
    if kind == "link to nowhere":
        path.symlink_to(path.parent / "nowhere at all")
    elif kind == "link to itself":
        path.symlink_to(path)
    elif kind == "latin":
        path.write_bytes(content.encode("utf-8") + b"# \xe9\n")
    else:
        path.write_text(content, "utf-8")
        if kind == "unreadable":
            os.chmod(path, 0)
