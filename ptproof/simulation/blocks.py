"""Systems, seekers and closed loops for other tools: python-control objects, and C code for the vehicle's computer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, Problem, example
from ptproof.problem.model import GAIN
from ptproof.problem.seekers import Feedback, unicycle
from ptproof.reading.expressions import parse
from ptproof.simulation.numbers import as_float, by_name
from ptproof.simulation.plan import Array
from ptproof.simulation.translate import to_function, translate
from ptproof.system import System


def to_control(
    target: System | Problem | str, values: Mapping[Any, Any] | None = None, *, seeker: str = "pt", frame: str = "t",
    coordinates: str = "full",
) -> Any:  # fmt: skip
    """A system, or the closed loop of a problem, as a ``control.NonlinearIOSystem`` without inputs.

    Parameters
    ----------
    target
        A :class:`System`, a :class:`Problem`, or an example's name.
    values
        The parameters by name; they become the object's ``params`` and can be overridden in a call. For a problem
        they replace its own.
    seeker, frame, coordinates
        For a problem: as for :func:`ptproof.problem.closed_loop`.

    Returns
    -------
    control.NonlinearIOSystem
        Its outputs are its states, under the system's names.

    Raises
    ------
    InputError
        If a parameter has no value, or the right-hand side can't be evaluated.

    Examples
    --------
    >>> import control, ptproof
    >>> run = ptproof.simulate("vanishing", until=0.02, samples=4)
    >>> loop = ptproof.to_control("vanishing")
    >>> response = control.input_output_response(loop, run.t, X0=run.x[:, 0], solve_ivp_method="LSODA")
    >>> bool(abs(response.states - run.x).max() < 1e-2)
    True
    """
    import control

    given = by_name(values or {})
    if not isinstance(target, System):
        problem = _problem(target)
        system = problem.closed_loop(seeker, frame, coordinates=coordinates, symbolic=True)
        given = by_name(problem.values) | given
    else:
        system = target
    names = [symbol.name for symbol in system.parameters or ()]
    if missing := [name for name in names if name not in given]:
        raise InputError(f"{system.name}: no value for {', '.join(missing)}")
    function = to_function(system)

    def update(time: float, x: Any, _: Any, params: Mapping[str, float]) -> Array:
        return np.array(function(time, x, [params[name] for name in names])).ravel()

    states = [symbol.name for symbol in system.state]
    plain = "".join(letter if letter.isalnum() else "_" for letter in system.name)
    return control.NonlinearIOSystem(
        update, None, inputs=0, outputs=states, states=states, name=plain,
        params={name: as_float(given[name], name) for name in names},
    )  # fmt: skip


def linearize_at_source(problem: Problem | str, seeker: str = "pt", time: Any = None) -> Any:
    """The average in t, linearized at the source at ``time`` (t₀ if left out), as a ``control.StateSpace``.

    Its matrix is the exact Jacobian; for the drift E∇F it is (E + K k/2) ∇²F(x*), which has to be stable for the source
    to be attractive at that gain.

    Examples
    --------
    >>> import ptproof
    >>> print(ptproof.linearize_at_source("vanishing", time="9/10").poles().real.round(2))
    [-28.74  -9.  ]
    """
    import control

    problem = _problem(problem)
    system = problem.averaged(seeker, "t")
    instant = problem.tuning.t0 if time is None else parse(time, where="time") if isinstance(time, str) else time
    at = dict(zip(system.state, problem.source, strict=True)) | {system.time: sp.sympify(instant)}
    A = np.array(system.linearization(at).evalf(17).tolist(), dtype=float)
    n = system.dimension
    names = [symbol.name for symbol in system.state]
    return control.ss(A, np.zeros((n, 0)), np.eye(n), np.zeros((n, 0)), states=names, outputs=names)


def block_diagram(problem: Problem | str, *, dilated_filter: bool = True) -> Any:
    """The prescribed-time seeker as a block diagram, from its parts, joined by ``control.interconnect``.

    The parts: the unicycle with its drift, the map F, the washout filter, the gain −k, the sum with ω, and twice
    the gain K(t). The filter's rate is multiplied by K(t), as in eq:z, so that the diagram is the closed loop; without
    ``dilated_filter`` it is the time-invariant s/(μs + 1), which it is not.

    Returns
    -------
    control.InterconnectedSystem
        With the states of the vehicle (x₁, x₂, θ) and then the filter's, and y, u1 and u2 as outputs.

    Examples
    --------
    >>> import ptproof
    >>> ptproof.simulation.block_diagram("vanishing").output_labels
    ['y', 'u1', 'u2']
    """
    import control

    problem = _problem(problem)
    letters = problem.states
    values = {symbol.name: float(value) for symbol, value in problem.values.items()}
    k, mu, omega = values["k"], values["mu"], values["omega"]
    positions = [symbol.name for symbol in problem.variables]
    measure = sp.lambdify(problem.variables, problem.field.expression, modules="numpy")
    gain = sp.lambdify(TIME, problem.seeker_clock().rate.subs(dict(problem.values)), modules="math")
    # The transfer function s/(mu s + 1) where the rate is 1, in the realisation whose state is z.
    filter_rate = gain if dilated_filter else lambda _: 1.0
    washout = control.NonlinearIOSystem(
        lambda time, z, u, _: filter_rate(time) * (u[0] - z[0]) / mu, lambda _, z, u, __: (u[0] - z[0]) / mu,
        inputs=["y"], outputs=["innovation"], states=[letters.filter.name], name="washout",
    )  # fmt: skip
    parts = [
        _vehicle(problem), washout, control.summing_junction(["turn", "omega"], "rate", name="sum"),
        _static("field", lambda _, u: measure(*u), positions, "y"),
        _static("minus_k", lambda _, u: -k * u[0], ["innovation"], "turn"),
        _static("gain_1", lambda time, u: gain(time) * u[0], ["root_omega"], "u1"),
        _static("gain_2", lambda time, u: gain(time) * u[0], ["rate"], "u2"),
        _static("root_omega", lambda _, __: omega**0.5, [], "root_omega"),
        _static("omega", lambda _, __: omega, [], "omega"),
    ]  # fmt: skip
    return control.interconnect(
        parts, inputs=[], inplist=[], outputs=["y", "u1", "u2"], outlist=["field.y", "gain_1.u1", "gain_2.u2"],
        name="seeker", warn_duplicate=False, check_unused=False,
    )  # fmt: skip


def _vehicle(problem: Problem) -> Any:
    import control

    u1, u2 = sp.symbols("u1 u2", real=True)
    # The unicycle of the seekers with its inputs left free; its filter state is not part of the vehicle.
    open_loop = unicycle(TIME, problem.drift.rate, Feedback(u1, u2, sp.S.Zero), problem.states, "unicycle")
    states = open_loop.state[:3]
    function = sp.lambdify([TIME, states, (u1, u2)], list(open_loop.rhs[:3]), modules="math")
    names = [symbol.name for symbol in states]
    return control.NonlinearIOSystem(
        lambda time, x, u, _: np.array(function(time, list(x), list(u))), lambda _, x, __, ___: x,
        inputs=["u1", "u2"], outputs=names, states=names, name="vehicle",
    )  # fmt: skip


def _static(name: str, function: Callable[[float, Any], Any], inputs: Sequence[str], output: str) -> Any:
    import control

    return control.NonlinearIOSystem(
        None, lambda time, _, u, __: np.atleast_1d(function(time, u)), inputs=list(inputs), outputs=[output], name=name
    )


def _problem(target: Problem | str) -> Problem:
    if not isinstance(target, Problem | str):
        raise InputError(f"expected a problem or an example's name, got {type(target).__name__}")
    return example(target) if isinstance(target, str) else target


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
