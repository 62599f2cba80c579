"""What a proof does to its process costs that claim only, and its evidence says what happened."""

from __future__ import annotations

import os
import sys
import textwrap
import time
from pathlib import Path

import pytest
import sympy as sp

from ptproof.proof import Verdict, claim, decide, eq, exact, load, verify
from ptproof.proof.result import Verification
from ptproof.proof.run import Interrupted
from ptproof.reading.limits import apart
from ptproof.reading.system import children

PROLOGUE = """
import ctypes, mmap, os, random, signal, stat, sys, threading, time, warnings
import sympy as sp
from ptproof.proof import claim, eq, exact
x = sp.Symbol("x", real=True)

def forever():
    while True:
        pass

def in_c():
    ctypes.PyDLL(None).usleep(1_000_000)  # with the lock of the interpreter held
    in_c()

def deaf():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    forever()

def deep():
    sys.setrecursionlimit(10**8)
    class Deep:
        def __repr__(self):
            return repr([self])
    repr(Deep())

def lingering():
    if os.fork() == 0:
        os.setsid()
        time.sleep(300)

def scribble():
    for number in range(3, 100):
        try:
            if stat.S_ISSOCK(os.fstat(number).st_mode):
                os.write(number, b"x" * 99)
        except OSError:
            pass

def settings():
    import flint, mpmath
    mpmath.mp.prec = flint.ctx.prec = 5
    sys.setrecursionlimit(400)
    os.environ["PTPROOF_FAULT"] = "1"
    os.chdir("/")
    warnings.simplefilter("error")

def unsettled():
    import flint, mpmath
    assert (mpmath.mp.prec, flint.ctx.prec, sys.getrecursionlimit()) == (53, 53, LIMIT)
    assert "PTPROOF_FAULT" not in os.environ and os.getcwd() != "/"

LIMIT = sys.getrecursionlimit()

def fault(name, what):
    def prove(goal):
        exec(what, globals())
        return exact(goal)
    return claim(name, name, eq(x + x, 2 * x))(prove)

"""
PROVED = "normal form 0"
TABLE = [
    ("sys.exit(0)", "the proof called sys.exit(0)"),
    ("sys.exit('bye')", "the proof called sys.exit('bye')"),
    ("os._exit(0)", "the process ended with status 0"),
    ("os._exit(3)", "the process ended with status 3"),
    ("raise KeyboardInterrupt", "the proof raised KeyboardInterrupt"),
    ("raise GeneratorExit", "the proof raised GeneratorExit"),
    ("raise SystemExit", "the proof called sys.exit()"),
    ("raise MemoryError", "GiB of memory"),
    ("raise RecursionError('deep')", "RecursionError: deep"),
    ("raise BaseException('base')", "the proof raised BaseException: base"),
    ("input()", "EOFError"),
    ("forever()", "no answer in 1 s"),
    ("in_c()", "no answer in 1 s"),
    ("deaf()", "no answer in 1 s"),
    ("os.kill(os.getpid(), signal.SIGSTOP)", "no answer in 1 s"),
    ("ctypes.string_at(0)", "the process was ended by signal 11 (segmentation fault)"),
    ("deep()", "the process was ended by signal 11 (segmentation fault)"),
    ("os.abort()", "the process was ended by signal 6 (aborted)"),
    ("os.kill(0, 9)", "the process was ended by signal 9 (killed)"),
    ("os.kill(os.getppid(), 9); time.sleep(9)", "the proof ended the process that watched over it"),
    ("os.killpg(os.getpgid(os.getppid()), 9); time.sleep(9)", "the proof ended the process that watched over it"),
    ("os.closerange(0, 500)", "the proof closed the channel of its answer"),
    ("scribble()", "the proof wrote to the channel of its answer"),
    ("bytearray(b'x' * 2**34)", "GiB of memory"),
    ("mmap.mmap(-1, 2**34, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)", "Cannot allocate memory"),
    ("print('printed'); os.write(1, b'written'); ctypes.CDLL(None).puts(b'put')", PROVED),
    ("os.fork()", PROVED),
    ("lingering()", PROVED),
    ("threading.Thread(target=time.sleep, args=(300,)).start()", PROVED),
    ("signal.setitimer(signal.ITIMER_REAL, 0.1)", PROVED),
    ("time.sleep(0.3)", PROVED),
    ("settings()", PROVED),
    ("unsettled()", PROVED),
    ("1 / 0", "ZeroDivisionError"),
]  # fmt: skip

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot copy a process")


BEFORE: list[int] = []  # what other tests left running in this process


def _below(pid: int) -> list[int]:
    """All that come from this process."""
    found = children(pid)
    return found + [pid for child in found for pid in _below(child)]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Verification, str]:
    """All faults in one run, with a false claim among them, and what stood on standard output by the end."""
    folder = tmp_path_factory.mktemp("faults")
    made = "".join(f"f{n} = fault('{n}', {what!r})\n" for n, (what, _) in enumerate(TABLE))
    (folder / "claims.py").write_text(f"{PROLOGUE}{made}false = claim('false', 'False', eq(x, x + 1))(exact)\n")
    apart(60, pow, 2, 5)  # a process with threads keeps one from which it makes others, for all later work
    BEFORE.extend(_below(os.getpid()))
    kept = os.dup(1)
    with open(folder / "output", "w+") as output:
        os.dup2(output.fileno(), 1)
        try:
            return verify(load([folder]), workers=4, timeout=1), (folder / "output").read_text()
        finally:
            os.dup2(kept, 1)
            os.close(kept)


@pytest.mark.parametrize("number", range(len(TABLE)), ids=[what for what, _ in TABLE])
def test_a_fault_is_named_and_costs_only_its_own_claim(number: int, run: tuple[Verification, str]) -> None:
    result = next(item for item in run[0].results if item.claim.id == str(number))
    assert TABLE[number][1] in result.evidence[0].detail
    assert (result.verdict is Verdict.PROVED) == (TABLE[number][1] == PROVED)


def test_what_is_false_beside_faults_is_refuted(run: tuple[Verification, str]) -> None:
    assert next(item for item in run[0].results if item.claim.id == "false").verdict is Verdict.REFUTED
    assert not run[0].as_expected


def test_what_proofs_print_is_not_on_standard_output(run: tuple[Verification, str]) -> None:
    assert run[1] == ""


def test_no_process_is_left(run: tuple[Verification, str]) -> None:
    until = time.monotonic() + 5  # the last of them has said that it ends
    while (left := set(_below(os.getpid())) - set(BEFORE)) and time.monotonic() < until:
        time.sleep(0.01)
    assert left == set()


x = sp.Symbol("x", real=True)
HERE = [
    ("sys.exit(0)", "the proof called sys.exit(0)"),
    ("raise KeyboardInterrupt", "the proof raised KeyboardInterrupt"),
    ("raise GeneratorExit", "the proof raised GeneratorExit"),
    ("os.chdir('/'); sys.setrecursionlimit(5000); os.environ['PTPROOF_FAULT'] = '1'", PROVED),
]


@pytest.mark.parametrize(("what", "words"), HERE)
def test_in_this_process_a_proof_ends_nothing_and_leaves_its_state(what: str, words: str) -> None:
    @claim("here", "Here", eq(x + x, 2 * x))
    def here(goal):  # type: ignore[no-untyped-def]
        exec(what, {"os": os, "sys": sys})
        return exact(goal)

    before = os.getcwd(), sys.getrecursionlimit(), dict(os.environ)
    assert words in decide([here]).results[0].evidence[0].detail
    assert before == (os.getcwd(), sys.getrecursionlimit(), dict(os.environ))


def test_an_interrupt_keeps_what_is_decided() -> None:
    items = [claim(name, name, eq(x + x, 2 * x))(exact) for name in ("first", "second")]

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(Interrupted) as ended:
        decide(items, progress=stop)
    first, second = ended.value.verification.results
    assert (first.verdict, second.verdict) == (Verdict.PROVED, Verdict.UNDECIDED)
    assert second.evidence[0].engine == "interrupted"


def test_a_module_that_exits_while_it_is_read_is_bad_input_with_its_line(tmp_path: Path) -> None:
    from ptproof.errors import InputError

    (tmp_path / "claims.py").write_text(textwrap.dedent("import sys\n\nsys.exit(0)\n"))
    with pytest.raises(InputError, match=r"claims.py, line 3: the module called sys.exit\(0\)"):
        load([tmp_path])
