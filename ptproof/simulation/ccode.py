"""The feedback law as C code, for the vehicle's own computer."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import sympy as sp

from ptproof.problem import TIME, Problem
from ptproof.problem.model import GAIN
from ptproof.simulation.translate import translate


def feedback_code(problem: Problem, seeker: str | None = None) -> str:
    """C source with the function ``feedback`` of a seeker with the problem's numbers, made by CasADi.

    It takes the time t, the measured field y and the controller's states (z, and u2 for a saturated seeker), and gives
    the inputs (u1 and u2, or u1 and the angular acceleration a) and the filter's rate dz/dt: the same expressions
    that are proved about and integrated. The source needs no library but ``math.h``; its calling
    convention (pointers to arguments, results, and room to work in) is CasADi's, whose names and sizes it
    has as functions (``feedback_n_in``, ``feedback_name_in``, ``feedback_work``, …).

    Parameters
    ----------
    problem
        Its tuning, clock and clip are compiled in.
    seeker
        The problem's own if left out.

    Raises
    ------
    InputError
        For a seeker that the problem has no table for.

    Examples
    --------
    >>> from ptproof.problem import example
    >>> "int feedback(const casadi_real** arg" in feedback_code(example("vanishing"))
    True
    """
    import casadi as ca

    name = seeker or problem.default_seeker
    record, states, clock = problem.seeker(name), problem.states, problem.seeker_clock(name)
    y = sp.Symbol("y", real=True)
    loop = record.law(y, problem.drift, GAIN, states)
    wanted = dict(record.inputs(y, GAIN, states)) | {
        f"d{states.filter.name}": dict(zip(loop.state, loop.rhs, strict=True))[states.filter]
    }
    own = [state for state in loop.state if any(state in entry.free_symbols for entry in wanted.values())]
    given = dict(problem.values)
    outputs = [entry.subs(GAIN, clock.rate).subs(given) for entry in wanted.values()]
    symbols = [TIME, y, *own]
    inputs = [ca.SX.sym(symbol.name) for symbol in symbols]
    made = translate(outputs, dict(zip(symbols, inputs, strict=True)))
    function = ca.Function("feedback", inputs, made, [symbol.name for symbol in symbols], list(wanted))
    with TemporaryDirectory() as folder:
        generator = ca.CodeGenerator("feedback.c", {"with_header": False})
        generator.add(function)
        generator.generate(f"{folder}/")
        return Path(folder, "feedback.c").read_text("utf-8")
