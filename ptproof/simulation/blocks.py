"""Systems as python-control objects, and the paper's block diagram (fig:unicycle_pt_controller) from its parts.

The diagram's washout filter s/(μs + 1) is drawn time-invariant in t, whereas eq:z scales the filter's rate by K(t).
Built from its parts, the figure as drawn is therefore not eq:closed_loop_system_t: its filter gives dy/dt, so that
θ̇ = K(ω − k dy/dt), where the equations give K(ω − k dy/dτ) = Kω − k dy/dt. With the filter run in the dilated time
(its rate multiplied by K) the two are the same. :func:`compare_figure` shows both in numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, Problem, parameters
from ptproof.problem.seekers import unicycle
from ptproof.simulation.plan import Array
from ptproof.simulation.run import simulate
from ptproof.simulation.setup import by_name
from ptproof.simulation.trajectory import Trajectory
from ptproof.simulation.translate import to_function
from ptproof.system import System


def to_control(system: System, values: Mapping[Any, Any] | None = None) -> Any:
    """The system as a ``control.NonlinearIOSystem`` without inputs, whose outputs are its states.

    ``values`` gives the parameters by name; they become the object's ``params`` and can be overridden in a call.

    Raises
    ------
    InputError
        If a parameter has no value, or the right-hand side can't be evaluated.
    """
    import control

    function = to_function(system)
    names = [symbol.name for symbol in system.parameters or ()]
    given = {name: float(value) for name, value in by_name(values or {}).items()}
    if missing := [name for name in names if name not in given]:
        raise InputError(f"{system.name}: no value for {', '.join(missing)}")

    def update(time: float, x: Any, _: Any, params: Mapping[str, float]) -> Array:
        return np.array(function(time, x, [params[name] for name in names])).ravel()

    states = [symbol.name for symbol in system.state]
    return control.NonlinearIOSystem(
        update, None, inputs=0, outputs=states, states=states, name=_name(system.name),
        params={name: given[name] for name in names},
    )  # fmt: skip


def linearize_at_source(problem: Problem, seeker: str = "pt", time: Any = None) -> Any:
    """The average in t, linearized at the source at ``time`` (t₀ if left out), as a ``control.StateSpace``.

    Its matrix is the exact Jacobian; for the drift E∇F it is (E + K k/2) ∇²F(x*), which has to be stable for the source
    to be attractive at that gain.
    """
    import control

    system = problem.averaged(seeker, "t")
    at = dict(zip(system.state, problem.source, strict=True)) | {
        system.time: problem.tuning.t0 if time is None else sp.sympify(time)
    }
    A = np.array(system.linearization(at).evalf(17).tolist(), dtype=float)
    n = system.dimension
    names = [symbol.name for symbol in system.state]
    return control.ss(A, np.zeros((n, 0)), np.eye(n), np.zeros((n, 0)), states=names, outputs=names)


def figure_loop(problem: Problem, *, dilated_filter: bool) -> Any:
    """The block diagram from its parts, joined by ``control.interconnect``.

    The parts: the unicycle with its drift, the map F, the washout filter, the gain −k, the sum with ω, and twice
    the gain K(t). With ``dilated_filter`` the filter's rate is multiplied by K(t), as in eq:z; without, it is the
    time-invariant s/(μs + 1) that is drawn.

    Returns
    -------
    control.InterconnectedSystem
        With the states of the vehicle (x₁, x₂, θ) and then the filter's, and y, u1 and u2 as outputs.
    """
    import control

    letters = problem.states
    values = {symbol.name: float(value) for symbol, value in problem.values.items()}
    gain = _scalar(problem.seeker_clock().rate, problem)
    u1, u2 = sp.symbols("u1 u2", real=True)
    vehicle = _vehicle(problem, u1, u2)
    x1, x2 = problem.variables
    measure = sp.lambdify([x1, x2], problem.field.expression, modules="numpy")
    k, mu, omega = values["k"], values["mu"], values["omega"]
    field = _static("field", lambda _, u: measure(u[0], u[1]), [x1.name, x2.name], "y")
    minus_k = _static("minus_k", lambda _, u: -k * u[0], ["innovation"], "turn")
    total = control.summing_junction(["turn", "omega"], "rate", name="sum")
    forward = _static("gain_1", lambda time, u: gain(time) * u[0], ["root_omega"], "u1")
    angular = _static("gain_2", lambda time, u: gain(time) * u[0], ["rate"], "u2")
    constants = [
        _static("root_omega", lambda _, __: omega**0.5, [], "root_omega"),
        _static("omega", lambda _, __: omega, [], "omega"),
    ]
    if dilated_filter:
        washout = control.NonlinearIOSystem(
            lambda time, z, u, _: gain(time) * (u[0] - z[0]) / mu, lambda _, z, u, __: (u[0] - z[0]) / mu,
            inputs=["y"], outputs=["innovation"], states=[letters.filter.name], name="washout",
        )  # fmt: skip
    else:
        # The transfer function that the figure shows, in the realisation whose state is z.
        washout = control.ss(
            [[-1 / mu]], [[1 / mu]], [[-1 / mu]], [[1 / mu]], inputs=["y"], outputs=["innovation"],
            states=[letters.filter.name], name="washout",
        )  # fmt: skip
    parts = [vehicle, field, washout, minus_k, total, forward, angular, *constants]
    return control.interconnect(
        parts, inputs=[], inplist=[], outputs=["y", "u1", "u2"], outlist=["field.y", "gain_1.u1", "gain_2.u2"],
        name="figure", warn_duplicate=False, check_unused=False,
    )  # fmt: skip


def washout_transfer(problem: Problem) -> Any:
    """The filter as the figure prints it: the transfer function s/(μs + 1)."""
    import control

    return control.tf([1, 0], [float(problem.tuning.mu), 1])


def _vehicle(problem: Problem, u1: sp.Symbol, u2: sp.Symbol) -> Any:
    import control

    from ptproof.problem.seekers import Feedback

    letters = problem.states
    # The unicycle of the seekers with its inputs left free; its filter state is not part of the vehicle.
    open_loop = unicycle(TIME, problem.drift.rate, Feedback(u1, u2, sp.S.Zero), letters, "unicycle")
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


def _scalar(expression: sp.Expr, problem: Problem) -> Callable[[float], float]:
    filled = expression.subs(dict(problem.values))
    function = sp.lambdify(TIME, filled, modules="math")
    return lambda time: float(function(time))


def _name(text: str) -> str:
    return "".join(character if character.isalnum() else "_" for character in text)


@dataclass(frozen=True)
class FigureComparison:
    """How far the block diagram is from eq:closed_loop_system_t.

    ``rhs_dilated`` and ``rhs_drawn`` are the largest relative differences of the right-hand sides over the points that
    were tried, with the filter in dilated time and as drawn; ``final_equations`` and ``final_drawn`` the distances
    from the source at T, and ``largest_gap`` the largest distance between the two paths.
    """

    rhs_dilated: float
    rhs_drawn: float
    final_equations: float
    final_drawn: float
    largest_gap: float


def compare_figure(problem: Problem, points: int = 50, seed: int = 0) -> FigureComparison:
    """Both readings of the figure against the closed loop: right-hand sides at random points, and the whole runs."""
    loop = problem.closed_loop("pt", "t")
    function = to_function(loop)
    drawings = [figure_loop(problem, dilated_filter=dilated) for dilated in (True, False)]
    draw = np.random.default_rng(np.random.SeedSequence(seed))
    start, T = float(problem.tuning.t0), float(problem.tuning.T)
    worst = [0.0, 0.0]
    for _ in range(points):
        time, state = start + T * draw.random(), draw.normal(size=4)
        truth = np.array(function(time, state, [])).ravel()
        for i, drawing in enumerate(drawings):
            gap = np.abs(drawing.dynamics(time, state, []) - truth) / (1 + np.abs(truth))
            worst[i] = max(worst[i], float(gap.max()))
    equations = simulate(problem, samples=2000)
    assert isinstance(equations, Trajectory)
    initial = [*(float(v) for v in problem.initial.x), float(problem.initial.theta), float(problem.measured)]
    drawn = simulate(
        drawn_loop(problem), initial=initial, span=(start, start + T), parameters=_values_of(problem), samples=2000
    )
    assert isinstance(drawn, Trajectory)
    source = np.array([float(value) for value in problem.source])
    on_grid = np.array([np.interp(equations.t, drawn.t, row) for row in drawn.x[:2]])
    return FigureComparison(
        worst[0], worst[1], equations.final_distance, float(np.linalg.norm(drawn.x[:2, -1] - source)),
        float(np.max(np.linalg.norm(on_grid - equations.x[:2], axis=0))),
    )  # fmt: skip


def drawn_loop(problem: Problem) -> System:
    """The figure as drawn, as a system: the closed loop with the filter's rate not multiplied by K(t)."""
    loop = problem.closed_loop("pt", "t", symbolic=True)
    rhs = [*loop.rhs]
    rhs[-1] = sp.cancel(rhs[-1] / problem.seeker_clock().rate)
    return System(loop.time, loop.state, tuple(rhs), name="block diagram as drawn")


def _values_of(problem: Problem) -> dict[str, float]:
    used = {symbol.name for symbol in drawn_loop(problem).parameters or ()}
    return {s.name: float(v) for s, v in problem.values.items() if s.name in used and s != parameters.p0}
