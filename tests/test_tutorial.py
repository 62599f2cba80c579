"""The tutorial, followed literally: commands in a shell, Python in one session, and what both are shown to say."""

import ast
import itertools
import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from ptproof.commands.cli import main
from ptproof.commands.starter import write_starter
from ptproof.simulation.drawing import BLUE
from tests.pictures import ink, pixels

TUTORIAL = Path(__file__).resolve().parents[1] / "TUTORIAL.md"
README = TUTORIAL.with_name("README.md")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
WRITTEN = re.compile(r"[%#] (added to )?(\S+\.(?:tex|py))")
STATUS = re.compile(r"  # exit status (\d)$")


@dataclass(frozen=True)
class Step:
    """A block that is run, and the block after it that says what comes out."""

    code: str
    shown: str
    kind: str


def steps(language, page=TUTORIAL):
    blocks = BLOCK.findall(page.read_text("utf-8"))
    for i, (kind, code) in enumerate(blocks):
        if kind == language:
            after = blocks[i + 1] if i + 1 < len(blocks) and blocks[i + 1][0] in ("text", "math") else ("", "")
            yield Step(code, after[1], after[0])


def blocks_of(part):
    """The blocks of one part of the tutorial, for a shell: commands, and what is written into files."""
    text = TUTORIAL.read_text("utf-8").partition("## From a paper's source\n")[0 if part == 1 else 2]
    blocks = BLOCK.findall(text)
    for i, (kind, code) in enumerate(blocks):
        if kind in ("sh", "latex", "py"):
            yield (
                kind,
                Step(code, blocks[i + 1][1] if blocks[i + 1 : i + 2] and blocks[i + 1][0] == "text" else "", "text"),
            )


def assert_shown(shown, output):
    """Every line of ``shown`` occurs in the output, in this order; spaces count as one, and … as anything."""
    lines = [" ".join(line.split()) for line in output.splitlines()]
    position = 0
    for line in shown.splitlines():
        pattern = re.escape(" ".join(line.split())).replace("…", ".*")
        found = next((i for i in range(position, len(lines)) if re.fullmatch(pattern, lines[i])), None)
        assert found is not None, f"the tutorial shows {line!r}, but the output is\n{output}"
        position = found + 1


def run(command, folder):
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST_", "COLUMNS"))}
    environment["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{environment['PATH']}"
    environment["COLUMNS"] = "120"
    environment["PYTEST_ADDOPTS"] = "-p no:hypothesispytest"  # seconds of imports that nothing here needs
    return subprocess.run(command, shell=True, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_every_block_is_run_or_says_what_came_out():
    kinds = [kind for kind, _ in BLOCK.findall(TUTORIAL.read_text("utf-8"))]
    assert set(kinds) == {"sh", "python", "text", "math", "latex", "py"}
    assert TUTORIAL.read_text("utf-8").count("```") == 2 * len(kinds)
    for before, kind in itertools.pairwise(kinds):
        assert kind in ("sh", "python", "latex", "py") or before in ("sh", "python")


@pytest.mark.parametrize("shown", ["one\n", "two\none\n", "on…\n…o\n", "a    b\n"])
def test_what_is_shown_is_found(shown):
    assert_shown(shown, "two\n  one\ntwo\na b\n")


@pytest.mark.parametrize("shown", ["three\n", "one\none\n", "tw\n", "two\none\n", "…\n…\n…\n"])
def test_what_is_shown_and_does_not_come_out_is_found_out(shown):
    with pytest.raises(AssertionError, match="the tutorial shows"):
        assert_shown(shown, "one\ntwo\n")


def follow(step, folder, run=run):
    """Run the commands of a block, each with its status, and hold what they print against what is shown."""
    output = ""
    for line in step.code.splitlines():
        status = STATUS.search(line)
        done = run(STATUS.sub("", line), folder)
        assert done.returncode == (int(status[1]) if status else 0), f"{line}\n{done.stdout}{done.stderr}"
        assert "Traceback" not in done.stdout + done.stderr
        output += done.stdout
    assert_shown(step.shown, output)


def write(code, folder):
    """Write a block into the file that its first line names, or add it there."""
    first, _, text = code.partition("\n")
    name = WRITTEN.fullmatch(first)
    assert name, f"{first!r} names no file"
    with (folder / name[2]).open("a" if name[1] else "x", encoding="utf-8") as file:
        file.write(("\n\n" if name[1] else "") + text)


@pytest.fixture
def here(tmp_path, monkeypatch, capfd):
    """Runs a command line in this process where it is one of ptproof's own; what it has loaded is forgotten first."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")

    def call(line, folder):
        program, *arguments = shlex.split(line)
        if program != "ptproof":
            return run(line, folder)
        for name, module in list(sys.modules.items()):
            if str(getattr(module, "__file__", None) or "").startswith(str(folder)):
                del sys.modules[name]
        with pytest.raises(SystemExit) as ended:
            main(arguments)
        return subprocess.CompletedProcess(line, int(ended.value.code or 0), *capfd.readouterr())

    return call


def test_a_derivation_from_a_papers_source(tmp_path, here):
    for kind, step in blocks_of(2):
        if kind == "sh":
            follow(step, tmp_path, here)
        else:
            write(step.code, tmp_path)
    assert ": letters guessed" not in "".join(file.read_text("utf-8") for file in tmp_path.glob("swing/*.py"))


def test_the_commands(tmp_path, here):
    """The first in a process, as all are that are not ptproof's: the others start in the same way."""
    first, *others = blocks_of(1)
    assert {kind for kind, _ in (first, *others)} == {"sh"}
    follow(first[1], tmp_path)
    for _, step in others:
        follow(step, tmp_path, here)
    for name in ("report/index.html", "report/report.md"):
        assert "The average as printed, without the factor 1/2" in (tmp_path / name).read_text("utf-8")
    assert pixels(tmp_path / "path.png").shape == (960, 1200, 3)
    assert 0.005 < ink(tmp_path / "path.png", BLUE) < 0.2


def test_the_python_of_the_readme(capsys):
    (step,) = steps("python", README)
    exec(compile(step.code, "README", "exec"), {})
    assert_shown(step.shown, capsys.readouterr().out)


def test_the_notebook(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_starter("my_seeker")
    session = {}
    for step in steps("python"):
        if re.match(r"\w+Error:", step.shown):
            with pytest.raises(Exception) as caught:  # noqa: PT011 - the tutorial says which
                evaluate(step.code, session)
            assert_shown(step.shown, f"{type(caught.value).__name__}: {caught.value}")
            continue
        value = evaluate(step.code, session)
        if step.kind == "text":
            assert_shown(step.shown, repr(value))
        elif step.kind == "math":
            assert "".join(step.shown.split()) == "".join(value.latex().split())
            assert value.latex() in value._repr_latex_()
        else:
            assert rich(value), f"{step.code} shows nothing in a notebook"


def evaluate(code, session):
    """Run a cell and return the value of its last line, as a notebook does."""
    tree = ast.parse(code)
    *before, last = tree.body
    exec(compile(ast.Module(before, []), "cell", "exec"), session)
    if not isinstance(last, ast.Expr):
        exec(compile(ast.Module([last], []), "cell", "exec"), session)
        return None
    return eval(compile(ast.Expression(last.value), "cell", "eval"), session)


def rich(value):
    """What a notebook shows instead of the text: a formula, a picture or a table."""
    for name, opening in (("_repr_png_", b"\x89PNG"), ("_repr_latex_", "$"), ("_repr_html_", "<")):
        method = getattr(value, name, None)
        if method is not None:
            shown = method()
            return shown.startswith(opening) and (name != "_repr_png_" or ink(shown, BLUE) > 0.001)
    return False
