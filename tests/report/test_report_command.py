"""``ptproof report`` as a whole, with real workers."""

import pytest

from ptproof.commands import parts
from ptproof.commands.beside import Beside
from ptproof.commands.cli import main
from ptproof.report.typeset import set_part

GOOD = '''
import sympy as sp
from ptproof.proof.claim import claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq

x = sp.Symbol("x", real=True)

@claim("c/one", "A sum", eq(x + x, {right}))
def one(goal):
    """Add."""
    return exact(goal)
'''
FIGURES = """
from ptproof.report.content import Figure, Table

def figures():
    {body}
    return [Figure(name="f", caption="A figure.", content=b"<svg xmlns='http://www.w3.org/2000/svg'/>")]

def tables():
    return [Table("T", "C", ("a",), (("1",),))]
"""


def status(*arguments):
    with pytest.raises(SystemExit) as ended:
        main(["report", "--jobs", "1", *map(str, arguments)])
    return ended.value.code


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "derivation"
    folder.mkdir()
    (folder / "claims.py").write_text(GOOD.replace("{right}", "2 * x"))
    return folder


def test_a_report_is_written_and_its_place_named(folder, tmp_path, capsys):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    assert status(folder, "--out", tmp_path / "out") == 0
    files = {str(path.relative_to(tmp_path / "out")) for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert {"index.html", "report.md", "graph.svg", "figures/f.svg"} <= files
    assert str(tmp_path / "out" / "index.html") in capsys.readouterr().out
    assert str(tmp_path) not in (tmp_path / "out" / "index.html").read_text()


@pytest.fixture
def papers(folder, tmp_path):
    """Two papers in one folder: the figures of the first cannot be drawn."""
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "raise ValueError('no picture')"))
    other = tmp_path / "other"
    other.mkdir()
    (other / "claims.py").write_text(GOOD.replace("{right}", "2 * x"))
    (other / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    return folder, other


def test_several_papers_have_a_folder_each_and_a_page_above(papers, tmp_path, capsys):
    out = tmp_path / "out"
    assert status(*papers, "--out", out, "--single") == 1
    for name in ("index.html", "report.md", "derivation/index.html", "other/report.md", "other/report.html"):
        assert (out / name).is_file()
    assert (out / "other" / "figures" / "f.svg").is_file()
    assert not (out / "derivation" / "figures").exists()
    said = capsys.readouterr()
    assert "derivation: The figures could not be drawn: ValueError: no picture" in said.err
    assert "derivation: 1 claims: 1 proved" in said.out
    assert str(out / "other" / "index.html") in said.out


MANY = """
import sympy as sp
from ptproof.proof import claim, eq, exact, gt
SECTION = "1 Many"
x, y, k = sp.symbols("x y k", positive=True)
"""
SUM = " + ".join(f"{power} * x**{power} * sp.exp(y)" for power in range(2, 15))


def test_two_processes_write_the_bytes_of_one(tmp_path, monkeypatch):
    """Of few claims, which the second process sets a part of as if they were many."""
    begun, begin = [], Beside.begin

    def hear(beside, key, work, *arguments):
        begun.append(work)
        begin(beside, key, work, *arguments)

    monkeypatch.setattr(Beside, "begin", hear)
    monkeypatch.setattr(parts, "_MANY", 5)
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        said = "eq({n} * x + ({sum}), ({sum}) + {n} * x), given=[gt(x, {n})], labels=['eq:{n}']"
        claims = (f"c{n} = claim('{n}', 'No. {n}', {said.format(n=n, sum=SUM)})(exact)" for n in range(6, 9))
        (folder / "claims.py").write_text(MANY + "\n".join(claims))
        (folder / "__init__.py").touch()
        (folder / "notation.toml").write_text('letters = { x = "x", y = "y" }')
        (folder / "printed.toml").write_text("[printed]\n'eq:7' = 'y = 2 x'")
        (folder / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    written = []
    for jobs in (1, 2):
        out = tmp_path / f"out-{jobs}"
        with pytest.raises(SystemExit):
            main(["report", "--jobs", str(jobs), "--out", str(out), str(tmp_path / "one"), str(tmp_path / "two")])
        assert begun.count(set_part) == jobs - 1
        written.append({file.relative_to(out): file.read_bytes() for file in out.rglob("*") if file.is_file()})
    assert written[0] == written[1]
    assert len(written[0]) > 20


def test_a_paper_that_cannot_be_loaded_is_bad_input_and_nothing_is_written(papers, tmp_path):
    (papers[1] / "claims.py").write_text("nonsense(")
    assert status(*papers, "--out", tmp_path / "out") == 2
    assert not (tmp_path / "out").exists()


PAPER = r"\begin{document}\begin{equation} y = %s \label{eq:one} \end{equation}\end{document}"


@pytest.mark.parametrize(("printed", "ends", "word"), [("3 x", 1, "different"), ("2 x", 0, "equal")])
@pytest.mark.parametrize("kept", [True, False])
def test_the_printed_side_is_read_from_the_papers_source(folder, tmp_path, capsys, printed, ends, word, kept):
    body = GOOD.replace("x + x, {right})", 'sp.Symbol("y", real=True), 2 * x), labels=["eq:one"], expected="refuted"')
    (folder / "claims.py").write_text(body)
    (folder / "__init__.py").touch()
    (folder / "notation.toml").write_text('letters = { x = "x", y = "y" }')
    (tmp_path / "paper.tex").write_text(PAPER % printed)
    (folder / "printed.toml").write_text(f"[printed]\n'eq:one' = 'y = {printed if kept else '9 x'}'")
    paper = [] if kept else ["--paper", tmp_path / "paper.tex"]
    assert status(folder, "--out", tmp_path / "out", *paper) == ends
    assert ("c/one: what is printed is something else" in capsys.readouterr().err) is (word == "different")
    for name in ("section-claims.html", "report.md"):
        assert f"printed side read: {word}" in (tmp_path / "out" / name).read_text()
    for name in ("index.html", "report.md"):
        assert "Printed sides read by a machine" in (tmp_path / "out" / name).read_text()


def test_a_paper_that_is_not_there_is_bad_input_before_anything_runs(folder, tmp_path, capsys):
    assert status(folder, "--out", tmp_path / "out", "--paper", tmp_path / "gone.tex") == 2
    assert "gone.tex" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_what_is_unexpected_is_status_1_and_the_report_is_written(folder, tmp_path):
    (folder / "claims.py").write_text(GOOD.replace("{right}", "3 * x"))
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "not as expected" in (tmp_path / "out" / "index.html").read_text()


def test_a_figure_that_fails_is_named_and_the_report_is_written(folder, tmp_path, capsys):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "raise ValueError('no picture')"))
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "no picture" in (tmp_path / "out" / "report.md").read_text()
    assert "no picture" in capsys.readouterr().err


def test_no_figures_draws_none(folder, tmp_path):
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "raise ValueError('no picture')"))
    assert status(folder, "--out", tmp_path / "out", "--no-figures") == 0
    assert not (tmp_path / "out" / "figures").exists()


def test_a_file_as_place_is_bad_input_before_anything_runs(folder, tmp_path, capsys):
    (tmp_path / "out").write_text("mine")
    assert status(folder, "--out", tmp_path / "out") == 2
    assert "is a file" in capsys.readouterr().err
    assert (tmp_path / "out").read_text() == "mine"


def test_no_derivation_is_bad_input(tmp_path):
    assert status(tmp_path / "gone", "--out", tmp_path / "out") == 2
    assert not (tmp_path / "out").exists()


def test_the_derivation_is_known_also_where_engines_are_its_proofs(folder, tmp_path):
    direct = GOOD[: GOOD.index("@claim")] + 'one = claim("c/one", "A sum", eq(x + x, 2 * x))(exact)\n'
    (folder / "claims.py").write_text(direct)
    (folder / "__init__.py").write_text('"""A title."""')
    (folder / "figures.py").write_text(FIGURES.replace("{body}", "pass"))
    assert status(folder, "--out", tmp_path / "out") == 0
    assert "# A title" in (tmp_path / "out" / "report.md").read_text()
    assert (tmp_path / "out" / "figures" / "f.svg").exists()


def test_an_entry_of_the_notation_that_cannot_be_read_is_named_with_its_file(folder, tmp_path, capsys):
    (folder / "notation.py").write_text("NOTATION = [3]")
    assert status(folder, "--out", tmp_path / "out") == 2
    assert "notation.py: 3 in NOTATION has no symbol" in capsys.readouterr().err


def test_what_is_no_figure_is_named_and_the_report_is_written(folder, tmp_path, capsys):
    (folder / "figures.py").write_text("def figures(): return [3]")
    assert status(folder, "--out", tmp_path / "out") == 1
    assert "got 3" in capsys.readouterr().err


TOOLS = """
import sympy as sp
from ptproof.report.instruments import Instrument, Quantity, Slider, taken
from .claims import one, x

def instruments():
    {body}
    sliders = (Slider(x, 0, 2, 1),)
    yield Instrument("sum", "A sum", "", sliders, (Quantity("It", taken(one, sliders)),))
"""


@pytest.mark.parametrize(
    ("body", "expected", "said"),
    [("pass", 0, ""), ("raise ValueError('no slider')", 1, "The instruments could not be drawn: ValueError: no slider"),
     ("sp.Symbol('y').nonsense", 1, "The instruments could not be drawn: AttributeError")],
)  # fmt: skip
def test_instruments_are_brought_by_a_module_beside_the_claims(folder, tmp_path, capsys, body, expected, said):
    (folder / "instruments.py").write_text(TOOLS.replace("{body}", body))
    assert status(folder, "--no-figures", "--out", tmp_path / "out") == expected
    assert said in capsys.readouterr().err
    assert (tmp_path / "out" / "instruments.html").is_file() == (expected == 0)
