"""The claims of a derivation as test items."""

import pytest

# Loaded here, they stay loaded for the runs within this process.
import ptproof.proof.engines.exact
import ptproof.proof.load
import ptproof.proof.run
import ptproof.testing.collecting  # noqa: F401

pytest_plugins = ["pytester"]

HEAD = """
import sympy as sp
from ptproof.proof.claim import cited, claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import Prose, eq
x = sp.Symbol("x", real=True)
"""
CLAIMS = """
from .base import *

@claim("part/double-angle", "Double angle", eq(sp.sin(2 * x), 2 * sp.sin(x) * sp.cos(x)), labels=["eq:double"])
def double(goal):
    return exact(goal)

@claim("part/forgotten-two", "A forgotten 2", eq(sp.sin(2 * x), sp.sin(x) * sp.cos(x)), expected="refuted")
def forgotten(goal):
    return exact(goal)

theorem = claim("part/theorem", "A theorem", Prose("Something is so."), expected="cited")(cited("A book"))
"""
WRONG = """
from .base import *
from .claims import double, forgotten

@claim("wrong/refuted", "It is refuted", eq(sp.cos(2 * x), sp.cos(x)), uses=[double])
def refuted(goal):
    return exact(goal)

@claim("wrong/proved", "It is proved after all", eq(x, x), expected="refuted")
def proved(goal):
    return exact(goal)

@claim("wrong/ancestor", "It uses what is refuted", eq(x, x), uses=[forgotten])
def ancestor(goal):
    return exact(goal)

@claim("wrong/slow", "It takes too long", eq(x, x))
def slow(goal):
    while True:
        pass

@claim("wrong/crash", "It ends its process", eq(x, x))
def crash(goal):
    import os
    os._exit(3)

@claim("wrong/error", "It raises", eq(x, x))
def error(goal):
    raise KeyError("lost")
"""


@pytest.fixture
def derivation(pytester):
    folder = pytester.mkpydir("derivation")
    (folder / "base.py").write_text(HEAD)
    (folder / "claims.py").write_text(CLAIMS)
    (folder / "test_more.py").write_text("def test_more():\n    pass\n")
    return folder


# Hypothesis would be rewritten and imported again by each run within this process, which takes seconds.
LIGHT = ("-p", "no:cacheprovider", "-p", "no:hypothesispytest")


def run(pytester, *arguments):
    return pytester.runpytest_inprocess(*LIGHT, *arguments)


def test_each_claim_is_an_item_that_passes_when_it_comes_out_as_expected(pytester, derivation):
    result = run(pytester, "--ptproof", "-v", derivation)
    result.assert_outcomes(passed=4)
    result.stdout.fnmatch_lines(
        [
            "*claims.py::part/double-angle PASSED*",
            "*claims.py::part/forgotten-two PASSED*",
            "*claims.py::part/theorem PASSED*",
            "*test_more.py::test_more PASSED*",
        ]
    )


def test_without_the_option_there_is_nothing(pytester, derivation):
    result = run(pytester, "--collect-only", "-q", derivation)
    assert "part/" not in result.stdout.str()
    result.stdout.fnmatch_lines(["*test_more.py::test_more"])


@pytest.mark.parametrize(
    ("selection", "found"),
    [
        (["-k", "double"], "part/double-angle"),
        (["-k", "eq:double"], "part/double-angle"),
        (["-k", "part/forgotten-two"], "part/forgotten-two"),
        (["derivation/claims.py::part/theorem"], "part/theorem"),
    ],
)
def test_claims_are_selected_by_id_label_and_node(pytester, derivation, selection, found):
    paths = [] if "::" in selection[0] else [derivation]
    result = run(pytester, "--ptproof", "-q", "--collect-only", *selection, *paths)
    items = [line for line in result.stdout.lines if "::" in line]
    assert [item.split("::")[1] for item in items] == [found]


def test_it_is_the_same_under_xdist(pytester, derivation):
    run(pytester, "--ptproof", "-n", "2", derivation).assert_outcomes(passed=4)


def test_what_is_not_as_expected_fails_with_the_reason(pytester, derivation):
    (derivation / "wrong.py").write_text(WRONG)
    result = run(pytester, "--ptproof", "--ptproof-timeout", "1", "-v", derivation / "wrong.py")
    result.assert_outcomes(failed=6)
    result.stdout.fnmatch_lines(
        [
            "wrong/refuted: expected proved, came out refuted",
            "*statement: cos(2*x) = cos(x)",
            "*witness: * x = *left *right*",
            "wrong/proved: expected refuted, came out proved",
            "wrong/ancestor: expected proved, came out undecided",
            "*the proof uses what is refuted: part/forgotten-two",
            "wrong/slow: expected proved, came out undecided",
            "*no answer in 1 s",
            "wrong/crash: expected proved, came out undecided",
            "*the process ended*",
            "wrong/error: expected proved, came out undecided",
            "*KeyError*lost*",
        ]
    )
    assert "Traceback" not in result.stdout.str()


def test_a_claim_that_is_only_imported_is_not_collected_twice(pytester, derivation):
    (derivation / "later.py").write_text("from .claims import *  # a module that speaks of ptproof and claims\n")
    result = run(pytester, "--ptproof", "-q", "--collect-only", derivation)
    ids = [line.split("::")[1] for line in result.stdout.lines if "::" in line]
    assert sorted(ids) == ["part/double-angle", "part/forgotten-two", "part/theorem", "test_more"]


def test_an_id_that_stands_twice_is_an_error_of_collection(pytester, derivation):
    (derivation / "twice.py").write_text(CLAIMS.replace("forgotten-two", "other"))
    result = run(pytester, "--ptproof", "-q", derivation)
    assert result.ret == 2
    result.stdout.fnmatch_lines(["*the id 'part/double-angle' stands twice*"])


def test_a_file_that_cannot_be_imported_is_an_error_with_its_line(pytester, derivation):
    (derivation / "broken.py").write_text("# a claim for ptproof\nx = = 1\n")
    result = run(pytester, "--ptproof", "-q", derivation)
    assert result.ret == 2
    result.stdout.fnmatch_lines(["*broken.py, line 2: SyntaxError*"])


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("os._exit(0)", "*ends.py: cannot be imported: the process ended with status 0*"),
        ("raise KeyboardInterrupt", "*ends.py: cannot be imported: the module raised KeyboardInterrupt*"),
    ],
)
def test_a_file_that_ends_its_process_is_an_error_of_collection(pytester, derivation, body, words):
    (derivation / "ends.py").write_text(f"# a claim for ptproof\nimport os\n{body}\n")
    result = run(pytester, "--ptproof", "-q", derivation)
    assert result.ret == 2
    result.stdout.fnmatch_lines([words])


def test_a_file_that_does_not_speak_of_claims_is_never_imported(pytester, derivation):
    (derivation / "script.py").write_text("raise SystemExit('imported')\n")
    result = run(pytester, "--ptproof", "-q", "--collect-only", derivation)
    assert result.ret == 0
    assert "imported" not in result.stdout.str()


def test_a_folder_without_init_is_loaded_as_a_whole(pytester, derivation):
    (derivation / "__init__.py").unlink()
    (derivation / "test_more.py").unlink()
    run(pytester, "--ptproof", derivation).assert_outcomes(passed=3)


@pytest.mark.parametrize("value", ["0", "-1", "nan", "inf", "soon"])
def test_a_bad_time_limit_is_refused(pytester, value):
    result = run(pytester, "--ptproof", f"--ptproof-timeout={value}")
    assert result.ret == 4
    result.stderr.fnmatch_lines(["*expected a positive number of seconds*"])
