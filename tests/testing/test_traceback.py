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


@pytest.fixture
def shown(tmp_path, monkeypatch, capsys):
    """What Python prints where a script ends by an error, without the start of another process."""
    monkeypatch.setattr(sys, "excepthook", sys.__excepthook__)

    def run(text):
        file = tmp_path / "script.py"
        file.write_text(text)
        try:
            exec(compile(text, str(file), "exec"), {"__name__": "__main__"})
        except Exception as error:
            sys.excepthook(type(error), error, error.__traceback__.tb_next)
        return capsys.readouterr()

    return run


def frames(stderr):
    return [line for line in stderr.splitlines() if line.lstrip().startswith("File ")]


def test_in_a_plain_script_the_last_frame_is_the_users(tmp_path):
    done = script(tmp_path, FAILING + "check()\n")
    assert done.returncode == 1
    assert len(frames(done.stderr)) == 2
    assert "in check" in frames(done.stderr)[-1]
    assert "assert_identity(x, -x)  # the user's line" in done.stderr
    assert "AssertionError: the two sides are not equal: refuted" in done.stderr


def test_bad_use_in_a_plain_script_ends_there_too(shown):
    err = shown(FAILING.replace("-x)", "0.5)") + "check()\n").err
    assert "in check" in frames(err)[-1]
    assert "InputError: right: 0.5 is not exact" in err


@pytest.mark.parametrize("call", ["assert_identity(x, None)", "assert_identity(x)", "assert_identity(x, x, foo=1)"])
def test_so_does_a_wrong_type_or_a_wrong_number_of_arguments(shown, call):
    err = shown(FAILING.replace("assert_identity(x, -x)", call) + "check()\n").err
    assert "in check" in frames(err)[-1]
    assert "TypeError: " in err


def test_an_error_in_an_engine_keeps_its_whole_traceback(shown, monkeypatch):
    monkeypatch.setattr("ptproof.proof.engines.exact.exact", lambda goal: len(3))
    assert "in <lambda>" in frames(shown(FAILING + "check()\n").err)[-1]


def test_other_errors_keep_their_whole_traceback(shown):
    caught = (
        FAILING + "try:\n    check()\nexcept AssertionError:\n    pass\ndef other():\n    raise ValueError(1)\nother()"
    )
    err = shown(caught).err
    assert "in other" in frames(err)[-1]
    assert "AssertionError" not in err


def test_a_hook_of_the_users_is_kept(shown):
    hook = "import sys\nsys.excepthook = lambda kind, error, trace: print('mine:', kind.__name__)\n"
    assert "mine: AssertionError" in shown(hook + FAILING + "check()\n").out


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
