"""The feedback law as C: compiled where there is a compiler, it computes what the symbolic law says."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, example
from ptproof.problem.model import GAIN
from ptproof.simulation.blocks import feedback_code

COMPILER = shutil.which("cc") or shutil.which("gcc")


@pytest.mark.skipif(COMPILER is None, reason="needs a C compiler, which this machine has not")
@pytest.mark.parametrize("name", ["vanishing", "saturated"])
def test_the_compiled_law_is_the_law(tmp_path, name):
    problem = example(name)
    (tmp_path / "law.c").write_text(feedback_code(problem))
    library = tmp_path / "law.so"
    subprocess.run([COMPILER, "-shared", "-fPIC", "-o", library, tmp_path / "law.c", "-lm"], check=True)
    law = ctypes.CDLL(str(library)).feedback
    states = problem.states
    own = [states.filter] if name == "vanishing" else [states.angular_velocity, states.filter]
    y, seeker = sp.Symbol("y", real=True), problem.seeker(problem.default_seeker)
    rate = problem.seeker_clock(problem.default_seeker).rate
    wanted = seeker.inputs(y, GAIN, states)
    loop = seeker.law(y, problem.drift, GAIN, states)
    outputs = [*wanted.values(), loop.rhs[loop.state.index(states.filter)]]
    outputs = [entry.subs(GAIN, rate).subs(dict(problem.values)) for entry in outputs]
    rng = np.random.default_rng(1)
    for t in (0.0, 0.3, 0.69, 0.71, 1.0, 1.5):
        values = [t, *rng.uniform(-2, 2, 1 + len(own))]
        found = (ctypes.c_double * len(outputs))()
        arguments = [ctypes.c_double(value) for value in values]
        pointers = (ctypes.POINTER(ctypes.c_double) * len(arguments))(*map(ctypes.pointer, arguments))
        size = ctypes.sizeof(ctypes.c_double)
        places = [
            ctypes.cast(ctypes.addressof(found) + i * size, ctypes.POINTER(ctypes.c_double)) for i in range(len(found))
        ]
        results = (ctypes.POINTER(ctypes.c_double) * len(found))(*places)
        assert law(pointers, results, None, (ctypes.c_double * 50)(), 0) == 0
        exact = [float(entry.subs(dict(zip((TIME, y, *own), values, strict=True)))) for entry in outputs]
        assert list(found) == pytest.approx(exact, rel=1e-9, abs=1e-9)


def test_refused():
    with pytest.raises(InputError, match=r"\[saturation\]"):
        feedback_code(example("vanishing"), "saturated")
