"""A failing assertion ends its traceback in the user's line: in a plain script, under pytest, under unittest."""

import subprocess
import sys

import pytest
import sympy as sp

from ptproof.testing import assert_identity

x = sp.Symbol("x", real=True)
pytest_plugins = ["pytester"]
FAILING = """
import sympy as sp
from ptproof.testing import assert_identity
x = sp.Symbol("x", real=True)
def check():
    assert_identity(x, -x)  # the user's line
"""


def script(tmp_path, text):
    file = tmp_path / "script.py"
    file.write_text(text)
    return subprocess.run([sys.executable, str(file)], capture_output=True, text=True, check=False)


def frames(stderr):
    return [line for line in stderr.splitlines() if line.lstrip().startswith("File ")]


def test_in_a_plain_script_the_last_frame_is_the_users(tmp_path):
    done = script(tmp_path, FAILING + "check()\n")
    assert done.returncode == 1
    assert len(frames(done.stderr)) == 2
    assert "in check" in frames(done.stderr)[-1]
    assert "assert_identity(x, -x)  # the user's line" in done.stderr
    assert "AssertionError: the two sides are not equal: refuted" in done.stderr


def test_bad_use_in_a_plain_script_ends_there_too(tmp_path):
    done = script(tmp_path, FAILING.replace("-x)", "0.5)") + "check()\n")
    assert "in check" in frames(done.stderr)[-1]
    assert "InputError: right: 0.5 is not exact" in done.stderr


@pytest.mark.parametrize("call", ["assert_identity(x, None)", "assert_identity(x)", "assert_identity(x, x, foo=1)"])
def test_so_does_a_wrong_type_or_a_wrong_number_of_arguments(tmp_path, call):
    done = script(tmp_path, FAILING.replace("assert_identity(x, -x)", call) + "check()\n")
    assert "in check" in frames(done.stderr)[-1]
    assert "TypeError: " in done.stderr


def test_an_error_in_an_engine_keeps_its_whole_traceback(tmp_path):
    broken = "import ptproof.proof.engines.exact\nptproof.proof.engines.exact.exact = lambda goal: len(3)\n"
    done = script(tmp_path, FAILING + broken + "check()\n")
    assert "in <lambda>" in frames(done.stderr)[-1]


def test_other_errors_keep_their_whole_traceback(tmp_path):
    caught = (
        FAILING + "try:\n    check()\nexcept AssertionError:\n    pass\ndef other():\n    raise ValueError(1)\nother()"
    )
    done = script(tmp_path, caught)
    assert "in other" in frames(done.stderr)[-1]
    assert "AssertionError" not in done.stderr


def test_a_hook_of_the_users_is_kept(tmp_path):
    hook = "import sys\nsys.excepthook = lambda kind, error, trace: print('mine:', kind.__name__)\n"
    assert "mine: AssertionError" in script(tmp_path, hook + FAILING + "check()\n").stdout


def test_in_a_notebook_the_last_frame_is_the_users():
    with pytest.raises(AssertionError) as failed:
        assert_identity(x, -x)
    shown = failed.value._render_traceback_()
    assert "in test_in_a_notebook" in frames("\n".join(shown))[-1]
    assert "AssertionError: the two sides are not equal: refuted" in shown


def test_under_pytest_the_last_entry_is_the_users(pytester):
    pytester.makepyfile(FAILING.replace("def check", "def test_it"))
    result = pytester.runpytest_inprocess("-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:hypothesispytest")
    result.assert_outcomes(failed=1)
    text = result.stdout.str()
    result.stdout.fnmatch_lines([">*assert_identity(x, -x)  # the user's line", "*.py:5: AssertionError"])
    assert "failure.py" not in text
    assert "E       AssertionError: the two sides are not equal: refuted" in text


def test_under_unittest_the_last_frame_is_the_users(tmp_path):
    text = FAILING.replace(
        "def check():\n    ", "import unittest\nclass T(unittest.TestCase):\n    def test_it(self):\n        "
    )
    done = script(tmp_path, text + "unittest.main()\n")
    assert "FAILED (failures=1)" in done.stderr
    assert "in test_it" in frames(done.stderr)[-1]


def test_the_plugin_imports_nothing_heavy():
    heavy = {"casadi", "matplotlib", "z3", "flint", "scipy", "control", "sympy", "numpy", "pebble"}
    code = "import sys, ptproof.testing.plugin; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "ptproof.testing.plugin" in done.stdout.split()
    assert heavy & set(done.stdout.split()) == set()
