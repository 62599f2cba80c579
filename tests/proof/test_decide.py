"""Claims decided without the command line: in this process, in others, on a cluster."""

import sys
from pathlib import Path

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import Verdict, claim, decide, eq, exact, gt, load, reals, verify
from ptproof.proof.load import claims_in, homes_of

x = sp.Symbol("x", real=True)
TRUE = claim("square", "A square", eq((x + 1) ** 2, x**2 + 2 * x + 1))(exact)
FALSE = claim("positive", "Not at 0", gt(x**2, 0), uses=[TRUE], expected="refuted")(reals)
PACKAGE = {
    "first": "from ptproof.proof import claim, eq, exact\nimport sympy as sp\nx = sp.Symbol('x', real=True)\n"
    "a = claim('a', 'one', eq(x + x, 2 * x))(exact)\n",
    "second": "from .first import a, claim, eq, exact, x\nb = claim('b', 'two', eq(x + x, 2 * x), uses=[a])(exact)\n",
    "third": "import os\nwith open(os.environ['THIRD'], 'a') as log:\n    log.write('read\\n')\n"
    "from .first import claim, eq, exact, x\nc = claim('c', 'three', eq(x, x))(exact)\n",
}


@pytest.fixture
def package(tmp_path, monkeypatch):
    monkeypatch.setenv("THIRD", str(tmp_path / "third.log"))
    folder = tmp_path / "package"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    for name, text in PACKAGE.items():
        (folder / f"{name}.py").write_text(text)
    return folder


@pytest.mark.parametrize("workers", [None, 1])
def test_claims_and_what_they_use_are_decided(workers):
    found = decide([FALSE], workers=workers)
    assert [result.claim.id for result in found.results] == ["square", "positive"]
    assert [result.verdict for result in found.results] == [Verdict.PROVED, Verdict.REFUTED]
    assert found.as_expected


def test_a_claim_over_its_time_is_undecided_here_too():
    @claim("slow", "Slow", eq(x, x))
    def slow(goal):
        while True:
            pass

    assert decide([slow], timeout=0.2).results[0].evidence[0].engine == "time limit"


def test_a_claim_that_stands_in_no_file_is_decided_here_only():
    own = claim("own", "Made in a function", eq(x, x))(exact)
    assert decide([own]).as_expected
    with pytest.raises(InputError, match="own: other processes"):
        decide([own], workers=2)


def test_two_claims_of_one_name_are_refused():
    with pytest.raises(InputError, match="stands twice"):
        decide([TRUE, claim("square", "Another", eq(x, x))(exact)])


def test_workers_read_only_the_files_of_the_claims(package):
    derivation = load([package])
    assert {id: Path(file).stem for id, file in derivation.homes.items()} == {"a": "first", "b": "second", "c": "third"}
    assert verify(derivation, select="two", workers=1).summary()["proved"] == 2
    assert Path(package.parent / "third.log").read_text() == "read\n"  # by this process


def test_claims_in_a_file_come_with_what_they_use(package):
    assert set(claims_in([str(package / "second.py")])) == {"a", "b"}


def test_homes_are_files_of_modules():
    assert homes_of([TRUE]) == {"square": sys.modules[__name__].__file__}


def test_a_cluster_decides_the_same(package):
    distributed = pytest.importorskip("distributed")
    derivation = load([package])
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        assert verify(derivation, client=client).as_expected
        assert decide([FALSE], client=client).as_expected
