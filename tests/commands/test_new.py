"""``ptproof new``: what it writes, and where it refuses to write."""

import json
import os
import subprocess
import sys

import pytest

from ptproof.commands.cli import main
from ptproof.commands.starter import FILES, write_starter
from ptproof.errors import InputError


def call(*arguments):
    with pytest.raises(SystemExit) as ended:
        main(["new", *arguments])
    return ended.value.code


def test_it_writes_a_derivation_into_a_new_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert call("my_seeker") == 0
    assert sorted(file.name for file in (tmp_path / "my_seeker").iterdir()) == sorted(FILES)
    assert os.listdir(tmp_path) == ["my_seeker"]
    assert "ptproof verify my_seeker" in capsys.readouterr().out


def test_it_fills_an_empty_folder(tmp_path):
    folder = tmp_path / "my_seeker"
    folder.mkdir()
    write_starter(folder)
    assert sorted(file.name for file in folder.iterdir()) == sorted(FILES)


def test_it_fills_the_empty_folder_that_one_stands_in(tmp_path, monkeypatch):
    (tmp_path / "my_seeker").mkdir()
    monkeypatch.chdir(tmp_path / "my_seeker")
    assert call(".") == 0
    assert sorted(os.listdir(".")) == sorted(FILES)


def test_the_name_stands_in_the_files(tmp_path):
    write_starter(tmp_path / "my_seeker")
    assert (tmp_path / "my_seeker" / "__init__.py").read_text().startswith('"""my_seeker: ')
    assert not any("@NAME@" in file.read_text() for file in (tmp_path / "my_seeker").iterdir())


def test_json_names_the_files_and_nothing_else_is_printed(tmp_path, capsys):
    folder = str(tmp_path / "my_seeker")
    assert call(folder, "--json") == 0
    assert json.loads(capsys.readouterr().out) == {"folder": folder, "files": list(FILES)}


def test_its_claims_come_out_as_expected_and_one_of_them_is_refuted(tmp_path):
    from ptproof.proof.deciding import run_one
    from ptproof.proof.load import load
    from ptproof.proof.run import conclude

    write_starter(tmp_path / "my_seeker")
    claims = load([tmp_path / "my_seeker"]).claims
    results = conclude(claims, {item.id: run_one(item) for item in claims})
    assert [str(result.verdict) for result in results] == ["refuted", "proved", "proved"]
    assert all(result.as_expected for result in results)
    assert results[0].evidence[0].witness is not None
    assert results[1].claim.corrects is results[0].claim


def test_a_corrupted_claim_does_not_come_out_as_expected(tmp_path):
    from ptproof.proof.deciding import run_one
    from ptproof.proof.load import load
    from ptproof.proof.verdict import Verdict

    write_starter(tmp_path / "my_seeker")
    file = tmp_path / "my_seeker" / "claims.py"
    file.write_text(file.read_text().replace("-k / 2 * b**2 * V", "-k * b**2 * V"))
    assert run_one(load([tmp_path / "my_seeker"]).claims[2]).verdict is Verdict.REFUTED


def test_its_problem_files_are_read(tmp_path):
    from ptproof.averaging import load_dither_system, study
    from ptproof.problem import load

    write_starter(tmp_path / "my_seeker")
    assert study(load_dither_system(tmp_path / "my_seeker" / "dither.toml")).as_expected
    assert load(tmp_path / "my_seeker" / "seeker.toml").kappa == 1


def test_its_python_is_formatted_and_clean(tmp_path):
    write_starter(tmp_path / "my_seeker")
    settings = ["--line-length", "120", "--isolated"]
    for command in (["format", "--check"], ["check", "--select", "E,F,B,UP,C4"]):
        done = subprocess.run(
            [sys.executable, "-m", "ruff", *command, *settings, str(tmp_path)],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("content", ["claims.py", ".hidden"])
def test_a_folder_that_is_not_empty_is_left_as_it_is(tmp_path, capsys, content):
    folder = tmp_path / "my_seeker"
    folder.mkdir()
    (folder / content).write_text("mine")
    assert call(str(folder)) == 2
    assert os.listdir(folder) == [content]
    assert (folder / content).read_text() == "mine"
    assert capsys.readouterr().err == (
        f"ptproof: {folder}: is not empty (it holds {content}); name a new or empty folder\n"
    )


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("my-seeker", "cannot be the name of a Python package"),
        ("3d", "cannot be the name"),
        ("class", "cannot be the name"),
        ("größe", "cannot be the name"),
        ("my seeker", "cannot be the name"),
        ("json", "is the name of a module that Python already has"),
        ("sympy", "is the name of a module that Python already has"),
        ("tests", "looks like a test"),
    ],
)
def test_a_name_that_cannot_be_a_package_is_refused(tmp_path, name, reason):
    with pytest.raises(InputError, match=reason):
        write_starter(tmp_path / name)
    assert os.listdir(tmp_path) == []


def test_a_file_a_missing_parent_and_a_dead_link_are_refused(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    for place, reason in (("file", "is a file"), ("no/my_seeker", "there is no folder"), ("link", "link to nothing")):
        with pytest.raises(InputError, match=reason):
            write_starter(tmp_path / place)


@pytest.mark.parametrize("exists", [False, True])
def test_a_failure_half_way_leaves_nothing(tmp_path, monkeypatch, exists):
    folder = tmp_path / "my_seeker"
    if exists:
        folder.mkdir()
    replace, count = os.replace, iter(range(10))

    def fail(source, target):
        if next(count) == 3:
            raise OSError(28, "No space left on device")
        replace(source, target)

    monkeypatch.setattr(os, "replace", fail)
    monkeypatch.setattr("pathlib.Path.rename", lambda *_: fail_now())
    with pytest.raises(InputError, match="No space left on device"):
        write_starter(folder)
    assert not folder.exists() or os.listdir(folder) == []
    assert [name for name in os.listdir(tmp_path) if name != "my_seeker"] == []


def fail_now():
    raise OSError(28, "No space left on device")


PAPER = "\\section{Law}\n\\[ u = -k x \\]\n\\[ k u \\le 0 \\]\n\\[ \\sup_x u = 1 \\]\n\\input{rest}\n"


def test_a_paper_becomes_a_derivation_and_what_was_not_read_is_said(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "law.tex").write_text(PAPER)
    assert call("law", "--from", "law.tex") == 0
    assert sorted(os.listdir("law")) == [
        "__init__.py",
        "notation.py",
        "notation.toml",
        "printed.toml",
        "section1_law.py",
    ]
    said = capsys.readouterr()
    assert said.out.startswith("law holds 5 files with 1 definition, 1 claim, 1 gap.")
    assert said.err.splitlines() == [
        "ptproof: law.tex inputs rest, which is not beside it; nothing of that was read",
        r"ptproof: Section 1 (3): line 4: \sup is not known",
    ]


def test_a_paper_in_json(tmp_path, capsys):
    (tmp_path / "law.tex").write_text(PAPER)
    assert call(str(tmp_path / "law"), "--from", str(tmp_path / "law.tex"), "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["counts"] == {"definition": 1, "claim": 1, "gap": 1}
    assert [(item["place"], item["line"]) for item in found["gaps"]] == [("Section 1 (3)", 4)]


@pytest.mark.parametrize(
    ("paper", "place", "reason"),
    [
        (b"\x00", "law", "is not a text file"),
        (b"", "law", "no formula is displayed"),
        (None, "law", "no such file"),
        (b"\\[ x = 1 \\]", "taken", "is not empty"),
        (b"\\[ x = 1 \\]", "json", "already has"),
    ],
)
def test_a_paper_that_is_none_and_a_folder_that_is_taken_leave_nothing(tmp_path, capsys, paper, place, reason):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "mine").write_text("")
    if paper is not None:
        (tmp_path / "law.tex").write_bytes(paper)
    before = sorted(tmp_path.rglob("*"))
    assert call(str(tmp_path / place), "--from", str(tmp_path / "law.tex")) == 2
    said = capsys.readouterr().err
    assert reason in said
    assert said.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before


def test_help_and_a_missing_argument(capsys):
    assert call("--help") == 0
    assert "DIR" in capsys.readouterr().out
    assert call() == 2
