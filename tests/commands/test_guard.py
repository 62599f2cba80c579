"""The program as a person starts it: whatever a derivation or the world does, one sentence and the right status."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

CLAIMS = """
import ctypes, os, signal, sys, threading, time
import sympy as sp
from ptproof.proof import claim, eq, exact
x = sp.Symbol("τ", real=True)
SECTION = "Größe"
{body}
good = claim("good", "true → τ", eq(x + x, 2 * x), expected="{expected}")(exact)
"""
pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot copy a process")


def write(folder: Path, body: str = "", expected: str = "proved") -> Path:
    file = folder / "claims.py"
    file.write_text(CLAIMS.format(body=body, expected=expected))
    return file


def start(*arguments: object, **options: object) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "ptproof", *map(str, arguments)]
    return subprocess.Popen(command, **{"stdout": -1, "stderr": -1, "start_new_session": True, **options})  # type: ignore[call-overload, no-any-return]


def ended(process: subprocess.Popen[bytes]) -> tuple[int, str, str]:
    out, err = process.communicate(timeout=60)
    return process.returncode, (out or b"").decode(), (err or b"").decode()


FATAL = [
    ("sys.exit(0)", "line 7: the module called sys.exit(0)"),
    ("os._exit(0)", "the process ended with status 0 while the derivation was loaded"),
    ("raise KeyboardInterrupt", "the derivation raised KeyboardInterrupt while it was loaded"),
    ("ctypes.string_at(0)", "the process was ended by signal 11 (segmentation fault) while the derivation was loaded"),
    ("os.execv('/bin/true', ['true'])", "the process ended with status 0 while the derivation was loaded"),
    ("bytearray(2**36)", "MemoryError"),
]


@pytest.mark.parametrize(("body", "words"), FATAL)
def test_a_derivation_that_ends_its_process_while_it_is_read_is_bad_input(
    body: str, words: str, tmp_path: Path
) -> None:
    status, out, err = ended(start("verify", write(tmp_path, body), "--json"))
    assert (status, out) == (2, "")
    assert words in err
    assert "Traceback" not in err


def test_what_a_derivation_prints_is_not_on_standard_output(tmp_path: Path) -> None:
    body = "print('p'); os.write(1, b'w'); os.system('echo s'); ctypes.CDLL(None).puts(b'c'); os.fork()\n"
    body += "threading.Thread(target=lambda: [print('t', flush=True) or time.sleep(0.01) for _ in range(100)]).start()"
    status, out, err = ended(start("verify", write(tmp_path, body), "--json"))
    assert (status, json.loads(out)["summary"]["proved"]) == (0, 1)
    assert "t\n" in err


@pytest.mark.parametrize(("encoding", "json_"), [("ascii", ()), ("ascii", ("--json",)), ("cp1252", ())])
def test_what_an_encoding_lacks_is_escaped_or_replaced(encoding: str, json_: tuple[str, ...], tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    process = start("verify", write(tmp_path), *json_, env=environment)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, b"")
    shown = out.decode(encoding)
    assert json.loads(shown)["claims"][0]["title"] == "true → τ" if json_ else "true ? ?" in shown


@pytest.mark.parametrize("arguments", [("new", "folder"), ("new", "folder", "--json")], ids=["text", "json"])
class TestOutput:
    """Every command writes to the same stream, so the quickest one stands for them."""

    def test_a_full_disk_is_named(self, arguments: tuple[str, ...], tmp_path: Path) -> None:
        with open("/dev/full", "w") as full:
            status, _, err = ended(start(*arguments, stdout=full, cwd=tmp_path))
        assert (status, err) == (2, "ptproof: standard output: cannot be written (No space left on device)\n")

    def test_a_reader_who_has_gone_is_no_error(self, arguments: tuple[str, ...], tmp_path: Path) -> None:
        read, written = os.pipe()
        os.close(read)
        assert ended(start(*arguments, stdout=written, cwd=tmp_path))[::2] == (0, "")
        os.close(written)

    @pytest.mark.parametrize(("closed", "status"), [("<&- >&-", 2), ("2>&-", 0), (">&- 2>&-", 2)])
    def test_a_closed_stream(self, arguments: tuple[str, ...], closed: str, status: int, tmp_path: Path) -> None:
        line = f'"$0" -m ptproof {" ".join(arguments)} {closed}'
        done = subprocess.run(["sh", "-c", line, sys.executable], capture_output=True, cwd=tmp_path, timeout=60)
        assert done.returncode == status
        assert b"Traceback" not in done.stderr
        assert (b"it is closed" in done.stderr) == (closed == "<&- >&-")


HANGS = "\n".join(
    f"""
@claim("hangs/{name}", "{name}", eq(x, x))
def hangs_{name}(goal):
    {body}
"""
    for name, body in {
        "python": "while True: pass",
        "big": "9 ** (9 ** 9)",
        "deaf": "signal.signal(2, signal.SIG_IGN); signal.signal(15, signal.SIG_IGN); time.sleep(100)",
    }.items()
)


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_the_first_interrupt_shows_what_is_decided_and_leaves_nothing_running(
    number: int, status: int, tmp_path: Path
) -> None:
    log = tmp_path / "log"
    body = HANGS.replace("(goal):", f"(goal):\n    open({str(log)!r}, 'a').write('x')")
    environment = {**os.environ, "PTPROOF_TEST_MARK": str(tmp_path)}
    process = start("verify", write(tmp_path, body), "--json", "--jobs", 2, env=environment)
    _wait(lambda: log.exists() and log.read_text() == "xx")
    process.send_signal(number)
    code, out, err = ended(process)
    assert code == status
    claims = {item["id"]: item for item in json.loads(out)["claims"]}
    assert {claims[name]["evidence"][0]["engine"] for name in claims if name != "good"} == {"interrupted"}
    assert "interrupted" in err
    _wait(lambda: not _running(str(tmp_path)))


@pytest.mark.parametrize("body", ["while True: pass", "9 ** (9 ** 9)"])
def test_an_interrupt_ends_what_hangs_while_it_is_read(body: str, tmp_path: Path) -> None:
    process = start("verify", write(tmp_path, f"print('reading', flush=True)\nn = 9\n{body.replace('9 **', 'n **')}"))
    assert process.stderr is not None
    assert process.stderr.readline() == b"reading\n"
    process.send_signal(signal.SIGINT)
    status, out, err = ended(process)
    assert (status, out, err.strip()) == (130, "", "ptproof: interrupted")


def test_a_second_interrupt_ends_at_once(tmp_path: Path) -> None:
    process = start("verify", write(tmp_path, "print('reading', flush=True)\nn = 9\nn ** (n ** n)"))
    assert process.stderr is not None
    process.stderr.readline()
    process.send_signal(signal.SIGINT)
    time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    assert ended(process)[0] == 130


def test_figures_that_end_the_process_leave_no_report_and_no_good_status(tmp_path: Path) -> None:
    write(tmp_path)
    (tmp_path / "figures.py").write_text("import os\ndef figures():\n    os._exit(0)\ndef tables():\n    return []\n")
    status, _, err = ended(start("report", tmp_path, "--out", tmp_path / "out"))
    assert status == 2
    assert "the process ended with status 0 while the report was made; none is written" in err
    assert not (tmp_path / "out").exists()


def test_figures_that_raise_an_interrupt_are_bad_input(tmp_path: Path) -> None:
    write(tmp_path)
    (tmp_path / "figures.py").write_text("def figures():\n    raise KeyboardInterrupt\n")
    status, _, err = ended(start("report", tmp_path, "--out", tmp_path / "out"))
    assert status == 2
    assert "the derivation raised KeyboardInterrupt while the report was written" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_interrupt_ends_figures_that_hang_in_another_process(jobs: int, tmp_path: Path) -> None:
    write(tmp_path)
    log = tmp_path.with_name(f"{tmp_path.name}-log")
    body = f"def figures():\n    open({str(log)!r}, 'w').close()\n    while True: pass\n"
    (tmp_path / "figures.py").write_text(body)
    environment = {**os.environ, "PTPROOF_TEST_MARK": str(tmp_path)}
    process = start("report", tmp_path, "--out", tmp_path / "out", "--jobs", jobs, env=environment)
    _wait(log.exists)
    process.send_signal(signal.SIGINT)
    status, _, err = ended(process)
    assert (status, "interrupted" in err, "Traceback" in err) == (130, True, False)
    assert not (tmp_path / "out").exists()
    _wait(lambda: not _running(str(tmp_path)))


def _wait(condition: object) -> None:
    for _ in range(600):
        if condition():  # type: ignore[operator]
            return
        time.sleep(0.05)
    pytest.fail("it did not come to that")


def _running(mark: str) -> list[str]:
    found = []
    for file in Path("/proc").glob("[0-9]*/environ"):
        try:
            found += [file.parent.name] if mark.encode() in file.read_bytes() else []
        except OSError:
            continue
    return [name for name in found if name != str(os.getpid())]
